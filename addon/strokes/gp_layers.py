"""The grease-pencil layers of a picture's strokes: one for each layer and role, named after both ("Oak · Sway Line").

Which is which stands in an attribute of theirs, so that it stays true when they are renamed, moved, duplicated, copied
to another file, saved. Grease-pencil layers take no custom properties, and text attributes of theirs crash Blender 5.2:
two whole numbers hold the layer's id (12 hexadecimal digits, names.new_id) and above it the role's number.
"""

import bpy

from ..properties import clip, names, plane
from . import clip_plane, roles

ATTRIBUTE = "stillwater"
HALF = 24  # bits of an id in each number
FAINT = 0.12  # opacity of strokes that cut layers out, while none of the layer's are drawn


def data_of(picture):
    """The picture's grease-pencil data; None where it has no object for strokes."""
    holder = picture.strokes
    return holder.data if holder is not None and holder.type == "GREASEPENCIL" else None


def of(picture, layer_id: str, role: roles.Role) -> list:
    """The grease-pencil layers with the strokes of one role, from the lowest to the uppermost."""
    return [part for part, mark in _marked(picture) if mark == (layer_id, role)]


def all_of(picture) -> list[tuple]:
    """Each grease-pencil layer that has a role, with the role."""
    return [(part, mark[1]) for part, mark in _marked(picture) if mark is not None]


def ensure(picture, layer_id: str, role: roles.Role):
    """The uppermost of them, made on the picture's plane, or the clip's, where there is none. Throws ValueError, OSError."""
    drawn_on = _plane_of(picture, layer_id, role)
    there = of(picture, layer_id, role)
    if there:
        lay_on_clip(picture, layer_id)
        return there[-1]
    gp = data_of(picture)
    made = gp.layers.new(_name(picture, layer_id, role), set_active=False)
    _lay_on_plane(made, drawn_on)
    _mark(gp, made, layer_id, role)
    return made


def lay_on_clip(picture, layer_id: str) -> None:
    """What was drawn on a layer's clip lies on the plane that it has now."""
    shown = clip.plane_of(picture, layer_id)
    for role in roles.ROLES:
        for part in of(picture, layer_id, role) if role.on_clip and shown is not None else ():
            if part.parent != shown:
                _lay_on_plane(part, shown)


def pixels_to_world(picture, layer_id: str, role: roles.Role):
    """4x4: from the pixels in which strokes of a role are measured, the picture's or the clip's. Throws ValueError."""
    return clip.pixels_to_world(picture, layer_id) if role.on_clip else plane.pixels_to_world(picture)


def copy(picture, from_id: str, to_id: str) -> None:
    """Gives the layer `to_id` a copy of all strokes of the layer `from_id`, and of the clip that some are drawn on."""
    gp = data_of(picture)
    clip_plane.copy(picture, from_id, to_id)
    active = gp.layers.active if gp is not None else None
    for role in roles.ROLES:
        for part in of(picture, from_id, role):
            gp.layers.active = part
            with bpy.context.temp_override(object=picture.strokes, active_object=picture.strokes):
                bpy.ops.grease_pencil.layer_duplicate()
            made = gp.layers.active
            _mark(gp, made, to_id, role)
            made.name = _name(picture, to_id, role)
    lay_on_clip(picture, to_id)
    if active is not None:
        gp.layers.active = active


def remove(picture, layer_id: str) -> None:
    """Removes all strokes of a layer, and its clip from the scene."""
    for role in roles.ROLES:
        for part in of(picture, layer_id, role):
            data_of(picture).layers.remove(part)
    clip_plane.remove(picture, layer_id)


def fade(picture, layer_id: str = "") -> None:
    """Lets the strokes that cut a layer out be seen well, those of the others faintly: there are many of them."""
    for part, mark in _marked(picture):
        if mark is not None and mark[1].of:
            opacity = 1.0 if mark[0] == layer_id else FAINT
            if abs(part.opacity - opacity) > 1e-3:
                part.opacity = opacity


def follow_names(picture) -> None:
    """Names them anew after their layers."""
    for part, mark in _marked(picture):
        if mark is not None and names.layer_by_id(picture, mark[0]) is not None:
            wanted = _name(picture, *mark)
            if wanted not in (part.name, part.name.rpartition(".")[0]):  # .001: one of several
                part.name = wanted


def ensure_key(part, role: roles.Role, frame: int) -> None:
    """Sees to it that strokes can be drawn at `frame`: Blender draws on the key that holds there."""
    if part.get_frame_at(frame) is not None:
        return
    first = min((key.frame_number for key in part.frames), default=None)
    if first is None or role.keyed:
        part.frames.new(frame)
    else:
        part.frames.move(first, frame)


def material(gp, role: roles.Role) -> int:
    """The slot of the role's material, made where there is none."""
    name = f"Stillwater {role.name}"
    slot = gp.materials.find(name)
    if slot >= 0:
        return slot
    made = bpy.data.materials.get(name)
    if made is None:
        made = bpy.data.materials.new(name)
    if made.grease_pencil is None:
        bpy.data.materials.create_gpencil_data(made)
        made.grease_pencil.color = made.diffuse_color = (*role.colour, 1)
    gp.materials.append(made)
    return len(gp.materials) - 1


def _name(picture, layer_id: str, role: roles.Role) -> str:
    layer = names.layer_by_id(picture, layer_id)
    return f"{layer.name} · {role.name}" if layer else role.name


def _plane_of(picture, layer_id: str, role: roles.Role):
    """What strokes of a role are drawn on; a clip is shown where it was not. Throws ValueError, OSError."""
    return clip_plane.ensure(picture, names.layer_by_id(picture, layer_id)) if role.on_clip else picture.plane


def _lay_on_plane(part, drawn_on) -> None:
    """Makes its space the plane's, wherever the object is: strokes that are drawn along x and y lie on the picture.

    Blender keeps the place of what gets a parent: its own transform is the plane's of this moment.
    """
    part.parent = drawn_on
    part.translation, turn, part.scale = drawn_on.matrix_world.decompose()
    part.rotation = turn.to_euler()


def _marked(picture) -> list[tuple]:
    """Each grease-pencil layer, with its layer's id and its role; with None where it is the artist's own."""
    gp = data_of(picture)
    kept = gp.attributes.get(ATTRIBUTE) if gp is not None else None
    if kept is None:
        return []
    return [(part, _unpacked(*item.value)) for part, item in zip(gp.layers, kept.data, strict=True)]


def _mark(gp, part, layer_id: str, role: roles.Role) -> None:
    kept = gp.attributes.get(ATTRIBUTE) or gp.attributes.new(ATTRIBUTE, "INT32_2D", "LAYER")
    index = next(i for i, other in enumerate(gp.layers) if other == part)
    kept.data[index].value = _packed(layer_id, role)


def _packed(layer_id: str, role: roles.Role) -> tuple[int, int]:
    high, low = divmod(int(layer_id or "0", 16), 1 << HALF)
    return high | role.number << HALF, low


def _unpacked(first: int, low: int) -> tuple[str, roles.Role] | None:
    number, high = divmod(first, 1 << HALF)
    role = roles.by_number(number)
    identifier = f"{high << HALF | low:012x}" if high or low else ""
    return (identifier, role) if role is not None else None
