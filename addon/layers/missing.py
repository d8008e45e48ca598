"""What a layer still misses before it can move, as a sentence that says what to do. Reads, and needs no bpy."""


def of(picture, index: int, drawn: set[str]) -> list[str]:
    """A sentence for each thing that the engine would miss in one layer.

    `drawn`: the numbers of its motion, and of the view, that strokes stand for.
    """
    layer = picture.layers[index]
    last = index == len(picture.layers) - 1
    return [*_matte(layer, last, drawn), *_fill(layer, drawn), *_motion(picture, layer, drawn), *_circle(picture, layer)]


def horizon(view, drawn: set[str]) -> list[str]:
    """A sentence where the horizon is not known, which all water needs."""
    if "use_horizon" in drawn:
        return []
    if not view.use_horizon:
        return ["Draw the horizon, or turn it on in View"]
    if tuple(view.horizon_start) == tuple(view.horizon_end):
        return ["Draw the horizon, or place its two ends in View"]
    return []


def _matte(layer, last: bool, drawn: set[str]) -> list[str]:
    matte = layer.matte
    match matte.form:
        case "none" if not last:
            return ["Draw on it with Foreground, or choose its matte: which part of the picture it is"]
        case "file" | "labels" if not getattr(matte, matte.form):
            return ["Choose the file of its matte"]
        case "trimap" if not matte.trimap:
            return ["Choose the file of its trimap"]
        case "scribbles" if "foreground" not in drawn:
            return ["Press Foreground and draw on what is part of it"]
        case "scribbles" if "background" not in drawn:
            return ["Press Background and draw beside it, on what is not part of it"]
        case "lasso" if "outline" not in drawn:
            return ["Press Outline and draw once around it"]
    return []


def _fill(layer, drawn: set[str]) -> list[str]:
    fill, source = layer.fill, layer.fill.source
    if fill.method == "file":
        return [] if fill.file else ["Choose the file that is painted behind it"]
    if fill.method == "none":
        return []
    match source.form:
        case "file" | "labels" | "trimap" if not getattr(source, source.form):
            return ["Choose the file that says what the hole behind it is filled with"]
        case "scribbles" if "source_foreground" not in drawn:
            return ["Press Source Foreground and draw on what the hole behind it may be filled with"]
        case "scribbles" if "source_background" not in drawn:
            return ["Press Source Background and draw on what the hole behind it must not be filled with"]
        case "lasso" if "source_outline" not in drawn:
            return ["Press Source Outline and draw around what the hole behind it may be filled with"]
    return []


def _motion(picture, layer, drawn: set[str]) -> list[str]:
    motion = layer.motion
    match motion.type:
        case "sway" if tuple(motion.sway.armature_root) == tuple(motion.sway.armature_tip) and "armature_tip" not in drawn:
            return ["Draw its sway line, from where it is held to its tip"]
        case "ripple":
            return horizon(picture.view, drawn)
        case "bob":
            return _bob(picture, motion.bob, drawn)
        case "flow" if "strokes" not in drawn:
            return ["Press Flow and draw the way that it flows, or Propose Flow"]
        case "example":
            clip = [] if motion.example.clip else ["Press Choose Clip: a film of such a fluid, from a camera that stands still"]
            return clip + ([] if "strokes" in drawn else ["Press Flow and draw the way that it flows, or Propose Flow"])
    return []


def _bob(picture, bob, drawn: set[str]) -> list[str]:
    said = []
    water = {layer.name for layer in picture.layers if layer.motion.type == "ripple"}
    if bob.water not in water:
        said.append("Choose the water it floats on" if water else "Add a layer with Ripple: the water it floats on")
    if len({tuple(point.place) for point in bob.waterline}) < 2 and "waterline" not in drawn:
        said.append("Draw its waterline, along the hull where it meets the water")
    return said


def _circle(picture, layer) -> list[str]:
    """A layer can't move with one that moves with it."""
    follows, water = layer.follows.layer, layer.motion.bob.water if layer.motion.type == "bob" else ""
    said = []
    if layer.name in _with_all_below(picture, follows):
        said.append("Choose another layer to follow: that one follows this one")
    if layer.name in _with_all_below(picture, water):
        said.append("Choose other water: that one follows this layer")
    return said


def _with_all_below(picture, name: str) -> set[str]:
    """A layer, what it moves with, what that moves with and so on, by name."""
    layers = {layer.name: layer for layer in picture.layers}
    found, to_look = set(), [name]
    while to_look:
        name = to_look.pop()
        if name in layers and name not in found:
            found.add(name)
            motion = layers[name].motion
            to_look += [layers[name].follows.layer, motion.bob.water if motion.type == "bob" else ""]
    return found
