"""A recipe that uses every field that Blender's properties have, with values that are nobody's default."""

import json
from pathlib import Path

import bpy

FOLDER = Path(__file__).parent


def whole() -> dict:
    """One layer of each motion, each form of matte and fill."""
    keyed = lambda *values: {"first": -1, "values": list(values)}  # noqa: E731
    return {
        "stillwater": 1,
        "picture": "picture.png",
        "colour_space": "linear",
        "size": [32, 16],
        "frames": [3, 6],
        "fps": 23.976,
        "seed": 12,
        "loop": True,
        "wind": {"speed": keyed(3, 4.5, 7), "direction": keyed(10, 20, 35.5), "gusts": 0.3,
                 "gust_size": 0.4, "seed": 5},
        "view": {"horizon": [[-10.5, 4], [30, 6.25]], "fov": 65, "height": 2.6},
        "layers": [
            {
                "name": "tree",
                "visible": False,
                "opacity": keyed(0.2, 0.6),
                "feather": 1.5,
                "matte": {"file": "matte.png", "channel": "R"},
                "fill": {"file": "behind.png"},
                "motion": {
                    "type": "sway", "armature": [[4, 8], [5.5, -3]], "frequency": keyed(0.7, 0.8), "mass": 2,
                    "damping": 0.3, "amount": keyed(1.5, 2), "foreshortening": 0.25, "shimmer": 0.75, "seed": 9,
                },
            },
            {
                "name": "boat",
                "matte": {"labels": "labels.png", "value": 3},
                "fill": {"method": "none"},
                "motion": {"type": "bob", "waterline": [[2, 6], [4, 6.5], [9, 6]], "water": "lake", "amount": 0.8},
            },
            {
                "name": "reflection",
                "matte": {"labels": "labels.png", "value": 4},
                "follows": {"layer": "boat", "mirror": True},
            },
            {
                "name": "lake",
                "matte": {"labels": "labels.png", "value": 5},
                "motion": {
                    "type": "ripple", "amplitude": keyed(0.5, 0.75), "roughness": 3, "tile": 80, "resolution": 512,
                    "mode": "normal", "spectrum": "tma", "fetch": 20, "depth": 15, "seed": 4,
                },
            },
            {
                "name": "clouds",
                "matte": {"labels": "labels.png", "value": 6},
                "motion": {"type": "drift", "velocity": keyed([1, 0], [1.5, -0.5])},
            },
            {"name": "haze", "matte": {"labels": "labels.png", "value": 7}, "motion": {"type": "drift", "wind": 0.125}},
            {"name": "sky"},
        ],
        "output": {
            "folder": "made", "name": "lake", "depth": "float", "compression": "piz", "layers": True, "scale": 0.5,
        },
    }


def write(folder: Path, recipe: dict) -> Path:
    """Writes the recipe and a picture of 32 x 16 beside it; returns the recipe's path."""
    folder.mkdir(parents=True, exist_ok=True)
    image = bpy.data.images.new("picture", 32, 16)
    image.pixels = [0.25, 0.5, 0.75, 1.0] * (32 * 16)
    image.filepath_raw, image.file_format = str(folder / "picture.png"), "PNG"
    image.save()
    bpy.data.images.remove(image)
    path = folder / "recipe.json"
    path.write_text(json.dumps(recipe))
    return path
