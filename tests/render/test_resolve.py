"""From the recipe to a frame's plain numbers: values, integrals, seeds."""

import math

import pytest
from msgspec import inspect
from stillwater.recipe import parse
from stillwater.recipe.parts import Keys
from stillwater.recipe.stochastic import Bob, Drift, Ripple, Still, Sway
from stillwater.render.resolve import ANIMATED, Timeline

BOAT, REFLECTION, TREE, SEA, CLOUDS = range(5)


def timeline(recipe, **changes):
    return Timeline(parse({**recipe, **changes}).recipe)


def keys(*values, first=1):
    return {"first": first, "values": list(values)}


def takes_keys(field):
    return isinstance(field.type, inspect.UnionType) and any(
        isinstance(part, inspect.StructType) and part.cls.__name__.startswith("Keys") for part in field.type.types
    )


@pytest.mark.parametrize("motion", [Still, Sway, Ripple, Bob])
def test_every_animated_field_of_a_motion_is_resolved(motion):
    animated = [field.name for field in inspect.type_info(motion).fields if takes_keys(field)]
    assert tuple(animated) == ANIMATED.get(motion, ())


def test_nothing_animated_is_left_in_a_frame(recipe):
    recipe["layers"][TREE]["motion"] |= {"frequency": keys(0.5, 0.7), "amount": keys(1, 2)}
    recipe["layers"][SEA] |= {"opacity": keys(1, 0.5)}
    recipe["layers"][SEA]["motion"]["amplitude"] = keys(1, 3)
    recipe["layers"][BOAT]["motion"]["amount"] = keys(0, 1)
    now = timeline(recipe, wind={"speed": keys(1, 2, 3), "direction": keys(0, 90), "gusts": keys(0, 1)}).at(2)
    tree, sea, boat = now.layers[TREE].motion, now.layers[SEA], now.layers[BOAT].motion
    assert (tree.frequency, tree.amount, sea.opacity, sea.motion.amplitude, boat.amount) == (0.7, 2, 0.5, 3, 1)
    assert (now.moment.wind.speed, now.moment.wind.direction, now.moment.wind.gusts) == (2, 90, 1)
    parts = [now.moment, now.moment.wind, *now.layers, *(layer.motion for layer in now.layers)]
    assert not any(isinstance(getattr(part, name), Keys) for part in parts for name in part.__struct_fields__)


def test_gusts_travel_with_the_wind(recipe):
    travelled = timeline(recipe, fps=10, wind={"speed": 6, "direction": 30}).at(21).moment.wind.travel
    assert travelled == pytest.approx((12 * math.cos(math.pi / 6), 12 * math.sin(math.pi / 6)))


def test_the_wind_turns_without_a_jump_of_the_gusts(recipe):
    turning = timeline(recipe, wind={"speed": 24, "direction": keys(*range(0, 360, 10), first=20)})
    way = [turning.at(frame).moment.wind.travel for frame in range(1, 60)]
    assert max(math.dist(a, b) for a, b in zip(way, way[1:], strict=False)) < 1.0001


def test_drift_at_a_velocity(recipe):
    recipe["layers"][CLOUDS]["motion"] = {"type": "drift", "velocity": keys([1, 0], [3, -2])}
    drift = timeline(recipe)
    assert [drift.at(frame).layers[CLOUDS].motion.offset for frame in (0, 1, 2, 3)] == [(-1, 0), (0, 0), (2, -1), (5, -3)]


def test_drift_with_the_wind_along_the_picture(recipe):
    recipe["layers"][CLOUDS]["motion"] = {"type": "drift", "wind": 0.5}
    drift = timeline(recipe, wind={"speed": 8, "direction": 60}).at(11).layers[CLOUDS].motion
    assert drift.offset == pytest.approx((20, 0)) and drift.loop_offset == (0, 0)


def test_a_loop_says_how_far_things_go_in_it(recipe):
    recipe["layers"][CLOUDS]["motion"] = {"type": "drift", "velocity": [2, -1]}
    now = timeline(recipe, loop=True, frames=[5, 24], fps=20, wind={"speed": 3}).at(7)
    assert now.layers[CLOUDS].motion.loop_offset == (40, -20)
    assert (now.moment.first_frame, now.moment.loop_frames, now.moment.loop_travel) == (5, 20, pytest.approx((3, 0)))


def test_without_a_loop_there_is_no_period(recipe):
    moment = timeline(recipe, frames=[5, 24]).at(7).moment
    assert (moment.first_frame, moment.loop_frames, moment.loop_travel) == (1, 0, (0, 0))


def test_the_frame_after_the_last_of_a_loop_is_the_first_and_drift_goes_on(recipe):
    looping = timeline(recipe, loop=True, frames=[1, 20], wind={"speed": keys(*range(20), first=1)})
    first, beyond = looping.at(1), looping.at(21)
    assert beyond.moment.wind.speed == first.moment.wind.speed
    gained = [b - a for a, b in zip(first.layers[CLOUDS].motion.offset, beyond.layers[CLOUDS].motion.offset, strict=True)]
    assert gained == pytest.approx(list(first.layers[CLOUDS].motion.loop_offset))


def test_what_does_not_close_is_blended_and_named(recipe):
    recipe["layers"][TREE]["motion"]["frequency"] = keys(0.5, 0.5, 0.7)
    recipe["layers"][CLOUDS]["motion"]["velocity"] = keys([0, 1], [0, 2])
    said = timeline(recipe, loop=True, frames=[1, 40], wind={"speed": keys(4, 5, 4)}).warnings()
    how = "differs between frames 1 and 40; blended over the last 4 of 40 frames, so that the loop closes"
    assert said == [f"layers[2].motion.frequency: {how}", f"layers[4].motion.velocity: {how}"]
    assert timeline(recipe, loop=False).warnings() == []


class TestSeeds:
    def seeds(self, recipe, **changes):
        layers = timeline(recipe, **changes).at(1).layers
        return layers[TREE].motion.seed, layers[SEA].motion.seed

    def test_layers_do_not_move_in_step(self, recipe):
        tree, sea = self.seeds(recipe)
        assert tree != sea and max(tree, sea) < 2**64

    def test_renaming_changes_the_noise(self, recipe):
        before = self.seeds(recipe)
        recipe["layers"][TREE]["name"] = "bush"
        assert self.seeds(recipe)[0] != before[0] and self.seeds(recipe)[1] == before[1]

    def test_reordering_does_not(self, recipe):
        before = self.seeds(recipe)
        layers = recipe["layers"]
        layers[TREE], layers[SEA] = layers[SEA], layers[TREE]
        assert self.seeds(recipe) == before[::-1]

    def test_the_recipes_seed_changes_all(self, recipe):
        assert not set(self.seeds(recipe)) & set(self.seeds(recipe, seed=8))

    def test_a_seed_that_is_given_is_taken(self, recipe):
        recipe["layers"][TREE]["motion"]["seed"] = 5
        assert self.seeds(recipe)[0] == 5
