"""The layers of a picture, kept one by one: only what depends on a change is cut anew, and comes out the same."""

import os

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater import load
from stillwater.render.cache import FOLDER, Cache
from stillwater.render.prepare import Sources
from stillwater.render.stack import cut, find_stack


@pytest.fixture
def stack_of(tmp_path):
    """Cuts a recipe's layers; gives the stack and the names of the layers that were cut anew."""

    def make(path, fresh=False, folder=FOLDER):
        document, cache = load(path), Cache(tmp_path / folder)
        sources, before = Sources(document, cache), set(cache.facts())
        images = drained(sources.read())
        stack = drained(cut(sources, images, cache, lambda: None, fresh))
        names = zip(sources.layer_keys, document.recipe.layers, strict=True)
        return stack, [layer.name for key, layer in names if key not in before]

    return make


def drained(work):
    """What a generator returns."""
    while True:
        try:
            next(work)
        except StopIteration as end:
            return end.value


def same(stack, other):
    assert stack.facts == other.facts and stack.arrays.keys() == other.arrays.keys()
    for name, array in stack.arrays.items():
        np.testing.assert_array_equal(array, other.arrays[name])


def test_a_layer_that_changes_leaves_those_in_front(scene, recipe, stack_of):
    names = [layer["name"] for layer in recipe["layers"]]
    whole, made = stack_of(scene())
    assert made == names
    assert stack_of(scene())[1] == []
    changed = scene(lambda recipe: recipe["layers"][2].update(feather=3), "changed.json")
    stack, made = stack_of(changed)
    assert made == names[2:]
    same(stack, stack_of(changed, folder="elsewhere")[0])
    np.testing.assert_array_equal(stack.arrays["colour0"], whole.arrays["colour0"])
    assert not np.array_equal(stack.arrays["colour2"], whole.arrays["colour2"])


def test_a_layer_behind_is_cut_on_what_the_kept_ones_left(scene, stack_of):
    open_behind = scene(lambda recipe: recipe["layers"][0].update(fill={"method": "none"}))
    stack_of(open_behind)
    changed = scene(
        lambda recipe: (recipe["layers"][0].update(fill={"method": "none"}), recipe["layers"][3].update(feather=5)), "c.json"
    )
    stack, made = stack_of(changed)
    assert made == ["sea", "clouds"]
    same(stack, stack_of(changed, folder="elsewhere")[0])


def test_a_picture_s_alpha_is_kept_with_its_layers(scene, stack_of, tmp_path):
    path = scene()
    rgba = engine.read_picture(str(tmp_path / "picture.png")).image
    rgba[..., 3] = np.linspace(0.2, 1, rgba.shape[1])
    engine.write_picture(str(tmp_path / "picture.png"), rgba)
    whole, _ = stack_of(path)
    again, made = stack_of(path)
    assert made == [] and "alpha0" in whole.arrays
    same(again, whole)
    changed = scene(lambda recipe: recipe["layers"][2].update(feather=3), "changed.json")
    same(stack_of(changed)[0], stack_of(changed, folder="elsewhere")[0])


def test_fresh_cuts_all(scene, stack_of, tmp_path):
    path = scene()
    whole, _ = stack_of(path)
    cache = Cache(tmp_path / FOLDER)
    for key in cache.facts():
        os.utime(cache.folder / key / "meta.json", (1, 1))
    same(stack_of(path, fresh=True)[0], whole)
    assert all((cache.folder / key / "meta.json").stat().st_mtime > 1 for key in cache.facts())


def test_a_stack_with_a_layer_missing_is_none(scene, stack_of, tmp_path):
    path = scene()
    stack_of(path)
    cache = Cache(tmp_path / FOLDER)
    sources = Sources(load(path), cache)
    same(find_stack(cache, sources.key), stack_of(path)[0])
    cache.forget(sources.layer_keys[3])
    assert find_stack(cache, sources.key) is None
    assert len(stack_of(path)[1]) == 1


def test_what_was_left_must_fit_the_picture():
    peeling = engine.Peeling(np.ones((6, 8, 4), np.float32))
    matte = np.zeros((6, 8), np.float32)
    matte[2:4, 3:6] = 1
    _, behind = peeling.take(matte, engine.Fill.push_pull)
    assert behind.box == [3, 2, 3, 2] and not behind.open
    moved = engine.Behind(behind.colour, behind.matte, (6, 2, 3, 2), False)
    with pytest.raises(ValueError, match="behind: its box does not fit its pixels and the picture"):
        engine.Peeling(np.ones((6, 8, 4), np.float32)).leave(moved)
    with pytest.raises(ValueError, match=r"trees.feather: -1 is not"):
        peeling.take(matte, engine.Fill.push_pull, -1.0, "trees")
    with pytest.raises(ValueError, match=r"trees.matte: 7 x 6 is not the size of the picture"):
        peeling.take(matte[:, 1:].copy(), engine.Fill.push_pull, 0.0, "trees")


def test_what_is_left_is_the_picture_without_the_layer():
    picture = np.ones((6, 8, 4), np.float32)
    picture[2:4, 3:6, :3] = 0
    matte = (picture[..., 0] == 0).astype(np.float32)
    peeling = engine.Peeling(picture)
    peeling.take(matte, engine.Fill.push_pull)
    np.testing.assert_allclose(peeling.left(), 1, atol=1e-6)
    np.testing.assert_array_equal(peeling.rest().pixels, peeling.left())
