"""A picture's file came back at another size: what is measured in its pixels goes with it.

Places keep their place over the picture, lengths and speeds their share of it; keyed ones too.
"""

from .. import strokes, versions
from ..properties.picture import frame_size
from ..properties.walk import every
from . import place
from . import scene as settings


def resize(scene, picture, new: tuple[int, int]) -> bool:
    """Gives the picture its new size, px. False where it had it, or none, before.

    The camera needs nothing: the plane's longer side stays as long, and the render's proportions follow.
    """
    old = tuple(picture.picture_size)
    picture.picture_size = new
    if old == new or 0 in old:
        return False
    render = scene.render
    if (render.resolution_x, render.resolution_y) == frame_size(picture, old):
        settings.use_size(scene, picture)
    place.stretch_strokes(picture, old)
    factors = new[0] / old[0], new[1] / old[1]
    strokes.scale_speeds(picture, (factors[0] * factors[1]) ** 0.5)
    for group, kind in every(picture):
        if _is_measured(group, kind):
            _scale(scene, group, kind.identifier, factors)
    return True


def _is_measured(group, kind) -> bool:
    """Whether it was set to something that is measured in the picture's pixels, as its description says."""
    return kind.type == "FLOAT" and "[px" in kind.description and group.is_property_set(kind.identifier)


def _scale(scene, group, name: str, factors: tuple[float, float]) -> None:
    value = getattr(group, name)
    if group.bl_rna.properties[name].is_array:
        setattr(group, name, [part * factor for part, factor in zip(value, factors, strict=True)])
    else:
        factors = [(factors[0] * factors[1]) ** 0.5]
        setattr(group, name, value * factors[0])
    path = f"{group.path_from_id()}.{name}"
    for index, factor in enumerate(factors):
        versions.scale_curve(scene, path, index, factor)
