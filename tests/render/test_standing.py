"""Which frames are ready, missing or out of date, and why; found without rendering or writing anything."""

import os

import pytest
from stillwater.recipe import RecipeError, load
from stillwater.render.errors import Refused
from stillwater.render.loop import Order, render
from stillwater.render.standing import Frames, by_reason, joined, standing


def spans(path, **order):
    return joined(standing(load(path), Order(**order)).all())


@pytest.fixture
def rendered(scene):
    path = scene()
    list(render(load(path), Order()))
    return path


def test_before_and_after_a_bake(scene):
    path = scene()
    assert spans(path) == [Frames(1, 6, "missing")]
    list(render(load(path), Order(frames=(2, 4))))
    assert spans(path) == [Frames(1, 1, "missing"), Frames(2, 4, "ready"), Frames(5, 6, "missing")]
    assert spans(path, frames=(2, 3)) == [Frames(2, 3, "ready")]


def test_a_keyed_wind_names_the_frames_it_changed(rendered, scene):
    keyed = scene(lambda recipe: recipe["wind"].update(speed={"first": 1, "values": [8, 8, 8, 8, 3]}))
    assert spans(keyed) == [Frames(1, 3, "ready"), Frames(4, 6, "stale", ("wind changed",))]


def test_what_is_stale_is_what_a_bake_renders_anew(rendered, scene):
    """For each kind of change, the frames that are named are those that a bake does not keep."""
    slowed = {"first": 1, "values": [[0.7, 0.2]] * 3 + [[0, 0]]}
    for change in (
        lambda recipe: recipe["layers"][2]["motion"].update(amount={"first": 3, "values": [3, 4, 3]}),
        lambda recipe: recipe["layers"][4]["motion"].update(velocity=slowed),
        lambda recipe: recipe.update(output={"depth": "float"}),
    ):
        changed = scene(change)
        named = {frame.first for frame in standing(load(changed)).all() if frame.state == "stale"}
        events = list(render(load(changed), Order()))
        assert named == {event.frame for event in events if type(event).__name__ == "Frame" and not event.kept}
        assert named and {span.state for span in spans(changed)} == {"ready"}


def test_reasons_come_with_their_ranges(rendered, scene):
    def change(recipe):
        recipe["wind"]["speed"] = {"first": 1, "values": [8, 8, 8, 8, 3]}
        recipe["layers"][2]["motion"]["amount"] = {"first": 1, "values": [3, 4, 3, 3, 3, 4]}

    found = by_reason(spans(scene(change)))
    assert found == {"motion of tree changed": [(1, 2), (5, 6)], "wind changed": [(4, 6)]}


def test_a_file_that_is_no_frame_of_ours_says_so(rendered, tmp_path):
    (tmp_path / "frames" / "frame_0002.exr").write_text("no frame")
    assert spans(rendered)[1] == Frames(2, 2, "stale", ("made by something else",))


def test_nothing_is_written_but_known_hashes(scene, tmp_path):
    path = scene()
    before = sorted(os.listdir(tmp_path))
    spans(path)
    assert sorted(os.listdir(tmp_path)) == before


def test_what_was_read_is_remembered_by_the_caller(rendered):
    asked = []
    list(standing(load(rendered), read=lambda path: asked.append(path.name) or ("", {})).all())
    assert asked == [f"frame_{frame:04d}.exr" for frame in range(1, 7)]


def test_what_is_wrong_is_an_error(scene, tmp_path):
    path = scene()
    with pytest.raises(Refused, match="--frames: 3-9 is not within the recipe's 1-6"):
        standing(load(path), Order(frames=(3, 9)))
    (tmp_path / "tree.png").unlink()
    with pytest.raises(RecipeError, match="layers.2..matte.file: .*tree.png: there is no such file"):
        standing(load(path))
