"""How the bake goes, and what the frames are to be like."""

from ..ui import sidebar


class _Bake(sidebar.OfPicture):
    bl_label = "Bake"
    bl_order = 6
    bl_options = set()

    def draw(self, context):
        layout, picture = self.layout, context.scene.stillwater.active()
        state = picture.tree.stillwater if picture.tree else None
        if state is not None and state.state == "running":
            row = layout.row(align=True)
            row.progress(factor=state.share, text=state.message)
            row.operator("stillwater.cancel", text="", icon="X")
        else:
            layout.operator("stillwater.bake", icon="RENDER_ANIMATION")
            if state is not None and state.message:
                sidebar.say(context, layout, state.message, "ERROR" if state.state == "failed" else "INFO")
        if state is not None:
            for warning in filter(None, state.warning.split("\n")):
                sidebar.say(context, layout, warning, "ERROR")
            layout.operator("stillwater.refresh", icon="FILE_REFRESH")


class _Frames(sidebar.OfPicture):
    bl_label = "Output"
    bl_order = 7

    def draw(self, context):
        picture = context.scene.stillwater.active()
        self.layout.use_property_split = True
        for name in ("colour_space", "seed", "loop"):
            self.layout.prop(picture, name)
        sidebar.draw_all(self.layout, picture.output)


CLASSES = [*sidebar.in_both_editors("bake", _Bake), *sidebar.in_both_editors("output", _Frames)]
