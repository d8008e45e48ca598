"""Numbers as a person would write them: Blender keeps floats in 32 bits, angles in radians."""

import math
import struct


def plain(value: float, subtype: str = "NONE") -> float:
    """The shortest decimal number that Blender would keep as `value`; an angle comes in degrees."""
    angle = subtype == "ANGLE"
    given, wanted = math.degrees(value) if angle else value, _kept(value)
    for digits in range(6, 10):
        short = float(f"{given:.{digits}g}")
        if _kept(math.radians(short) if angle else short) == wanted:
            return short
    return given


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
