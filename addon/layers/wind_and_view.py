"""What all layers share: the wind, and how the picture sees the world."""

from .. import strokes
from ..ui import sidebar


class _Wind(sidebar.OfPicture):
    bl_label = "Wind"
    bl_order = 3

    def draw(self, context):
        sidebar.draw_all(self.layout, context.scene.stillwater.active().wind)


class _View(sidebar.OfPicture):
    bl_label = "View"
    bl_order = 4

    def draw(self, context):
        picture = context.scene.stillwater.active()
        sidebar.draw_all(self.layout, picture.view, but=strokes.replaced(context.scene, picture))


CLASSES = [*sidebar.in_both_editors("wind", _Wind), *sidebar.in_both_editors("view", _View)]
