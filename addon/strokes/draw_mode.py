"""Into Blender's own draw mode for strokes of one role, and back. Drawing itself is Blender's.

What is being drawn, and the tool settings to go back to, stand in the scene (properties/drawing.py). The artist may
leave by Blender's own ways too (Tab, the mode menu, undo): a timer sees it and puts settings and status bar back.
"""

import bpy

from .. import versions
from ..properties import names
from . import gp_layers, roles

MODE = "PAINT_GREASE_PENCIL"
INTERVAL = 0.25  # s
TOOL = "stillwater.stroke"


def enter(context, picture, layer, role: roles.Role) -> None:
    """Makes all that drawing a stroke of `layer` (None: of the picture) needs. Throws ValueError with a sentence."""
    scene = context.scene
    leave(scene)
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    holder = _holder(context, picture)
    layer_id = layer.id if layer is not None else ""
    part = gp_layers.ensure(picture, layer_id, role)
    part.hide = part.lock = False
    gp_layers.ensure_key(part, role, scene.frame_current if role.keyed else min(scene.frame_current, scene.frame_start))
    holder.data.layers.active = part
    holder.active_material_index = gp_layers.material(holder.data, role)
    context.view_layer.objects.active = holder
    holder.select_set(True)
    _remember(scene, picture, layer_id, role)
    settings = scene.tool_settings
    settings.gpencil_stroke_placement_view3d = "ORIGIN"
    settings.gpencil_sculpt.lock_axis = "AXIS_Z"  # of the grease-pencil layer: across the plane
    settings.use_keyframe_insert_auto = role.keyed and settings.use_keyframe_insert_auto
    bpy.ops.object.mode_set(mode=MODE)
    bpy.ops.wm.tool_set_by_id(name=TOOL, space_type="VIEW_3D")
    look_after()


def finish(scene) -> None:
    """Back to object mode; of a role that takes one stroke the last stays."""
    picture, role = drawn(scene)
    drawing = scene.stillwater.drawing
    if picture is not None and role.one:
        for part in gp_layers.of(picture, drawing.layer_id, role):
            _keep_last(part)
    if _is_drawing(scene):
        bpy.ops.object.mode_set(mode="OBJECT")
    leave(scene)


def leave(scene) -> None:
    """Puts the tool settings back that drawing changed."""
    drawing, settings = scene.stillwater.drawing, scene.tool_settings
    if not drawing.role:
        return
    settings.gpencil_stroke_placement_view3d = drawing.placement
    settings.gpencil_sculpt.lock_axis = drawing.lock_axis
    settings.use_keyframe_insert_auto = drawing.auto_key
    drawing.role = ""
    _tell_status()


def drawn(scene) -> tuple:
    """The picture whose strokes are being drawn, and their role; (None, None) where nothing is."""
    drawing = scene.stillwater.drawing
    picture = next((p for p in scene.stillwater.pictures if drawing.role and p.id == drawing.picture_id), None)
    return (picture, roles.by_key(drawing.role)) if picture is not None else (None, None)


def hint(scene) -> str:
    """What a stroke will do; empty where none is being drawn."""
    picture, role = drawn(scene)
    if picture is None:
        return ""
    layer = names.layer_by_id(picture, scene.stillwater.drawing.layer_id)
    return f"{role.name} of {layer.name if layer else picture.name}: {role.hint}"


def look_after(*_) -> None:
    """Starts the timer where something is being drawn; after an undo step or a file that was opened, too."""
    if any(scene.stillwater.drawing.role for scene in bpy.data.scenes):
        _tell_status()
        if not bpy.app.timers.is_registered(tick):
            bpy.app.timers.register(tick, first_interval=INTERVAL)


def tick() -> float | None:
    """Sees whether the artist left draw mode by another way; called by the timer."""
    busy = [scene for scene in bpy.data.scenes if scene.stillwater.drawing.role]
    for scene in busy:
        if not _is_drawing(scene):
            leave(scene)
    if any(scene.stillwater.drawing.role for scene in busy):
        return INTERVAL
    _tell_status()  # after undo, too, which left no scene to leave
    return None


def stop() -> None:
    """Before the extension goes."""
    for scene in bpy.data.scenes:
        leave(scene)
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


def _is_drawing(scene) -> bool:
    picture, _ = drawn(scene)
    return picture is not None and gp_layers.data_of(picture) is not None and picture.strokes.mode == MODE


def _holder(context, picture):
    """The picture's grease-pencil object, made where there is none, and shown."""
    if picture.plane is None:
        raise ValueError(f"{picture.name}: has no plane in the scene to draw on; open its picture again")
    holder = picture.strokes
    if gp_layers.data_of(picture) is None:
        name = f"{picture.name} Strokes"
        holder = picture.strokes = bpy.data.objects.new(name, versions.grease_pencils().new(name))
        holder.show_in_front = holder.hide_render = True
        context.scene.collection.objects.link(holder)
    if context.view_layer.objects.get(holder.name) == holder:
        holder.hide_viewport = False
        holder.hide_set(False)
    if not holder.visible_get():
        raise ValueError(f"{holder.name}: is not visible in this view layer; show its collection to draw")
    return holder


def _remember(scene, picture, layer_id: str, role: roles.Role) -> None:
    drawing, settings = scene.stillwater.drawing, scene.tool_settings
    drawing.role, drawing.picture_id, drawing.layer_id = role.key, picture.id, layer_id
    drawing.placement = settings.gpencil_stroke_placement_view3d
    drawing.lock_axis = settings.gpencil_sculpt.lock_axis
    drawing.auto_key = settings.use_keyframe_insert_auto


def _keep_last(part) -> None:
    """Removes the strokes before the last line of each drawing; dabs after it as well."""
    for key in part.frames:
        sizes = [len(stroke.points) for stroke in key.drawing.strokes]
        lines = [i for i, size in enumerate(sizes) if size > 1]
        others = [i for i in range(len(sizes)) if lines and i != lines[-1]]
        if others:
            key.drawing.remove_strokes(indices=others)


def _tell_status() -> None:
    """The hint in every window's status bar, or Blender's own text again."""
    for window in bpy.context.window_manager.windows:
        with bpy.context.temp_override(window=window):
            window.workspace.status_text_set(hint(window.scene) or None)
