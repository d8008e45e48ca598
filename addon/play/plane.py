"""Pixels onto the picture's plane, and away again.

The plane, an image Empty, shows a float image of our own while the picture is live, else the picture's own image. Ours is
looked up by its name at every frame: undo and loading may have taken it away.
"""

import bpy

PREFIX = "Stillwater Live "
REST = 0.3  # s


def show(picture, pixels) -> None:
    """Shows height x width x 4 pixels (scene-linear, premultiplied, bottom row first) on the plane."""
    height, width = pixels.shape[:2]
    image = _image(PREFIX + picture.id, width, height)
    image.pixels.foreach_set(pixels.ravel())
    if picture.plane.data != image:
        picture.plane.data = image
    if not bpy.app.timers.is_registered(rest):
        bpy.app.timers.register(rest, first_interval=REST)


def rest() -> float | None:
    """Packs live images once nothing plays; called by a timer.

    Before it saves or quits, Blender asks what is to become of images that were changed: of those that are not packed.
    """
    if any(window.screen.is_animation_playing for window in bpy.context.window_manager.windows):
        return REST
    for image in bpy.data.images:
        if is_live(image) and image.is_dirty:
            image.pack()
    return None


def clear(picture) -> None:
    """Shows the picture's own image again."""
    if picture.plane is not None and is_live(picture.plane.data):
        picture.plane.data = picture.image
    image = bpy.data.images.get(PREFIX + picture.id)
    if image is not None and image.users == 0:
        bpy.data.images.remove(image)


def shows(picture) -> bool:
    """Whether the plane shows what show() left on it."""
    image = bpy.data.images.get(PREFIX + picture.id)
    return image is not None and picture.plane.data == image


def is_live(image) -> bool:
    return image is not None and image.name.startswith(PREFIX)


def sweep(identifiers: set[str]) -> None:
    """Removes the live images of pictures that are gone."""
    for image in [image for image in bpy.data.images if is_live(image)]:
        if image.name.removeprefix(PREFIX) not in identifiers:
            bpy.data.images.remove(image)


def _image(name: str, width: int, height: int):
    image = bpy.data.images.get(name)
    if image is not None and tuple(image.size) != (width, height):
        bpy.data.images.remove(image)
        image = None
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True, float_buffer=True)
    return image
