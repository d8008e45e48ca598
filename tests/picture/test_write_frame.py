"""A frame on disk: its channels, their formats and values, its key; read back by ourselves and by others."""

import os
import re
import shutil
import subprocess
import sys

import numpy as np
import pytest
from PIL import Image
from stillwater import _stillwater as engine

RNG = np.random.default_rng(21)
HEIGHT, WIDTH = 53, 47
ALPHA = RNG.random((HEIGHT, WIDTH, 1)).astype(np.float32)
IMAGE = np.concatenate([RNG.random((HEIGHT, WIDTH, 3)).astype(np.float32) * ALPHA, ALPHA], 2)
FLOW = RNG.normal(0, 5, (HEIGHT, WIDTH, 2)).astype(np.float32)
MATTE = RNG.random((HEIGHT, WIDTH)).astype(np.float32)
LAYER = IMAGE[::-1].copy()
COMPRESSIONS = ["none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"]

needs_oiiotool = pytest.mark.skipif(not shutil.which("oiiotool"), reason="oiiotool is not installed")


def options(**given):
    return engine.FrameOptions(**given)


def write(path, **given):
    engine.write_frame(str(path), IMAGE, FLOW, MATTE, [("tree", LAYER)], options(**given))


def described(path):
    """What oiiotool says of a file, and {channel: format}."""
    info = subprocess.run(
        ["oiiotool", "--info", "-v", str(path)], capture_output=True, text=True, timeout=60, check=True
    )
    of_all = re.search(r"channel, (?:\w+/)*(\w+) openexr", info.stdout)[1]
    names = re.search(r"channel list: (.*)", info.stdout)[1].split(", ")
    parts = [re.fullmatch(r"(\S+)(?: \((\w+)\))?", name) for name in names]
    return info.stdout, {part[1]: part[2] or of_all for part in parts}


def planes_of(path, names):
    """{channel: height x width} as oiiotool reads them: one below the other in a float picture."""
    tower = path.with_suffix(".tif")
    command = ["oiiotool", str(path), "--label", "F", "--pop"]
    for name in names:
        command += ["F", "--ch", f"Y={name}"]
    command += ["--mosaic", f"1x{len(names)}", "-d", "float", "-o", str(tower)]
    subprocess.run(command, capture_output=True, timeout=60, check=True)
    with Image.open(tower) as image:
        return dict(zip(names, np.split(np.asarray(image, np.float32), len(names)), strict=True))


def linear(premultiplied):
    alpha = premultiplied[..., 3:].astype(np.float64)
    straight = premultiplied[..., :3] / alpha
    curved = np.where(straight <= 0.04045, straight / 12.92, ((straight + 0.055) / 1.055) ** 2.4)
    return np.concatenate([curved * alpha, alpha], 2)


def expected_formats(colour):
    formats = {f"{layer}{c}": colour for layer in ("", "Stillwater.Combined.") for c in "RGBA"}
    formats |= {f"Stillwater.Flow.{c}": "float" for c in "XYZ"}
    return formats | {"Stillwater.Matte.V": colour} | {f"tree.Combined.{c}": colour for c in "RGBA"}


@needs_oiiotool
@pytest.mark.parametrize("colour", ["half", "float"])
def test_others_see_what_was_meant(tmp_path, colour):
    path = tmp_path / "frame.exr"
    write(path, half=colour == "half", key="abc 123")
    info, formats = described(path)
    assert formats == expected_formats(colour)
    assert "chromaticities: 0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329" in info
    assert 'stillwater:key: "abc 123"' in info
    assert 'compression: "zip"' in info
    assert "DateTime" not in info


@needs_oiiotool
def test_values_in_a_half_file(tmp_path):
    path = tmp_path / "frame.exr"
    write(path)
    planes = planes_of(path, list(expected_formats("half")))
    for layer, image in (("", IMAGE), ("Stillwater.Combined.", IMAGE), ("tree.Combined.", LAYER)):
        for c, name in enumerate("RGBA"):
            np.testing.assert_allclose(
                planes[f"{layer}{name}"], linear(image)[..., c], rtol=2**-11 + 1e-5, atol=2**-24
            )
    for c, name in enumerate("XY"):
        flow = planes[f"Stillwater.Flow.{name}"]
        np.testing.assert_allclose(flow, FLOW[..., c], rtol=2**-13)
        assert not (flow.view(np.uint32) & 0x7FF).any()
    assert not planes["Stillwater.Flow.Z"].any()
    np.testing.assert_array_equal(planes["Stillwater.Matte.V"], MATTE.astype(np.float16))


