"""Overlays: their lines lie where the engine has things, and they are drawn when they are asked for."""

import random
from types import SimpleNamespace

import bpy
import numpy as np
import pytest
import stage
from panels import Recorder

SIZE = (640, 400)


@pytest.fixture
def room(extension):
    return extension.overlay


def recipe(*layers, **more):
    plain = {"visible": True, "motion": {"type": "still"}}
    return {
        "wind": {"speed": 5.0, "direction": 0.0, "gusts": 0.0},
        "view": {"fov": 50.0, "height": 1.7},
        "layers": [plain | layer for layer in layers],
        **more,
    }


class Bending:
    """Stands for stillwater.Live: all that moves is 10 px to the right, gusts are twice the wind."""

    layers, scale = ["tree", "boat"], 0.5

    def moved(self, frame, layer, points):
        return [(x + 10, y) for x, y in points]

    def gust(self, frame, points):
        return [(1.0, 0.0, 2.0) for _ in points]


def subject(room, given, active="", live=None, frame=1):
    return room.shapes.Subject(given, SIZE, frame, active, live)


VIEWS = [
    ([[0, 150], [640, 150]], 50, 1.7),
    ([[640, 150], [0, 150]], 50, 1.7),
    ([[-50, -90], [700, -20]], 90, 12),
    ([[0, 180], [640, 260]], 20, 0.5),
    ([[300, 0], [300, 400]], 50, 3),
]


@pytest.mark.parametrize("horizon, fov, height", VIEWS)
def test_the_water_s_plane_is_the_engine_s(room, horizon, fov, height):
    from stillwater import _stillwater as engine

    ours = room.water.WaterPlane(horizon, fov, height, SIZE)
    theirs = engine.WaterPlane(engine.View(horizon=horizon, fov=fov, height=height), SIZE)
    rng, compared = random.Random(1), 0
    for _ in range(200):
        place = rng.uniform(0, SIZE[0]), rng.uniform(0, SIZE[1])
        level = ours.level(place)
        np.testing.assert_allclose(ours.picture(level), place, atol=1e-9)
        if level[1] <= ours.horizon + 1:
            continue
        right, away = theirs.ground(place)
        np.testing.assert_allclose(ours.seen(right, away), place, atol=1e-6)
        assert ours.away(level[1]) == pytest.approx(away)
        compared += 1
    assert compared > 20


@pytest.mark.parametrize("horizon, fov, height", VIEWS)
def test_the_grid_lies_on_the_water_within_the_picture(room, horizon, fov, height):
    plane = room.water.WaterPlane(horizon, fov, height, SIZE)
    lines = room.water.grid(plane, SIZE)
    assert len(lines) > 10
    for x, y in [end for line in lines for end in line]:
        assert -1e-3 <= x <= SIZE[0] + 1e-3 and -1e-3 <= y <= SIZE[1] + 1e-3
        assert plane.level((x, y))[1] >= plane.horizon - 1e-3


def test_without_water_in_the_picture_there_is_no_grid(room):
    plane = room.water.WaterPlane([[0, 500], [640, 500]], 50, 1.7, SIZE)
    assert room.water.grid(plane, SIZE) == []
    with pytest.raises(ValueError, match="horizon: has no length"):
        room.water.WaterPlane([[1, 2], [1, 2]], 50, 1.7, SIZE)


@pytest.mark.parametrize(
    "a, b, inside",
    [
        ((-10, 50), (110, 50), ((0, 50), (100, 50))),
        ((20, 20), (30, 40), ((20, 20), (30, 40))),
        ((50, -50), (150, 50), None),
        ((-5, 10), (-5, 90), None),
        ((50, 150), (50, 50), ((50, 100), (50, 50))),
    ],
)
def test_lines_are_cut_at_the_picture(room, a, b, inside):
    assert room.water.clip(a, b, (100, 100)) == inside


def test_an_outline_goes_round_its_matte_and_closes(room):
    y, x = np.mgrid[:80, :100] + 0.5
    coverage = np.clip(20.5 - np.hypot(x - 45, y - 38), 0, 1)
    lines = room.outline.outline(coverage)
    radius = np.hypot(lines[..., 0] - 45, lines[..., 1] - 38)
    assert np.abs(radius - 20).max() < 0.1
    ends, counts = np.unique(lines.reshape(-1, 2).round(3), axis=0, return_counts=True)
    assert len(ends) == len(lines) and (counts == 2).all()
    (ax, ay), (bx, by) = lines[:, 0].T, lines[:, 1].T
    assert abs((ax * by - bx * ay).sum() / 2) == pytest.approx(np.pi * 400, rel=0.01)


