"""A picture is dropped onto the viewport, and a finished one opened from its recipe beside it: the water of a lake."""

from pathlib import Path

import bpy
from seen import FIELD, changes, is_live, on_screen, open_overlays, open_sidebar, part, picture, right_end
from seen import switch_off_and_on

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
WATER = (300, 600, 640, 780)  # left, top, right, bottom


def test_a_picture_dropped_onto_the_viewport_is_opened(window):
    yield from open_sidebar(window)
    yield from window.drop_file(SAMPLES / "tree" / "picture.png", window.box("VIEW_3D").middle)
    yield from window.screenshot("31-dropped")
    yield from window.key("O")  # the letter that is underlined in Open in Stillwater
    yield from window.until(lambda: picture() is not None, 20, "no picture")
    assert bpy.context.scene.camera == picture().camera
    yield from window.screenshot("32-opened")


def test_a_lake_is_opened_beside_it_from_its_recipe(window):
    sidebar = window.box("VIEW_3D", "UI")
    title = yield from window.see("Stillwater", sidebar)
    row = [(x, title[1] - 30) for x in range(right_end(sidebar), sidebar.x, -8)]
    yield from window.point_at("stillwater.load_recipe", row)
    yield from window.press()
    yield from window.until(lambda: window.has("FILE_BROWSER"), 10, "no file browser")
    yield from window.open_file(SAMPLES / "lake" / "recipe.json", "Open Recipe")
    yield from window.until(lambda: len(bpy.context.scene.stillwater.pictures) == 2, 30, "no second picture")
    assert len(picture().layers) == 9 and bpy.context.scene.frame_end == 120
    yield from window.screenshot("33-lake")
    yield from window.until(is_live, 90, "the layers are not cut out")


def test_water_shows_its_plane_as_a_grid(window):
    yield from window.scroll_to("water", window.box("VIEW_3D", "UI"))
    yield from window.click("water", window.box("VIEW_3D", "UI"))
    yield from window.settle()
    yield from window.screenshot("34-water")
    yield from window.cut_out("water", window.box("VIEW_3D"), 0.6)
    yield from open_overlays(window)
    yield from switch_off_and_on(window, "Water Plane", part(window, WATER), least=400)
    yield from window.key("ESC")


def test_a_slider_moved_while_it_plays_is_seen(window):
    sidebar, water = window.box("VIEW_3D", "UI"), part(window, WATER)
    amplitude = lambda: picture().layers[6].motion.ripple.amplitude  # noqa: E731
    yield from window.scroll_to("Amplitude", sidebar)
    before, still = amplitude(), window.pixels(water)
    yield from window.key("SPACE", at=on_screen(window, 300, 300))
    yield 1.0
    assert changes(window, water, still) > 1
    label = yield from window.see("Amplitude", sidebar, lowest=True)
    number = label[0] + FIELD, label[1]
    yield from window.drag([number, (number[0] + 60, number[1])])
    assert window.plays and amplitude() > before
    yield from window.screenshot("35-rougher")
    yield from window.key("SPACE", at=on_screen(window, 300, 300))
    assert not window.plays and bpy.context.scene.frame_current > 1
    rough, high = window.pixels(water), amplitude()
    yield from window.drag([number, (number[0] - 160, number[1])])  # calm
    assert amplitude() < high, (amplitude(), high)
    assert changes(window, water, rough) > 0.5, (changes(window, water, rough), amplitude(), high)
