"""`layers`: the layers of a recipe, each as a picture."""

import numpy as np
from stillwater import _stillwater as engine


def pictures(folder):
    return [engine.read_picture(str(path)).image for path in sorted(folder.iterdir())]


def test_each_layer_is_a_picture_front_first(scene, tmp_path, command):
    done = command("layers", scene(), "-o", tmp_path / "layers")
    assert done.returncode == 0, done.stderr
    names = ["01_boat.png", "02_reflection.png", "03_tree.png", "04_sea.png", "05_clouds.png"]
    assert done.stdout.split() == [str(tmp_path / "layers" / name) for name in names]
    assert sorted(file.name for file in (tmp_path / "layers").iterdir()) == names
    front, *behind = pictures(tmp_path / "layers")
    assert front.shape == (36, 48, 4) and front[..., 3].min() == 0 and front[..., 3].max() == 1


def test_what_a_file_s_name_can_t_hold_is_left_out(scene, tmp_path, command):
    path = scene()
    path.write_text(path.read_text().replace('"boat"', '"a/boat: red"'))
    done = command("layers", path, "-o", tmp_path / "layers")
    assert (tmp_path / "layers" / "01_a_boat_ red.png").exists(), done.stderr


def test_laid_over_each_other_they_give_the_picture(scene, tmp_path, command):
    command("layers", scene(), "-o", tmp_path / "layers", "--format", "exr")
    *front, whole = pictures(tmp_path / "layers")
    for layer in reversed(front):
        whole = layer + (1 - layer[..., 3:]) * whole
    np.testing.assert_allclose(whole, engine.read_picture(str(tmp_path / "picture.png")).image, atol=4e-3)  # half floats


def test_a_picture_s_alpha_is_the_layers_too(scene, tmp_path, command):
    path = scene()
    rgba = engine.read_picture(str(tmp_path / "picture.png")).image
    rgba[:, :24, 3] = 0
    rgba[:, :24, :3] = 0
    engine.write_picture(str(tmp_path / "picture.png"), rgba)
    command("layers", path, "-o", tmp_path / "layers")
    clouds = pictures(tmp_path / "layers")[-1]
    assert clouds[2, 20, 3] == 0 and clouds[5, 40, 3] == 1


def test_what_is_cut_is_kept_for_a_render(scene, tmp_path, command):
    command("layers", scene(), "-o", tmp_path / "layers")
    assert "the layers are cut" in command("info", scene()).stdout


def test_a_folder_that_can_t_be_is_a_sentence(scene, tmp_path, command):
    path = scene()
    done = command("layers", path, "-o", tmp_path / "picture.png")
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "picture.png: cannot be written" in done.stderr
    (tmp_path / "tree.png").unlink()
    done = command("layers", path, "-o", tmp_path / "layers")
    assert done.returncode == 2 and "layers[2].matte.file" in done.stderr and not (tmp_path / "layers").exists()
