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
    play         the picture in motion in the viewport, with no bake
    overlay      what can't be seen in the picture itself, drawn over it
    pictures     from a file on disk to a picture that can be drawn on, and away again
    clips        the clip that a fluid looks like: chosen, shown, asked for its speed

Each room registers its own classes: properties, operators and the panels that show them.
"""

from . import bake, clips, compositor, engine, layers, overlay, pictures, play, preferences, properties, strokes, ui

ROOMS = [preferences, properties, ui, compositor, strokes, layers, bake, play, overlay, pictures, clips]


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
