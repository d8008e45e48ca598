"""A picture's place in the scene: its plane, the camera that sees just the plane, the drawing for its strokes.

The plane stands upright (front view), its middle at its origin, the longer side SIDE metres: at the scene's origin, or
behind what stands there. Camera and drawing hang on it: where it goes, they go. All three lie in a collection of their
own.
"""

from math import radians

import bpy
from bpy.app.translations import pgettext_data as data_
from mathutils import Matrix, Vector

from .. import versions

SIDE = 10.0  # m: the longer side of a picture
GAP = 1.0  # m: between the planes of two pictures
DISTANCE = 10.0  # m: of the camera from the plane
SOLID = {"MESH", "CURVE", "CURVES", "SURFACE", "META", "FONT", "GREASEPENCIL", "POINTCLOUD", "VOLUME"}


def ensure(scene, picture) -> None:
    """Makes what is missing of the picture's place, and puts back what was unlinked from the scene."""
    _collection(scene, picture)
    if picture.plane is None:
        picture.plane = _plane(scene, picture)
    picture.plane.data = picture.image
    if picture.camera is None:
        camera = bpy.data.cameras.new(f"{picture.name} {data_('Camera')}")
        camera.type, camera.clip_end = "ORTHO", 10 * DISTANCE
        picture.camera = _hung(picture, bpy.data.objects.new(camera.name, camera))
        picture.camera.location.z = DISTANCE
    if picture.strokes is None:
        drawing = versions.grease_pencils().new(f"{picture.name} {data_('Strokes')}")
        picture.strokes = _hung(picture, bpy.data.objects.new(drawing.name, drawing))
        picture.strokes.hide_render = True  # strokes say what moves; they are no part of the plate
        picture.strokes.show_in_front = True
    for item in parts(picture):
        if item.name not in scene.objects:
            picture.collection.objects.link(item)
    fit_camera(picture)


def parts(picture) -> list:
    """The objects that were made for a picture."""
    return [item for item in (picture.plane, picture.camera, picture.strokes) if item is not None]


def is_whole(scene, picture) -> bool:
    """Whether all of it is there, in this scene."""
    there = parts(picture)
    return picture.image is not None and len(there) == 3 and all(item.name in scene.objects for item in there)


def fit_camera(picture) -> None:
    """Makes the camera see the plane, no more and no less, at the picture's proportions."""
    plane = picture.plane
    picture.camera.data.ortho_scale = plane.empty_display_size * max(plane.matrix_world.to_scale()[:2])


def stretch_strokes(picture, old: tuple[int, int]) -> None:
    """After a change of size: strokes lie over the same part of the picture as before."""
    strokes, new = picture.strokes, tuple(picture.picture_size)
    if strokes is None or strokes.parent != picture.plane or 0 in old:
        return
    sides = [(new[i] / max(new)) / (old[i] / max(old)) for i in (0, 1)]
    strokes.matrix_parent_inverse = Matrix.Diagonal((*sides, 1, 1)) @ strokes.matrix_parent_inverse


def _collection(scene, picture) -> None:
    if picture.collection is None:
        picture.collection = bpy.data.collections.new(f"Stillwater {picture.name}")
    if picture.collection not in scene.collection.children_recursive:
        scene.collection.children.link(picture.collection)


def _plane(scene, picture):
    """The plane, to the right of the scene's other pictures."""
    plane = bpy.data.objects.new(picture.name, None)
    plane.empty_display_type, plane.empty_display_size = "IMAGE", SIDE
    plane.empty_image_offset = -0.5, -0.5
    plane.empty_image_depth = "BACK"  # strokes lie over it from wherever it is seen
    plane.empty_image_side = "DOUBLE_SIDED"
    plane.hide_select = True  # a click means a stroke
    others = [other.plane for other in scene.stillwater.pictures if other.plane not in (None, plane)]
    x = max(other.location.x for other in others) + SIDE + GAP if others else 0
    y = others[0].location.y if others else _free_depth(scene)
    plane.matrix_world = Matrix.Translation((x, y, 0)) @ Matrix.Rotation(radians(90), 4, "X")
    return plane


def _free_depth(scene) -> float:
    """How far back the plane stands, so that nothing of the artist's lies between it and its camera."""
    boxes = [_box(item) for item in scene.objects if item.type in SOLID]
    half = SIDE / 2
    sight = ((-half, half), (-DISTANCE, 0), (-half, half))
    if not any(all(low <= s[1] and high >= s[0] for low, high, s in zip(*box, sight, strict=True)) for box in boxes):
        return 0.0
    return max(high.y for _, high in boxes) + DISTANCE + GAP


def _box(item) -> tuple[Vector, Vector]:
    """The corners of an object's bounding box with the lowest and with the highest coordinates, in the world."""
    corners = [item.matrix_world @ Vector(corner) for corner in item.bound_box]
    return tuple(Vector(edge(axis) for axis in zip(*corners, strict=True)) for edge in (min, max))


def _hung(picture, item):
    item.parent = picture.plane
    return item
