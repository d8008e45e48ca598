"""The flow that the picture proposes becomes strokes, which the artist goes on with."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import EnumProperty

from .. import engine, strokes
from ..play import recipes
from ..play.stage import Stage
from ..properties import fluids
from ..ui import polls
from . import flow, flow_field

DIGITS = 3


class STILLWATER_OT_propose_flow(bpy.types.Operator):
    """Draw the flow that the picture itself proposes, as strokes that you can change, add to and delete"""

    bl_idname = "stillwater.propose_flow"
    bl_label = "Propose Flow"
    bl_options = {"REGISTER", "UNDO"}

    kind: EnumProperty(name="Proposal", description="What flows", items=fluids.PROPOSALS, options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context):
        if engine.problem():
            cls.poll_message_set(engine.problem())
            return False
        if not polls.own_picture(cls, context) or not polls.on_a_plane(cls, context):
            return False
        picture = context.scene.stillwater.active()
        layer = picture.layers[picture.active_layer] if picture.active_layer < len(picture.layers) else None
        if layer is None or layer.motion.type not in strokes.FLUIDS:
            cls.poll_message_set(tip_("Select a layer with the motion Flow or Example first"))
            return False
        return True

    def execute(self, context):
        scene, picture = context.scene, context.scene.stillwater.active()
        layer = picture.layers[picture.active_layer]
        if self.properties.is_property_set("kind"):
            layer.motion.flow.proposal = self.kind
        try:
            lines = _proposed(scene, picture, layer)
            if not lines:
                raise ValueError(rpt_("{layer}: the picture shows no streaks there; draw with Flow").format(layer=layer.name))
            strokes.ready(context, picture)
            strokes.lay_down(scene, picture, layer.id, {"flow": lines})
        except (ValueError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def _proposed(scene, picture, layer) -> list[dict]:
    """Strokes as a recipe has them, in the picture's pixels. Their speeds are in proportion; the fastest has Stroke Speed."""
    stage = Stage(picture.id, lambda: None)
    recipe, stage.folder = recipes.now(scene, picture)
    stage.look(recipe)
    shown = flow.show.stage_of(scene, picture)
    if shown is not None:  # it knows the matte
        shown.look(recipe)
        shown.folder, stage = stage.folder, shown
    field, scale, bound = flow.proposal(picture, layer, stage)
    found = flow_field.lines_of(field, bound)
    fastest = max((speed for _, speed in found), default=0)
    numbers = layer.motion.flow
    return [
        {
            "points": [[round(float(x) / scale, DIGITS), round(float(y) / scale, DIGITS)] for x, y in line],
            "width": max(4.0, 0.006 * max(picture.picture_size)),
            "kind": "both",
            "speed": round(numbers.stroke_speed * speed / fastest, DIGITS),
            "local": numbers.stroke_local,
            "alpha": numbers.stroke_alpha,
            "frame": None,
        }
        for line, speed in found
    ]


CLASSES = [STILLWATER_OT_propose_flow]
