"""Into Blender's own draw mode for strokes of one role, and back. Drawing itself is Blender's.

What is being drawn, and the tool settings to go back to, stand in the scene (properties/drawing.py). The artist may
leave by Blender's own ways too (Tab, the mode menu, undo): a timer sees it and puts settings and status bar back. Undo
brings back what stands in a scene, but never its tool settings: which scenes have ours is kept here besides. Meanwhile
the shelf of brushes, which lies over the lower part of the picture, is away; whoever wants another brush opens it.
"""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
import numpy as np

from .. import versions
from ..properties import names
from . import brush, control_points, gp_layers, read, roles

MODE = "PAINT_GREASE_PENCIL"
INTERVAL = 0.25  # s
TOOL = "stillwater.stroke"
BRUSH = "GREASE_PENCIL_OT_brush_stroke"

finished = []  # called with scene, picture, layer and role when a layer's strokes are drawn; rooms add themselves

_before: dict[int, tuple] = {}  # by the session_uid of a scene that has our tool settings: its own
_shelves: dict[int, bool] = {}  # by the session_uid of a scene whose viewports have no shelf: whether one had it
_told: set[str] = set()  # workspaces whose status bar has our hint


def enter(context, picture, layer, role: roles.Role) -> None:
    """Makes all that drawing a stroke of `layer` (None: of the picture) needs. Throws ValueError with a sentence."""
    scene = context.scene
    leave(scene)
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    holder = holder_of(context, picture)
    layer_id = layer.id if layer is not None else ""
    part = gp_layers.ensure(picture, layer_id, role)
    part.hide = part.lock = False
    gp_layers.fade(picture, layer_id if role.of else "")
    begins_late = role.keyed and len(part.frames)
    gp_layers.ensure_key(part, role, scene.frame_current if begins_late else min(scene.frame_current, scene.frame_start))
    holder.data.layers.active = part
    holder.active_material_index = gp_layers.material(holder.data, role)
    context.view_layer.objects.active = holder
    holder.select_set(True)
    drawing = scene.stillwater.drawing
    drawing.role, drawing.picture_id, drawing.layer_id = role.key, picture.id, layer_id
    drawing.new_layer = False
    drawing.placement, drawing.lock_axis, drawing.auto_key = _settings(scene)
    drawing.shelf = False
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
    _stamp(scene)
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
        _stamp(scene)
        picture, _ = drawn(scene)
        if picture is not None:
            gp_layers.fade(picture)
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
    for kept in (_before, _shelves):
        for uid in kept.keys() - {scene.session_uid for scene in bpy.data.scenes}:
            del kept[uid]
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
        elif scene.stillwater.drawing.role and scene.session_uid not in _shelves:
            _take_shelf_away(scene)
        if scene.stillwater.drawing.role and not pen_is_down():
            _stamp(scene)
    return INTERVAL if any(scene.stillwater.drawing.role for scene in bpy.data.scenes) else None


def _stamp(scene) -> None:
    """Strokes that were just drawn keep the numbers that their layer has now."""
    picture, role = drawn(scene)
    layer = names.layer_by_id(picture, scene.stillwater.drawing.layer_id) if picture is not None else None
    if layer is not None and role.brushed and gp_layers.data_of(picture) is not None:
        brush.stamp(picture, layer)


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
    _shelves.clear()
    if bpy.app.timers.is_registered(tick):
        bpy.app.timers.unregister(tick)


def _is_drawing(scene) -> bool:
    picture, _ = drawn(scene)
    return picture is not None and gp_layers.data_of(picture) is not None and picture.strokes.mode == MODE


def holder_of(context, picture):
    """The picture's grease-pencil object, made where there is none, and shown. Throws ValueError with a sentence."""
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
        if _shelves.pop(uid, False):
            _show_shelf(scene, True)


def _take_shelf_away(scene) -> None:
    """From the scene's viewports; once, so that whoever opens it has it. Before they were drawn it can't be told."""
    spaces = [area.spaces.active for _, area in _viewports(scene)]
    if any(space.is_property_readonly("show_region_asset_shelf") for space in spaces):
        return
    drawing = scene.stillwater.drawing
    drawing.shelf = drawing.shelf or any(space.show_region_asset_shelf for space in spaces)  # or: in a file from meanwhile
    _shelves[scene.session_uid] = drawing.shelf
    _show_shelf(scene, False)


def _show_shelf(scene, shown: bool) -> None:
    """Out of draw mode the property is read-only, but not the region that it stands for."""
    for window, area in _viewports(scene):
        space = area.spaces.active
        if space.is_property_readonly("show_region_asset_shelf"):
            if space.show_region_asset_shelf != shown:
                with bpy.context.temp_override(window=window, area=area):
                    bpy.ops.screen.region_toggle(region_type="ASSET_SHELF")
        else:
            space.show_region_asset_shelf = shown


def _viewports(scene) -> list[tuple]:
    """The 3D viewports that show the scene, each with its window."""
    shown = [window for window in bpy.context.window_manager.windows if window.scene == scene]
    return [(window, area) for window in shown for area in window.screen.areas if area.type == "VIEW_3D"]


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
