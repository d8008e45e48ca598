"""Stillwater: brings still pictures to life. Rooms, in the order in which they may use each other:

    engine       the one door to `import stillwater`
    versions     what differs between Blender 4.5 and 5.2
    preferences  cache, threads, the worker's Python: the person's, not the file's
    properties   what the artist says, in the scene
    recipe       scene <-> recipe, without bpy
    ui           the sidebar's tab, and what all panels share
    compositor   the node that shows the frames
    strokes      what is said by drawing on the picture
    layers       the list of layers, their motions, wind and view
    bake         the worker that makes the frames
    pictures     from a file on disk to a picture that can be drawn on, and away again

Each room registers its own classes: properties, operators and the panels that show them.
"""

from . import bake, compositor, engine, layers, pictures, preferences, properties, strokes, ui

ROOMS = [preferences, properties, ui, compositor, strokes, layers, bake, pictures]


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
