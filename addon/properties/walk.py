"""Every property of a picture, however deep."""

from collections.abc import Iterator

import bpy


def every(group) -> Iterator[tuple]:
    """Each property below a property group, as (the group that has it, its definition)."""
    for kind in group.bl_rna.properties:
        if kind.identifier == "rna_type":
            continue
        yield group, kind
        if kind.type == "COLLECTION":
            for item in getattr(group, kind.identifier):
                yield from every(item)
        elif kind.type == "POINTER" and isinstance(getattr(group, kind.identifier), bpy.types.PropertyGroup):
            yield from every(getattr(group, kind.identifier))
