"""Frame after frame: kept or rendered, in any order, by any number of threads, the same bytes."""

import shutil

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater.recipe import RecipeError, load
from stillwater.render.errors import Failed, Refused
from stillwater.render.events import Done, Frame, Preparing, Started, Warn
from stillwater.render.loop import Order, render

FRAMES = [f"frame_{frame:04d}.exr" for frame in range(1, 7)]


def run(path, **order):
    return list(render(load(path), Order(**order)))


def rendered(events):
    return [event.frame for event in events if isinstance(event, Frame) and not event.kept]


def sentences(events):
    return [event.sentence for event in events if isinstance(event, Warn)]


def files(folder):
    """Every frame in a folder: name -> bytes. Nothing else may lie there."""
    return {path.name: path.read_bytes() for path in sorted(folder.iterdir())}


@pytest.fixture
def whole(scene, tmp_path):
    """The scene's path, and its frames, rendered in one go."""
    path = scene()
    events = run(path)
    assert rendered(events) == [1, 2, 3, 4, 5, 6]
    return path, files(tmp_path / "frames")


def test_what_happens_is_told_in_order(scene, tmp_path):
    events = run(scene())
    kinds = [type(event) for event in events if not isinstance(event, Warn)]
    preparing = kinds.count(Preparing)
    assert kinds == [Started, *[Preparing] * preparing, *[Frame] * 6, Done] and preparing > 3
    assert events[0] == Started(1, 6, 6, (48, 36), str(tmp_path / "frames"))
    shares = [event.share for event in events if isinstance(event, Preparing)]
    assert shares == sorted(shares) and (shares[0], shares[-1]) == (0, 1)
    assert (events[-1].rendered, events[-1].kept) == (6, 0)
    assert [event.path for event in events if isinstance(event, Frame)] == [str(tmp_path / "frames" / name) for name in FRAMES]


def test_the_frames_are_the_scene_in_motion(whole, tmp_path):
    path, _ = whole
    pictures = [engine.read_frame(str(tmp_path / "frames" / name)) for name in FRAMES]
    still = engine.read_picture(str(path.parent / "picture.png")).image
    moving = [np.abs(picture - still).mean() for picture in pictures]
    assert all(0.001 < amount < 0.2 for amount in moving)
    assert len({picture.tobytes() for picture in pictures}) == 6


def test_a_frame_alone_and_in_any_order_is_the_same(whole, tmp_path):
    path, frames = whole
    for frame in (5, 2, 6, 1, 3, 4):
        run(path, frames=(frame, frame), folder=tmp_path / "one by one")
    assert files(tmp_path / "one by one") == frames


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_threads_do_not_change_the_bytes(whole, tmp_path, threads):
    path, frames = whole
    shutil.rmtree(tmp_path / ".stillwater-cache")
    try:
        engine.set_threads(threads)
        run(path, folder=tmp_path / "again")
    finally:
        engine.set_threads(0)
    assert files(tmp_path / "again") == frames


def test_a_second_run_keeps_everything(whole, tmp_path):
    path, _ = whole
    times = [p.stat().st_mtime_ns for p in sorted((tmp_path / "frames").iterdir())]
    events = run(path)
    assert rendered(events) == [] and not any(isinstance(event, Preparing) for event in events)
    assert events[-1].kept == 6
    assert [p.stat().st_mtime_ns for p in sorted((tmp_path / "frames").iterdir())] == times


def test_fresh_renders_everything_anew(whole, tmp_path):
    path, frames = whole
    events = run(path, fresh=True)
    assert rendered(events) == [1, 2, 3, 4, 5, 6] and any(isinstance(event, Preparing) for event in events)
    assert files(tmp_path / "frames") == frames


def test_a_missing_frame_and_one_that_is_none_are_rendered(whole, tmp_path):
    path, frames = whole
    (tmp_path / "frames" / FRAMES[1]).unlink()
    (tmp_path / "frames" / FRAMES[3]).write_text("not a frame")
    (tmp_path / "frames" / FRAMES[4]).write_bytes(frames[FRAMES[0]])
    assert rendered(run(path)) == [2, 4, 5]
    assert files(tmp_path / "frames") == frames


def test_a_longer_range_keeps_the_frames_it_has(scene):
    run(scene())
    assert rendered(run(scene(lambda recipe: recipe.update(frames=[-1, 8])))) == [-1, 0, 7, 8]


def test_a_keyed_wind_redoes_only_where_it_changed(scene):
    run(scene())
    keyed = scene(lambda recipe: recipe["wind"].update(speed={"first": 1, "values": [8, 8, 8, 8, 3]}))
    assert rendered(run(keyed)) == [4, 5, 6]  # 4 looks ahead


def test_a_recipe_renamed_and_moved_redoes_nothing(whole, tmp_path):
    path, _ = whole
    moved = tmp_path.with_name(tmp_path.name + " elsewhere")
    path.rename(path.with_name("renamed.json"))
    tmp_path.rename(moved)
    try:
        events = run(moved / "renamed.json")
    finally:
        moved.rename(tmp_path)
    assert rendered(events) == []


def test_a_picture_painted_over_redoes_all_and_one_only_touched_nothing(whole, tmp_path):
    path, _ = whole
    picture = tmp_path / "picture.png"
    picture.touch()
    assert rendered(run(path)) == []
    engine.write_picture(str(picture), np.full((36, 48, 4), 0.5, np.float32))
    assert rendered(run(path)) == [1, 2, 3, 4, 5, 6]


def test_preparations_are_used_again(whole, tmp_path):
    path, frames = whole
    events = run(path, folder=tmp_path / "again")
    assert not any(isinstance(event, Preparing) for event in events)
    assert files(tmp_path / "again") == frames


