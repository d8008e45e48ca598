"""Picking a speed from the clip: how fast it is where it is clicked, as the picture would have it.

Asked of the engine in this process, of the clip's first frames that are used, made small: 50 ms for 640 x 360,
more for a larger one. The preparation in the cache has the whole clip's, but only once the layer is finished.
"""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.props import FloatVectorProperty

from .. import engine
from ..ui import redraw
from .operators import OnClip, example_layer
from .places import under_mouse

DIGITS = 3
FASTEST = 1000.0  # px/frame: the recipe's


def speed_at(scene, example, place: tuple[float, float]) -> float:
    """px/frame of the picture, at a place of the clip in its pixels. Throws ValueError, OSError.

    The clip's own px/frame, times what its pixels and its frames are in the picture's.
    """
    clip = engine.clip_facts(bpy.path.abspath(example.clip))
    right, down = engine.clip_motion(clip, example.clip_first if example.use_clip_frames else 1, place)
    fps = scene.render.fps / scene.render.fps_base
    clip_fps = example.clip_fps or clip.fps or fps
    return min((right**2 + down**2) ** 0.5 * example.clip_scale * clip_fps / fps, FASTEST)


class STILLWATER_OT_pick_speed(OnClip, bpy.types.Operator):
    """Click on the clip, below the picture or in an Image Editor: the next strokes get the speed that it has there"""

    bl_idname = "stillwater.pick_speed"
    bl_label = "Pick Speed"

    place: FloatVectorProperty(
        name="Place", description="Where on the clip [px from its top left corner, y down]", size=2, subtype="XYZ", min=0,
        max=16384, options={"SKIP_SAVE"},
    )

    def invoke(self, context, event):
        hint = rpt_("Click on the clip where it is as fast as the next strokes shall be; Esc: cancel")
        return self.begin(context, "EYEDROPPER", hint)

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"}:
            self.end(context)
            return {"CANCELLED"}
        if event.type != "LEFTMOUSE" or event.value != "PRESS":
            return {"PASS_THROUGH"}  # the view may be moved meanwhile
        picture = context.scene.stillwater.active()
        place = under_mouse(context.screen, picture, example_layer(picture), event.mouse_x, event.mouse_y)
        if place is None:
            self.report({"WARNING"}, rpt_("Click on the clip: that place is beside it"))
            return {"RUNNING_MODAL"}
        self.end(context)
        self.place = place
        return self.execute(context)

    def execute(self, context):
        scene, layer = context.scene, example_layer(context.scene.stillwater.active())
        try:
            speed = speed_at(scene, layer.motion.example, tuple(self.place))
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        layer.motion.flow.stroke_speed = round(speed, DIGITS)
        self.report({"INFO"}, rpt_("The next strokes say {speed:.3g} px/frame").format(speed=speed))
        redraw.panels()
        return {"FINISHED"}


CLASSES = [STILLWATER_OT_pick_speed]
