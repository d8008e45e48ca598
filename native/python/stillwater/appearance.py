"""The look of a picture, taken apart and given to another: pyramids, histograms, textures, blur along a flow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater
from .layers import _premultiplied, _straight


@dataclass(frozen=True)
class Pyramid:
    """What `steerable_pyramid` gives. A change of its arrays changes what `collapse_pyramid` makes of it.

    `bands[scale][orientation]`: scale 0 is the finest; float32, or complex64 in a complex pyramid.
    """

    highpass: NDArray[np.float32]
    bands: list[list[NDArray]]
    lowpass: NDArray[np.float32]


def steerable_pyramid(image: ArrayLike, scales: int = 4, orientations: int = 4, complex: bool = False) -> Pyramid:
    """Take a plane apart by size and orientation.

    Any size, odd ones too; level s has ceil(side / 2^s) pixels a side. Beyond its sides the plane begins anew. The
    frame is tight: squares of all coefficients, those of scale s divided by 4^s, add up to the plane's (sides that halve
    evenly).

    Args:
        image: height x width.
        scales: 1..12; the shorter side is longer than 2^scales pixels.
        orientations: 1..16; orientation b answers to gradients at pi b / orientations from x towards y (down).
        complex: with the bands' quadrature partners as imaginary parts; needs 2 orientations.

    Returns:
        The pyramid.

    Raises:
        ValueError: another shape or range than above.

    Source: Simoncelli and Freeman 1995; the coefficients are those of pyrtools' SteerablePyramidFreq (even sides; for odd
    sides its frequencies are half a step off, and it can't lead back).
    """
    plane = np.asarray(image, np.float32)
    highpass, bands, quadrature, lowpass = _stillwater.steerable_pyramid(plane, scales, orientations, complex)
    if complex:
        bands = [[re + np.complex64(1j) * im for re, im in zip(*pair, strict=True)] for pair in zip(bands, quadrature, strict=True)]
    return Pyramid(highpass, bands, lowpass)


def collapse_pyramid(pyramid: Pyramid) -> NDArray[np.float32]:
    """The plane that has this pyramid, or, after a change of its coefficients, the nearest one (least squares).

    Args:
        pyramid: from `steerable_pyramid`. Of complex bands the real parts count: they hold all that there is.

    Returns:
        height x width.

    Raises:
        ValueError: bands whose sizes don't belong together.

    Source: Simoncelli and Freeman 1995.
    """
    bands = [[np.ascontiguousarray(np.real(band), np.float32) for band in scale] for scale in pyramid.bands]
    return _stillwater.collapse_steerable(pyramid.highpass, bands, pyramid.lowpass)


def describe_histogram(reference: ArrayLike, points: int = 4096) -> _stillwater.Histogram:
    """What `match_histogram` needs of a plane, kept in at most `points` values (0 = all).

    Raises:
        ValueError: not height x width, or not finite.
    """
    return _stillwater.histogram(np.asarray(reference, np.float32), points)


def match_histogram(image: ArrayLike, reference: ArrayLike | _stillwater.Histogram) -> NDArray[np.float32]:
    """Give a plane the histogram of another: each value becomes that of the same rank.

    Monotone and smooth (values between two of the reference's are possible, so that nothing bands); equal pixels stay
    equal and take the middle of their ranks. A plane of the same size without equal pixels gets exactly the
    reference's values.

    Args:
        image: height x width, or height x width x channels, each of which is matched by itself.
        reference: of any size, with as many channels; for a plane also what `describe_histogram` gives.

    Returns:
        Of the image's shape.

    Raises:
        ValueError: another shape; a value that is not finite.

    Source: Heeger and Bergen 1995, 3.
    """
    plane = np.asarray(image, np.float32)
    if isinstance(reference, _stillwater.Histogram):
        return _stillwater.match_histogram(plane, reference)
    wanted = np.asarray(reference, np.float32)
    if plane.ndim == 2 and wanted.ndim == 2:
        return _stillwater.match_histogram(plane, describe_histogram(wanted, 0))
    if plane.ndim != 3 or wanted.ndim != 3 or plane.shape[2] != wanted.shape[2]:
        raise _stillwater.BadInput(f"reference: an array of shape {wanted.shape} is not of as many channels as {plane.shape}")
    channels = [match_histogram(plane[..., c], wanted[..., c]) for c in range(plane.shape[2])]
    return np.stack(channels, axis=2)


def describe_texture(
    picture: ArrayLike,
    grid: tuple[int, int] | None = None,
    scales: int | None = None,
    orientations: int = 4,
    matching: Literal["steerable", "laplacian"] = "steerable",
) -> _stillwater.TextureTarget:
    """What `match_texture` needs of a picture, so that it is found once for many frames. Arguments as there."""
    across, down = (0, 0) if grid is None else grid
    if grid is not None and min(across, down) < 1:
        raise _stillwater.BadInput(f"grid: {across} x {down} is not at least one cell across and down")
    return _stillwater.TextureTarget(_premultiplied(picture), (across, down), scales or 0, orientations, matching)


def match_texture(
    frame: ArrayLike,
    picture: ArrayLike | _stillwater.TextureTarget,
    grid: tuple[int, int] | None = None,
    repetitions: int = 3,
    matching: Literal["steerable", "laplacian"] = "steerable",
    stylize: float = 1.0,
    scales: int | None = None,
    orientations: int = 4,
) -> NDArray[np.float32]:
    """Give a frame the texture of a picture: the histograms of its pyramid's bands and of its pixels, place by place.

    Colours are matched along the principal axes of the picture's colours. Cells share one pyramid of the whole frame,
    and their statistics run into each other: no cell has a border. Pixels count as much as they are seen (alpha).

    Args:
        frame: height x width x 3 or 4, display-referred, straight alpha (which stays). At least 16 px a side.
        picture: the same, of any size, or what `describe_texture` gave; then `grid`, `matching`, `scales` and
            `orientations` are those given there.
        grid: cells (across, down), each at least 8 px a side; None = cells of about 55 px. 1 x 1: one texture everywhere.
        repetitions: 1..50, of the pyramid's matching.
        matching: "steerable", or "laplacian", which is quick and knows no orientations.
        stylize: 0 (the frame) .. 1 (matched).
        scales: of the pyramid; None = 4, fewer where a cell would have less than 4 coefficients a side.
        orientations: 1..16.

    Returns:
        height x width x 4.

    Raises:
        ValueError: another shape, size or range than above.

    Source: Heeger and Bergen 1995; Okabe et al. 2009, 4.
    """
    if not isinstance(picture, _stillwater.TextureTarget):
        picture = describe_texture(picture, grid, scales, orientations, matching)
    return _straight(_stillwater.match_texture(_premultiplied(frame), picture, repetitions, stylize))


def motion_blur(
    picture: ArrayLike, velocity: ArrayLike, shutter: float = 0.2, fps: float = 24.0, average_blur: float = 8.0
) -> NDArray[np.float32]:
    """What a flowing picture looks like on average: blurred along the flow, then by a Gaussian.

    Args:
        picture: height x width x 3 or 4, display-referred, straight alpha.
        velocity: height x width x 2, (x, y), pixels per frame.
        shutter: seconds, 0..10, half of them before and half after.
        fps: frames per second, 1..1000.
        average_blur: sigma of the Gaussian, px, 0..1000.

    Returns:
        height x width x 4, straight alpha.

    Raises:
        ValueError: sizes differ, numbers are not finite or out of range, a path is longer than 4096 px.

    Source: Okabe et al. 2009, 4 (approximated average).
    """
    field = np.asarray(velocity, np.float32)
    return _straight(_stillwater.motion_blur(_premultiplied(picture), field, shutter, fps, average_blur))
