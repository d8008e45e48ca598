"""A lake moves like a clip: the clip is shown below the picture, its speed picked, a piece of it cloned, and it plays."""

import sys
from pathlib import Path

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector
from seen import is_live, on_screen, open_sidebar, part, picture

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))
import clips  # noqa: E402

SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "lake"
WATER = (660, 520, 940, 780)  # left, top, right, bottom
SIZE = (320, 180)  # px, of the clip
TAKEN, LAID = [(40, 60), (160, 70), (280, 60)], [(420, 500), (600, 520), (800, 500)]
ALONG = [(400, 600), (620, 690), (900, 700)]


def module(name: str):
    return next(found for known, found in sys.modules.items() if known.endswith(f"stillwater.{name}"))


def call(window, name: str, **arguments) -> None:
    """An operator, as a button of the sidebar calls it."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=window.area("VIEW_3D")):
        assert getattr(bpy.ops.stillwater, name)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}


def water() -> np.ndarray:
    """Water of the picture that passes by, as a clip."""
    image = picture().image
    pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
    image.pixels.foreach_get(pixels)
    whole = pixels.reshape(image.size[1], image.size[0], 4)[::-1, :, :3]
    return clips.scrolled(whole[520:, 380:], SIZE)


def on_clip(window, x: float, y: float) -> tuple[int, int]:
    """Where a pixel of the clip is seen in the viewport."""
    place = module("properties.clip").pixels_to_world(picture(), picture().layers[0].id) @ Vector((x, y, 0))
    area, box = window.area("VIEW_3D"), window.box("VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    seen = location_3d_to_region_2d(region, area.spaces.active.region_3d, place)
    return round(box.x + seen.x), round(box.y + seen.y)


def stage():
    return module("play.show").stage_of(bpy.context.scene, picture())


def test_the_clip_is_shown_below_the_picture(window):
    yield from open_sidebar(window)
    call(window, "open_picture", filepath=str(SAMPLE / "picture.png"))
    path = clips.write(Path(bpy.app.tempdir) / "clip.avi", water())
    call(window, "add_layer", motion="example")
    picture().layers[0].matte.form, picture().layers[0].matte.file = "file", str(SAMPLE / "mattes" / "water.png")
    yield from window.see("Choose Clip", window.box("VIEW_3D", "UI"), lowest=True)
    yield from window.screenshot("60-no-clip")
    call(window, "choose_clip", filepath=str(path))
    yield from window.scroll_to("Show Clip", window.box("VIEW_3D", "UI"))
    yield from window.click("Show Clip", window.box("VIEW_3D", "UI"))
    yield from window.until(lambda: module("properties.clip").planes_of(picture()), 30, "no clip is shown")
    yield from window.screenshot("61-clip")
    box = window.box("VIEW_3D")
    for corner in ((0, 0), SIZE):
        x, y = on_clip(window, *corner)
        assert box.x <= x <= box.x + box.width and box.y <= y <= box.top, f"{corner} of the clip is out of sight: {x}, {y} in {box}"


def test_a_click_on_it_gives_its_speed(window):
    numbers = picture().layers[0].motion.flow
    numbers.stroke_speed = 0
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=window.area("VIEW_3D")):
        assert bpy.ops.stillwater.pick_speed("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from window.settle()
    yield from window.click(on_clip(window, 160, 90))
    yield from window.until(lambda: numbers.stroke_speed > 0, 30, "no speed was picked")
    scene = bpy.context.scene
    wanted = clips.STEP * clips.FPS * scene.render.fps_base / scene.render.fps
    assert abs(numbers.stroke_speed - wanted) < 0.2 * wanted, numbers.stroke_speed


def test_what_is_drawn_on_clip_and_picture_is_a_pair(window):
    for role, line, seen in (("clone_source", TAKEN, on_clip), ("clone_target", LAID, on_screen), ("flow", ALONG, on_screen)):
        call(window, "draw_stroke", role=role)
        yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
        yield from window.drag([seen(window, *place) for place in line])
    yield from window.screenshot("62-clones")
    yield from window.cut_out("example", window.box("VIEW_3D"), 0.7)
    yield from window.until(lambda: stage().read["layers"][0]["motion"]["transfer"].get("strokes"), 20, "nothing is cloned")
    (pair,) = stage().read["layers"][0]["motion"]["transfer"]["strokes"]
    for drawn, line, pixel in ((pair["source"], TAKEN, 1.0), (pair["target"], LAID, 4.0)):
        for end in (0, -1):
            assert np.hypot(*np.subtract(drawn[end], line[end])) < 2 * pixel, (drawn, line)
    call(window, "stop_drawing")


def test_a_source_is_drawn_on_the_clip_in_an_image_editor(window):
    area = window.area("PROPERTIES")
    area.type = "IMAGE_EDITOR"
    yield from window.settle()
    call(window, "show_clip")
    area.spaces.active.show_region_ui = False
    yield from window.settle()
    region = next(region for region in area.regions if region.type == "WINDOW")

    def seen(x, y):
        at = region.view2d.view_to_region(x / SIZE[0], 1 - y / SIZE[1], clip=False)
        return region.x + at[0], region.y + at[1]

    def drawn():
        return module("clips.editor").sources(bpy.context.scene, picture(), picture().layers[0])

    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=area, region=region):
        bpy.ops.image.view_all(fit_view=True)
        assert bpy.ops.stillwater.draw_clone_source("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from window.settle()
    yield from window.drag([seen(*place) for place in TAKEN])
    yield from window.until(lambda: len(drawn()) == 2, 20, "no source was drawn")
    for end in (0, -1):
        assert np.hypot(*np.subtract(drawn()[1][end], TAKEN[end])) < 3, drawn()
    area.spaces.active.show_region_ui = True
    yield from window.settle()
    next(region for region in area.regions if region.type == "UI").active_panel_category = "Stillwater"
    yield from window.settle()
    yield from window.screenshot("64-image-editor")
    area.type = "PROPERTIES"


def test_it_plays_like_the_clip(window):
    picture().layers[0].motion.example.life = 6
    yield from window.until(lambda: stage().share is None and not stage().problem and is_live(), 150, lambda: f"not ready: {stage().problem}")
    yield from window.screenshot("63-live")
    seen = []
    for frame in (1, 9, 17):
        bpy.context.scene.frame_set(frame)
        yield from window.settle()
        seen.append(window.pixels(part(window, WATER)).astype(float))
    changes = [np.abs(after - before).mean() for before, after in zip(seen, seen[1:])]
    assert min(changes) > 0.5, f"the water does not move: {changes}"
