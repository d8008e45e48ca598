"""How large live pictures are."""

import bpy

PACKAGE = __package__.rpartition(".")[0]
USUAL = 960  # px: the longer side


def longest() -> int:
    """The longer side of a live picture, px: as the preferences have it."""
    addon = bpy.context.preferences.addons.get(PACKAGE)
    return getattr(addon.preferences, "preview_size", USUAL) if addon else USUAL
