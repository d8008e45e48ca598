"""Onto the screen, after all else of the viewport."""

import bpy
import gpu
from bpy.app.translations import pgettext_iface as iface_
from gpu_extras.batch import batch_for_shader

from ..play import show
from ..properties.plane import pixels_to_world
from . import shapes
from .outline import outline

problem = ""  # why nothing is drawn

_handle = None
_outlines: dict[tuple, object] = {}  # of the last layer that was asked for
_drawn: tuple[tuple, list] = ((), [])  # what was made of the last subject


def begin() -> None:
    global _handle
    _handle = bpy.types.SpaceView3D.draw_handler_add(draw, (), "WINDOW", "POST_VIEW")


def end() -> None:
    global _handle, _drawn
    bpy.types.SpaceView3D.draw_handler_remove(_handle, "WINDOW")
    _handle = None
    _outlines.clear()
    _drawn = ((), [])


def draw() -> None:
    """One redraw of one viewport. What goes wrong is a sentence in the Overlays popover."""
    global problem
    context = bpy.context
    picture = context.scene.stillwater.active()
    if picture is None or picture.plane is None or not context.space_data.overlay.show_overlays:
        return
    try:
        lines = of(context.scene, picture)
        if lines:
            _paint(lines, pixels_to_world(picture), gpu.state.viewport_get()[2:])
        problem = ""
    except Exception as error:  # noqa: BLE001  a handler that raises would fill the console at every redraw
        problem = iface_("Overlays: {why}").format(why=error)


def of(scene, picture) -> list[shapes.Lines]:
    """What is drawn over a picture at the scene's frame."""
    global _drawn
    stage, overlay = show.stage_of(scene, picture), scene.stillwater_overlay
    if stage is None or not stage.read or not picture.plane.visible_get():
        return []
    active = picture.layers[picture.active_layer].name if picture.active_layer < len(picture.layers) else ""
    wanted = tuple(name for name in type(overlay).__annotations__ if getattr(overlay, name))
    size, frame = tuple(picture.picture_size), scene.frame_current
    key = (picture.id, stage.reads, stage.taken, size, frame, active, wanted)
    if key != _drawn[0]:
        subject = shapes.Subject(stage.read, size, frame, active, stage.live)
        lines = [line for name in wanted for line in _made(name, subject, stage)]
        _drawn = key, [line for line in lines if line.ends]
    return _drawn[1]


def _made(name: str, subject: shapes.Subject, stage):
    if name != "outline":
        return getattr(shapes, name)(subject)
    if subject.live is None or subject.active not in subject.live.layers:
        return []
    key = (stage.identifier, stage.taken, subject.active)
    if key not in _outlines:
        _outlines.clear()
        _outlines[key] = outline(subject.live.coverage(subject.active))
    return shapes.outline(subject, _outlines[key])


def _paint(lines: list[shapes.Lines], matrix, viewport: tuple[int, int]) -> None:
    shader = gpu.shader.from_builtin("POLYLINE_SMOOTH_COLOR")
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE")
    scale = bpy.context.preferences.system.ui_scale
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(matrix)
        for line in lines:
            places = [(x, y, 0) for x, y in line.ends]
            colours = [(*line.colour, alpha) for alpha in line.alphas]
            batch = batch_for_shader(shader, "LINES", {"pos": places, "color": colours})
            shader.bind()
            shader.uniform_float("viewportSize", viewport)
            shader.uniform_float("lineWidth", line.width * scale)
            batch.draw(shader)
    gpu.state.blend_set("NONE")
