"""From a recipe to its frames: everything around the engine's FrameRenderer.

    resolve    recipe -> the plain numbers of one frame
    keys       ... and the hash of all that a frame, or a preparation, depends on
    reads      ... part by part, so that what changed can be named
    standing   which frames are there and right, and why the others are not
    cache      preparations, kept beside the recipe (lock: by one worker at a time)
    prepare    picture and mattes -> layers
    claim      which worker renders which frames
    loop       frame after frame; what happens comes as events
    movie      frames -> a film
    preview    layers at the size of a screen, prepared
    live       frames for a screen, from what is prepared

Start with loop.py.
"""
