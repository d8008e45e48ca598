"""`serve` as Blender uses it: lines in, lines out, whatever comes."""

import contextlib
import json
import os
import select
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from PIL import Image
from stillwater import Live

FOLDER = ".stillwater-cache"


class Server:
    """A process of `stillwater serve`, asked and heard in lines of JSON."""

    def __init__(self, *options):
        line = [sys.executable, "-m", "stillwater", "serve", *options]
        pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
        self.process = subprocess.Popen(line, **pipes)
        self._rest = b""

    def ask(self, *requests):
        """A request, or a line as it is."""
        for request in requests:
            line = request if isinstance(request, bytes) else json.dumps(request).encode()
            self.process.stdin.write(line + b"\n")
            self.process.stdin.flush()

    def hear(self, event, identifier=None):
        """The next answer of this kind, and those before it."""
        heard, deadline = [], time.monotonic() + 30
        while time.monotonic() < deadline:
            while b"\n" in self._rest:
                line, self._rest = self._rest.split(b"\n", 1)
                heard.append(json.loads(line))
                if heard[-1]["event"] == event and identifier in (None, heard[-1]["id"]):
                    return heard[-1], heard[:-1]
            if select.select([self.process.stdout], [], [], 1)[0]:
                said = os.read(self.process.stdout.fileno(), 65536)
                assert said, self.process.stderr.read()
                self._rest += said
        raise AssertionError(f"no {event} within 30 s: {heard}")

    def close(self):
        self.process.kill()
        self.process.wait()
        for pipe in (self.process.stdin, self.process.stdout, self.process.stderr):
            with contextlib.suppress(BrokenPipeError):
                pipe.close()


@pytest.fixture
def server():
    server = Server()
    yield server
    server.close()


@pytest.fixture
def large(scene, tmp_path):
    """A recipe of a picture that takes a second or two to be cut."""
    def change(recipe):
        recipe.update(view={"horizon": [[0, 20], [48, 20]]})
        for layer in recipe["layers"]:
            layer["fill"] = {"method": "none"}
        recipe["layers"][-1]["motion"] = {"type": "still"}  # an endless one takes several seconds more

    path = scene(change)
    for name in ("picture.png", "labels.png", "tree.png"):
        image = Image.open(tmp_path / name)
        image.resize((1920, 1440), Image.Resampling.NEAREST).save(tmp_path / name)
    return path


def prepare(identifier, path, **more):
    return {"id": identifier, "do": "prepare", "recipe": str(path), **more}


def test_what_is_asked_for_lies_in_the_cache(server, scene, recipe, tmp_path):
    server.ask(prepare(7, scene(), longest=24))
    done, before = server.hear("done")
    assert done["id"] == 7 and (tmp_path / FOLDER / done["key"] / "meta.json").exists()
    assert {answer["event"] for answer in before} == {"preparing"} and {answer["id"] for answer in before} == {7}
    assert [answer["what"] for answer in before][-3:] == ["making the layers small", "making clouds endless", "done"]
    shares = [answer["share"] for answer in before if answer["event"] == "preparing"]
    assert shares == sorted(shares) and (shares[0], shares[-1]) == (0, 1)
    live = Live()
    live.learn(done["files"])
    assert live.take(recipe, tmp_path, 24) and live.size == (24, 18)


def test_the_recipe_may_lie_elsewhere(server, scene, tmp_path):
    (tmp_path / "else").mkdir()
    path = scene().rename(tmp_path / "else" / "live.json")
    server.ask(prepare(1, path, folder=str(tmp_path)))
    done, _ = server.hear("done")
    assert (tmp_path / FOLDER / done["key"]).is_dir()


def test_the_cache_may_lie_elsewhere_and_has_a_limit(scene, recipe, tmp_path):
    """The folder and the limit of `render`, in the same words."""
    path, cache = scene(), tmp_path / "one for all"
    server = Server("--cache", str(cache), "--cache-limit", "0.001")
    try:
        server.ask(prepare(1, path))
        done, _ = server.hear("done")
        live = Live()
        live.learn(done["files"])
        assert live.take(recipe, tmp_path, cache=cache) and not Live().take(recipe, tmp_path)
        assert not (tmp_path / FOLDER).exists()
        old = cache / "old"
        old.mkdir()
        (old / "meta.json").write_text("{}")
        (old / "a.npy").write_bytes(bytes(2_000_000))
        os.utime(old / "meta.json", (0, 0))
        server.ask(prepare(2, path, longest=30))
        server.hear("done")
        assert not old.exists()
    finally:
        server.close()


WRONG = [
    (b"garbage", None, "request: JSON is malformed"),
    (b"[1, 2]", None, "request: Expected `object`, got `array`"),
    (b'{"id": 3, "do": "dance"}', 3, "request: Invalid value 'dance' - at `$.do`"),
    (b'{"id": 4, "do": "prepare"}', 4, "request: Object missing required field `recipe`"),
    (b'{"id": 5, "do": "prepare", "recipe": "a", "longest": 3}', 5, "request: Expected `int` >= 16 - at `$.longest`"),
    (b'{"id": "x", "do": "cancel"}', None, "request: Expected `int`, got `str` - at `$.id`"),
    (b'{"id": 6, "do": "cancel", "why": 1}', 6, "request: Object contains unknown field `why`"),
    (b'{"id": 7, "do": "prepare", "recipe": "none.json"}', 7, "none.json: No such file or directory"),
    (b"\xff\xfe", None, "request: "),
]