def test_an_outline_closes_at_the_border_and_at_single_pixels(room):
    assert len(room.outline.outline(np.zeros((5, 5)))) == 0
    full = room.outline.outline(np.ones((4, 6)))
    assert full[..., 0].min() == 0 and full[..., 0].max() == 6 and full[..., 1].max() == 4
    corners = np.array([[1, 0], [0, 1]])
    _, counts = np.unique(room.outline.outline(corners).reshape(-1, 2), axis=0, return_counts=True)
    assert (counts == 2).all()


def test_an_outline_has_no_specks(room):
    """Leaves that fly beside the crown and gaps between its leaves, of a few pixels."""
    y, x = np.mgrid[:300, :400] + 0.5
    crown = (np.hypot(x - 200, y - 150) < 100).astype(np.float32)
    alone = room.outline.outline(crown)
    specked = crown.copy()
    for row, column in ((20, 20), (21, 20), (150, 200), (150, 201), (250, 380)):
        specked[row, column] = 1 - specked[row, column]
    np.testing.assert_array_equal(np.sort(room.outline.outline(specked), axis=0), np.sort(alone, axis=0))
    specked[140:160, 190:210] = 0  # a gap as large as a branch
    assert len(room.outline.outline(specked)) > len(alone)


def test_a_matte_of_specks_alone_keeps_its_outline(room):
    stars = np.zeros((300, 400))
    stars[::50, ::50] = 1
    assert len(room.outline.outline(stars)) == 4 * stars.sum()


def test_an_outline_is_left_out_whole_or_not_at_all(room):
    """In a maze of outlines that touch at corners, too."""
    lines = room.outline.outline(np.random.default_rng(3).random((200, 300)), 0.45)
    _, counts = np.unique(lines.reshape(-1, 2), axis=0, return_counts=True)
    assert (counts == 2).all() and len(lines) > 10_000


TREE = {"name": "tree", "motion": {"type": "sway", "armature": [[100, 300], [100, 100]]}}


def test_a_sway_line_bends_with_its_layer(room):
    still, bent, cross = room.shapes.sway_lines(subject(room, recipe(TREE), "tree", Bending()))
    assert (still.ends[0], still.ends[-1]) == ([100, 300], [100, 100])
    assert bent.ends[0] == (110, 300) and bent.ends[-1] == (110, 100) and len(bent.ends) == 48
    assert len(cross.ends) == 4 and {len(line.ends) == len(line.alphas) for line in (still, bent, cross)} == {True}


def test_a_sway_line_that_was_not_drawn_yet_is_not_shown(room):
    undrawn = {**TREE, "motion": {"type": "sway", "armature": [[0, 0], [0, 0]]}}
    assert not list(room.shapes.sway_lines(subject(room, recipe(undrawn), "tree", Bending())))


def test_what_is_hidden_or_elsewhere_is_not_drawn_and_the_active_one_is_stronger(room):
    hidden = TREE | {"visible": False}
    assert not list(room.shapes.sway_lines(subject(room, recipe(hidden, {"name": "sky"}))))
    strong, faint = (list(room.shapes.sway_lines(subject(room, recipe(TREE), name)))[1] for name in ("tree", "sky"))
    assert max(faint.alphas) < 0.6 * max(strong.alphas)


def test_a_waterline_floats_with_its_boat(room):
    boat = {"name": "boat", "motion": {"type": "bob", "waterline": [[10, 20], [30, 25], [60, 22]]}}
    still, floating = room.shapes.waterlines(subject(room, recipe(boat), "boat", Bending()))
    assert floating.ends == [(20, 20), (40, 25), (40, 25), (70, 22)] and still.ends[0] == (10, 20)


@pytest.mark.parametrize("active, drawn", [("lake", True), ("boat", True), ("sky", False), ("", False)])
def test_the_water_is_drawn_while_it_is_worked_on(room, active, drawn):
    layers = [{"name": "boat", "motion": {"type": "bob", "waterline": []}}, {"name": "lake", "motion": {"type": "ripple"}}]
    given = recipe(*layers, {"name": "sky"}, view={"horizon": [[0, 150], [640, 150]], "fov": 50.0, "height": 1.7})
    lines = list(room.shapes.water(subject(room, given, active)))
    assert bool(lines) == drawn
    if drawn:
        grid, horizon = lines
        assert max(grid.alphas) > 0.5 and min(grid.alphas) == pytest.approx(0.12)
        assert {round(y, 6) for _, y in horizon.ends} == {150}
    assert not list(room.shapes.water(subject(room, recipe(*layers), active)))  # no horizon, no plane


