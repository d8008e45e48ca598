"""Live frames: those of the render, at the size of a screen, from what is prepared already."""

from types import SimpleNamespace

import numpy as np
import pytest
from stillwater import Live, RecipeError, load
from stillwater import _stillwater as engine
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.events import Preparing, Ready
from stillwater.render.loop import Job, Order, render
from stillwater.render.preview import forget, prepare, reduced


def prepared(path, longest=960):
    """Prepares the recipe at a path; the Ready that says so."""
    *events, ready = prepare(load(path), longest, Cache(path.parent / FOLDER))
    assert isinstance(ready, Ready) and all(not isinstance(event, Ready) for event in events)
    return ready


@pytest.fixture
def live(scene, recipe, tmp_path):
    """The scene's recipe, taken."""
    live = Live()
    live.learn(prepared(scene()).files)
    assert live.take(recipe, tmp_path)
    return live


def assert_shows(pixels, combined):
    """A live frame shows the renderer's, within 1/40 of a level of 256."""
    np.testing.assert_allclose(engine.scene_to_display(pixels)[::-1], combined, rtol=1e-5, atol=1 / 40 / 255)
    np.testing.assert_array_equal(pixels[::-1, :, 3], combined[..., 3])


def rendering(job):
    """The renderer of a bake, which finds the layers in the cache."""
    steps = job.ready(SimpleNamespace(beat=lambda: None))
    while True:
        try:
            next(steps)
        except StopIteration as done:
            return done.value


def test_frames_are_the_render_s(live, scene, tmp_path):
    job = Job(load(scene()), Order())
    renderer = rendering(job)
    for frame in (5, -3, 400, 1):
        assert_shows(live.frame(frame), renderer.frame(frame).combined)


def test_a_picture_with_alpha_keeps_it(scene, recipe, tmp_path):
    path = scene()
    rgba = engine.read_picture(str(tmp_path / "picture.png")).image
    rgba[..., 3] = np.linspace(0.2, 1, rgba.shape[1])
    engine.write_picture(str(tmp_path / "picture.png"), rgba)
    live = Live()
    live.learn(prepared(path).files)
    assert live.take(recipe, tmp_path)
    job = Job(load(path), Order())
    wanted = rendering(job).frame(4).combined
    assert_shows(live.frame(4), wanted)
    assert live.frame(4)[..., 3].min() < 0.5


def test_a_changed_number_needs_no_preparing(live, recipe, scene, tmp_path):
    before = live.frame(3).copy()
    for change in (
        lambda r: r["wind"].update(speed=3),
        lambda r: r["layers"][2]["motion"].update(armature=[[9, 34], [12, 4]]),
        lambda r: r["layers"][1].update(opacity=0.5),
        lambda r: r["layers"][4].update(motion={"type": "still"}),
        lambda r: r["view"].update(horizon=[[0, 15], [48, 15]]),
    ):
        change(recipe)
        assert live.take(recipe, tmp_path)
        after = live.frame(3)
        assert np.abs(after - before).max() > 1e-4
        fresh = Live()
        fresh.learn(prepared(scene()).files)
        fresh.take(recipe, tmp_path)
        np.testing.assert_array_equal(after, fresh.frame(3))  # nothing of the numbers before is left
        before = after.copy()


@pytest.mark.parametrize(
    "change",
    [
        lambda r: r["layers"][2].update(feather=3),
        lambda r: r["layers"][0]["matte"].update(value=3),
        lambda r: r.update(colour_space="linear"),
    ],
    ids=["feather", "matte", "colour space"],
)
def test_what_must_be_prepared_is_not_done_here(live, recipe, scene, tmp_path, change):
    before = live.frame(3).copy()
    change(recipe)
    assert not live.take(recipe, tmp_path)
    np.testing.assert_array_equal(live.frame(3), before)  # the last result stands
    live.learn(prepared(scene(change)).files)
    assert live.take(recipe, tmp_path)
    assert np.abs(live.frame(3) - before).max() > 1e-4


def test_a_file_that_changed_must_be_prepared_again(live, recipe, scene, tmp_path):
    picture = engine.read_picture(str(tmp_path / "picture.png")).image
    engine.write_picture(str(tmp_path / "picture.png"), picture * [0.5, 0.5, 0.5, 1])
    assert not live.take(recipe, tmp_path)
    live.learn(prepared(tmp_path / "recipe.json").files)
    assert live.take(recipe, tmp_path)


