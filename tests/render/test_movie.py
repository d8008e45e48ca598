"""Frames to a film: as many, as they are, whole or not at all."""

import json
import shutil
import subprocess

import numpy as np
import pytest
from stillwater import _stillwater as engine
from stillwater.recipe import load
from stillwater.render.errors import Failed, Refused
from stillwater.render.events import Done
from stillwater.render.loop import Order, render
from stillwater.render.movie import Movie

needs_ffmpeg = pytest.mark.skipif(not shutil.which("ffmpeg"), reason="no ffmpeg on this machine")


def film(path, width, height):
    """Its frames as bytes, height x width x 3."""
    command = ["ffmpeg", "-loglevel", "error", "-i", str(path), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    raw = subprocess.run(command, capture_output=True, timeout=30, check=True).stdout
    return np.frombuffer(raw, np.uint8).reshape(-1, height, width, 3)


def facts(path):
    command = ["ffprobe", "-loglevel", "error", "-show_streams", "-of", "json", str(path)]
    return json.loads(subprocess.run(command, capture_output=True, timeout=30, check=True).stdout)["streams"][0]


@needs_ffmpeg
@pytest.mark.parametrize("kept", [(), (1, 2), (1, 6)])
def test_the_film_shows_the_frames_kept_or_not(scene, tmp_path, kept):
    path = scene(lambda recipe: recipe.update(fps=12.5))
    if kept:
        list(render(load(path), Order(frames=kept)))
    events = list(render(load(path), Order(movie=tmp_path / "film.mp4")))
    assert isinstance(events[-1], Done) and events[-1].movie == str(tmp_path / "film.mp4")
    shown = film(tmp_path / "film.mp4", 48, 36)
    frames = [engine.read_frame(str(file))[..., :3] for file in sorted((tmp_path / "frames").iterdir())]
    assert len(shown) == 6
    coarse = [np.asarray(f).reshape(9, 4, 12, 4, 3).mean(axis=(1, 3)) for f in (*shown / 255, *frames)]
    assert np.abs(np.subtract(coarse[:6], coarse[6:])).mean() < 0.02
    stream = facts(tmp_path / "film.mp4")
    assert (stream["codec_name"], stream["pix_fmt"], stream["r_frame_rate"]) == ("h264", "yuv420p", "25/2")
    assert not [p for p in tmp_path.iterdir() if ".tmp" in p.name]


@needs_ffmpeg
def test_odd_sides_are_padded(tmp_path):
    movie = Movie(tmp_path / "film.mp4")
    movie.begin((7, 5), 24)
    movie.add(np.full((5, 7, 3), 200, np.uint8))
    movie.end()
    shown = film(tmp_path / "film.mp4", 8, 6)[0]
    assert abs(shown[:5, :7].astype(int) - 200).max() < 12 and shown[5, 7].max() < 40


@needs_ffmpeg
def test_a_film_has_its_name_only_when_it_is_whole(tmp_path):
    (tmp_path / "film.mp4").write_text("the last one")
    movie = Movie(tmp_path / "film.mp4")
    movie.begin((8, 6), 24)
    movie.add(np.zeros((6, 8, 3), np.uint8))
    assert (tmp_path / "film.mp4").read_text() == "the last one"
    movie.end()
    assert len(film(tmp_path / "film.mp4", 8, 6)) == 1


@needs_ffmpeg
def test_what_ffmpeg_will_not_do_is_a_sentence(tmp_path):
    movie = Movie(tmp_path / "film.unknown")
    movie.begin((8, 6), 24)
    with pytest.raises(Failed, match=r"film\.unknown: ffmpeg could not write it \(.+\)"):
        movie.add(np.zeros((6, 8, 3), np.uint8))
        movie.end()
    assert list(tmp_path.iterdir()) == []


def test_without_ffmpeg(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(Refused, match="--movie: there is no program called ffmpeg on this machine"):
        Movie(tmp_path / "film.mp4")


@needs_ffmpeg
@pytest.mark.parametrize("name, sentence", [("film", "is not a file name"), ("none/film.mp4", "there is no such folder")])
def test_names_that_cannot_be(tmp_path, name, sentence):
    with pytest.raises(Refused, match=sentence):
        Movie(tmp_path / name)
