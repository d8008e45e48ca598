"""The strokes of a flow, from what was drawn of each kind to the recipe's list and back."""

from collections.abc import Callable

KINDS = {"flow": "both", "orientation": "orientation", "speed": "speed"}  # by their roles' keys


def strokes_of_flow(drawn: Callable[[str], list | None], usual: dict) -> list[dict]:
    """All strokes that say how a layer flows. `drawn`: a role's key -> its strokes, each with its key's frame.

    `usual`: what a stroke says that has nothing of its own. Where the strokes of a role have several keys they hold from
    theirs on; a recipe's strokes with a frame hold until the next one's, so those that hold on are said again there.
    """
    said = [drawn(key) or [] for key in KINDS]
    frames = [sorted({stroke["frame"] for stroke in strokes}) for strokes in said]
    changes = sorted({frame for keys in frames if len(keys) > 1 for frame in keys})
    always = [_said(stroke, usual) for strokes, keys in zip(said, frames, strict=True) if len(keys) < 2 for stroke in strokes]
    keyed = []
    for frame in changes:
        for strokes, keys in zip(said, frames, strict=True):
            if len(keys) > 1:
                holds = max([key for key in keys if key <= frame], default=keys[0])
                keyed += [{**_said(stroke, usual), "frame": frame} for stroke in strokes if stroke["frame"] == holds]
    return always + keyed


def _said(stroke: dict, usual: dict) -> dict:
    return {name: value for name, value in {**usual, **stroke}.items() if name != "frame"}


def drawn_of(motion: dict) -> dict[str, list]:
    """The strokes of a recipe's flow by the keys of their roles. Those that hold always lie on each of their role's keys."""
    found = {}
    for key, kind in KINDS.items():
        strokes = [stroke for stroke in motion["strokes"] if stroke["kind"] == kind]
        frames = sorted({stroke["frame"] for stroke in strokes if stroke["frame"] is not None}) or [None]
        found[key] = [
            {**stroke, "frame": frame} for frame in frames for stroke in strokes if stroke["frame"] in (None, frame)
        ]
    return {**found, "freeze": motion.get("freeze", []), **_clones_of(motion)}


def clones(sources: list | None, targets: list | None) -> list[dict]:
    """What is taken along strokes on the clip and laid along strokes on the picture: the first of both are a pair, and so
    on. How wide and how strongly says the target."""
    return [
        {
            "source": [point[:2] for point in source["points"]],
            "target": [point[:2] for point in target["points"]],
            "width": target["width"],
            "alpha": target["alpha"],
        }
        for source, target in zip(sources or [], targets or [], strict=False)
    ]


def _clones_of(motion: dict) -> dict[str, list]:
    """The other way round. A source is drawn as wide as what it takes is in the clip."""
    said, scale = motion.get("transfer", {}).get("strokes", []), motion.get("clip_scale", 1.0)
    return {
        "clone_source": [{"points": clone["source"], "width": clone["width"] / scale} for clone in said],
        "clone_target": [{"points": clone["target"], "width": clone["width"], "alpha": clone["alpha"]} for clone in said],
    }


def holding(strokes: list[dict], frame: int) -> list[dict]:
    """Those of a recipe's strokes that hold at a frame."""
    frames = sorted({stroke["frame"] for stroke in strokes if stroke.get("frame") is not None})
    now = max([each for each in frames if each <= frame], default=frames[0] if frames else None)
    return [stroke for stroke in strokes if stroke.get("frame") in (None, now)]
