"""What a layer still misses before it can move, as a sentence that says what to do. Reads, and needs no bpy."""


def of(picture, index: int, drawn: set[str]) -> list[str]:
    """A sentence for each thing that the engine would miss in one layer.

    `drawn`: the numbers of its motion, and of the view, that strokes stand for.
    """
    layer = picture.layers[index]
    last = index == len(picture.layers) - 1
    return [*_matte(layer, last), *_motion(picture, layer, drawn), *_circle(picture, layer)]


def horizon(view, drawn: set[str]) -> list[str]:
    """A sentence where the horizon is not known, which all water needs."""
    if "use_horizon" in drawn:
        return []
    if not view.use_horizon:
        return ["Draw the horizon, or turn it on in View"]
    if tuple(view.horizon_start) == tuple(view.horizon_end):
        return ["Draw the horizon, or place its two ends in View"]
    return []


def _matte(layer, last: bool) -> list[str]:
    matte, fill = layer.matte, layer.fill
    said = []
    if matte.form == "none" and not last:
        said.append("Choose its matte: which part of the picture it is")
    elif matte.form in ("file", "labels") and not getattr(matte, matte.form):
        said.append("Choose the file of its matte")
    if fill.method == "file" and not fill.file:
        said.append("Choose the file that is painted behind it")
    return said


def _motion(picture, layer, drawn: set[str]) -> list[str]:
    motion = layer.motion
    match motion.type:
        case "sway" if tuple(motion.sway.armature_root) == tuple(motion.sway.armature_tip) and "armature_tip" not in drawn:
            return ["Draw its sway line, from where it is held to its tip"]
        case "ripple":
            return horizon(picture.view, drawn)
        case "bob":
            return _bob(picture, motion.bob, drawn)
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
