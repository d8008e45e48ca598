"""Animated numbers: held outside their keys, integrated from frame 1, closed over a loop."""

import numpy as np
import pytest
from scipy.integrate import trapezoid
from stillwater.recipe.animation import Loop, Track, combine, ends_differ
from stillwater.recipe.parts import Keys

VALUES = [3.0, -1.0, 4.0, 1.5, 9.0, 2.5]


@pytest.mark.parametrize("frame, value", [(-100, 3), (4, 3), (5, 3), (6, -1), (10, 2.5), (11, 2.5), (5000, 2.5)])
def test_a_keyed_number_is_held_outside_its_keys(frame, value):
    assert Track.of(Keys(first=5, values=VALUES)).at(frame) == value


@pytest.mark.parametrize("first", [-20, -3, 0, 1, 2, 30])
@pytest.mark.parametrize("frame", [-40, -3, 0, 1, 2, 7, 33, 90])
def test_the_integral_is_the_trapezoids_from_frame_1(first, frame):
    track = Track.of(Keys(first=first, values=VALUES))
    frames = np.arange(min(frame, 1), max(frame, 1) + 1)
    area = trapezoid([track.at(f) for f in frames], frames)
    assert track.integral(frame) == pytest.approx(area if frame >= 1 else -area, abs=1e-12)


def test_the_integral_of_a_plain_number_grows_evenly():
    track = Track.of(0.25)
    assert [track.integral(frame) for frame in (-3, 1, 2, 1001)] == [-1, 0, 0.25, 250]


def test_more_values_never_change_the_integral_before_them():
    long = np.random.default_rng(1).uniform(0, 1, 300).tolist()
    short = Track.of(Keys(first=-20, values=long[:200]))
    assert [Track.of(Keys(first=-20, values=long)).integral(frame) for frame in range(-30, 180)] == [
        short.integral(frame) for frame in range(-30, 180)
    ]


def test_a_keyed_number_that_stays_is_integrated_like_a_plain_one():
    plain, held = Track.of(0.1), Track.of(Keys(first=-7, values=[0.1] * 30))
    assert [plain.integral(frame) for frame in range(-500, 500)] == [held.integral(frame) for frame in range(-500, 500)]


def test_earlier_values_never_change_the_integral_after_frame_1():
    values = np.random.default_rng(2).uniform(0, 1, 50).tolist()
    with_more, without = Track.of(Keys(first=-9, values=[7.0, *values])), Track.of(Keys(first=-8, values=values))
    assert [with_more.integral(frame) for frame in range(-8, 60)] == [without.integral(frame) for frame in range(-8, 60)]


class TestInALoop:
    loop = Loop(11, 50)
    ramp = Keys(first=11, values=np.linspace(0, 39, 40).tolist())

    def test_frames_wrap(self):
        track = Track.of(self.ramp, self.loop)
        assert [track.at(frame + 40) for frame in range(-60, 60)] == [track.at(frame) for frame in range(-60, 60)]

    def test_a_ramp_is_blended_over_the_last_tenth_and_only_there(self):
        track = Track.of(self.ramp, self.loop)
        assert [track.at(frame) for frame in range(11, 47)] == list(range(36))
        steps = np.diff([track.at(frame) for frame in range(46, 52)])
        assert abs(steps).max() < 39 / 3 and track.at(51) == 0

    def test_values_before_the_range_lead_into_it(self):
        before = Keys(first=1, values=[*range(-10, 40)])
        assert Track.of(before, self.loop).at(50) == pytest.approx(39 + 0.8 * (-1 - 39))

    def test_a_number_that_closes_is_left_as_it_is(self):
        wave = [np.sin(2 * np.pi * i / 40) for i in range(41)]
        track = Track.of(Keys(first=11, values=wave), self.loop)
        assert [track.at(frame) for frame in range(11, 51)] == wave[:40]

    @pytest.mark.parametrize(
        "values, differ", [([1, 2, 3], True), ([1, 2, 1], False), ([5], False), ([1.0, 4, 1 + 1e-13], False)]
    )
    def test_whether_ends_differ(self, values, differ):
        assert ends_differ(Track.of(Keys(first=11, values=[*values[:-1]] * 13 + values[-1:] * 20)), self.loop) == differ

    @pytest.mark.parametrize("number", [0.5, ramp, Keys(first=-5, values=VALUES * 20)])
    def test_the_integral_gains_the_same_in_every_loop(self, number):
        track = Track.of(number, self.loop)
        gains = [track.integral(frame + 40) - track.integral(frame) for frame in range(-70, 90)]
        assert gains == pytest.approx([track.over_loop()] * len(gains), abs=1e-9)

    def test_the_integral_follows_the_values(self):
        track = Track.of(self.ramp, self.loop)
        steps = [track.integral(frame + 1) - track.integral(frame) for frame in range(-90, 90)]
        assert steps == pytest.approx([(track.at(frame) + track.at(frame + 1)) / 2 for frame in range(-90, 90)])

    def test_a_loop_of_one_frame(self):
        track = Track.of(self.ramp, Loop(30, 30))
        assert (track.at(3), track.at(30), track.integral(4)) == (track.at(31), track.at(30), 3 * track.at(30))


@pytest.mark.parametrize("loop", [None, Loop(1, 20)])
def test_a_combination_is_made_value_by_value(loop):
    speed, angle = Keys(first=3, values=[1, 2, 3]), Keys(first=9, values=[0, 2])
    tracks = [Track.of(number, loop) for number in (speed, angle, 2.0)]
    product = combine(lambda a, b, c: a * b + c, *tracks)
    for frame in range(-5, 45):
        a, b, c = (track.at(frame) for track in tracks)
        assert product.at(frame) == a * b + c


def test_plain_numbers_combine_to_a_plain_number():
    product = combine(lambda a, b: a * b, Track.of(2.0, Loop(900_000, 900_010)), Track.of(3.0, Loop(900_000, 900_010)))
    assert (product.at(5), product.integral(11), product.over_loop()) == (6, 60, 66)
