"""Onto the screen, after all else of the viewport."""

import time

import blf
import bpy
import gpu
from bpy.app.translations import pgettext_iface as iface_
from gpu_extras.batch import batch_for_shader

from ..play import show
from ..properties import names
from ..properties.plane import pixels_to_world
from ..strokes import roles
from . import cutting, flow, flow_field, shapes
from .outline import outline

DASH = 0.006  # of the picture's longer side
LETTERS = 13  # px on the screen, of what is told
LEGEND, MARGIN = 0.16, 0.02  # of the picture's shorter side
STEPS = 8  # of a march, each second

problem = ""  # why nothing is drawn
_words = ""

_handles: list = []
_outlines: dict[tuple, object] = {}  # of the last layer that was asked for
_veils: dict[tuple, object] = {}  # a texture, of the last one
_drawn: tuple[tuple, list] = ((), [])  # what was made of the last subject


def begin() -> None:
    for function, place in ((draw, "POST_VIEW"), (draw_words, "POST_PIXEL")):
        _handles.append(bpy.types.SpaceView3D.draw_handler_add(function, (), "WINDOW", place))


def end() -> None:
    global _drawn
    while _handles:
        bpy.types.SpaceView3D.draw_handler_remove(_handles.pop(), "WINDOW")
    _outlines.clear()
    _veils.clear()
    _drawn = ((), [])
    if bpy.app.timers.is_registered(march):
        bpy.app.timers.unregister(march)


def draw() -> None:
    """One redraw of one viewport. What goes wrong is a sentence in the Overlays popover."""
    global problem, _words
    context, _words = bpy.context, ""
    picture = context.scene.stillwater.active()
    if picture is None or picture.plane is None or not context.space_data.overlay.show_overlays:
        return
    try:
        if (shown := veil_of(context.scene, picture)) is not None:
            _lay_over(shown, tuple(picture.picture_size), pixels_to_world(picture))
        if (sight := flow.of(context.scene, picture)) is not None:
            _lay_flow(context, picture, sight)
            _words = flow.sentence(sight, flow.layer_of(context.scene, picture))
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
    cut_out = cut_layer(scene, picture)
    active = cut_out or (picture.layers[picture.active_layer].name if picture.active_layer < len(picture.layers) else "")
    wanted = tuple(name for name in _lines_of(overlay) if getattr(overlay, name))
    size, frame, number = tuple(picture.picture_size), scene.frame_current, _sketched(stage)
    step = int(STEPS * time.monotonic()) % (2 * STEPS) if cut_out and overlay.outline else None
    key = (picture.id, stage.reads, stage.taken, number, size, frame, active, wanted, step)
    if step is not None and not bpy.app.timers.is_registered(march):
        bpy.app.timers.register(march, first_interval=1 / STEPS)
    if key != _drawn[0]:
        subject = shapes.Subject(stage.read, size, frame, active, stage.live)
        lines = [line for name in wanted for line in _made(name, subject, stage, step)]
        _drawn = key, [line for line in lines if line.ends]
    return _drawn[1]


def cut_layer(scene, picture) -> str:
    """The name of the layer whose matte is being drawn; empty where none is."""
    drawing = scene.stillwater.drawing
    if not drawing.role or drawing.picture_id != picture.id or not roles.by_key(drawing.role).of.startswith("matte."):
        return ""
    layer = names.layer_by_id(picture, drawing.layer_id)
    return layer.name if layer else ""


def veil_of(scene, picture):
    """What is laid over the picture while a matte is drawn, height x width x 4; None where nothing is.

    With what it was made of, by which its texture is known.
    """
    stage, overlay, layer = show.stage_of(scene, picture), scene.stillwater_overlay, cut_layer(scene, picture)
    if stage is None or not layer or not (overlay.tint or overlay.checker) or not picture.plane.visible_get():
        return None
    cut = cutting.cut(layer, stage.live, stage.sketch, picture.picture_size[0])
    key = (stage.identifier, stage.taken, _sketched(stage), layer, overlay.checker)
    return None if cut is None else (key, lambda: cutting.veil(cut.coverage, overlay.checker))


