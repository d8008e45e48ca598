"""Numbers as a person would write them: Blender keeps floats in 32 bits, angles in radians."""

import math
import struct

import numpy as np

DIGITS = range(6, 10)  # of a decimal number: 9 tell any two numbers of 32 bits apart
EXACT = 22  # 10 to this power is a number of 64 bits, exactly


def plain(value: float, subtype: str = "NONE") -> float:
    """The shortest decimal number that Blender would keep as `value`; an angle comes in degrees."""
    angle = subtype == "ANGLE"
    given, wanted = math.degrees(value) if angle else value, _kept(value)
    for digits in DIGITS:
        short = float(f"{given:.{digits}g}")
        if _kept(math.radians(short) if angle else short) == wanted:
            return short
    return given


def plain_all(values: np.ndarray, subtype: str = "NONE") -> list[float]:
    """plain() of each of many numbers.

    A whole number divided or multiplied by an exact power of ten is rounded as the decimal number itself would be.
    """
    values = np.asarray(values, np.float64)
    angle = subtype == "ANGLE"
    given, wanted = np.degrees(values) if angle else values, values.astype(np.float32)
    with np.errstate(divide="ignore", invalid="ignore"):
        places = np.floor(np.log10(np.abs(given)))
    written = given.copy()
    left = np.flatnonzero(np.abs(places) < EXACT - DIGITS[-1])
    others = np.setdiff1d(np.arange(given.size), left)
    for digits in DIGITS:
        move = digits - 1 - places[left]
        up, down = 10.0 ** np.maximum(move, 0), 10.0 ** np.maximum(-move, 0)
        short = np.rint(given[left] * up / down) / up * down
        same = (np.radians(short) if angle else short).astype(np.float32) == wanted[left]
        written[left[same]] = short[same]
        left = left[~same]
    written[others] = [plain(value, subtype) for value in values[others].tolist()]  # 0, or further than EXACT
    return written.tolist()


def kept(value: float, subtype: str = "NONE") -> float:
    """The other way: what a property of this subtype is set to."""
    return math.radians(value) if subtype == "ANGLE" else value


def _kept(value: float) -> bytes:
    return struct.pack("f", value)


def over_time(values: list, first: int):
    """An animated number of the recipe: one value where it never changes, else a value for each frame."""
    if all(value == values[0] for value in values):
        return values[0]
    return {"first": first, "values": values}
