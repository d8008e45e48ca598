"""From a picture's properties to its recipe.

Properties have the names of the recipe's fields, so most groups are written field by field; what Blender keeps in
another form (points, the horizon, layers by id) has a function of its own here.
"""

from collections.abc import Callable

import numpy as np

from .animation import Animation
from .flow import clones, strokes_of_flow
from .numbers import over_time, plain, plain_all

Locate = Callable[[str], str]  # a path as Blender keeps it -> as the recipe has it
Drawn = Callable[[str, str], list | None]  # a layer's id ("" = the picture), a role -> what its strokes say, if any


def recipe_of(scene, picture, animation: Animation, locate: Locate, drawn: Drawn) -> dict:
    """The recipe of one picture of `scene`. What was left empty is left out: the engine says what it misses.

    What is drawn goes before what is typed.
    """
    return {
        "stillwater": 1,
        **_given("picture", picture.picture and locate(picture.picture)),
        "colour_space": picture.colour_space,
        **_given("size", list(picture.picture_size) if all(picture.picture_size) else None),
        "frames": [scene.frame_start, scene.frame_end],
        "fps": plain(scene.render.fps / scene.render.fps_base),
        "seed": picture.seed,
        "loop": picture.loop,
        "wind": _fields(picture.wind, animation),
        "view": _view(picture.view, animation, drawn),
        "layers": [_layer(picture, layer, animation, locate, drawn) for layer in picture.layers],
        "output": _fields(picture.output, animation),
    }


def frames_to_sample(first: int, last: int) -> range:
    """Where animated numbers are asked for: rates are summed from frame 1, and the flow looks one frame ahead."""
    return range(min(1, first), max(1, last) + 2)


def _given(name: str, value) -> dict:
    return {name: value} if value else {}


def _fields(group, animation: Animation, but: tuple = ()) -> dict:
    """Every property of a group under its own name. A seed of -1 is none."""
    names = [name for name in type(group).__annotations__ if name not in but]
    return {name: _value(group, name, animation) for name in names if (name, getattr(group, name)) != ("seed", -1)}


def _value(group, name: str, animation: Animation):
    """One property, over time where it is animated."""
    value, kind = getattr(group, name), group.bl_rna.properties[name]
    if kind.type != "FLOAT":
        return value
    numbers = list(value) if kind.is_array else [value]
    low, high = kind.hard_min, kind.hard_max
    columns = _columns(group, name, numbers, animation) if kind.is_animatable else None
    if columns is None:
        written = [plain(min(max(v, low), high), kind.subtype) for v in numbers]
        return written if kind.is_array else written[0]
    written = [plain_all(np.clip(column, low, high), kind.subtype) for column in columns]
    values = list(map(list, zip(*written, strict=True))) if kind.is_array else written[0]
    return over_time(values, animation.frames.start)


def _columns(group, name: str, numbers: list[float], animation: Animation) -> list | None:
    """Each number of one property over all frames; None where nothing animates it. A part may be animated alone."""
    path = f"{group.path_from_id()}.{name}"
    columns = [animation.values(path, i) for i in range(len(numbers))]
    if not any(columns):
        return None
    still = [[number] * len(animation.frames) for number in numbers]
    return [column or held for column, held in zip(columns, still, strict=True)]


def _line(group, start: str, end: str) -> list:
    return [[plain(v) for v in getattr(group, name)] for name in (start, end)]


def _view(view, animation: Animation, drawn: Drawn) -> dict:
    written = _fields(view, animation, but=("use_horizon", "horizon_start", "horizon_end"))
    typed = _line(view, "horizon_start", "horizon_end") if view.use_horizon else None
    horizon = drawn("", "horizon") or typed
    return {**_given("horizon", horizon), **written}


def _layer(picture, layer, animation: Animation, locate: Locate, drawn: Drawn) -> dict:
    followed = layer.follows.layer
    return {
        **_fields(layer, animation, but=("id", "selected", "solo", "follows", "matte", "fill", "motion")),
        **_given("follows", followed and {"layer": followed, "mirror": layer.follows.mirror}),
        **_given("matte", _matte(layer.matte, layer.id, locate, drawn)),
        "fill": _fill(layer.fill, layer.id, locate, drawn),
        "motion": _motion(layer, animation, locate, drawn),
    }


