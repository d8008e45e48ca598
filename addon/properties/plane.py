"""Where the picture's pixels lie in the scene: on its plane, an image Empty."""

from bpy.app.translations import pgettext_rpt as rpt_
from mathutils import Matrix


def pixels_to_world(picture) -> Matrix:
    """4x4: (x, y, 0, 1), px from the picture's top left corner, y down, to world coordinates.

    An image Empty shows its picture with the longer side `empty_display_size` long, its lower left corner at
    `empty_image_offset` (in widths and heights) from its origin. Throws ValueError where there is no plane or no size.
    """
    plane, size = picture.plane, tuple(picture.picture_size)
    if plane is None or 0 in size:
        sentence = rpt_("{name}: has no plane in the scene; make it anew with Set Up in Scene")
        raise ValueError(sentence.format(name=picture.name))
    return of_pixels(plane, size)


def of_pixels(plane, size: tuple[int, int]) -> Matrix:
    """The same of any image Empty that shows so many pixels."""
    width, height = size
    unit = plane.empty_display_size / max(width, height)
    left, bottom = plane.empty_image_offset[0] * width, plane.empty_image_offset[1] * height
    pixels = Matrix(((unit, 0, 0, left * unit), (0, -unit, 0, (bottom + height) * unit), (0, 0, unit, 0), (0, 0, 0, 1)))
    return plane.matrix_world @ pixels
