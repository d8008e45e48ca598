"""A clip of a fluid taken apart, so that a picture can flow like it."""

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from . import _stillwater as engine
from .render.clips import read_frames, take_apart

__all__ = ["ClipAnalysis", "analyse", "read_analysis", "reconstruct", "write_analysis"]


@dataclass(frozen=True)
class ClipAnalysis:
    """What a clip is made of (METHODS.md 2).

    Attributes:
        average: height x width x 3, the mean frame A, display-referred.
        velocity: height x width x 2, the mean flow v of what moves, px/frame, x right, y down.
        residuals: frames x height x width x 3, float16: the first is D_0 = F_0 - A, the others what the flow does not
            predict from the frame before.
        energy: height x width, mean square of the residuals' luma around each place.
        fps: frames per second, those that repeat another left out; 0 where the file does not say.
        moving: height x width x 3, share of what is seen around each place that moves, of detail finer than 1.5, 4 and 10 px.
        reach: px, the distance over which residuals are alike.
        explained: share of the differences' energy that the flow predicts from frame to frame, at most 1; below 0 the flow
            says less than none would.
        warnings: what is odd about the clip, a sentence each.
    """

    average: NDArray[np.float32]
    velocity: NDArray[np.float32]
    residuals: NDArray[np.float16]
    energy: NDArray[np.float32]
    moving: NDArray[np.float32]
    fps: float
    reach: float
    explained: float
    warnings: list[str] = field(default_factory=list)


def analyse(
    clip: str | os.PathLike[str],
    frames: tuple[int, int] | None = None,
    flow: Literal["dense", "features"] = "dense",
    quality: Literal["fast", "medium", "best"] = "medium",
    steady: bool = False,
    memory: float = 1200.0,
    progress: Callable[[str, float], bool] | None = None,
) -> ClipAnalysis:
    """Take a clip apart into its average, mean flow and residuals.

    Frames that repeat the one before are left out. What does not fit into the memory is made smaller. Both are said in
    `warnings`, and so is a picture that moves as a whole (a camera that moves).

    Args:
        clip: the file: anything that `read_clip` reads.
        frames: first and last, both taken, counted from 1; None is the whole clip. At least 3.
        flow: "dense" finds it everywhere; "features" follows 100 corners a frame and spreads their mean, as published.
        quality: of the dense flow, as `optical_flow` has it.
        steady: takes the camera's shake out first.
        memory: MB that the clip may need while it is taken apart.
        progress: called with what is being done and its share 0..1; answers False to cancel.

    Raises:
        OSError: the file is missing, not a clip, or can't be decoded.
        ValueError: frames out of range, nothing that moves, too few MB.
        stillwater.Cancelled: `progress` answered False.

    Source: Okabe et al. 2009, 3.
    """
    tell = progress or (lambda phase, share: True)

    def reading(share: float) -> None:
        if not tell("reading the clip", share):
            raise engine.Cancelled("cancelled")

    read = read_frames(os.fspath(clip), frames, memory * 1e6, reading)
    found = take_apart(read, flow, quality, steady, tell)
    return ClipAnalysis(  # fmt: skip
        found.average, found.velocity, read.frames, found.energy, found.moving, read.fps, found.reach,
        found.explained, read.warnings,
    )


def reconstruct(analysis: ClipAnalysis, moment: float, life: int = 16, fade: float = 0.0) -> NDArray[np.float32]:
    """A frame of the clip from its residuals, each carried along the mean flow since it came.

    Args:
        analysis: of the clip.
        moment: frames since the clip's first one, 0 or more; between two frames it is a mixture of both.
        life: frames after which a residual is gone, 1..1000. With the clip's whole length the frame itself comes back.
        fade: over which share of its life a residual goes, 0..1; 0: all at once at its end, as published.

    Returns:
        height x width x 3, display-referred.

    Raises:
        ValueError: numbers out of range.

    Source: Okabe et al. 2009, 3: D_i as a sum of W^(i-k-1)(R_k).
    """
    height, width = analysis.velocity.shape[:2]
    own = engine.identical_map((width, height))
    carried = engine.CarriedResiduals(analysis.residuals, own, analysis.velocity, life, fade, endless=False, mirrored=False)
    return analysis.average + carried.at(float(moment))


def write_analysis(path: str | os.PathLike[str], analysis: ClipAnalysis) -> None:
    """Write an analysis as a compressed .npz file; it appears under its name only when it is whole.

    Raises OSError where it can't be written, ValueError for another ending.
    """
    place = os.fspath(path)
    if not place.lower().endswith(".npz"):
        raise engine.BadInput(f"{place}: its ending is not .npz")
    aside = engine.temporary_name(os.path.abspath(place))
    kept = engine.TemporaryFile(aside)
    with open(aside, "wb") as file:
        np.savez_compressed(file, **{name: getattr(analysis, name) for name in analysis.__dataclass_fields__})
    kept.keep_as(place)


def read_analysis(path: str | os.PathLike[str]) -> ClipAnalysis:
    """Read what `write_analysis` wrote. Raises OSError where the file is missing, ValueError where it is something else."""
    place = os.fspath(path)
    try:
        with np.load(place) as file:
            arrays = {name: file[name] for name in ClipAnalysis.__dataclass_fields__}
    except (KeyError, ValueError, EOFError) as error:
        raise engine.BadInput(f"{place}: not the analysis of a clip ({error})") from None
    numbers = {name: float(arrays.pop(name)) for name in ("fps", "reach", "explained")}
    return ClipAnalysis(warnings=[str(sentence) for sentence in arrays.pop("warnings")], **numbers, **arrays)