def test_a_small_one_looks_like_the_large_one(scene, recipe, tmp_path):
    """Averaged over areas: at half the size the same picture, but for what a smaller one can't hold.

    Its background is painted: patches of noise would hold less still.
    """
    for layer in recipe["layers"][:-1]:
        layer["fill"] = {"file": "picture.png"}
    path, live, small = scene(lambda whole: whole.update(recipe)), Live(), Live()
    live.learn(prepared(path).files)
    assert live.take(recipe, tmp_path)
    small.learn(prepared(path, 24).files)
    assert not Live().take(recipe, tmp_path, 20) and small.take(recipe, tmp_path, 24)
    assert (small.size, small.scale) == ((24, 18), 0.5)
    for frame in (1, 4):
        large = live.frame(frame)
        averaged = large.reshape(18, 2, 24, 2, 4).mean(axis=(1, 3))
        difference = np.abs(small.frame(frame) - averaged)
        assert difference.mean() < 0.02 and difference.mean() < 0.2 * np.abs(averaged - averaged.mean()).mean()


def test_a_reduced_recipe_has_every_place_and_way_reduced(scene):
    def change(recipe):
        recipe["layers"][4]["motion"]["velocity"] = {"first": 1, "values": [[1, 2], [3, 4]]}

    whole = load(scene(change)).recipe
    small = reduced(whole, 0.5)
    boat, tree, clouds = (small.layers[i].motion for i in (0, 2, 4))
    assert boat.waterline == [(10, 12.5), (16, 12.5)] and tree.armature == ((4, 17), (4, 2))
    assert clouds.velocity.values == [(0.5, 1), (1.5, 2)] and small.view.horizon == ((0, 8.5), (24, 9))
    assert reduced(whole, 1.0) == whole


def test_a_layer_alone_and_its_matte(live):
    whole, tree = live.frame(2).copy(), live.frame(2, "tree").copy()
    matte = live.frame(2, "tree", matte=True).copy()
    covered = tree[..., 3]
    assert 0.02 < covered.mean() < 0.4 and np.ptp(matte[..., :3], axis=-1).max() == 0 and (matte[..., 3] == 1).all()
    np.testing.assert_allclose(engine.linear_to_srgb(matte[..., 0]), covered, atol=1 / 40 / 255)
    inside = covered == 1
    assert inside.sum() > 10 and np.abs(whole - tree)[inside].max() < 0.35  # the boat may lie before it
    with pytest.raises(ValueError, match='layer: "tea" is not one of boat, reflection, tree, sea, clouds'):
        live.frame(1, "tea")


def test_points_go_with_their_layer(live):
    (root, tip), (held, bent) = [(8, 34), (8, 4)], live.moved(3, "tree", [(8, 34), (8, 4)])
    assert np.hypot(held[0] - root[0], held[1] - root[1]) < 1e-4
    assert 0.1 < np.hypot(bent[0] - tip[0], bent[1] - tip[1]) < 20
    assert live.moved(1, "clouds", [(3, 3)]) == [(3, 3)] and live.moved(3, "clouds", [(3, 3)])[0][0] == pytest.approx(4.4)


def test_the_wind_has_a_heading_and_gusts(live, recipe, tmp_path):
    gusts = live.gust(5, [(0, 0), (24, 18), (48, 36)])
    assert {(round(right, 6), round(away, 6)) for right, away, _ in gusts} == {(0.939693, 0.34202)}
    assert len({factor for *_, factor in gusts}) == 3 and all(factor >= 0.6 for *_, factor in gusts)
    recipe["wind"]["gusts"] = 0
    live.take(recipe, tmp_path)
    assert [factor for *_, factor in live.gust(5, [(0, 0), (24, 18)])] == [1, 1]


def test_a_layer_s_coverage_lies_where_its_matte_is(live):
    covered = live.coverage("boat")
    assert covered.shape == (36, 48) and covered[22, 26] == 1 and covered[10, 26] == 0


def test_before_a_recipe_there_is_nothing():
    live = Live()
    assert not live.ready and (live.size, live.scale, live.layers) == ((0, 0), 1.0, [])
    with pytest.raises(ValueError, match="live: no recipe was taken yet"):
        live.frame(1)


def test_a_wrong_recipe_is_said_and_changes_nothing(live, recipe, tmp_path):
    before = live.frame(3).copy()
    recipe["layers"][0]["motion"]["water"] = "lake"
    with pytest.raises(RecipeError, match=r"layers\[0\].motion.water"):
        live.take(recipe, tmp_path)
    recipe["layers"][0]["motion"]["water"] = "sea"
    recipe["layers"][2]["matte"]["file"] = "gone.png"
    with pytest.raises(RecipeError, match="there is no such file"):
        live.take(recipe, tmp_path)
    recipe["layers"][2]["matte"]["file"] = "tree.png"
    recipe["view"]["horizon"] = [[0, 90], [48, 90]]
    with pytest.raises(RecipeError, match="water lies below the horizon"):
        live.take(recipe, tmp_path)
    np.testing.assert_array_equal(live.frame(3), before)


