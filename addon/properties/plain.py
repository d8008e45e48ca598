"""Property groups as plain data, so that they can be copied within a picture, to another one and into a file."""

import ast
import re

import bpy
from bpy.app.translations import pgettext_rpt as rpt_


def values_of(group, but: tuple = ()) -> dict:
    """What was said in a group, by name. Names of layers are left out: the ids beside them say the same."""
    names = type(group).__annotations__
    return {name: _plain(getattr(group, name)) for name in names if name not in but and f"{name}_id" not in names}


def set_values(group, values: dict) -> None:
    """Writes such values. Throws ValueError for a name, or a value, that the group can't have."""
    for name, value in values.items():
        kind = group.bl_rna.properties.get(name)
        if name not in type(group).__annotations__ or kind is None:
            raise ValueError(rpt_('"{name}" is not known to this version of Stillwater').format(name=name))
        if kind.type == "COLLECTION":
            items = getattr(group, name)
            items.clear()
            for item in value:
                set_values(items.add(), item)
        elif kind.type == "POINTER" and isinstance(getattr(group, name), bpy.types.PropertyGroup):
            set_values(getattr(group, name), value)
        elif kind.type == "POINTER":
            setattr(group, name, datablock(value))
        else:
            _set(group, name, value)


def address(block) -> list | None:
    """Where a datablock is found: its collection, its name, its library's path, and the tree inside it that it is."""
    found = re.fullmatch(r"bpy\.data\.(\w+)\[(.+)\](?:\.(\w+))?", repr(block)) if block else None
    if found is None:
        return None
    named = ast.literal_eval(found[2])
    name, library = named if isinstance(named, tuple) else (named, None)
    return [found[1], name, library, found[3]]


def datablock(address: list | None):
    """The datablock of this file at an address; None where there is none."""
    if address is None:
        return None
    collection, name, library, inside = address
    block = getattr(bpy.data, collection).get((name, library))
    return getattr(block, inside, None) if inside else block


def _plain(value):
    if isinstance(value, bpy.types.PropertyGroup):
        return values_of(value)
    if isinstance(value, bpy.types.ID):
        return address(value)
    if isinstance(value, str | int | float | bool) or value is None:
        return value
    return [_plain(item) for item in value]


def _set(group, name: str, value) -> None:
    try:
        setattr(group, name, value)
    except (TypeError, ValueError) as error:
        sentence = rpt_("{name}: {value!r} is not a value that it can have")
        raise ValueError(sentence.format(name=name, value=value)) from error
