"""A tree cut out with the mouse: a few strokes on it and beside it, and its matte lies over the picture."""

import sys
import time
from pathlib import Path

import bpy
import numpy as np
from seen import on_screen, open_sidebar, part, picture

SAMPLE = Path(__file__).resolve().parents[2] / "blend_samples" / "tree"
CROWN, MEADOW = (600, 220, 700, 300), (150, 690, 400, 780)  # left, top, right, bottom
ON_IT = [[(560, 230), (700, 260), (780, 380), (860, 300)], [(808, 590), (806, 500)]]
BESIDE = [[(300, 90), (300, 520), (420, 640)], [(1150, 120), (1150, 560), (1000, 660)], [(560, 20), (1000, 20)]]


def stage():
    play = next(module for name, module in sys.modules.items() if name.endswith("stillwater.play.show"))
    return play.stage_of(bpy.context.scene, picture())


def call(window, name: str, **arguments) -> None:
    """An operator, as a button of the sidebar calls it."""
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=window.area("VIEW_3D")):
        assert getattr(bpy.ops.stillwater, name)("EXEC_DEFAULT", True, **arguments) == {"FINISHED"}


def strokes(window, role: str, lines: list):
    call(window, "draw_stroke", role=role)
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    for line in lines:
        yield from window.drag([on_screen(window, *place) for place in line])


def test_strokes_cut_the_tree_out(window):
    yield from open_sidebar(window)
    call(window, "open_picture", filepath=str(SAMPLE / "picture.png"))
    call(window, "add_layer", motion="sway")
    yield from window.settle()
    yield from strokes(window, "foreground", ON_IT)
    assert picture().layers[0].matte.form == "scribbles"
    yield from window.see("Press Background and draw beside", window.box("VIEW_3D", "UI"))
    yield from window.screenshot("20-foreground")
    before = window.pixels(part(window, MEADOW)).astype(float)
    yield from strokes(window, "background", BESIDE)
    lifted = time.monotonic()
    cut = lambda: stage().sketch is not None or (stage().live is not None and stage().taken)  # noqa: E731
    yield from window.until(cut, 30, lambda: f"no matte: {stage().problem}")
    print(f"a matte {time.monotonic() - lifted:.2f} s after the pen was lifted")
    yield from window.settle()
    yield from window.screenshot("21-tint")
    tinted = window.pixels(part(window, MEADOW)).astype(float)
    assert (tinted - before)[..., 0].mean() > (tinted - before)[..., 1].mean() + 20  # reddened
    yield from window.until(lambda: stage().sketch is None, 60, "the matte itself does not come")
    matte = stage().live.coverage(picture().layers[0].name)
    scale = stage().live.scale
    inside, outside = (matte[int(t * scale) : int(b * scale), int(l * scale) : int(r * scale)].mean()
                       for l, t, r, b in (CROWN, MEADOW))  # noqa: E741
    assert inside > 0.6 and outside < 0.05, (inside, outside)


def test_the_outline_marches_and_a_checkerboard_can_be_had(window):
    crown = part(window, (480, 120, 900, 640))
    first = window.pixels(crown).astype(float)
    yield 0.5
    assert np.abs(window.pixels(crown) - first).max() > 60  # it has gone on
    bpy.context.scene.stillwater_overlay.checker = True
    yield from window.settle()
    meadow = window.pixels(part(window, MEADOW)).astype(float)
    assert np.ptp(meadow, axis=-1).mean() < 12  # gray squares instead of grass
    yield from window.screenshot("22-checker")


def test_done_takes_both_away(window):
    call(window, "stop_drawing")
    yield from window.until(lambda: bpy.context.mode == "OBJECT", 10, "still in draw mode")
    yield from window.settle()
    green = window.pixels(part(window, MEADOW)).astype(float)
    assert green[..., 1].mean() > green[..., 2].mean() + 20
    bpy.context.scene.stillwater_live.view = "behind"
    yield 1.0
    yield from window.screenshot("23-behind")
    bpy.context.scene.stillwater_live.view = "layer"
    yield 1.0
    yield from window.screenshot("24-layer")
    bpy.context.scene.stillwater_live.view = "picture"


def test_a_layer_from_one_line(window):
    call(window, "layer_from_outline", motion="drift")
    yield from window.until(lambda: bpy.context.mode == "PAINT_GREASE_PENCIL", 10, "no draw mode")
    ring = [(100, 40), (500, 40), (500, 200), (100, 200), (104, 44)]
    yield from window.drag([on_screen(window, *place) for place in ring])
    yield from window.until(lambda: bpy.context.mode == "OBJECT", 20, "it is not done after one line")
    yield from window.until(lambda: stage().problem != "" or stage().share is None, 60, "not cut out")
    yield from window.screenshot("25-from-outline")
    assert picture().layers[0].matte.form == "lasso" and picture().layers[0].name == "Clouds"