def test_what_a_render_cut_is_not_cut_again(scene):
    path = scene()
    list(render(load(path), Order(frames=(1, 1))))
    events = list(prepare(load(path), 960, Cache(path.parent / FOLDER)))
    assert [event.what for event in events if isinstance(event, Preparing)] == [
        "making the layers small",
        "making clouds endless",
        "done",
    ]
    events = list(prepare(load(path), 960, Cache(path.parent / FOLDER)))
    assert [event.what for event in events if isinstance(event, Preparing)] == ["done"]


def test_a_layer_that_begins_to_drift_is_made_endless_elsewhere(live, recipe, scene, tmp_path, monkeypatch):
    """That takes long: not where frames are shown. Which way it drifts counts, how fast does not."""

    def drift(x, y):
        return lambda r: r["layers"][2].update(motion={"type": "drift", "velocity": [x, y]})

    before = live.frame(3).copy()
    drift(1, 0)(recipe)
    assert not live.take(recipe, tmp_path)
    np.testing.assert_array_equal(live.frame(3), before)
    live.learn(prepared(scene(drift(1, 0))).files)
    assert live.take(recipe, tmp_path) and np.abs(live.frame(3) - before).max() > 1e-2
    drift(5, 0)(recipe)
    assert live.take(recipe, tmp_path)
    drift(5, 1)(recipe)
    assert not live.take(recipe, tmp_path)


@pytest.mark.parametrize("along", [(False, False), (True, False), (False, True), (True, True)])
def test_plates_from_what_was_made_before_are_the_same(along):
    noise = np.random.default_rng(3)
    pixels = noise.uniform(0, 1, (30, 40, 1)).astype(np.float32) * noise.uniform(0, 1, (30, 40, 4)).astype(np.float32)
    clouds, size = engine.LayerImage(pixels, (20, 10, 40, 30)), (80, 50)
    made = engine.make_endless(clouds, size, 1.0, along)
    moment = engine.Moment(frame=30, fps=24, loop_frames=40)
    frames = []
    for before in ([], [made]):
        plates = engine.make_plates(clouds, None, size, 1.0, along, before)
        layer = engine.Layer(plates, engine.Drift(), endless=along)
        renderer = engine.FrameRenderer(size, 1.0, engine.View(), engine.Wind(), [layer])
        way = tuple(7.0 * axis for axis in along)
        state = engine.LayerState(1.0, engine.Drift(offset=way, loop_offset=tuple(2 * x for x in way)))
        frames.append(renderer.render(moment, moment, [state], [state]).combined)
    np.testing.assert_array_equal(*frames)
    assert frames[0][..., 3].max() > 0.5
    other = engine.LayerImage(np.ascontiguousarray(pixels[:29, :39]), (20, 10, 39, 29))
    if along != (True, True):  # then both lie on the whole picture
        with pytest.raises(ValueError, match="endless: made for another layer, scale or way of drifting"):
            engine.make_plates(other, None, size, 1.0, along, [made])


def test_layers_are_forgotten_at_every_size_and_no_others(scene):
    path, other = scene(), scene(lambda recipe: recipe["layers"][2].update(feather=3), "other.json")
    for longest in (960, 24):
        prepared(path, longest)
    kept = prepared(other).key
    cache = Cache(path.parent / FOLDER)
    forget(load(path), cache)
    layers = len(load(other).recipe.layers)
    assert cache.find(kept) and len(cache.facts()) == 3 + layers  # all layers, those made small, the endless one


def test_plates_of_something_else_are_refused(scene, live):
    image = engine.LayerImage(np.ones((4, 4, 4), np.float32), (0, 0, 4, 4))
    plates = engine.make_plates(image, None, (8, 8), 1.0, None)
    view, wind = engine.View(), engine.Wind()
    engine.FrameRenderer((8, 8), 1.0, view, wind, [engine.Layer(plates)])
    for size, motion in (((9, 8), None), ((8, 8), engine.Drift())):
        with pytest.raises(ValueError, match=r"layers\[0\].plates: made for another picture, scale or way of drifting"):
            engine.FrameRenderer(size, 1.0, view, wind, [engine.Layer(plates, motion)])
    with pytest.raises(ValueError, match="colour: its box does not fit its pixels and the picture"):
        engine.make_plates(image, None, (3, 3), 1.0, None)
