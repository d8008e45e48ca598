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


def cut_out() -> dict:
    """A layer of each form of matte that is drawn or solved, and of each field of a fill; nobody's default."""
    stroke = lambda width, *points: {"points": [list(point) for point in points], "width": width}  # noqa: E731
    scribbles = {
        "foreground": [stroke(3, (4, 4), (6.5, 5)), stroke(2, (5, 7))],
        "background": [stroke(4, (1, 1, 0.5), (30, 1, 1), (30.25, 14, 0.25))],
    }
    outline = [[3, 2], [12, 2.5], [11, 9], [4, 10]]
    one, other = stroke(5, (8, 3), (9, 4)), stroke(6, (8, 5), (10, 6, 0.5))
    fill = {"method": "exemplar", "patch": 7, "radius": 25, "grow": 3.5}
    source = {"scribbles": scribbles, "method": "bayesian"}
    return {
        **{name: value for name, value in whole().items() if name not in ("layers", "output")},
        "layers": [
            {"name": "tree", "matte": {"scribbles": scribbles, "method": "bayesian"},
             "fill": {**fill, "source": {"lasso": outline, "feather": 2, "snap": 1, "method": "bayesian"},
                      "touch_up": [{"stroke": one, "radius": 12, "seed": 4}, {"stroke": other, "radius": 12, "seed": 4}]}},
            {"name": "boat", "matte": {"lasso": outline, "feather": 3, "snap": 4, "method": "bayesian"},
             "fill": {**fill, "source": {"trimap": "behind.png", "method": "bayesian"},
                      "touch_up": [{"stroke": one, "radius": None, "seed": 0}, {"stroke": other, "radius": 9, "seed": 8}]}},
            {"name": "hill", "matte": {"trimap": "trimap.png", "method": "bayesian"}, "fill": {**fill, "source": source}},
            {"name": "wall", "matte": {"trimap": "trimap.png"},
             "fill": {**fill, "radius": None, "source": {"labels": "labels.png", "value": 2}}},
            {"name": "gate", "matte": {"trimap": "trimap.png"}, "fill": {"method": "exemplar", "source": {"file": "matte.png", "channel": "R"}}},
            {"name": "sky"},
        ],
    }


FLOW_POINTS = [[4, 4, 0.5], [9, 5, 1], [14, 4, 0.5]]
FLOW_STROKES = [
    {"points": FLOW_POINTS, "width": 3, "kind": "both", "speed": 0.5, "local": True, "alpha": 0.75, "frame": 1},
    {"points": FLOW_POINTS[:2], "width": 2, "kind": "both", "speed": 1.5, "local": False, "alpha": 1, "frame": 4},
    {"points": FLOW_POINTS[1:], "width": 1, "kind": "speed", "speed": 0, "local": False, "alpha": 0.25, "frame": None},
]


def flowing() -> dict:
    """A layer that flows, with strokes keyed in time."""
    flow = {
        "type": "flow", "strokes": FLOW_STROKES, "refine": {"width": 5, "amount": 0.5}, "period": 12,
        "speed": {"first": -1, "values": [1, 1, 2, 1.5, 3, 1, 1, 1, 1]}, "freeze": [{"points": [[20, 8], [25, 9]], "width": 4}],
    }  # fmt: skip
    rest = {name: value for name, value in whole().items() if name != "layers"}
    return {**rest, "layers": [{"name": "river", "motion": flow}]}


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