def test_scale(scene, tmp_path):
    events = run(scene(), scale=0.5)
    assert events[0].size == (24, 18)
    assert engine.read_frame(str(tmp_path / "frames" / FRAMES[0])).shape == (18, 24, 4)
    assert rendered(run(scene(lambda recipe: recipe.update(output={"scale": 0.5})))) == []
    assert rendered(run(scene())) == [1, 2, 3, 4, 5, 6]


def test_a_loop_closes(scene, tmp_path):
    run(scene(lambda recipe: recipe.update(loop=True, frames=[3, 8])), folder=tmp_path / "a")
    run(scene(lambda recipe: recipe.update(loop=True, frames=[3, 8], layers=recipe["layers"][:4] + [{"name": "clouds"}])),
        folder=tmp_path / "b")  # fmt: skip
    frames = [engine.read_frame(str(path)) for path in sorted((tmp_path / "b").iterdir())]
    steps = [np.abs(a - b).mean() for a, b in zip(frames, [*frames[1:], frames[0]], strict=True)]
    assert steps[-1] < 2 * max(steps[:-1])


def test_layers_of_their_own(scene, tmp_path):
    def change(recipe):
        recipe["output"] = {"layers": True, "depth": "float"}
        recipe["layers"][2]["visible"] = False
        recipe["layers"][3]["opacity"] = 0

    run(scene(change), frames=(1, 1))
    names = engine.inspect_picture(str(tmp_path / "frames" / FRAMES[0])).channel_names
    assert {name.split(".")[0] for name in names} == {*"RGBA", "Stillwater", "boat", "reflection", "sea", "clouds"}


@pytest.mark.parametrize(
    "frames, sentence",
    [((0, 3), "--frames: 0-3 is not within the recipe's 1-6"), ((3, 7), "--frames: 3-7 is not within the recipe's 1-6"),
     ((4, 2), "--frames: 4-2 runs backwards (the first is not above the last)")],
)  # fmt: skip
def test_frames_that_the_recipe_has_not(scene, tmp_path, frames, sentence):
    with pytest.raises(Refused) as raised:
        run(scene(), frames=frames)
    assert str(raised.value) == sentence and not (tmp_path / "frames").exists()


def test_a_frame_too_large(scene, tmp_path):
    with pytest.raises(RecipeError, match=r"size: \[5, 5\] is not the size of the picture, 48 x 36"):
        run(scene(lambda recipe: recipe.update(size=[5, 5])))
    with pytest.raises(RecipeError, match="scale: 1000 is not"):
        run(scene(lambda recipe: recipe.update(output={"scale": 1000})))
    assert not (tmp_path / "frames").exists()


def test_warnings_come_with_every_run(scene, tmp_path):
    picture = np.full((36, 48, 4), 0.5, np.float32)
    picture[3, 4:16, 1] = np.nan
    picture[5, 0, 0] = np.inf

    def change(recipe):
        recipe.update(picture="bad.exr", loop=True)
        recipe["wind"]["speed"] = {"first": 1, "values": [4, 5, 6, 7, 8]}
        recipe["layers"][2]["fill"] = {"method": "none"}
        recipe["layers"][0]["matte"]["value"] = 77

    path = scene(change)
    engine.write_frame(str(tmp_path / "bad.exr"), picture, options=engine.FrameOptions(half=False))
    expected = [
        "picture: 13 pixels are not finite numbers and count as 0",
        "layers[0].matte: covers no pixel; the layer is not seen",
        "wind.speed: differs between frames 1 and 6; blended over the last 1 of 6 frames, so that the loop closes",
    ]
    assert sentences(run(path)) == expected
    assert sentences(run(path)) == expected
    frame = engine.read_frame(str(tmp_path / "frames" / FRAMES[0]))
    assert np.isfinite(frame).all()


def test_a_cache_that_cannot_be_written_is_a_warning_and_the_frames_are_the_same(whole, tmp_path):
    path, frames = whole
    shutil.rmtree(tmp_path / ".stillwater-cache")
    (tmp_path / ".stillwater-cache").write_text("in the way")
    events = run(path, folder=tmp_path / "again")
    assert sentences(events)[-1] == (
        f"{tmp_path}/.stillwater-cache: cannot be written (Not a directory); preparations are kept in memory only"
    )
    assert files(tmp_path / "again") == frames


def test_an_output_folder_that_is_a_file(scene, tmp_path):
    (tmp_path / "frames").write_text("precious")
    with pytest.raises(Refused, match=r"output\.folder: .*/frames: cannot be written \(File exists\)"):
        run(scene())
    assert (tmp_path / "frames").read_text() == "precious"
    assert not (tmp_path / ".stillwater-cache").exists()


def test_a_frame_that_cannot_be_written_is_a_failure_at_work(scene, tmp_path):
    (tmp_path / "frames" / FRAMES[2]).mkdir(parents=True)
    with pytest.raises(Failed, match=r"frame_0003\.exr: cannot be written"):
        run(scene())
    assert sorted(path.name for path in (tmp_path / "frames").iterdir()) == FRAMES[:3]


def test_other_files_in_the_folder_are_left_alone(scene, tmp_path):
    (tmp_path / "frames").mkdir()
    (tmp_path / "frames" / "notes.txt").write_text("mine")
    run(scene(), frames=(1, 1))
    assert files(tmp_path / "frames")["notes.txt"] == b"mine"


def test_work_abandoned_halfway_leaves_whole_frames_and_no_claim(scene, tmp_path):
    events = render(load(scene()), Order())
    for event in events:
        if isinstance(event, Frame) and event.frame == 2:
            events.close()
    assert sorted(files(tmp_path / "frames")) == FRAMES[:2]
    assert rendered(run(scene())) == [3, 4, 5, 6]
