"""Live on or off, what is shown, and what it waits for."""

from bpy.app.translations import pgettext_iface as iface_

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
            sidebar.say(context, layout, iface_("The picture has no plane in this scene"), "INFO")
        elif stage.problem:
            sidebar.say(context, layout, stage.problem, "ERROR")
        elif stage.share is not None:
            layout.progress(factor=stage.share, text=iface_("Preparing {share:.0%}").format(share=stage.share))
            if stage.what and stage.share < 1:
                sidebar.say(context, layout, iface_(stage.what[:1].upper() + stage.what[1:]), "TIME")
        elif stage.rests:
            sidebar.say(context, layout, iface_("Nothing moves yet: give a layer a motion"), "INFO")
        elif stage.live is not None:
            width, height = stage.live.size
            layout.label(text=iface_("{width} x {height} px").format(width=width, height=height))


CLASSES = sidebar.in_viewport("live", _Live)
