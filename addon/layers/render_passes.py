"""Object Index and Cryptomatte passes of an OpenEXR file that Blender, or another renderer, wrote."""

import json

import bpy
import numpy as np
from bpy.app.translations import pgettext_rpt as rpt_

from . import label_maps

INDICES = ("IndexOB", "Object Index", "IndexMA", "Material Index")  # 4.5 and 5.2 name them each in its way
CRYPTOMATTE = "cryptomatte/"


def read(path: str) -> label_maps.LabelMap:
    """The first Cryptomatte of a file, else its first index pass. Throws ValueError with a sentence."""
    channels, facts = _read_file(path)
    for key in sorted(name for name in facts if name.startswith(CRYPTOMATTE) and name.endswith("/name")):
        ranks = _ranks(channels, facts[key])
        if ranks:
            manifest = facts.get(key.removesuffix("name") + "manifest", "{}")
            return label_maps.from_cryptomatte(ranks, _manifest(manifest))
    for name, plane in channels.items():
        if any(f".{index}." in f".{name}" for index in INDICES):
            return label_maps.from_index(plane)
    raise ValueError(rpt_("{path}: has neither an Object Index nor a Cryptomatte pass").format(path=path))


def _ranks(channels: dict, name: str) -> list[tuple[np.ndarray, np.ndarray]]:
    """Ids and coverage of a Cryptomatte: NAME00.r, .g, .b, .a and so on hold two ranks each."""
    found, lower = [], {channel.lower(): plane for channel, plane in channels.items()}
    for level in range(100):
        parts = [lower.get(f"{name}{level:02d}.{letter}".lower()) for letter in "rgba"]
        if any(part is None for part in parts):
            break
        found += [(parts[0], parts[1]), (parts[2], parts[3])]
    return found


def _manifest(text: str) -> dict[str, str]:
    try:
        read = json.loads(text)
        return {str(name): digits for name, digits in read.items() if int(digits, 16) >= 0}
    except (ValueError, TypeError, AttributeError):
        return {}  # names are only for people


def _read_file(path: str) -> tuple[dict[str, np.ndarray], dict[str, str]]:
    """Every channel of a file, height x width, and what it says besides."""
    try:
        if bpy.app.module:
            bpy.utils.expose_bundled_modules()
        import OpenImageIO as oiio
    except ImportError as error:
        sentence = "This Blender has no OpenImageIO to read passes with; use one from blender.org"
        raise ValueError(rpt_(sentence)) from error
    file = oiio.ImageInput.open(path)
    if file is None:
        raise ValueError(rpt_("{path}: can't be read ({why})").format(path=path, why=oiio.geterror()))
    channels, facts, part = {}, {}, 0
    while file.seek_subimage(part, 0):
        spec = file.spec()
        pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise ValueError(rpt_("{path}: can't be read ({why})").format(path=path, why=file.geterror()))
        channels |= {name: pixels[..., i] for i, name in enumerate(spec.channelnames)}
        facts |= {item.name: item.value for item in spec.extra_attribs if isinstance(item.value, str)}
        part += 1
    file.close()
    return channels, facts
