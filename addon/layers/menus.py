"""Menus of the layers: what can be added, what else can be done, and what a right click on a value offers."""

import bpy

from ..properties import motions, names
from ..properties.curve_data import LAYER
from . import preset_files, selection


class STILLWATER_MT_add_layer(bpy.types.Menu):
    bl_label = "Add Layer"

    def draw(self, context):
        layout = self.layout
        layout.operator_context = "EXEC_DEFAULT"
        layout.operator("stillwater.add_layer", text="Still", icon=motions.ICONS["still"]).motion = "still"
        for kind in preset_files.KINDS[:-1]:
            layout.separator()
            icon = motions.ICONS[kind]
            if kind == "example":  # its presets are named after the same fluids as those of Flow
                layout.label(text="Flow like a Clip")
            for path in preset_files.paths(kind):
                added = layout.operator("stillwater.add_layer", text=preset_files.name_of(path), icon=icon)
                added.motion, added.preset = kind, str(path)
                icon = "BLANK1"


class STILLWATER_MT_motion(bpy.types.Menu):
    bl_label = "Set Motion"

    def draw(self, context):
        for kind, icon in motions.ICONS.items():
            self.layout.operator("stillwater.set_motion", text=kind.title(), icon=icon).type = kind


class STILLWATER_MT_layers(bpy.types.Menu):
    bl_label = "Layer Specials"

    def draw(self, context):
        layout = self.layout
        layout.operator("stillwater.duplicate_layer", icon="DUPLICATE")
        layout.operator("stillwater.copy_layers", icon="COPYDOWN")
        layout.operator("stillwater.paste_layers", icon="PASTEDOWN")
        layout.separator()
        layout.operator("stillwater.layers_from_mask", icon="MOD_MASK")
        layout.operator("stillwater.layers_from_pass", icon="RENDERLAYERS")
        layout.separator()
        for direction, text, icon in (("TOP", "Move to the Front", "TRIA_UP_BAR"),
                                      ("BOTTOM", "Move to the Back", "TRIA_DOWN_BAR")):
            layout.operator("stillwater.move_layer", text=text, icon=icon).direction = direction
        layout.separator()
        for action, text in (("SELECT", "Select All"), ("DESELECT", "Select None"), ("INVERT", "Invert Selection"),
                             ("MOTION", "Select Same Motion")):
            layout.operator("stillwater.select_layers", text=text).action = action
        layout.separator()
        layout.operator("stillwater.show_layers", text="Show Selected", icon="HIDE_OFF").visible = True
        layout.operator("stillwater.show_layers", text="Hide Selected", icon="HIDE_ON").visible = False
        layout.menu("STILLWATER_MT_motion")
        layout.operator("stillwater.copy_to_selected", text="Copy Motion to Selected").path = "motion"


def draw_context_menu(menu, context):
    """On a value of a layer: copy it to the selected ones."""
    pointer, kind = getattr(context, "button_pointer", None), getattr(context, "button_prop", None)
    if pointer is None or kind is None or not isinstance(pointer, bpy.types.PropertyGroup):
        return
    found = LAYER.fullmatch(f"{pointer.path_from_id()}.{kind.identifier}")
    if found is None or not isinstance(pointer.id_data, bpy.types.Scene):
        return
    index, picture = int(found["layer"]), names.picture_of(pointer)
    path = found["inside"]
    if picture == context.scene.stillwater.active() and selection.can_be_copied(picture.layers[index], path):
        menu.layout.separator()
        copied = menu.layout.operator("stillwater.copy_to_selected")
        copied.path, copied.layer = path, index


CLASSES = [STILLWATER_MT_add_layer, STILLWATER_MT_motion, STILLWATER_MT_layers]