@pytest.fixture(scope="module")
def opencv(tmp_path_factory):
    """A program that reads a file with OpenCV's imread alone and writes its floats out."""
    source, program = tmp_path_factory.mktemp("opencv") / "read.cpp", tmp_path_factory.mktemp("opencv") / "read"
    source.write_text("""
        #include <cstdio>
        #include <opencv2/imgcodecs.hpp>
        int main(int, char** argv) {
          const cv::Mat image = cv::imread(argv[1], cv::IMREAD_UNCHANGED);
          if (image.type() != CV_32FC4) return 1;
          return std::fwrite(image.data, image.elemSize(), image.total(), stdout) == image.total() ? 0 : 1;
        }""")
    flags = subprocess.run(["pkg-config", "--cflags", "opencv4"], capture_output=True, text=True, timeout=60).stdout
    command = ["g++", "-std=c++17", *flags.split(), str(source), "-o", str(program)]
    subprocess.run([*command, "-lopencv_imgcodecs", "-lopencv_core"], timeout=100, check=True)
    return program


@pytest.mark.parametrize("half", [True, False])
def test_opencv_reads_the_picture(tmp_path, opencv, half):
    path = tmp_path / "frame.exr"
    write(path, half=half)
    environment = {**os.environ, "OPENCV_IO_ENABLE_OPENEXR": "1"}
    read = subprocess.run([opencv, str(path)], capture_output=True, timeout=60, env=environment, check=True).stdout
    blue, green, red, alpha = np.moveaxis(np.frombuffer(read, np.float32).reshape(IMAGE.shape), 2, 0)
    tolerance = 2**-11 + 1e-5 if half else 1e-5
    np.testing.assert_allclose(np.stack([red, green, blue, alpha], 2), linear(IMAGE), rtol=tolerance, atol=2**-24)


@pytest.mark.parametrize("half", [True, False])
def test_a_picture_comes_back_through_a_frame(tmp_path, half):
    most = 255 if half else 65535
    stored = RNG.integers(0, most + 1, (40, 60, 3))
    image = np.concatenate([stored / most, np.ones((40, 60, 1))], 2).astype(np.float32)
    engine.write_frame(str(tmp_path / "f.exr"), image, options=options(half=half))
    back = engine.read_picture(str(tmp_path / "f.exr"))
    np.testing.assert_array_equal(np.rint(back.image[..., :3] * most), stored)
    assert not back.has_alpha


@pytest.mark.parametrize("compression", COMPRESSIONS)
def test_every_compression(tmp_path, compression):
    path = tmp_path / "frame.exr"
    smooth = np.ones((64, 64, 4), np.float32) * np.linspace(0.2, 0.8, 64, dtype=np.float32)[:, None]
    smooth[..., 3] = 1
    engine.write_frame(str(path), smooth, options=options(compression=compression))
    np.testing.assert_allclose(engine.read_picture(str(path)).image, smooth, atol=0.01)
    if shutil.which("oiiotool"):
        info = subprocess.run(["oiiotool", "--info", "-v", str(path)], capture_output=True, text=True, timeout=60)
        assert re.search(f'compression: "{compression}', info.stdout)


def test_missing_flow_and_matte_are_zeros(tmp_path):
    engine.write_frame(str(tmp_path / "a.exr"), IMAGE)
    engine.write_frame(str(tmp_path / "b.exr"), IMAGE, np.zeros_like(FLOW), np.zeros_like(MATTE))
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()
    assert not engine.read_matte(str(tmp_path / "a.exr"), "Stillwater.Matte.V").any()


@pytest.mark.parametrize("half", [True, False])
def test_any_number_of_threads_gives_the_same_bytes(tmp_path, half):
    rng = np.random.default_rng(1)
    image = rng.random((700, 300, 4)).astype(np.float32)
    layers = [(f"layer {i}", image) for i in range(30)] if half else []
    contents = []
    try:
        for threads in (1, 2, 5):
            engine.set_threads(threads)
            engine.write_frame(str(tmp_path / "f.exr"), image, layers=layers, options=options(half=half))
            contents.append((tmp_path / "f.exr").read_bytes())
    finally:
        engine.set_threads(0)
    assert contents[0] == contents[1] == contents[2]


