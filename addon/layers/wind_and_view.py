"""What all layers share: the wind, and how the picture sees the world."""

from bpy.app.translations import pgettext_iface as iface_

from .. import strokes
from ..ui import sidebar
from . import missing
from .presets import STILLWATER_PT_wind_presets


class _Wind(sidebar.OfPicture):
    bl_label = "Wind"
    bl_order = 4

    def draw_header_preset(self, context):
        row = self.layout.row()
        row.emboss = "NONE"
        STILLWATER_PT_wind_presets.draw_button(row)

    def draw(self, context):
        layout, wind = self.layout, context.scene.stillwater.active().wind
        layout.use_property_split = True
        sidebar.draw(layout, wind, "speed", "direction")
        sidebar.draw(layout, wind, "gusts", "gust_size")
        if details := sidebar.fold(layout, "stillwater_wind", "Details"):
            sidebar.draw(details, wind, "seed")


class _View(sidebar.OfPicture):
    bl_label = "View"
    bl_order = 5

    def draw(self, context):
        picture = context.scene.stillwater.active()
        layout, view = self.layout, picture.view
        drawn = strokes.replaced(context.scene, picture)
        if any(layer.motion.type == "ripple" for layer in picture.layers):
            for sentence in missing.horizon(view, drawn):
                sidebar.say(context, layout, iface_(sentence.removesuffix(" in View")), "ERROR")
        layout.use_property_split = True
        if "use_horizon" not in drawn:
            sidebar.draw(layout, view, "use_horizon")
            if view.use_horizon:
                sidebar.draw(layout, view, "horizon_start", "horizon_end")
        sidebar.draw(layout, view, "fov", "height")


CLASSES = [*sidebar.in_both_editors("wind", _Wind), *sidebar.in_both_editors("view", _View)]
