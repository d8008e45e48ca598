"""Which pixel of a shown clip lies under the mouse, in any editor of a window."""

from bpy_extras import view3d_utils
from mathutils import Vector

from ..properties import clip


def under_mouse(screen, picture, layer, x: int, y: int) -> tuple[float, float] | None:
    """`x`, `y`: px of the window. Pixels of the clip from its top left corner, y down; None beside it."""
    shown = clip.plane_of(picture, layer.id)
    for area in screen.areas if shown is not None else ():
        region = next((each for each in area.regions if each.type == "WINDOW" and _holds(each, x, y)), None)
        if region is None or any(_holds(each, x, y) for each in area.regions if each.type not in ("WINDOW", "XR")):
            continue
        here = (x - region.x, y - region.y)
        if area.type == "VIEW_3D" and shown.visible_get():
            ray = [of(region, area.spaces.active.region_3d, here) for of in _RAY]
            return inside(on_plane(clip.pixels_to_world(picture, layer.id), *ray), clip.size_of(shown))
        if area.type == "IMAGE_EDITOR" and area.spaces.active.image == shown.data:
            return inside(in_editor(region.view2d.region_to_view(*here), clip.size_of(shown)), clip.size_of(shown))
    return None


_RAY = (view3d_utils.region_2d_to_origin_3d, view3d_utils.region_2d_to_vector_3d)


def on_plane(pixels_to_world, origin: Vector, direction: Vector) -> tuple[float, float] | None:
    """Where a ray of sight meets a plane, in its pixels; None where it runs along it."""
    from_world = pixels_to_world.inverted_safe()
    start, way = from_world @ origin, from_world.to_3x3() @ direction
    if abs(way.z) < 1e-9:
        return None
    met = start - way * (start.z / way.z)
    return met.x, met.y


def in_editor(place: tuple[float, float], size: tuple[int, int]) -> tuple[float, float]:
    """A place in an Image Editor, whose picture is 1 wide and 1 high with its lower left corner at 0, in its pixels."""
    return place[0] * size[0], (1 - place[1]) * size[1]


def inside(place: tuple[float, float] | None, size: tuple[int, int]) -> tuple[float, float] | None:
    """The place, where it lies on the clip."""
    return place if place is not None and all(0 <= at < side for at, side in zip(place, size, strict=True)) else None


def _holds(region, x: int, y: int) -> bool:
    return region.x <= x < region.x + region.width and region.y <= y < region.y + region.height
