"""A layout that writes down what is drawn on it, and refuses what does not exist."""

from types import SimpleNamespace

import bpy

ICONS = bpy.types.UILayout.bl_rna.functions["prop"].parameters["icon"].enum_items


class Recorder:
    """Stands for Blender's layout: takes any call, keeps texts and properties, and checks that these exist."""

    def __init__(self):
        self.texts, self.properties, self.operators, self.lists, self.menus, self.made = [], [], [], [], [], []
        self.icons = []  # of operators, each with its text

    def __getattr__(self, name):
        if name in ("row", "column", "box", "split", "grid_flow"):
            return lambda **_: self
        if name in ("separator",):
            return lambda **_: None
        if name == "panel":  # all that can be folded is shown unfolded
            return lambda identifier, default_closed=False: (self, self)
        raise AttributeError(name)

    def label(self, text="", icon="NONE"):
        assert icon in ICONS
        self.texts.append(text)

    def progress(self, factor=0.0, text=""):
        self.texts.append(text)

    def prop(self, data, name, text="", icon="NONE", emboss=True, expand=False, placeholder=""):
        getattr(data, name)
        assert icon in ICONS
        self.properties.append(name)

    def menu(self, name, text="", icon="NONE"):
        assert getattr(bpy.types, name).is_registered and icon in ICONS
        self.menus.append(name)

    def popover(self, panel, text="", icon="NONE"):
        self.menu(panel, text, icon)

    def operator(self, name, text="", icon="NONE", depress=False):
        room, verb = name.split(".")
        properties = getattr(getattr(bpy.ops, room), verb).get_rna_type().properties
        assert icon in ICONS
        self.operators.append(name)
        self.icons.append((text, icon))
        self.texts += [text] if text else []
        self.made.append(SimpleNamespace(**{kind.identifier: None for kind in properties}))
        return self.made[-1]

    def operator_menu_enum(self, name, property, text="", icon="NONE"):
        given = self.operator(name, text, icon)
        assert hasattr(given, property)
        return given

    def menu(self, name, text="", icon="NONE"):
        assert getattr(bpy.types, name) and icon in ICONS

    def template_list(self, kind, identifier, data, name, active_data, active_name, rows=1):
        assert getattr(bpy.types, kind) and hasattr(data, name) and hasattr(active_data, active_name)
        self.lists.append(active_name)


def registered(editor: str) -> list[type]:
    """Our panels of one editor ("view_3d" or "node_editor"), in the order in which they are drawn."""
    ours = [cls for cls in bpy.types.Panel.__subclasses__() if cls.__name__.startswith(f"STILLWATER_PT_{editor}")]
    known = [cls for cls in ours if cls.is_registered]
    return sorted(known, key=lambda cls: (hasattr(cls, "bl_parent_id"), getattr(cls, "bl_order", 0)))


def draw(panel) -> Recorder:
    """What a panel draws in the present context."""
    recorder = Recorder()
    panel.draw(SimpleNamespace(layout=recorder), bpy.context)
    return recorder
