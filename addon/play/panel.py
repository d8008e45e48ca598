"""Live on or off, what is shown, and what it waits for."""

from .. import engine
from ..ui import sidebar
from . import show


class _Live(sidebar.OfPicture):
    bl_label = "Live"
    bl_order = 6

    def draw_header(self, context):
        self.layout.prop(context.scene.stillwater_live, "on", text="")

    def draw(self, context):
        layout, scene = self.layout, context.scene
        settings, picture = scene.stillwater_live, scene.stillwater.active()
        layout.active = settings.on
        layout.row(align=True).prop(settings, "view", expand=True)
        stage = show.stage_of(scene, picture)
        if not settings.on or engine.problem() or stage is None:
            return
        if picture.plane is None:
            sidebar.say(context, layout, "The picture has no plane in this scene", "INFO")
        elif stage.problem:
            sidebar.say(context, layout, stage.problem, "ERROR")
        elif stage.share is not None:
            layout.progress(factor=stage.share, text=f"Preparing {stage.share:.0%}")
        elif stage.rests:
            sidebar.say(context, layout, "Nothing moves yet: give a layer a motion", "INFO")
        elif stage.live is not None:
            width, height = stage.live.size
            layout.label(text=f"{width} x {height} px")


CLASSES = sidebar.in_viewport("live", _Live)