def _matte(matte, layer_id: str, locate: Locate, drawn: Drawn, prefix: str = "") -> dict | None:
    """None also where what must be drawn of it is not drawn yet. `prefix`: of the keys of its strokes' roles."""
    method = {"method": matte.method}
    match matte.form:
        case "file":
            return {"file": locate(matte.file), "channel": matte.channel}
        case "labels":
            return {"labels": locate(matte.labels), "value": matte.value}
        case "trimap":
            return {"trimap": locate(matte.trimap), **method}
        case "scribbles":
            scribbles = {kind: drawn(layer_id, prefix + kind) for kind in ("foreground", "background")}
            return {"scribbles": scribbles, **method} if all(scribbles.values()) else None
        case "lasso":
            outline = drawn(layer_id, f"{prefix}outline")
            numbers = {name: plain(getattr(matte, name)) for name in ("feather", "snap")}
            return {"lasso": outline, **numbers, **method} if outline else None
    return None


def _fill(fill, layer_id: str, locate: Locate, drawn: Drawn) -> dict:
    if fill.method == "file":
        return {"file": locate(fill.file)}
    if fill.method == "none":
        return {"method": "none"}
    usual = {"radius": plain(fill.touch_up_radius) or None, "seed": fill.touch_up_seed}
    touched = [{**usual, **stroke} for stroke in drawn(layer_id, "touch_up") or ()]
    return {
        "method": "exemplar",
        "patch": fill.patch,
        **_given("radius", plain(fill.radius)),
        "grow": plain(fill.grow),
        **_given("source", _matte(fill.source, layer_id, locate, drawn, "source_")),
        **_given("touch_up", touched),
    }


def _motion(layer, animation: Animation, locate: Locate, drawn: Drawn) -> dict:
    motion = layer.motion
    match motion.type:
        case "sway":
            armature = drawn(layer.id, "sway_line") or _line(motion.sway, "armature_root", "armature_tip")
            numbers = _fields(motion.sway, animation, but=("armature_root", "armature_tip"))
            return {"type": "sway", "armature": armature, **numbers}
        case "ripple":
            numbers = _fields(motion.ripple, animation)
            return {"type": "ripple", **numbers, "resolution": int(numbers["resolution"])}
        case "bob":
            typed = [[plain(v) for v in point.place] for point in motion.bob.waterline]
            waterline = drawn(layer.id, "waterline") or typed
            numbers = _fields(motion.bob, animation, but=("waterline", "water_id"))
            return {"type": "bob", "waterline": waterline, **numbers}
        case "drift":
            way = "velocity" if motion.drift.use_velocity else "wind"
            return {"type": "drift", way: _value(motion.drift, way, animation)}
        case "flow":
            return {"type": "flow", **_flowing(layer, motion.flow, animation, drawn), "period": plain(motion.flow.period)}
        case "example":
            return {"type": "example", **_flowing(layer, motion.example, animation, drawn), **_example(layer, locate, drawn)}
    return {"type": "still"}


def _flowing(layer, numbers, animation: Animation, drawn: Drawn) -> dict:
    """What all fluids have. `numbers`: of the layer's motion."""
    brush = layer.motion.flow
    usual = {"speed": plain(brush.stroke_speed), "local": brush.stroke_local, "alpha": plain(brush.stroke_alpha)}
    outline = {"moving": True, "persistence": plain(numbers.outline_persistence)} if numbers.outline_moving else None
    return {
        "strokes": strokes_of_flow(lambda key: drawn(layer.id, key), usual),
        "refine": {"width": plain(numbers.refine_width), "amount": plain(numbers.refine_amount)},
        "speed": _value(numbers, "speed", animation),
        **_given("outline", outline),
        **_given("freeze", drawn(layer.id, "freeze")),
    }


def _example(layer, locate: Locate, drawn: Drawn) -> dict:
    example, usual = layer.motion.example, {"alpha": plain(layer.motion.flow.stroke_alpha)}
    targets = [{**usual, **stroke} for stroke in drawn(layer.id, "clone_target") or ()]
    cloned = clones(drawn(layer.id, "clone_source"), targets)
    names = ("life", "repetitions", "matching", "endless", "clip_steady")
    numbers = ("clip_scale", "shutter", "average_blur", "stylize")
    return {
        **_given("clip", example.clip and locate(example.clip)),
        **_given("clip_frames", [example.clip_first, example.clip_last] if example.use_clip_frames else None),
        **_given("clip_fps", plain(example.clip_fps)),
        **_given("grid", list(example.grid) if example.use_grid else None),
        **{name: getattr(example, name) for name in names},
        **{name: plain(getattr(example, name)) for name in numbers},
        "transfer": {"patch": example.transfer_patch, "order": example.transfer_order, **_given("strokes", cloned)},
    }
