"""Choosing, saving and removing presets of motions and of the wind."""

import bpy
from bpy.app.translations import pgettext_rpt as rpt_
from bpy.app.translations import pgettext_tip as tip_
from bpy.props import EnumProperty, StringProperty

from ..properties import curves
from . import preset_files
from .selection import OfPicture, chosen

KINDS = [(kind, kind.title(), "") for kind in preset_files.KINDS]
FAILURES = (ValueError, OSError)


class STILLWATER_OT_apply_preset(OfPicture, bpy.types.Operator):
    """Set the numbers of a motion, or of the wind, as a preset has them"""

    bl_idname = "stillwater.apply_preset"
    bl_label = "Apply Preset"

    filepath: StringProperty(
        name="File", description="File of the preset", subtype="FILE_PATH", options={"SKIP_SAVE"}
    )

    @classmethod
    def description(cls, context, properties):
        return preset_files.description_of(properties.filepath) or tip_(cls.__doc__)

    def execute(self, context):
        picture = context.scene.stillwater.active()
        try:
            preset = preset_files.read(self.filepath)
            groups = [picture.wind] if preset.kind == "wind" else _meant(picture, preset.kind)
            for group in groups:
                preset_files.apply(group, preset)
            if preset.kind != "wind":
                picture.layers[picture.active_layer].motion.type = preset.kind
        except FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        kept = sorted(set().union(*map(curves.moved, groups)) & set(preset.numbers))
        if kept:
            sentence = rpt_("{names}: keyed or driven, which stays as it was")
            names = [rpt_(groups[0].bl_rna.properties[name].name) for name in kept]
            self.report({"WARNING"}, sentence.format(names=", ".join(names)))
        return {"FINISHED"}


class STILLWATER_OT_save_preset(OfPicture, bpy.types.Operator):
    """Save the numbers of the active layer's motion, or of the wind, as a preset of your own"""

    bl_idname = "stillwater.save_preset"
    bl_label = "Save Preset"
    bl_options = {"REGISTER"}

    name: StringProperty(name="Name", description="Name of the preset and its file", maxlen=64, options={"SKIP_SAVE"})
    of: EnumProperty(
        name="From", description="Whose numbers are saved",
        items=[("MOTION", "Motion", "The active layer's motion"), ("WIND", "Wind", "The picture's wind")],
    )

    def execute(self, context):
        picture = context.scene.stillwater.active()
        try:
            kind, group = ("wind", picture.wind) if self.of == "WIND" else _motion_of(picture)
            path = preset_files.write(kind, self.name, group)
        except FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, rpt_("Saved {path}").format(path=path))
        return {"FINISHED"}


class STILLWATER_OT_remove_preset(bpy.types.Operator):
    """Delete the file of a preset of your own; this can't be undone"""

    bl_idname = "stillwater.remove_preset"
    bl_label = "Remove Preset"
    bl_options = {"REGISTER"}

    filepath: StringProperty(
        name="File", description="File of the preset", subtype="FILE_PATH", options={"SKIP_SAVE"}
    )

    def invoke(self, context, event):
        return context.window_manager.invoke_confirm(self, event)

    def execute(self, context):
        own = [path for kind in preset_files.KINDS for path in preset_files.paths(kind)]
        path = next((path for path in own if str(path) == self.filepath and not preset_files.is_shipped(path)), None)
        try:
            if path is None:
                raise ValueError(rpt_("{filepath}: is no preset of your own").format(filepath=self.filepath))
            path.unlink()
        except FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


class _Presets:
    """A list of presets that drops down from a button; saving one is its last line."""

    bl_space_type = "PROPERTIES"  # as those of Blender's own presets; where it drops from is told by its button
    bl_region_type = "HEADER"
    bl_label = "Presets"

    @classmethod
    def draw_button(cls, layout, text: str = "") -> None:
        layout.popover(panel=cls.__name__, text=text, icon="PRESET")

    def draw_kind(self, context, kind: str, of: str) -> None:
        column = self.layout.column(align=True)
        for path in preset_files.paths(kind):
            row = column.row(align=True)
            row.emboss = "PULLDOWN_MENU"
            row.operator("stillwater.apply_preset", text=preset_files.name_of(path)).filepath = str(path)
            if not preset_files.is_shipped(path):
                row.operator("stillwater.remove_preset", text="", icon="REMOVE").filepath = str(path)
        self.layout.separator()
        row = self.layout.row(align=True)
        row.prop(context.window_manager, "preset_name", text="")
        saved = row.operator("stillwater.save_preset", text="", icon="ADD")
        saved.name, saved.of = context.window_manager.preset_name, of
        own = {path.parent for path in preset_files.paths(kind) if not preset_files.is_shipped(path)}
        if own:
            shown = self.layout.operator("wm.path_open", text="Open Folder of Your Presets", icon="FILE_FOLDER")
            shown.filepath = str(own.pop())


class STILLWATER_PT_motion_presets(_Presets, bpy.types.Panel):
    """Presets of the active layer's motion."""

    def draw(self, context):
        picture = context.scene.stillwater.active()
        self.draw_kind(context, picture.layers[picture.active_layer].motion.type, "MOTION")


class STILLWATER_PT_wind_presets(_Presets, bpy.types.Panel):
    """Presets of the wind."""

    def draw(self, context):
        self.draw_kind(context, "wind", "WIND")


def _meant(picture, kind: str) -> list:
    """The numbers that a preset of a motion goes to: the active layer's, and those of selected ones of that motion."""
    if picture.active_layer >= len(picture.layers):
        raise ValueError(rpt_("Select a layer first"))
    motions = [picture.layers[i].motion for i in chosen(picture)]
    active = picture.layers[picture.active_layer].motion
    return [getattr(motion, kind) for motion in motions if motion == active or motion.type == kind]


def _motion_of(picture):
    if picture.active_layer >= len(picture.layers):
        raise ValueError(rpt_("Select a layer first"))
    motion = picture.layers[picture.active_layer].motion
    if motion.numbers() is None:
        raise ValueError(rpt_("Choose a motion first: a still layer has no numbers to save"))
    return motion.type, motion.numbers()


CLASSES = [
    STILLWATER_OT_apply_preset,
    STILLWATER_OT_save_preset,
    STILLWATER_OT_remove_preset,
    STILLWATER_PT_motion_presets,
    STILLWATER_PT_wind_presets,
]
