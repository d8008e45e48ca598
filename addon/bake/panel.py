"""How the bake goes, what is out of date and why, and what the frames are to be like."""

import bpy
from bpy.app.translations import pgettext_iface as iface_

from ..ui import sidebar
from . import outdated, status_bar


class _Bake(sidebar.OfPicture):
    bl_label = "Bake"
    bl_order = 7
    bl_options = set()

    def draw(self, context):
        scene = context.scene
        _draw_bake(context, self.layout, scene, scene.stillwater.active())
        row = self.layout.row(align=True)
        row.operator("stillwater.add_to_sequencer", text="To Sequencer", icon="SEQ_SEQUENCER")
        row.menu("STILLWATER_MT_bake", text="", icon="DOWNARROW_HLT")


def _draw_bake(context, layout, scene, picture) -> None:
    state = picture.tree.stillwater if picture.tree else None
    if state is not None and state.state == "running":
        row = layout.row(align=True)
        row.progress(factor=state.share, text=status_bar.text(state))
        row.operator("stillwater.cancel", text="", icon="X").tree = picture.tree.name
        return
    row = layout.row(align=True)
    row.operator("stillwater.bake", icon="RENDER_ANIMATION").picture = picture.name
    part = row.operator_menu_enum("stillwater.bake", "range", text="", icon="DOWNARROW_HLT")
    part.picture = picture.name
    found = outdated.of(scene, picture)
    if state is not None and state.message and (found is None or state.state != "done"):
        sidebar.say(context, layout, state.message, "ERROR" if state.state == "failed" else "INFO")
    for warning in filter(None, state.warning.split("\n") if state is not None else []):
        sidebar.say(context, layout, warning, "ERROR")
    for line in found.lines if found is not None else [iface_("Looking which frames are ready")]:
        sidebar.say(context, layout, line, "CHECKMARK" if found is not None and found.is_ready else "DOT")


class STILLWATER_MT_bake(bpy.types.Menu):
    bl_label = "Bake"

    def draw(self, context):
        layout = self.layout
        layout.operator("stillwater.check_frames", icon="VIEWZOOM")
        layout.operator("stillwater.refresh", icon="FILE_REFRESH")
        layout.separator()
        layout.operator("stillwater.export_recipe", icon="EXPORT")
        layout.operator("stillwater.collect", icon="PACKAGE")
        layout.separator()
        layout.operator("stillwater.free_bake", icon="TRASH")


class STILLWATER_PT_node(sidebar.Part, bpy.types.Panel):
    """Beside the node that is active, whichever picture's it is."""

    bl_label = "Stillwater Node"
    bl_space_type = "NODE_EDITOR"
    bl_category = "Node"
    bl_order = 9

    @classmethod
    def poll(cls, context):
        return super().poll(context) and cls._picture(context) is not None

    @staticmethod
    def _picture(context):
        """The picture whose node is active, with its scene; None where it is none of ours."""
        node = getattr(context, "active_node", None)
        tree = getattr(node, "node_tree", None)
        owners = [(scene, picture) for scene in bpy.data.scenes for picture in scene.stillwater.pictures]
        here = sorted(owners, key=lambda owner: owner[0] != context.scene)
        return next(((scene, picture) for scene, picture in here if tree and picture.tree == tree), None)

    def draw(self, context):
        scene, picture = self._picture(context)
        self.layout.label(text=picture.name, icon="IMAGE_DATA")
        if scene == context.scene:
            _draw_bake(context, self.layout, scene, picture)
        else:
            self.layout.label(text=iface_("Of the scene {name}").format(name=scene.name), icon="SCENE_DATA")


class _Frames(sidebar.OfPicture):
    bl_label = "Output"
    bl_order = 8

    def draw(self, context):
        picture = context.scene.stillwater.active()
        self.layout.use_property_split = True
        for name in ("seed", "loop"):
            self.layout.prop(picture, name)
        sidebar.draw_all(self.layout, picture.output)


CLASSES = [
    STILLWATER_MT_bake,
    *sidebar.in_both_editors("bake", _Bake),
    STILLWATER_PT_node,
    *sidebar.in_both_editors("output", _Frames),
]
