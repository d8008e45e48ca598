"""What a layer that flows like a clip needs beside its pixels, each a preparation of its own:

    clip taken apart -> where each place of the layer takes its residuals from -> what makes them look like the picture

A stroke that is changed leaves the clip alone; a number of the look leaves both.
"""

from collections.abc import Callable

import msgspec
import numpy as np

from .. import _stillwater as engine
from ..recipe import Document, RecipeError
from ..recipe.fluids import Example
from .cache import Prepared
from . import clips
from .filming import ExampleTrack, Pace
from .hashing import hashed
from .keys import ENGINES, look_facts
from .lock import as_progress

MEMORY = 1.2e9  # bytes that a clip may need while it is taken apart


class Film(msgspec.Struct, frozen=True):
    """A film as keys know it: the clip's digest, and the recipe's words on it."""

    clip: str
    fields: tuple[str, ...]
    motion: str  # digest of all that does not change from frame to frame
    transfer: str
    taken: tuple[int, int] | None
    steady: bool
    fps: float
    over_loop: float | None


def film_of(track: ExampleTrack, clip: str, fps: float) -> Film:
    """`clip`: the digest of its file."""
    example = track.example
    transfer = hashed([example.transfer, example.clip_scale])
    return Film(clip, tuple(track.paintings), hashed(look_facts(example)), transfer, example.clip_frames, example.clip_steady, fps, track.over_loop)


def clip_key(film: Film) -> str:
    facts = {"clip": film.clip, "frames": film.taken, "steady": film.steady, "memory": MEMORY}
    return hashed({**facts, "engine": [ENGINES["example"], ENGINES["clip"]]})


def transfer_key(layers: str, index: int, film: Film) -> str:
    return hashed({"transfer": [layers, index, clip_key(film), film.fields, film.transfer], "flow": ENGINES["flow"]})


def look_key(layers: str, index: int, film: Film, scale: float) -> str:
    facts = [transfer_key(layers, index, film), film.motion, film.fps, film.over_loop, min(1.0, scale)]
    return hashed({"look": facts, "appearance": ENGINES["appearance"]})


def take_apart(document: Document, example: Example, place: str, beat: Callable[[], None]) -> Prepared:
    """The clip. Arrays average, velocity, energy, moving, residuals; facts fps, reach, explained, warnings. Throws RecipeError."""

    try:
        clip = clips.read_frames(str(document.locate(example.clip)), example.clip_frames, MEMORY, lambda share: beat())
        found = clips.take_apart(clip, "dense", "medium", example.clip_steady, as_progress(beat))
    except engine.BadInput as error:
        raise RecipeError(f"{place}.{error}") from None
    except engine.FileError as error:
        raise RecipeError(f"{place}.clip: {error}") from None
    if len(clip.frames) <= example.life:
        raise RecipeError(f"{place}.life: {example.life} is not below the clip's {len(clip.frames)} frames")
    arrays = {"average": found.average, "velocity": found.velocity, "energy": found.energy, "moving": found.moving, "residuals": clip.frames}
    facts = {"fps": clip.fps, "reach": found.reach, "explained": found.explained, "warnings": clip.warnings}
    return Prepared(arrays, facts)


def transfer(fields: list[np.ndarray], clip: Prepared, example: Example, place: str) -> Prepared:
    """Where the layer takes its residuals from: array patches. Throws RecipeError."""
    velocity = np.mean([np.asarray(field) for field in fields], axis=0)
    try:
        patches = engine.match_patches(velocity, clip.arrays["velocity"], clip.arrays["energy"], _transfer_parameters(example))
    except engine.BadInput as error:
        raise RecipeError(f"{place}.transfer.{error}") from None
    return Prepared({"patches": patches}, {})


def setup(
    track: ExampleTrack, fields: list[np.ndarray], clip: Prepared, patches: Prepared, box: tuple, freeze, fps: float, matched: bool
) -> engine.ExampleSetup:
    """What the engine makes the film of. `box`: the layer's, in the picture; `freeze`: of the box, or None; `matched`: its
    texture to the picture's."""
    example, pace = track.example, pace_of(track, clip, fps)
    grid = example.grid or (0, 0)
    look = engine.LookParameters(
        shutter=example.shutter, fps=fps, average_blur=example.average_blur, grid=tuple(grid), repetitions=example.repetitions,
        matching=example.matching, stylize=example.stylize if matched else 0.0,
    )  # fmt: skip
    strokes = [
        engine.CloneStroke(stroke.source, [(x - box[0], y - box[1]) for x, y in stroke.target], stroke.width, stroke.alpha)
        for stroke in example.transfer.strokes
    ]
    return engine.ExampleSetup(
        residuals=clip.arrays["residuals"],
        patches=patches.arrays["patches"],
        strokes=strokes,
        transfer=_transfer_parameters(example),
        reach=clip.facts["reach"],
        moving=clip.arrays["moving"],
        velocities=[np.asarray(field) / np.float32(pace.steps) for field in fields],
        freeze=freeze,
        life=example.life,
        endless=example.endless,
        period=pace.period,
        look=look,
    )


def pace_of(track: ExampleTrack, clip: Prepared, fps: float) -> Pace:
    return Pace.of(track, clip.facts["fps"], len(clip.arrays["residuals"]), fps)


def make_look(plates: Callable[[], engine.LayerPlates], beat: Callable[[], None], place: str) -> Prepared:
    """What makes residuals look like the picture. `plates` makes the layer ready, without a look. Throws RecipeError."""

    try:
        look = engine.make_look(plates(), as_progress(beat))
    except engine.BadInput as error:
        raise RecipeError(f"{place}.{error}") from None
    numbers, lengths, pixels = look.curves
    return Prepared({"base": look.base, "slope": look.slope, "hold": look.hold, "numbers": numbers}, {"lengths": lengths, "pixels": pixels})


def look_of(prepared: Prepared) -> engine.ExampleLook:
    arrays, facts = prepared.arrays, prepared.facts
    return engine.ExampleLook(arrays["base"], arrays["slope"], arrays["hold"], arrays["numbers"], facts["lengths"], facts["pixels"])


def _transfer_parameters(example: Example) -> engine.TransferParameters:
    moved = example.transfer
    return engine.TransferParameters(
        patch=moved.patch, clip_scale=example.clip_scale, best_last=moved.order == "best-last"
    )