def test_rows_that_are_packed_in_several_goes(tmp_path):
    """30 layers of 2000 x 300 are more than is held at a time: the seams must not show."""
    ramp = np.zeros((2000, 300, 4), np.float32)
    ramp[..., 0] = np.linspace(0, 1, 2000)[:, None]
    ramp[..., 3] = 1
    engine.write_frame(
        str(tmp_path / "f.exr"), ramp, layers=[(f"l{i}", ramp) for i in range(30)], options=options(compression="none")
    )
    np.testing.assert_allclose(engine.read_picture(str(tmp_path / "f.exr")).image, ramp, atol=1e-3)


def test_the_sse_way_writes_the_same_file(tmp_path):
    program = (
        "import sys, numpy as np\nfrom stillwater import _stillwater as e\nr = np.random.default_rng(5)\n"
        "i, flow = r.random((90, 70, 4)).astype('f4'), r.random((90, 70, 2)).astype('f4')\n"
        "e.write_frame(sys.argv[1], i, flow, i[..., 0])"
    )
    for wish in ("avx2", "sse4.2"):
        environment = {**os.environ, "STILLWATER_CPU": wish}
        subprocess.run([sys.executable, "-c", program, str(tmp_path / wish)], env=environment, timeout=60, check=True)
    assert (tmp_path / "avx2").read_bytes() == (tmp_path / "sse4.2").read_bytes()


def test_the_key_of_a_frame(tmp_path):
    write(tmp_path / "a.exr", key="k" * 300 + " ä")
    write(tmp_path / "b.exr")
    (tmp_path / "c.exr").write_text("no frame")
    (tmp_path / "d.exr").touch()
    keys = [engine.read_frame_key(str(tmp_path / f"{name}.exr")) for name in "abcde"]
    assert keys == ["k" * 300 + " ä", "", "", "", ""]


def test_layer_names():
    names = ["boat", "a.b", "tab\there", "50%", "x" * 100, "x" * 99 + "y", "ä" * 40, "boat"]
    given = engine.layer_names(names)
    assert given[:4] == ["boat", "a%2Eb", "tab%09here", "50%25"]
    assert given[4:6] == ["x" * 63, "x" * 61 + "~2"]
    assert given[6:] == ["ä" * 31, "boat~2"]
    assert engine.layer_names(["Stillwater", "stillwater"]) == ["Stillwater~2", "stillwater"]
    with pytest.raises(ValueError, match="^layers: an empty name is not a layer's name$"):
        engine.layer_names(["boat", ""])


def test_names_of_layers_stay_apart_in_the_file(tmp_path):
    engine.write_frame(str(tmp_path / "f.exr"), IMAGE, layers=[("a.b", LAYER), ("x" * 70, IMAGE), ("x" * 71, LAYER)])
    np.testing.assert_allclose(engine.read_matte(str(tmp_path / "f.exr"), "a%2Eb.Combined.A"), LAYER[..., 3], rtol=2**-10)
    np.testing.assert_allclose(engine.read_matte(str(tmp_path / "f.exr"), "x" * 63 + ".Combined.A"), IMAGE[..., 3], rtol=2**-10)
    np.testing.assert_allclose(
        engine.read_matte(str(tmp_path / "f.exr"), "x" * 61 + "~2.Combined.A"), LAYER[..., 3], rtol=2**-10
    )


def test_what_is_no_frame(tmp_path):
    path = str(tmp_path / "f.exr")
    wrong = [
        ((IMAGE, FLOW[1:]), {}, "flow: 47 x 52 is not the size of combined, 47 x 53"),
        ((IMAGE, None, MATTE[:, 1:]), {}, "matte: 46 x 53 is not the size of combined, 47 x 53"),
        ((IMAGE, None, None, [("tree", IMAGE[2:])]), {}, "tree: 47 x 51 is not the size of combined, 47 x 53"),
        ((IMAGE[..., :3],), {}, "combined: an array of 53 x 47 x 3 is not height x width x 4"),
        ((IMAGE[:0],), {}, "combined: an array of 0 x 47 x 4 is not height x width x 4"),
        ((np.zeros((1, 16385, 4)),), {}, "combined: 16385 x 1 is not between 1 and 16384 pixels a side"),
        (
            (IMAGE,),
            {"options": options(compression="lzw")},
            "compression: lzw is not none, rle, zips, zip, piz, pxr24, b44, b44a, dwaa or dwab",
        ),
    ]
    for arguments, named, sentence in wrong:
        with pytest.raises(ValueError) as caught:
            engine.write_frame(path, *arguments, **named)
        assert str(caught.value) == sentence
    assert list(tmp_path.iterdir()) == []
