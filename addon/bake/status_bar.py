"""The bakes that run, in the window's status bar: progress, time left, and a cross."""

from . import job


def draw(self, context):
    for tree in job.running_trees():
        state = tree.stillwater
        row = self.layout.row(align=True)
        row.ui_units_x = 16
        row.progress(factor=state.share, text=text(state))
        row.operator("stillwater.cancel", text="", icon="X").tree = tree.name


def text(state) -> str:
    """How a bake goes, in one line."""
    return f"{state.message}, {state.left}" if state.left else state.message
