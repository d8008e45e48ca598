"""Pictures and clips in and out as arrays, and the sRGB curve.

Arrays are float32, rows top to bottom, display-referred (sRGB curve, 1 is white, not clamped above), with straight
alpha. Files are converted where they are read and written.
"""

from __future__ import annotations

import os
import warnings

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _stillwater as engine

Array = NDArray[np.float32]


def read(path: str | os.PathLike[str], colour_space: str = "auto") -> Array:
    """Read a picture.

    Anything OpenImageIO reads: PNG, JPEG (turned as its EXIF orientation says), TIFF, OpenEXR, PSD, Radiance HDR, ...
    grey or colours, with or without alpha.

    Args:
        path: the file.
        colour_space: how the file's numbers are meant, "srgb" or "linear"; "auto" is linear for OpenEXR and
            Radiance HDR files and sRGB for all others.

    Returns:
        height x width x 4: red, green, blue, straight alpha (1 where the file has none). Where alpha is 0 so is the
        colour.

    Raises:
        OSError: the file is missing, a folder, empty, not a picture, cut short, or may not be read.
        ValueError: an unknown colour space, or a picture of more than 16384 pixels a side.

    Warns:
        UserWarning: pixels that are not finite numbers; their colour is 0.

    Source: sRGB, IEC 61966-2-1:1999, section 5.2.
    """
    picture = engine.read_picture(os.fspath(path), engine.colour_space_named(colour_space))
    if sentence := bad_pixels_sentence(path, picture.bad_pixels):
        warnings.warn(sentence, stacklevel=2)
    return _straight(picture.image)


def bad_pixels_sentence(path: str | os.PathLike[str], count: int) -> str:
    """What an artist is told of pixels that are not finite numbers; empty where there are none."""
    if not count:
        return ""
    if count == 1:
        return f"{os.fspath(path)}: 1 pixel is not a finite number and counts as 0"
    return f"{os.fspath(path)}: {count} pixels are not finite numbers and count as 0"


def write(path: str | os.PathLike[str], image: ArrayLike, *, bits: int | None = None) -> None:
    """Write a picture; the file's extension says how (.png, .jpg, .tif, .exr).

    PNG, JPEG and TIFF are display-referred, clamped to 0..1; OpenEXR is scene-linear Rec.709, premultiplied. A JPEG has
    no alpha: the picture lies over black. The file appears under its name only when it is whole.

    Args:
        path: the file.
        image: height x width x 3 or 4, display-referred, straight alpha 0..1.
        bits: of a channel. PNG 8 or 16, JPEG 8, TIFF 8, 16 or 32 (float), OpenEXR 16 (half) or 32 (float); None is the
            first of these.

    Raises:
        OSError: the file can't be written (folder missing or not writable, disk full).
        ValueError: another shape, extension or number of bits.

    Source: sRGB, IEC 61966-2-1:1999, section 5.2.
    """
    pixels = np.asarray(image, np.float32)
    if pixels.ndim == 3 and pixels.shape[2] == 3:
        pixels = np.concatenate([pixels, np.ones_like(pixels[..., :1])], axis=2)
    if pixels.ndim == 3 and pixels.shape[2] == 4:
        pixels = np.concatenate([pixels[..., :3] * pixels[..., 3:], pixels[..., 3:]], axis=2)
    engine.write_picture(os.fspath(path), pixels, 0 if bits is None else bits)


def read_clip(
    path: str | os.PathLike[str], frames: tuple[int, int] | None = None, size: tuple[int, int] | None = None
) -> Array:
    """Read frames of a clip, through FFmpeg. One frame at a time is decoded.

    Args:
        path: the file: anything that FFmpeg reads (.mp4, .mov, .mkv, .webm, .avi, ...).
        frames: first and last, both read, counted from 1; None is the whole clip.
        size: (width, height) in pixels; None is the clip's. Smaller ones are averaged over areas.

    Returns:
        frames x height x width x 3, display-referred; what is transparent lies over black.

    Raises:
        OSError: the file is missing, not a clip, or can't be decoded.
        ValueError: frames backwards or outside the clip, or a size outside 1 .. 16384 pixels a side.
    """
    clip = engine.Clip(os.fspath(path))
    first, last = frames or (1, clip.frames)
    if last < first:
        raise engine.BadInput(f"frames: {first} to {last} is not a range (first, last)")
    for number in (first, last):
        if not 1 <= number <= clip.frames:
            raise engine.BadInput(f"frames: {number} is not between 1 and {clip.frames}")
    width, height = size or (clip.width, clip.height)
    start = clip.frame(first, width, height)
    read_frames = np.empty((last - first + 1, *start.shape), np.float32)
    read_frames[0] = start
    for number in range(first + 1, last + 1):
        read_frames[number - first] = clip.frame(number, width, height)
    return read_frames


def read_flow(path: str | os.PathLike[str]) -> Array:
    """Read a flow field.

    Args:
        path: the file; .flo (Middlebury), or .exr with channels X and Y, or those of a layer (NAME.X, NAME.Y), as the frames
            that `render` writes have; other channels are ignored. What a .flo file marks as unknown counts as 0.

    Returns:
        height x width x 2, px/frame, x right, y down.

    Raises:
        OSError: the file is missing, a folder, empty, not a flow, cut short, or may not be read.
        ValueError: another extension, no such channels, or numbers that are not finite.

    Source: Baker et al. 2011, "A database and evaluation methodology for optical flow" (.flo).
    """
    return engine.read_flow(os.fspath(path))


def write_flow(path: str | os.PathLike[str], flow: ArrayLike) -> None:
    """Write a flow field, as .flo (Middlebury) or as .exr with channels X and Y; floats. What `read_flow` reads.

    Args:
        path: the file; its extension says how.
        flow: height x width x 2, px/frame, x right, y down.

    Raises:
        OSError: the file can't be written.
        ValueError: another shape or extension.

    Source: Baker et al. 2011, "A database and evaluation methodology for optical flow" (.flo).
    """
    engine.write_flow(os.fspath(path), flow)


def srgb_to_linear(a: ArrayLike) -> Array:
    """Display-referred numbers to scene-linear ones, by the sRGB curve.

    Not clamped: above 1 the curve goes on, negative numbers are mirrored. Within 1e-6 of the exact value, relatively.

    Args:
        a: numbers, any shape.

    Returns:
        The same shape, float32.

    Source: IEC 61966-2-1:1999, section 5.2, equations 5 and 6.
    """
    return engine.srgb_to_linear(a)


def linear_to_srgb(a: ArrayLike) -> Array:
    """Scene-linear numbers to display-referred ones: the inverse of srgb_to_linear, with the same rules.

    Args:
        a: numbers, any shape.

    Returns:
        The same shape, float32.

    Source: IEC 61966-2-1:1999, section 5.2, equations 9 and 10.
    """
    return engine.linear_to_srgb(a)


def _straight(premultiplied: Array) -> Array:
    alpha = premultiplied[..., 3:]
    if (alpha == 1).all():
        return premultiplied
    colour = np.divide(premultiplied[..., :3], alpha, out=np.zeros_like(premultiplied[..., :3]), where=alpha > 0)
    return np.concatenate([colour, alpha], axis=2)
