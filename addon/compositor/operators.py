"""The Stillwater node in the Add menu, and reading frames that were made elsewhere."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_

from .. import versions
from ..ui import polls
from . import sequence, tree


class STILLWATER_OT_add_node(bpy.types.Operator):
    """Add a node that gives the active picture's frames"""

    bl_idname = "stillwater.add_node"
    bl_label = "Stillwater"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return polls.own_picture(cls, context)

    def execute(self, context):
        scene = context.scene
        added = tree.add_node(scene, tree.ensure(scene, scene.stillwater.active()))
        top = versions.compositor_tree(scene)
        for node in top.nodes:
            node.select = node == added
        top.nodes.active = added
        if context.space_data is not None and context.space_data.type == "NODE_EDITOR":
            added.location = context.space_data.cursor_location
        return {"FINISHED"}

    def invoke(self, context, event):
        if context.space_data is not None and context.space_data.type == "NODE_EDITOR":
            context.space_data.cursor_location_from_region(event.mouse_region_x, event.mouse_region_y)
        result = self.execute(context)
        # An editor that had no tree before shows the new one after its next redraw only: nothing to drag in yet.
        if bpy.ops.node.translate_attach_remove_on_cancel.poll():
            bpy.ops.node.translate_attach_remove_on_cancel("INVOKE_DEFAULT")
        return result


class STILLWATER_OT_refresh(bpy.types.Operator):
    """Read the active picture's frames from their folder again, as a farm or another machine left them there"""

    bl_idname = "stillwater.refresh"
    bl_label = "Read Frames Again"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        picture = context.scene.stillwater.active()
        if picture is None or picture.tree is None:
            cls.poll_message_set(tip_("The picture has no node yet: bake it, or add one, first"))
            return False
        return True

    def execute(self, context):
        shown = context.scene.stillwater.active().tree
        found = tree.show(shown)
        if not found:
            sentence = rpt_("{folder}: holds no frame {name}_0001.exr")
            state = shown.stillwater
            self.report({"WARNING"}, sentence.format(folder=state.folder, name=state.name))
        return {"FINISHED"}


class STILLWATER_OT_add_to_sequencer(bpy.types.Operator):
    """Add the active picture's frames to the sequencer as a strip, at their own frames"""

    bl_idname = "stillwater.add_to_sequencer"
    bl_label = "Add to Sequencer"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        picture = context.scene.stillwater.active()
        if picture is None or picture.tree is None or not picture.tree.stillwater.there:
            cls.poll_message_set(tip_("The picture has no frames yet: bake it first"))
            return False
        return True

    def execute(self, context):
        shown = context.scene.stillwater.active().tree
        if not tree.show(shown):
            sentence = rpt_("{folder}: holds no frames; bake the picture first")
            self.report({"ERROR"}, sentence.format(folder=shown.stillwater.folder))
            return {"CANCELLED"}
        sequence.add_strip(versions.sequencer_of(context), shown)
        return {"FINISHED"}


def draw_menu(self, context):
    if context.space_data.tree_type == "CompositorNodeTree":
        self.layout.separator()
        self.layout.operator(STILLWATER_OT_add_node.bl_idname, icon="SEQUENCE")


CLASSES = [STILLWATER_OT_add_node, STILLWATER_OT_refresh, STILLWATER_OT_add_to_sequencer]