def test_the_wind_s_arrow_points_where_it_blows_and_grows_with_it(room):
    def arrow(speed, direction):
        given = recipe(wind={"speed": speed, "direction": direction, "gusts": 0.0})
        (line,) = room.shapes.wind(subject(room, given))
        (x0, y0), (x1, y1) = line.ends[:2]
        return x1 - x0, y1 - y0

    right, away = arrow(5, 0), arrow(5, 90)
    assert right[0] > 10 and abs(right[1]) < 1e-9
    assert abs(away[0]) < 1e-9 and away[1] < 0 and -away[1] < right[0]  # up, and foreshortened
    assert arrow(20, 0)[0] == pytest.approx(2 * right[0]) and arrow(5, 180)[0] == pytest.approx(-right[0])
    assert not list(room.shapes.wind(subject(room, recipe(wind={"speed": 0, "direction": 0, "gusts": 1}))))


def test_gusts_are_arrows_over_the_picture_and_keyed_numbers_count_at_their_frame(room):
    keyed = {"first": 1, "values": [1.0, 4.0]}
    given = recipe(wind={"speed": keyed, "direction": 0.0, "gusts": 0.5})
    lengths = []
    for frame in (0, 1, 2, 9):
        main, gusts = room.shapes.wind(subject(room, given, live=Bending(), frame=frame))
        lengths.append(main.ends[1][0] - main.ends[0][0])
        assert len(gusts.ends) == 12 * 7 * 6 == len(gusts.alphas)
    np.testing.assert_allclose(np.array(lengths) / lengths[0], [1, 1, 2, 2])


@pytest.fixture
def live(extension, scene, tmp_path, monkeypatch):
    """A picture that is live."""
    monkeypatch.setattr(extension.play.show, "seen", True)
    picture = stage.set_up(scene, tmp_path)
    scene.frame_set(6)
    stage.wait(extension)
    scene.frame_set(6)
    yield picture
    extension.play.server.end()


def test_what_is_drawn_follows_frame_switch_and_layer(room, scene, live):
    overlay = scene.stillwater_overlay
    first = room.draw.of(scene, live)
    assert room.draw.of(scene, live) is first  # another redraw of the same
    scene.frame_set(7)
    second = room.draw.of(scene, live)
    bent = [line for line in second if line.width == 3 and line.colour == room.shapes.ORANGE]
    assert bent and bent != [line for line in first if line.width == 3 and line.colour == room.shapes.ORANGE]
    colours = {line.colour for line in second}
    assert colours == {room.shapes.ORANGE, room.shapes.YELLOW, room.shapes.WHITE}
    overlay.sway_lines = False
    assert {line.colour for line in room.draw.of(scene, live)} == colours - {room.shapes.ORANGE}
    overlay.wind = overlay.outline = False
    assert room.draw.of(scene, live) == []


def test_with_live_off_lines_are_drawn_at_rest(room, scene, live):
    scene.stillwater_live.on = False
    live.layers[0].motion.sway.armature_tip = (12, 2)
    scene.frame_set(6)
    tips = [line.ends[-1] for line in room.draw.of(scene, live) if line.colour == room.shapes.ORANGE]
    assert [12, 2] in tips


def test_a_hidden_plane_has_no_overlays(room, scene, live):
    live.plane.hide_set(True)
    assert room.draw.of(scene, live) == []


def test_it_draws_while_it_is_registered(extension, room):
    assert len(room.draw._handles) == 2
    room.draw.end()
    assert room.draw._handles == []
    room.draw.begin()
    assert len(room.draw._handles) == 2


def test_the_switches_stand_in_the_overlays_popover(room, scene, picture):
    assert room.settings.draw in bpy.types.VIEW3D_PT_overlay.draw._draw_funcs
    shown = Recorder()
    space = SimpleNamespace(overlay=SimpleNamespace(show_overlays=True))
    room.settings.draw(SimpleNamespace(layout=shown), SimpleNamespace(scene=scene, space_data=space))
    assert shown.properties == ["sway_lines", "wind", "water", "waterlines", "outline", "tint", "checker", "flow", "flow_colors"]


