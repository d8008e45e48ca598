"""Threads are asked for in one place."""

import os
import subprocess
import sys

import pytest
from stillwater import _stillwater as engine


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)


def test_a_number_of_threads_is_kept():
    engine.set_threads(3)
    assert engine.threads() == 3


def test_no_number_means_one_a_core():
    engine.set_threads(0)
    assert engine.threads() == len(os.sched_getaffinity(0)) or engine.threads() == os.cpu_count()


@pytest.mark.parametrize("given", [-1, 1025])
def test_an_impossible_number_is_refused(given):
    with pytest.raises(ValueError, match=rf"threads: {given} is not between 0 and 1024"):
        engine.set_threads(given)


def test_the_plain_way_can_be_asked_for():
    program = "from stillwater import _stillwater as e; print(e.has_avx2())"
    environment = {**os.environ, "STILLWATER_CPU": "sse4.2"}
    answer = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True, timeout=60)
    assert answer.stdout.strip() == "False"
