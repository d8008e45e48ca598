"""What the panel shows of a layer that flows."""

from ..ui import sidebar


def draw(layout, flow, drawn: set[str]) -> None:
    """`drawn`: the numbers that strokes stand for."""
    sidebar.draw(layout, flow, "speed", "period")
    column = layout.column(align=True)
    column.label(text="Next Strokes")
    sidebar.draw(column, flow, "stroke_speed", "stroke_local", "stroke_alpha")
    if "strokes" not in drawn:
        row = layout.column(align=True)
        sidebar.draw(row, flow, "proposal")
        row.operator("stillwater.propose_flow", icon="SHADERFX")
    if details := sidebar.fold(layout, "stillwater_flow", "Details"):
        sidebar.draw(details, flow, "refine_amount", "refine_width")


def draw_example(layout, example, drawn: set[str]) -> None:
    """As draw()."""
    sidebar.draw(layout, example, "clip", "speed", "life")
    if clip := sidebar.fold(layout, "stillwater_clip", "Clip"):
        sidebar.draw(clip, example, "clip_scale", "clip_fps", "use_clip_frames")
        if example.use_clip_frames:
            sidebar.draw(clip, example, "clip_first", "clip_last")
        sidebar.draw(clip, example, "transfer_patch", "transfer_order", "endless")
    if look := sidebar.fold(layout, "stillwater_look", "Look"):
        sidebar.draw(look, example, "stylize", "matching", "repetitions", "use_grid")
        if example.use_grid:
            sidebar.draw(look, example, "grid")
        sidebar.draw(look, example, "shutter", "average_blur", "refine_amount", "refine_width")
