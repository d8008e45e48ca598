"""A viewport looks through a picture's camera so that the picture lies whole where nothing lies over it."""

from math import sqrt

import bpy
import pytest
from pictures import paint

SIDEBAR = ("RIGHT", 1200, 0, 300, 900)
OVER = [("TOP", 0, 870, 1500, 30), ("LEFT", 0, 0, 40, 870), SIDEBAR]


@pytest.fixture
def fit(extension):
    return extension.pictures.fit


def box_of(fit, over, at=(0, 0)):
    """A viewport of 1500 x 900 at a place of the window, and what of it is free."""
    viewport = fit.Box(*at, 1500, 900)
    return viewport, fit.free(viewport, [(edge, fit.Box(x + at[0], y + at[1], w, h)) for edge, x, y, w, h in over])


@pytest.mark.parametrize(
    "over, free",
    [
        ([], (0, 0, 1500, 900)),
        (OVER, (40, 0, 1160, 870)),
        ([("LEFT", 0, 0, 200, 900), ("BOTTOM", 0, 0, 1500, 120)], (200, 120, 1300, 780)),
        ([("RIGHT", 1500, 0, 300, 900), ("FLOAT", 10, 10, 50, 50), ("NONE", 0, 0, 1500, 900)], (0, 0, 1500, 900)),
    ],
)
@pytest.mark.parametrize("at", [(0, 0), (300, 25)])
def test_what_lies_along_an_edge_is_not_free(fit, over, free, at):
    x, y, *size = free
    assert box_of(fit, over, at)[1] == fit.Box(x + at[0], y + at[1], *size)


@pytest.mark.parametrize("size", [(1280, 800), (800, 1280), (4000, 500), (10, 10), (1, 900)])
@pytest.mark.parametrize("over", [[], OVER])
def test_the_picture_lies_in_its_middle_and_reaches_its_edges(fit, size, over):
    """Where Blender puts it: camera_view_frame and view3d_winmatrix of its sources, for a camera that is orthographic."""
    viewport, free = box_of(fit, over, (100, 50))
    zoom, offset = fit.view_of(viewport, free, size)
    factor = (sqrt(2) + zoom / 50) ** 2 / 4
    width, height = (factor * max(viewport.width, viewport.height) * side / max(size) for side in size)
    x = viewport.middle[0] - 2 * factor * offset[0] * viewport.width
    y = viewport.middle[1] - 2 * factor * offset[1] * viewport.height
    assert (x, y) == pytest.approx(free.middle)
    gaps = sorted([(free.width - width) / 2, (free.height - height) / 2])
    assert gaps[0] >= fit.MARGIN * min(size) / max(size) - 1e-6 and gaps[0] <= fit.MARGIN + 1e-6


def test_a_zoom_that_blender_does_not_have_is_not_asked_for(fit):
    viewport = fit.Box(0, 0, 1500, 900)
    assert fit.view_of(viewport, fit.Box(0, 0, 3, 3), (100, 100))[0] == fit.ZOOMS[0]


def test_there_is_a_button_for_it(scene, tmp_path):
    assert not bpy.ops.stillwater.fit_view.poll()
    bpy.ops.stillwater.open_picture(filepath=str(paint(tmp_path / "a.png")))
    for view in views():
        view.view_perspective = "PERSP"
    assert bpy.ops.stillwater.fit_view() == {"FINISHED"}
    assert {view.view_perspective for view in views()} == {"CAMERA"}
    scene.camera = None
    with pytest.raises(RuntimeError, match="The scene's camera sees something else; use Show Picture first"):
        bpy.ops.stillwater.fit_view()


def views() -> list:
    return [area.spaces.active.region_3d for area in bpy.context.screen.areas if area.type == "VIEW_3D"]
