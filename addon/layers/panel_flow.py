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
