"""Names, tooltips and menus are written as Blender's are: https://developer.blender.org/docs/features/interface/hig/"""

import re

import bpy
from pixels import PACKAGE

SMALL = {"a", "an", "and", "as", "at", "by", "for", "from", "in", "it", "of", "on", "or", "the", "to", "with"}
BRITISH = re.compile(r"\b(colour|grey|centre|behaviour|neighbour|metre|licence)", re.IGNORECASE)


def ours(kind) -> list[type]:
    found = [cls for cls in kind.__subclasses__() if cls.__module__.startswith(PACKAGE)]
    return [cls for cls in found if cls.is_registered]


def rna(cls):
    """What Blender knows of a class; of an operator that is what its button shows."""
    if issubclass(cls, bpy.types.Operator):
        return getattr(bpy.ops.stillwater, cls.bl_idname.split(".")[1]).get_rna_type()
    return cls.bl_rna


def properties(cls) -> list:
    """What a person sees of a class's properties."""
    declared = {name for base in cls.__mro__ for name in base.__dict__.get("__annotations__", {})}
    shown = [kind for kind in rna(cls).properties if kind.identifier in declared]
    return [kind for kind in shown if not kind.is_hidden and kind.type not in ("POINTER", "COLLECTION")]


GROUPS = [bpy.types.PropertyGroup, bpy.types.Operator, bpy.types.AddonPreferences]


def names() -> list[str]:
    labels = [cls.bl_label for kind in (bpy.types.Operator, bpy.types.Panel, bpy.types.Menu) for cls in ours(kind)]
    kinds = [kind for group in GROUPS for cls in ours(group) for kind in properties(cls)]
    items = [item.name for kind in kinds if kind.type == "ENUM" for item in kind.enum_items_static]
    return [*labels, *(kind.name for kind in kinds), *items]


def tooltips() -> list[str]:
    kinds = [kind for group in GROUPS for cls in ours(group) for kind in properties(cls)]
    items = [item.description for kind in kinds if kind.type == "ENUM" for item in kind.enum_items_static]
    operators = [rna(cls).description for cls in ours(bpy.types.Operator)]
    said = [kind.description or f"{kind.name} ({kind.identifier}) says nothing." for kind in kinds]
    return [*operators, *said, *filter(None, items)]


def test_names_have_capitals(extension):
    assert len(names()) > 150
    wrong = [name for name in names() for word in name.split()[:1] if not re.match(r"[A-Z0-9s]", word)]
    wrong += [name for name in names() for word in name.split()[1:] if word[0].islower() and word not in SMALL]
    assert wrong == []


def test_tooltips_are_sentences_without_a_period(extension):
    assert len(tooltips()) > 150
    wrong = [text for text in tooltips() if not text or text.endswith(".") or "\n" in text or "  " in text]
    wrong += [text for text in tooltips() if text[:1].islower() and not text.startswith("px")]
    assert wrong == []


def test_tooltips_do_not_begin_in_the_middle(extension):
    assert [text for text in tooltips() if text.startswith("Of ")] == []


def test_words_are_spelled_as_blender_spells_them(extension):
    assert [text for text in [*names(), *tooltips()] if BRITISH.search(text)] == []