def march() -> float | None:
    """The outline goes on while a matte is drawn; called by a timer."""
    for window in bpy.context.window_manager.windows:
        picture = window.scene.stillwater.active()
        if picture is not None and cut_layer(window.scene, picture):
            for area in window.screen.areas:
                if area.type == "VIEW_3D":
                    area.tag_redraw()
            return 1 / STEPS
    return None


def _lines_of(overlay) -> list[str]:
    """The switches that are of lines."""
    return [name for name in type(overlay).__annotations__ if name not in ("tint", "checker", "flow", "flow_colors")]


def _sketched(stage) -> int:
    return stage.sketch.number if stage.sketch is not None else 0


def _made(name: str, subject: shapes.Subject, stage, step: int | None):
    if name != "outline":
        return getattr(shapes, name)(subject)
    cut = cutting.cut(subject.active, subject.live, stage.sketch, subject.size[0])
    if cut is None:
        return []
    key = (stage.identifier, stage.taken, _sketched(stage), subject.active)
    if key not in _outlines:
        _outlines.clear()
        _outlines[key] = outline(cut.coverage)
    if step is None:
        return shapes.outline(_outlines[key], cut.scale)
    return shapes.marching(_outlines[key], cut.scale, DASH * max(subject.size), step / STEPS)


def _lay_flow(context, picture, sight: flow.Sight) -> None:
    """Streaks, or colours and their legend in the lower left corner."""
    overlay, size, matrix = context.scene.stillwater_overlay, tuple(picture.picture_size), pixels_to_world(picture)
    pixels = flow.pixels_of(sight, overlay.flow_colors)
    _lay_texture(_texture(pixels), [(0, 0), (size[0], 0), size, (0, size[1])], matrix)
    if overlay.flow_colors:
        side, edge = LEGEND * min(size), MARGIN * min(size)
        left, top = edge, size[1] - edge - side
        corners = [(left, top), (left + side, top), (left + side, top + side), (left, top + side)]
        _lay_texture(_texture(flow_field.wheel()), corners, matrix)


def draw_words() -> None:
    """What is told of what draw() has shown, in the viewport's own pixels."""
    if not _words:
        return
    region, scale = bpy.context.region, bpy.context.preferences.system.ui_scale
    blf.size(0, LETTERS * scale)
    width, _ = blf.dimensions(0, _words)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 5, 0, 0, 0, 0.9)
    blf.color(0, 1, 1, 1, 1)
    blf.position(0, max(LETTERS, (region.width - width) / 2), 3 * LETTERS * scale, 0)
    blf.draw(0, _words)
    blf.disable(0, blf.SHADOW)


def _texture(pixels):
    buffer = gpu.types.Buffer("FLOAT", pixels.size, pixels.ravel())
    return gpu.types.GPUTexture(pixels.shape[1::-1], format="RGBA16F", data=buffer)


def _lay_over(veil: tuple, size: tuple[int, int], matrix) -> None:
    key, make = veil
    if key not in _veils:
        pixels = make()
        _veils.clear()
        _veils[key] = _texture(pixels)
    width, height = size
    _lay_texture(_veils[key], [(0, 0), (width, 0), (width, height), (0, height)], matrix)


def _lay_texture(texture, corners: list[tuple[float, float]], matrix) -> None:
    """Over four places of the picture: upper left, and on clockwise."""
    shader = gpu.shader.from_builtin("IMAGE")
    batch = batch_for_shader(
        shader, "TRI_FAN", {"pos": [(x, y, 0) for x, y in corners], "texCoord": [(0, 0), (1, 0), (1, 1), (0, 1)]}
    )
    gpu.state.blend_set("ALPHA")
    gpu.state.depth_test_set("NONE")
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(matrix)
        shader.bind()
        shader.uniform_sampler("image", texture)
        batch.draw(shader)
    gpu.state.blend_set("NONE")


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
