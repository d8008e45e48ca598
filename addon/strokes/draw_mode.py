"""Into Blender's own draw mode for strokes of one role, and back. Drawing itself is Blender's.

What is being drawn, and the tool settings to go back to, stand in the scene (properties/drawing.py). The artist may
leave by Blender's own ways too (Tab, the mode menu, undo): a timer sees it and puts settings and status bar back. Undo
brings back what stands in a scene, but never its tool settings: which scenes have ours is kept here besides.
"""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
import numpy as np

from .. import versions
from ..properties import names
from . import control_points, gp_layers, read, roles

MODE = "PAINT_GREASE_PENCIL"
INTERVAL = 0.25  # s
TOOL = "stillwater.stroke"
BRUSH = "GREASE_PENCIL_OT_brush_stroke"

finished = []  # called with scene, picture, layer and role when a layer's strokes are drawn; rooms add themselves

_before: dict[int, tuple] = {}  # by the session_uid of a scene that has our tool settings: its own
_told: set[str] = set()  # workspaces whose status bar has our hint


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
    drawing = scene.stillwater.drawing
    drawing.role, drawing.picture_id, drawing.layer_id = role.key, picture.id, layer_id
    drawing.new_layer = False
    drawing.placement, drawing.lock_axis, drawing.auto_key = _settings(scene)
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
    layer = names.layer_by_id(picture, drawing.layer_id) if picture is not None and drawing.new_layer else None
    leave(scene)
    if layer is not None:
        for follow in finished:
            follow(scene, picture, layer, role)


def leave(scene) -> None:
    """Says that nothing is being drawn any more."""
    if scene.stillwater.drawing.role:
        scene.stillwater.drawing.role, scene.stillwater.drawing.new_layer = "", False
        look_after()


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
    sentence = rpt_("{role} of {name}: {hint}")
    return sentence.format(role=rpt_(role.name), name=layer.name if layer else picture.name, hint=rpt_(role.hint))


def look_after(*_) -> None:
    """Settings, status bar and timer as the scenes say; after an undo step or a file that was opened, too."""
    for uid in _before.keys() - {scene.session_uid for scene in bpy.data.scenes}:
        del _before[uid]
    for scene in bpy.data.scenes:
        _settle(scene)
    _tell_status()
    if _before and not bpy.app.timers.is_registered(tick):
        bpy.app.timers.register(tick, first_interval=INTERVAL)


def tick() -> float | None:
    """Sees whether the artist left draw mode by another way; called by the timer."""
    for scene in bpy.data.scenes:
        if scene.stillwater.drawing.role and not _is_drawing(scene):
            leave(scene)
        elif scene.stillwater.drawing.new_layer and _has_one(scene):
            finish(scene)
            bpy.ops.ed.undo_push(message="New Layer from Outline")
    return INTERVAL if any(scene.stillwater.drawing.role for scene in bpy.data.scenes) else None


def _has_one(scene) -> bool:
    """Whether a stroke is there that says something, and the pen is up."""
    picture, role = drawn(scene)
    drawing = scene.stillwater.drawing
    if picture is None or not role.one or pen_is_down():
        return False
    try:
        return role.geometry(read.strokes(scene, picture, drawing.layer_id, role)) is not None
    except ValueError:
        return False


def pen_is_down() -> bool:
    """Whether a stroke is just being drawn."""
    windows = bpy.context.window_manager.windows
    return any(operator.bl_idname == BRUSH for window in windows for operator in window.modal_operators)


def stop() -> None:
    """Before the extension goes."""
    for scene in bpy.data.scenes:
        leave(scene)
    _before.clear()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


def _is_drawing(scene) -> bool:
    picture, _ = drawn(scene)
    return picture is not None and gp_layers.data_of(picture) is not None and picture.strokes.mode == MODE


def _holder(context, picture):
    """The picture's grease-pencil object, made where there is none, and shown."""
    if picture.plane is None:
        sentence = rpt_("{name}: has no plane in the scene to draw on; make it anew with Set Up in Scene")
        raise ValueError(sentence.format(name=picture.name))
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
        sentence = rpt_("{name}: is not visible in this view layer; show its collection to draw")
        raise ValueError(sentence.format(name=holder.name))
    return holder


def _settings(scene) -> tuple[str, str, bool]:
    """Where strokes are placed, across which axis they stay, whether keys are made by themselves."""
    settings = scene.tool_settings
    placement, lock_axis = settings.gpencil_stroke_placement_view3d, settings.gpencil_sculpt.lock_axis
    return placement, lock_axis, settings.use_keyframe_insert_auto


def _set(scene, placement: str, lock_axis: str, auto_key: bool) -> None:
    settings = scene.tool_settings
    settings.gpencil_stroke_placement_view3d, settings.gpencil_sculpt.lock_axis = placement, lock_axis
    settings.use_keyframe_insert_auto = auto_key


def _settle(scene) -> None:
    """Gives a scene the settings for what is being drawn, or its own again."""
    drawing, uid = scene.stillwater.drawing, scene.session_uid
    if drawing.role:
        _before[uid] = drawing.placement, drawing.lock_axis, drawing.auto_key
        keyed = roles.by_key(drawing.role).keyed
        _set(scene, "ORIGIN", "AXIS_Z", keyed and drawing.auto_key)  # across z: of the grease-pencil layer's own space
    elif uid in _before:
        _set(scene, *_before.pop(uid))


def _keep_last(part) -> None:
    """Removes the strokes before the last line of each drawing; dabs after it as well."""
    for key in part.frames:
        sizes = np.diff(control_points.offsets_of(key.drawing))
        lines = np.flatnonzero(sizes > 1)
        others = [i for i in range(len(sizes)) if len(lines) and i != lines[-1]]
        if others:
            key.drawing.remove_strokes(indices=others)


def _tell_status() -> None:
    """The hint in every window's status bar; Blender's own text again where it was ours."""
    for window in bpy.context.window_manager.windows:
        text, workspace = hint(window.scene), window.workspace
        if text or workspace.name in _told:
            with bpy.context.temp_override(window=window):
                workspace.status_text_set(text or None)
        (_told.add if text else _told.discard)(workspace.name)