def test_a_wrong_line_is_a_sentence_and_the_next_is_read(server, scene):
    for line, identifier, sentence in WRONG:
        server.ask(line, b"")
        error, _ = server.hear("error")
        assert error["id"] == identifier and error["sentence"].startswith(sentence)
    server.ask(prepare(9, scene()))
    server.hear("done", 9)


def test_a_wrong_recipe_is_a_sentence_and_the_next_is_prepared(server, scene, tmp_path):
    server.ask(prepare(1, scene(lambda recipe: recipe["layers"][0].pop("matte"), "wrong.json")), prepare(2, scene()))
    error, _ = server.hear("error")
    assert (error["id"], error["sentence"]) == (1, "layers[0].matte: missing (only the last layer needs none)")
    server.hear("done", 2)
    (tmp_path / "tree.png").write_bytes(b"no picture")
    server.ask(prepare(3, scene()))
    assert "layers[2].matte.file" in server.hear("error")[0]["sentence"]


def test_a_request_is_cancelled_at_work_and_while_it_waits(server, large, scene):
    other = scene(lambda recipe: recipe.update(seed=8), "other.json")
    server.ask(prepare(1, large), prepare(2, other))
    while not server.hear("preparing", 1)[0]["what"].startswith("cutting out"):
        pass
    asked = time.monotonic()
    server.ask({"id": 2, "do": "cancel"}, {"id": 1, "do": "cancel"})
    assert server.hear("cancelled")[0]["id"] == 2
    _, before = server.hear("cancelled", 1)
    assert time.monotonic() - asked < 2 and not [answer for answer in before if answer["event"] == "done"]
    assert not list((large.parent / FOLDER).glob("*.lock"))
    server.ask({"id": 1, "do": "cancel"}, prepare(3, large))  # what is over is not cancelled again
    _, before = server.hear("done", 3)
    assert not [answer for answer in before if answer["id"] != 3]


def test_a_newer_request_for_a_recipe_ends_the_older(server, large):
    server.ask(prepare(1, large))
    server.hear("preparing", 1)
    server.ask(prepare(2, large, longest=480), prepare(3, large, longest=240))
    done, before = server.hear("done")
    assert done["id"] == 3
    assert {answer["id"] for answer in before if answer["event"] == "cancelled"} == {1, 2}


def test_it_ends_with_its_standard_input(server, large):
    server.ask(prepare(1, large))
    server.hear("preparing", 1)
    server.process.stdin.close()
    assert server.process.wait(2) == 0
    assert not list((large.parent / FOLDER).glob("*.lock"))


@pytest.mark.parametrize("how, code", [(signal.SIGTERM, 143), (signal.SIGKILL, -signal.SIGKILL)])
def test_what_a_killed_one_left_is_no_obstacle(server, large, how, code):
    server.ask(prepare(1, large))
    while not server.hear("preparing", 1)[0]["what"].startswith("cutting out"):
        pass
    server.process.send_signal(how)
    assert server.process.wait(2) == code
    another = Server()
    try:
        another.ask(prepare(1, large))
        another.hear("done")
    finally:
        another.close()


def test_a_cache_that_can_t_be_written_is_a_sentence(server, scene, tmp_path):
    (tmp_path / FOLDER).write_text("a file where the folder should be")
    server.ask(prepare(1, scene()))
    error, _ = server.hear("error")
    assert f"{tmp_path / FOLDER}: cannot be written" in error["sentence"]


def test_the_prepared_picture_is_not_read_twice(server, large, recipe):
    """Two requests for one picture at two sizes: cut once."""
    server.ask(prepare(1, large))
    server.hear("done")
    server.ask(prepare(2, large, longest=100))
    _, before = server.hear("done")
    whats = [answer["what"] for answer in before if answer["event"] == "preparing"]
    assert whats == ["making the layers small", "done"]
    assert np.asarray(Image.open(large.parent / "picture.png")).shape == (1440, 1920, 3)


def test_a_matte_comes_at_once_and_is_not_cancelled_by_the_prepare_after_it(server, large):
    server.ask(prepare(1, large), {"id": 2, "do": "matte", "recipe": str(large), "layer": "tree"}, prepare(3, large))
    matte, before = server.hear("matte")
    assert matte["id"] == 2 and matte["layer"] == "tree"
    assert [answer["id"] for answer in before if answer["event"] == "cancelled"] == [1]
    assert (large.parent / FOLDER / matte["key"] / "matte.npy").exists()
    assert server.hear("done", 3)


def test_a_newer_matte_cancels_the_older(server, large):
    server.ask(*({"id": i, "do": "matte", "recipe": str(large), "layer": name} for i, name in ((1, "tree"), (2, "boat"))))
    _, before = server.hear("matte", 2)
    assert "cancelled" in {answer["event"] for answer in before if answer["id"] == 1}


def test_a_matte_of_no_layer_is_a_sentence(server, large):
    server.ask({"id": 1, "do": "matte", "recipe": str(large), "layer": "bush"})
    assert server.hear("error")[0]["sentence"] == 'layer: "bush" is not one of boat, reflection, tree, sea, clouds'
