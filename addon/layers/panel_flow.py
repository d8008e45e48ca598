"""What the panel shows of a layer that flows, with a clip or without."""

from ..ui import sidebar


def draw(layout, flow, drawn: set[str]) -> None:
    """`drawn`: the numbers that strokes stand for."""
    sidebar.draw(layout, flow, "speed", "period")
    _draw_next(layout, flow)
    _draw_proposal(layout, flow, drawn)
    _draw_outline(layout, flow)
    if details := sidebar.fold(layout, "stillwater_flow", "Details"):
        sidebar.draw(details, flow, "refine_amount", "refine_width")


def draw_example(layout, motion, drawn: set[str]) -> None:
    """As draw(); what the next strokes say stands in the layer's flow."""
    example = motion.example
    column = layout.column(align=True)
    column.operator("stillwater.choose_clip", icon="FILE_MOVIE")
    if example.clip:
        sidebar.draw(column, example, "clip")
        column.operator("stillwater.show_clip", icon="IMAGE_PLANE")
    sidebar.draw(layout, example, "clip_scale", "speed", "life")
    _draw_next(layout, motion.flow).operator("stillwater.pick_speed", icon="EYEDROPPER")
    _draw_proposal(layout, motion.flow, drawn)
    _draw_outline(layout, example)
    if clip := sidebar.fold(layout, "stillwater_clip", "Clip"):
        sidebar.draw(clip, example, "clip_fps", "clip_steady", "use_clip_frames")
        if example.use_clip_frames:
            sidebar.draw(clip, example, "clip_first", "clip_last")
        sidebar.draw(clip, example, "transfer_patch", "transfer_order", "endless")
    if look := sidebar.fold(layout, "stillwater_look", "Look"):
        sidebar.draw(look, example, "stylize", "matching")
        if example.matching != "none":
            sidebar.draw(look, example, "repetitions", "use_grid")
            if example.use_grid:
                sidebar.draw(look, example, "grid")
        sidebar.draw(look, example, "shutter", "average_blur", "refine_amount", "refine_width")


def _draw_next(layout, flow):
    column = layout.column(align=True)
    column.label(text="Next Strokes")
    sidebar.draw(column, flow, "stroke_speed", "stroke_local", "stroke_alpha")
    return column


def _draw_outline(layout, fluid) -> None:
    column = layout.column(align=True)
    sidebar.draw(column, fluid, "outline_moving")
    if fluid.outline_moving:
        sidebar.draw(column, fluid, "outline_persistence")


def _draw_proposal(layout, flow, drawn: set[str]) -> None:
    if "strokes" not in drawn:
        column = layout.column(align=True)
        sidebar.draw(column, flow, "proposal")
        column.operator("stillwater.propose_flow", icon="SHADERFX")
