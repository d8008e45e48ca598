"""Drawing a clone source on the clip, in an Image Editor or below the picture, without leaving what one is doing.

It becomes a stroke on the clip's plane below the picture, as if it were drawn there: so it is kept, copied and edited with
the others.
"""

import math

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import CollectionProperty

from .. import strokes
from . import editor
from .operators import OnClip, example_layer
from .places import under_mouse

APART = 3  # px of the window, between the points of a line
WIDTH = 20  # px of the picture, as the recipe's clone strokes have it where nothing is said


class STILLWATER_OT_draw_clone_source(OnClip, bpy.types.Operator):
    """Draw on the clip, in an Image Editor or below the picture, along what is to be taken; the first goes to the first Clone Target"""

    bl_idname = "stillwater.draw_clone_source"
    bl_label = "Draw Clone Source"

    path: CollectionProperty(
        name="Path", description="The line on the clip [px from its top left corner, y down]", type=bpy.types.OperatorMousePath,
        options={"SKIP_SAVE"},
    )

    def invoke(self, context, event):
        self._before = (-APART, -APART)
        editor.drawing.clear()
        return self.begin(context, "PAINT_CROSS", rpt_("Draw on the clip along what is to be taken; Esc: cancel"))

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.end(context)
            return {"CANCELLED"}
        if not editor.drawing:
            if event.type != "LEFTMOUSE" or event.value != "PRESS":
                return {"PASS_THROUGH"}  # the view may be moved meanwhile
            if not self._add(context, event):
                self.report({"WARNING"}, rpt_("Draw on the clip: that place is beside it"))
            return {"RUNNING_MODAL"}
        if event.type in {"MOUSEMOVE", "LEFTMOUSE"}:
            self._add(context, event)
        if event.type == "LEFTMOUSE" and event.value == "RELEASE":
            for place in editor.drawing:
                self.path.add().loc = place
            self.end(context)
            return self.execute(context)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        picture = context.scene.stillwater.active()
        layer = example_layer(picture)
        points = [[float(x), float(y)] for x, y in (step.loc for step in self.path)]
        if len({tuple(point) for point in points}) < 2:
            self.report({"ERROR"}, rpt_("Draw a line on the clip: a single point takes nothing"))
            return {"CANCELLED"}
        try:
            strokes.show_clip(picture, layer)
            line = {"points": points, "width": WIDTH / layer.motion.example.clip_scale}
            strokes.lay_down(context.scene, picture, layer.id, {"clone_source": [line]})
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        editor.redraw()
        return {"FINISHED"}

    def _add(self, context, event) -> bool:
        """Takes the place under the mouse, where it is on the clip and not too near the one before."""
        here = (event.mouse_x, event.mouse_y)
        picture = context.scene.stillwater.active()
        place = under_mouse(context.screen, picture, example_layer(picture), *here)
        if place is not None and math.dist(here, self._before) >= APART:
            self._before = here
            editor.drawing.append(place)
            editor.redraw()
        return place is not None

    def end(self, context) -> None:
        editor.drawing.clear()
        editor.redraw()
        super().end(context)


CLASSES = [STILLWATER_OT_draw_clone_source]
