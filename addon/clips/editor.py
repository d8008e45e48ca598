"""An Image Editor that shows the active layer's clip: what is taken from it drawn over it, and buttons in its sidebar."""

import blf
import bpy
import gpu
from gpu_extras.batch import batch_for_shader

from .. import strokes
from ..properties import clip
from ..strokes import roles
from ..ui import sidebar
from .operators import example_layer

LETTERS = 13  # px on the screen, of a source's number
LINE, DRAWN_LINE = 2.0, 3.0  # px on the screen: a source, and the one that is being drawn

drawing: list[tuple[float, float]] = []  # px of the clip: the source that is being drawn
_handles: list = []


def begin() -> None:
    _handles.append(bpy.types.SpaceImageEditor.draw_handler_add(draw, (), "WINDOW", "POST_PIXEL"))


def end() -> None:
    drawing.clear()
    while _handles:
        bpy.types.SpaceImageEditor.draw_handler_remove(_handles.pop(), "WINDOW")


def shown_in(context, space):
    """The picture and its active layer, where an editor shows that one's clip; else None."""
    picture = context.scene.stillwater.active()
    layer = example_layer(picture) if picture is not None else None
    plane = clip.plane_of(picture, layer.id) if layer is not None else None
    return (picture, layer) if plane is not None and space.image == plane.data else None


def sources(scene, picture, layer) -> list[list[tuple[float, float]]]:
    """What is taken from a layer's clip, px of it. Throws ValueError where strokes can't be read."""
    drawn = strokes.drawn(scene, picture)(layer.id, "clone_source") or []
    return [[tuple(point[:2]) for point in stroke["points"]] for stroke in drawn]


def draw() -> None:
    """One redraw of one Image Editor."""
    context = bpy.context
    space = context.space_data
    if not space.overlay.show_overlays or (shown := shown_in(context, space)) is None:
        return
    picture, layer = shown
    size = clip.size_of(clip.plane_of(picture, layer.id))
    try:
        lines = sources(context.scene, picture, layer)
    except ValueError:  # the panel Live says it
        lines = []
    for number, line in enumerate(lines, 1):
        ends = _on_screen(context.region, line, size)
        _line(ends, LINE)
        _number(ends[0], str(number))
    if len(drawing) > 1:
        _line(_on_screen(context.region, drawing, size), DRAWN_LINE)


def redraw() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "IMAGE_EDITOR":
                area.tag_redraw()


def _on_screen(region, line, size: tuple[int, int]) -> list[tuple[float, float]]:
    """Of an Image Editor, whose picture is 1 wide and 1 high with its lower left corner at 0."""
    return [region.view2d.view_to_region(x / size[0], 1 - y / size[1], clip=False) for x, y in line]


def _line(ends: list[tuple[float, float]], width: float) -> None:
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.blend_set("ALPHA")
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", width * bpy.context.preferences.system.ui_scale)
    shader.uniform_float("color", (*roles.by_key("clone_source").colour, 1.0))
    batch_for_shader(shader, "LINE_STRIP", {"pos": [(*end, 0.0) for end in ends]}).draw(shader)
    gpu.state.blend_set("NONE")


def _number(place: tuple[float, float], text: str) -> None:
    scale = bpy.context.preferences.system.ui_scale
    blf.size(0, LETTERS * scale)
    blf.enable(0, blf.SHADOW)
    blf.shadow(0, 5, 0, 0, 0, 0.9)
    blf.color(0, *roles.by_key("clone_source").colour, 1)
    blf.position(0, place[0] + 4 * scale, place[1] + 4 * scale, 0)
    blf.draw(0, text)
    blf.disable(0, blf.SHADOW)


class _Clip(sidebar.Part):
    bl_label = "Clip"

    @classmethod
    def poll(cls, context):
        return shown_in(context, context.space_data) is not None

    def draw(self, context):
        layout, (picture, layer) = self.layout, shown_in(context, context.space_data)
        layout.label(text=layer.name, icon="MOD_FLUIDSIM")
        column = layout.column(align=True)
        column.operator("stillwater.pick_speed", icon="EYEDROPPER")
        row = column.row(align=True)
        row.operator("stillwater.draw_clone_source", icon="GREASEPENCIL")
        if "clone_sources" in strokes.replaced(context.scene, picture, layer):
            row.operator("stillwater.delete_strokes", text="", icon="X").role = "clone_source"
        for sentence in strokes.unpaired(context.scene, picture, layer):
            sidebar.say(context, layout, sentence, "INFO")


CLASSES = sidebar.in_image_editor(_Clip)
