"""How the scene is set for a picture, and how it was set before: camera, render size, view transform, compositor."""

import contextlib

import bpy
from bpy.app.translations import pgettext_rpt as rpt_

from ..compositor import tree as node
from ..properties import clip
from ..properties.picture import frame_size
from . import fit

STANDARD = {
    "view_transform": "Standard", "look": "None", "exposure": 0.0, "gamma": 1.0,
    "use_curve_mapping": False, "use_white_balance": False,
}  # fmt: skip
RATES = {  # frames a second: fps, fps_base
    "23.98": (24, 1.001), "24": (24, 1.0), "25": (25, 1.0), "29.97": (30, 1.001), "30": (30, 1.0), "50": (50, 1.0),
    "60": (60, 1.0),
}  # fmt: skip


def keep(scene) -> None:
    """Remembers how the scene is set, once: before its first picture."""
    former, render = scene.stillwater.former, scene.render
    if former.kept:
        return
    former.kept, former.camera = True, scene.camera
    former.resolution = render.resolution_x, render.resolution_y
    former.resolution_percentage = render.resolution_percentage
    former.pixel_aspect = render.pixel_aspect_x, render.pixel_aspect_y
    former.fps, former.fps_base = render.fps, render.fps_base
    keep_view(scene)


def keep_view(scene) -> None:
    former = scene.stillwater.former
    former.display_device = scene.display_settings.display_device
    for name in STANDARD:
        setattr(former, name, getattr(scene.view_settings, name))


def is_standard(scene) -> bool:
    """Whether renders show a picture's colours as they are."""
    settings, device = scene.view_settings, scene.display_settings.display_device
    return device == "sRGB" and all(getattr(settings, name) == value for name, value in STANDARD.items())


def can_go_back(scene) -> bool:
    """Whether there was another view transform before."""
    former = scene.stillwater.former
    before = {name: getattr(former, name) for name in STANDARD}
    was_standard = before == STANDARD and former.display_device == "sRGB"
    return bool(former.view_transform) and not was_standard and is_standard(scene)


def use_standard(scene) -> None:
    """The view transform that changes no colour; the one before it is remembered. Throws ValueError."""
    if is_standard(scene):
        return
    keep_view(scene)
    try:
        scene.display_settings.display_device = "sRGB"
        for name, value in STANDARD.items():
            setattr(scene.view_settings, name, value)
    except TypeError:
        back_to_former_view(scene)
        sentence = rpt_("This color configuration has no view transform Standard on sRGB: colors may differ")
        raise ValueError(sentence) from None


def back_to_former_view(scene) -> None:
    """The view transform from before. Throws ValueError."""
    former = scene.stillwater.former
    try:
        scene.display_settings.display_device = former.display_device
        for name in STANDARD:
            setattr(scene.view_settings, name, getattr(former, name))
    except TypeError:
        sentence = rpt_("This color configuration has no view transform {name}")
        raise ValueError(sentence.format(name=former.view_transform)) from None


def use_rate(scene, rate: str) -> None:
    """One of RATES; any other name leaves the scene's."""
    if rate in RATES:
        scene.render.fps, scene.render.fps_base = RATES[rate]


def use_size(scene, picture) -> None:
    """Frames as large as the picture's."""
    render = scene.render
    render.resolution_x, render.resolution_y = frame_size(picture)
    render.resolution_percentage = 100
    render.pixel_aspect_x = render.pixel_aspect_y = 1


def show(scene, picture) -> bool:
    """Makes the picture what the scene's camera sees and what renders show, at its size.

    False where the artist's own compositor stands at the output: then the node is only put beside it.
    """
    keep(scene)
    use_size(scene, picture)
    scene.camera = picture.camera
    tree = node.ensure(scene, picture)
    node.show(tree)
    if node.is_free(scene):
        node.wire(scene, tree)
        return True
    if not node.nodes_of(scene, picture.id):
        node.add_node(scene, tree)
    return False


def look(scene, picture, below=None) -> None:
    """Makes every 3D viewport that shows the scene look through its camera, at the whole picture.

    `below`: the plane of a clip that is to be seen with it, below it.
    """
    size = frame_size(picture)
    share = fit.above(size, clip.size_of(below), clip.GAP) if below is not None else (1.0, 1.0)
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas if window.scene == scene else ():
            if area.type == "VIEW_3D":
                _look_through(area, size, share)


def _look_through(area, size: tuple[int, int], share: tuple[float, float]) -> None:
    view = area.spaces.active.region_3d
    view.view_perspective = "CAMERA"
    boxes = {region: fit.Box(region.x, region.y, region.width, region.height) for region in area.regions}
    viewport = next(box for region, box in boxes.items() if region.type == "WINDOW")
    over = [(region.alignment, box) for region, box in boxes.items() if min(box.width, box.height) > 1]
    within = fit.upper(fit.free(viewport, over), share)
    if min(within.width, within.height) > 1:  # it was drawn already
        view.view_camera_zoom, view.view_camera_offset = fit.view_of(viewport, within, size)


def go_back(scene, camera_gone: bool, size: tuple[int, int]) -> None:
    """After the last picture was removed: what is still as it was set for it becomes as it was before."""
    former, render = scene.stillwater.former, scene.render
    if not former.kept:
        return
    if camera_gone and former.camera is not None and former.camera.name in scene.objects:
        scene.camera = former.camera
    if (render.resolution_x, render.resolution_y) == size:
        render.resolution_x, render.resolution_y = former.resolution
        render.resolution_percentage = former.resolution_percentage
        render.pixel_aspect_x, render.pixel_aspect_y = former.pixel_aspect
    if is_standard(scene):
        with contextlib.suppress(ValueError):  # then it stays as it is
            back_to_former_view(scene)
    former.kept, former.camera = False, None
