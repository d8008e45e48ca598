"""Where errors become a sentence and an exit code."""

import errno
import signal

import pytest
from stillwater.command_line import check, main
from stillwater.recipe import RecipeError
from stillwater.render.errors import Failed, Refused


@pytest.fixture(autouse=True)
def _interrupts():
    before = signal.getsignal(signal.SIGINT)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize(
    "error, code, said",
    [
        (RecipeError("fps: 0 is not above 0", "seed: -1 is not above 0"), 2,
         "stillwater: r.json: fps: 0 is not above 0\nstillwater: r.json: seed: -1 is not above 0\n"),
        (Refused("frames: taken"), 2, "stillwater: frames: taken\n"),
        (Failed("f.exr: cannot be written"), 1, "stillwater: f.exr: cannot be written\n"),
        (FileNotFoundError(errno.ENOENT, "gone", "r.json"), 2, "stillwater: r.json: there is no such file\n"),
        (OSError(errno.EIO, "Input/output error", "frames"), 1, "stillwater: frames: Input/output error\n"),
        (RuntimeError("first\nsecond"), 1, "stillwater: first; second\n"),
        (AssertionError(), 1, "stillwater: AssertionError\n"),
    ],
)  # fmt: skip
def test_an_error_is_a_sentence_and_a_code(monkeypatch, capsys, error, code, said):
    def fail(path):
        raise error

    monkeypatch.setattr(check, "load", fail)
    assert main.run(["check", "r.json"]) == code
    assert capsys.readouterr().err == said


def test_the_way_there_is_shown_where_it_is_asked_for(monkeypatch, capsys):
    monkeypatch.setattr(check, "load", lambda path: 1 / 0)
    monkeypatch.setenv("STILLWATER_TRACEBACK", "1")
    assert main.run(["check", "r.json"]) == 1
    said = capsys.readouterr().err
    assert said.startswith("Traceback") and said.endswith("stillwater: division by zero\n")
