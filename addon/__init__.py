"""Stillwater: brings still pictures to life. Rooms, in the order in which they may use each other:

    engine       the one door to `import stillwater`
    versions     what differs between Blender 4.5 and 5.2
    properties   what the artist says, in the scene
    recipe       scene <-> recipe, without bpy
    compositor   the node that shows the frames
    bake         the worker that makes them
    ui           panels
"""

from . import bake, compositor, engine, properties, ui

ROOMS = [properties, compositor, bake, ui]


def register():
    """Registers every room, or none: an error is raised on after the rooms before it are taken back."""
    engine.load()
    registered = []
    try:
        for room in ROOMS:
            room.register()
            registered.append(room)
    except Exception:
        for room in reversed(registered):
            room.unregister()
        raise


def unregister():
    for room in reversed(ROOMS):
        room.unregister()