def test_what_goes_wrong_while_drawing_is_a_sentence(room, scene, live, monkeypatch):
    monkeypatch.setattr(room.draw, "of", lambda *_: 1 / 0)
    shows = SimpleNamespace(show_overlays=True)
    context = SimpleNamespace(scene=scene, space_data=SimpleNamespace(overlay=shows))
    monkeypatch.setattr(room.draw.bpy, "context", context)
    room.draw.draw()
    assert room.draw.problem == "Overlays: division by zero"
    shows.show_overlays, room.draw.problem = False, ""
    room.draw.draw()
    assert room.draw.problem == ""


def test_a_matte_s_outline_marches_in_black_and_white(room):
    lines = room.outline.outline(np.pad(np.ones((40, 60)), 10))
    (plain,) = room.shapes.outline(lines, 0.5)
    black, white = room.shapes.marching(lines, 0.5, dash=16, step=0)
    later = next(iter(room.shapes.marching(lines, 0.5, dash=16, step=1)))
    assert len(black.ends) + len(white.ends) == len(plain.ends) and 0.3 < len(black.ends) / len(plain.ends) < 0.7
    assert sorted(black.ends + white.ends) == sorted(plain.ends) and later.ends == white.ends
    assert (black.colour, white.colour) == (room.shapes.BLACK, room.shapes.WHITE)


def test_a_veil_lies_over_all_that_is_not_the_layer(room):
    coverage = np.zeros((32, 48), np.float32)
    coverage[8:24, 8:40], coverage[4, 4] = 1, 0.25
    tint, checker = room.cutting.veil(coverage, False), room.cutting.veil(coverage, True)
    for veil, strength in ((tint, room.cutting.STRENGTH), (checker, 1)):
        assert veil.shape == (32, 48, 4) and veil.dtype == np.float32
        np.testing.assert_allclose(veil[..., 3], strength * (1 - coverage))
    assert (tint[..., :3] == np.float32(room.cutting.TINT)).all()
    squares = checker[..., 0]
    assert set(np.unique(squares)) == {np.float32(room.cutting.LIGHT), np.float32(room.cutting.DARK)}
    assert squares[0, 0] == squares[7, 7] == squares[8, 8] != squares[0, 8] == squares[8, 0]


def test_a_sketch_goes_before_what_frames_are_made_of(room):
    class Live:
        layers, scale = ["tree"], 0.5

        def coverage(self, layer):
            return np.full((20, 30), 0.25, np.float32)

    sketch = SimpleNamespace(layer="tree", matte=np.full((1500, 3000), 255, np.uint8), number=1)
    cut = room.cutting.cut("tree", Live(), sketch, 3000)
    assert cut.coverage.shape == (500, 1000) and (cut.coverage == 1).all() and cut.scale == pytest.approx(1 / 3)
    assert room.cutting.cut("tree", Live(), None, 60).coverage[0, 0] == 0.25
    assert room.cutting.cut("boat", Live(), sketch, 3000) is None and room.cutting.cut("boat", None, None, 60) is None


def test_the_veil_is_there_while_a_matte_is_drawn(room, extension, scene, live, monkeypatch):
    overlay, drawing, layer = scene.stillwater_overlay, scene.stillwater.drawing, live.layers[0]
    assert room.draw.veil_of(scene, live) is None and room.draw.cut_layer(scene, live) == ""
    layer.matte.form = "scribbles"
    drawing.role, drawing.picture_id, drawing.layer_id = "foreground", live.id, layer.id
    key, make = room.draw.veil_of(scene, live)
    assert make().shape == (8, 16, 4) and make()[4, 2, 3] == 0 < make()[4, 14, 3]
    overlay.checker = True
    other, make = room.draw.veil_of(scene, live)
    assert other != key and make()[4, 14, 3] == 1
    lines = {line.colour for line in room.draw.of(scene, live)}
    assert {room.shapes.BLACK, room.shapes.WHITE} <= lines and bpy.app.timers.is_registered(room.draw.march)
    overlay.tint = overlay.checker = False
    assert room.draw.veil_of(scene, live) is None
    drawing.role, overlay.tint = "sway_line", True
    assert room.draw.veil_of(scene, live) is None and room.draw.march() is None
    bpy.app.timers.unregister(room.draw.march)
    drawing.role = ""
