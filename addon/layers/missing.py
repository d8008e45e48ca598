"""What a layer still misses before it can move, as a sentence that says what to do. Reads, and needs no bpy."""


def of(picture, index: int) -> list[str]:
    """A sentence for each thing that the engine would miss in one layer."""
    layer = picture.layers[index]
    return [*_matte(layer, index == len(picture.layers) - 1), *_motion(picture, layer)]


def horizon(view) -> list[str]:
    """A sentence where the horizon is not known, which all water needs."""
    if not view.use_horizon:
        return ["Say where the horizon is: turn it on in View"]
    if tuple(view.horizon_start) == tuple(view.horizon_end):
        return ["Say where the horizon is: place its two ends in View"]
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


def _motion(picture, layer) -> list[str]:
    motion = layer.motion
    match motion.type:
        case "sway" if tuple(motion.sway.armature_root) == tuple(motion.sway.armature_tip):
            return ["Draw its sway line, from where it is held to its tip"]
        case "ripple":
            return horizon(picture.view)
        case "bob":
            return _bob(picture, motion.bob)
    return []


def _bob(picture, bob) -> list[str]:
    said = []
    water = {layer.name for layer in picture.layers if layer.motion.type == "ripple"}
    if bob.water not in water:
        said.append("Choose the water it floats on" if water else "Add a layer with Ripple: the water it floats on")
    if len({tuple(point.place) for point in bob.waterline}) < 2:
        said.append("Draw its waterline, along the hull where it meets the water")
    return said
