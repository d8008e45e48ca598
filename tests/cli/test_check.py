"""`check` and `schema`: what they print, where, and how they end."""

import json
import subprocess
import sys

import pytest


def stillwater(*arguments):
    return subprocess.run([sys.executable, "-m", "stillwater", *arguments], capture_output=True, text=True, timeout=60)


@pytest.fixture
def recipe(tmp_path):
    def write(**changes):
        path = tmp_path / "recipe.json"
        path.write_text(json.dumps({"stillwater": 1, "picture": "p.png", "frames": [1, 3], "layers": [{"name": "all"}], **changes}))
        return str(path)

    return write


def test_schema_is_json():
    assert json.loads(stillwater("schema").stdout)["title"] == "Stillwater recipe"


def test_a_wrong_field_is_one_sentence_and_code_2(recipe):
    path = recipe(fps=-1)
    done = stillwater("check", path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"stillwater: {path}: fps: -1 is not above 0 (1/s)\n"


@pytest.mark.parametrize("arguments", [[], ["fly"], ["check"], ["check", "--bright", "x"]])
def test_wrong_arguments_are_one_sentence_and_code_2(arguments):
    done = stillwater(*arguments)
    assert done.returncode == 2
    assert done.stderr.startswith("stillwater: ") and done.stderr.count("\n") == 1


def test_no_such_recipe(tmp_path):
    done = stillwater("check", str(tmp_path / "none.json"))
    assert (done.returncode, done.stderr) == (2, f"stillwater: {tmp_path}/none.json: there is no such file\n")


def test_a_folder_is_no_recipe(tmp_path):
    done = stillwater("check", str(tmp_path))
    assert (done.returncode, done.stderr) == (2, f"stillwater: {tmp_path}: Is a directory\n")
