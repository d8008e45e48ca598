"""A lake becomes a river with the mouse: the proposed flow, strokes, streaks that move, colors, and the water plays."""

import sys
from pathlib import Path

import bpy
import numpy as np
from seen import is_live, on_screen, open_sidebar, part, picture

SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "lake"
WATER, SKY = (460, 600, 640, 760), (420, 20, 760, 120)  # left, top, right, bottom
ALONG = [[(420, 500), (600, 560), (900, 640)], [(500, 700), (700, 740), (880, 720)]]


def module(name: str):
    return next(found for known, found in sys.modules.items() if known.endswith(f"stillwater.{name}"))


def stage():
    return module("play.show").stage_of(bpy.context.scene, picture())


def sight():
    return module("overlay.flow").of(bpy.context.scene, picture())


def call(window, name: str, **arguments) -> None:
    """An operator, as a button of the sidebar calls it."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=window.area("VIEW_3D")):
        assert getattr(bpy.ops.stillwater, name)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}


def test_the_picture_proposes_a_flow(window):
    yield from open_sidebar(window)
    call(window, "open_picture", filepath=str(SAMPLE / "picture.png"))
    call(window, "add_layer", motion="flow")
    picture().layers[0].matte.form, picture().layers[0].matte.file = "file", str(SAMPLE / "mattes" / "water.png")
    yield from window.see("Direction", window.box("VIEW_3D", "UI"))
    yield from window.until(lambda: sight() is not None and sight().proposed, 30, lambda: module("overlay.flow").problem)
    yield from window.screenshot("50-proposed")
    first = window.pixels(part(window, WATER)).astype(float)
    yield 0.5
    assert np.abs(window.pixels(part(window, WATER)) - first).max() > 8  # the streaks move


def test_strokes_say_where_it_flows(window):
    call(window, "draw_stroke", role="flow")
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    yield from window.see("Done", window.box("VIEW_3D", "UI"))
    for line in ALONG:
        yield from window.drag([on_screen(window, *place) for place in line])
    yield from window.until(lambda: sight() is not None and not sight().proposed, 30, lambda: module("overlay.flow").problem)
    yield from window.screenshot("51-streaks")
    yield from window.cut_out("flow", window.box("VIEW_3D"), 0.7)
    before = window.pixels(part(window, WATER)).astype(float)
    yield 0.5
    assert np.abs(window.pixels(part(window, WATER)) - before).max() > 25


def test_colors_tell_the_direction(window):
    bpy.context.scene.stillwater_overlay.flow_colors = True
    yield from window.settle()
    yield from window.screenshot("52-colors")
    bpy.context.scene.stillwater_overlay.flow_colors = False
    yield from window.settle()


def test_rocks_are_held_still(window):
    call(window, "draw_stroke", role="freeze")
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    yield from window.drag([on_screen(window, *place) for place in ((1000, 700), (1100, 740))])
    yield from window.until(lambda: stage().read["layers"][0]["motion"].get("freeze"), 10, "nothing is held")
    yield from window.screenshot("53-hold-still")


def test_it_plays(window):
    call(window, "stop_drawing")
    yield from window.until(lambda: bpy.context.mode == "OBJECT", 10, "still in draw mode")
    yield from window.until(is_live, 90, lambda: f"not cut out: {stage().problem}")
    yield from window.until(lambda: stage().share is None, 90, "still in preparation")
    yield from window.screenshot("54-live")
    seen = []
    for frame in (1, 9, 17):
        bpy.context.scene.frame_set(frame)
        yield from window.settle()
        seen.append([window.pixels(part(window, place)).astype(float) for place in (WATER, SKY)])
        yield from window.screenshot(f"55-frame-{frame}")
    for (water, sky), (water_after, sky_after) in zip(seen, seen[1:]):
        assert np.abs(water_after - water).mean() > 1.5, "the water does not move"
        assert np.abs(sky_after - sky).max() <= 2, "the sky moves"
    yield from window.key("SPACE", at=window.box("VIEW_3D").middle)
    yield from window.until(lambda: window.plays, 10, "it does not play")
    yield 2.0
    yield from window.screenshot("56-plays")
    yield from window.key("SPACE", at=window.box("VIEW_3D").middle)
