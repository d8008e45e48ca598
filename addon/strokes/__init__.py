"""Grease-pencil strokes say where: from Blender's draw mode to the recipe.

    curves, control_points   what a drawing's control points mean
    projection, read         where strokes lie in the picture
    lines, roles             what they say there, by their role
    gp_layers                which grease-pencil layer holds which layer's strokes of which role
    draw_mode, operators     drawing and deleting them
    brush                    the speed and the weight that each keeps
    change                   giving them another role
    lay                      from the recipe back to strokes
    clip_plane               the clip of a layer, which some are drawn on
    panel                    its buttons, and the tool in the toolbar

Others use drawn(), replaced(), unpaired(), cut_out(), ready(), lay_down(), show_clip(), scale_speeds(), copy_roles()
and remove_roles().
"""

from functools import cache

import bpy
from bpy.app.handlers import persistent

from ..properties import fluids, names
from . import brush, clip_plane, draw_mode, gp_layers, lay, operators, panel, read, roles

CLASSES = [*operators.CLASSES, *panel.CLASSES]

copy_roles = gp_layers.copy  # (picture, from_id, to_id): a duplicated layer gets strokes of its own
remove_roles = gp_layers.remove  # (picture, layer_id): before a layer goes
FLUIDS = roles.FLUIDS  # the motions that flow
ready = draw_mode.holder_of  # (context, picture): its object for strokes, made where there is none, and shown
scale_speeds = brush.scale_speeds  # (picture, factor)
lay_down = lay.down  # (scene, picture, layer_id, strokes by the keys of their roles, as the recipe has them)


def drawn(scene, picture):
    """What the recipe asks (recipe/write.py): a layer's id, or "", and a role's key -> its strokes' geometry, or None.

    Asking throws ValueError with a sentence where strokes can't be read.
    """

    seen = cache(lambda: read.projection_of(picture))

    def geometry(layer_id: str, key: str):
        role = roles.by_key(key)
        return role.geometry(read.strokes(scene, picture, layer_id, role, seen))

    return geometry


def replaced(scene, picture, layer=None) -> set[str]:
    """The names of the numbers that strokes stand for: of the picture's view, and of the layer's motion."""
    owned = [("", role) for role in roles.of_motion("")]
    owned += [(layer.id, role) for role in roles.of_layer(layer)] if layer else []
    there = [role for layer_id, role in owned if read.is_drawn(scene, picture, layer_id, role)]
    return {name for role in there for name in role.replaces}


def unpaired(scene, picture, layer) -> list[str]:
    """A sentence where something is to be taken from the clip, or put somewhere, and the other is not drawn."""
    if layer.motion.type != "example":
        return []
    sources, targets = (read.count(scene, picture, layer.id, roles.by_key(f"clone_{end}")) for end in ("source", "target"))
    if sources > targets:
        return ["A Clone Source has no Clone Target: draw on the picture where it goes"]
    return ["A Clone Target has no Clone Source: draw on the clip what goes there"] if targets > sources else []


def show_clip(picture, layer):
    """The plane that shows the layer's clip, with what is drawn on it. Throws ValueError, OSError."""
    shown = clip_plane.ensure(picture, layer)
    gp_layers.lay_on_clip(picture, layer.id)
    return shown


def cut_out(scene, picture, layer) -> dict[str, list]:
    """What is drawn of a layer's matte and fill, and of how it flows, as lay_down() takes it.

    What other motions have drawn are numbers as well. Throws ValueError as drawn() does.
    """
    geometry, usual = drawn(scene, picture), brush.of_layer(layer.motion.flow)
    kept = [role for role in roles.of_layer(layer) if role.of or role.motion in FLUIDS]
    said = {role.key: geometry(layer.id, role.key) for role in kept}
    return {
        key: [{**usual, **stroke} for stroke in strokes] if roles.by_key(key).brushed else strokes
        for key, strokes in said.items() if strokes
    }  # fmt: skip


@persistent
def _look_after(*_):
    draw_mode.look_after()


HANDLERS = ["load_post", "undo_post", "redo_post"]


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.utils.register_tool(panel.STILLWATER_TL_stroke, after={"builtin.brush"})
    names.renamed.append(gp_layers.follow_names)
    fluids.clip_changed.append(clip_plane.follow)
    for name in HANDLERS:
        getattr(bpy.app.handlers, name).append(_look_after)


def unregister():
    for name in HANDLERS:
        getattr(bpy.app.handlers, name).remove(_look_after)
    fluids.clip_changed.remove(clip_plane.follow)
    names.renamed.remove(gp_layers.follow_names)
    draw_mode.stop()
    bpy.utils.unregister_tool(panel.STILLWATER_TL_stroke)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
