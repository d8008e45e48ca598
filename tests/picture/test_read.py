"""Pictures of all kinds come in as they are meant, turned upright; what can't be read is said in one sentence."""

import os
import shutil
import struct
import subprocess
import sys
import zlib

import numpy as np
import pytest
from PIL import Image, ImageOps
from stillwater import _stillwater as engine

RNG = np.random.default_rng(11)
COLOURS = RNG.integers(0, 256, (23, 31, 4), np.uint8)
SHARES = (COLOURS / np.float32(255)).astype(np.float32)

needs_oiiotool = pytest.mark.skipif(not shutil.which("oiiotool"), reason="oiiotool is not installed")


def oiiotool(*arguments):
    subprocess.run(["oiiotool", *map(str, arguments)], check=True, timeout=60, capture_output=True)


def premultiplied(straight):
    return np.concatenate([straight[..., :3] * straight[..., 3:], straight[..., 3:]], 2)


def exact_srgb(v):
    v = np.asarray(v, np.float64)
    return np.where(v <= 0.0031308, v * 12.92, 1.055 * v ** (1 / 2.4) - 0.055)


def write_float_exr(path, channels):
    """An OpenEXR file by hand, uncompressed, single part: {name: height x width floats}."""
    height, width = next(iter(channels.values())).shape
    names = sorted(channels)

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data

    table = b"".join(n.encode() + b"\0" + struct.pack("<iiii", 2, 0, 1, 1) for n in names) + b"\0"
    window = struct.pack("<iiii", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + attribute("channels", "chlist", table)
    header += attribute("compression", "compression", b"\0") + attribute("dataWindow", "box2i", window)
    header += attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<ff", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    rows = [b"".join(np.float32(channels[n][y]).tobytes() for n in names) for y in range(height)]
    first = len(header) + 8 * height
    offsets = [first + y * (8 + len(rows[0])) for y in range(height)]
    blocks = [struct.pack("<ii", y, len(row)) + row for y, row in enumerate(rows)]
    path.write_bytes(header + struct.pack(f"<{height}Q", *offsets) + b"".join(blocks))


@pytest.mark.parametrize(
    ("mode", "channels"), [("L", [0, 0, 0]), ("LA", [0, 0, 0, 3]), ("RGB", [0, 1, 2]), ("RGBA", [0, 1, 2, 3])]
)
def test_grey_and_colours_with_and_without_alpha(tmp_path, mode, channels):
    stored = COLOURS[..., sorted(set(channels))]
    Image.fromarray(stored.squeeze(), mode).save(tmp_path / "p.png")
    picture = engine.read_picture(str(tmp_path / "p.png"))
    straight = np.ones((23, 31, 4), np.float32)
    straight[..., : len(channels)] = SHARES[..., channels]
    np.testing.assert_array_equal(picture.image, premultiplied(straight))
    assert picture.has_alpha == (len(channels) == 4)
    assert picture.bad_pixels == 0


def test_an_alpha_of_ones_is_none(tmp_path):
    opaque = COLOURS.copy()
    opaque[..., 3] = 255
    Image.fromarray(opaque).save(tmp_path / "p.png")
    assert not engine.read_picture(str(tmp_path / "p.png")).has_alpha


@pytest.mark.parametrize("name", ["p.tif", "p.bmp", "p.tga", "p.webp", "p.ppm"])
def test_8_bit_formats_without_loss(tmp_path, name):
    Image.fromarray(COLOURS[..., :3]).save(tmp_path / name, **({"lossless": True} if name == "p.webp" else {}))
    np.testing.assert_array_equal(engine.read_picture(str(tmp_path / name)).image[..., :3], SHARES[..., :3])


def test_a_palette_becomes_colours(tmp_path):
    palette = Image.fromarray(COLOURS[..., :3]).quantize(40)
    palette.save(tmp_path / "p.png")
    colours = np.asarray(palette.convert("RGB")) / np.float32(255)
    np.testing.assert_array_equal(engine.read_picture(str(tmp_path / "p.png")).image[..., :3], colours)


def test_16_bit_grey(tmp_path):
    stored = RNG.integers(0, 65536, (9, 13), np.uint16)
    for name in ("p.png", "p.tif"):
        Image.fromarray(stored).save(tmp_path / name)
        image = engine.read_picture(str(tmp_path / name)).image
        np.testing.assert_array_equal(image[..., 1], stored / np.float32(65535))


def test_cmyk_comes_as_colours(tmp_path):
    Image.new("CMYK", (16, 16), (0, 255, 255, 0)).save(tmp_path / "p.jpg", quality=100)
    pixel = engine.read_picture(str(tmp_path / "p.jpg")).image[8, 8]
    np.testing.assert_allclose(pixel, [1, 0, 0, 1], atol=0.02)


@pytest.mark.parametrize("orientation", range(1, 9))
@pytest.mark.parametrize(("name", "options"), [("p.jpg", {"quality": 100, "subsampling": 0}), ("p.tif", {})])
def test_the_camera_is_turned_upright(tmp_path, orientation, name, options):
    path = tmp_path / name
    exif = Image.Exif()
    exif[0x0112] = orientation
    Image.fromarray(COLOURS[..., :3]).save(path, exif=exif, **options)
    with Image.open(path) as stored:
        scene = np.asarray(ImageOps.exif_transpose(stored)) / np.float32(255)
    assert scene.shape == ((23, 31, 3) if orientation < 5 else (31, 23, 3))
    np.testing.assert_allclose(engine.read_picture(str(path)).image[..., :3], scene, atol=1e-6)
    np.testing.assert_allclose(engine.read_matte(str(path), "R"), scene[..., 0], atol=1e-6)
    facts = engine.inspect_picture(str(path))
    assert (facts.height, facts.width) == scene.shape[:2]


def test_an_exr_is_unpremultiplied_before_the_curve(tmp_path):
    alpha = RNG.random((9, 13)).astype(np.float32)
    straight = (RNG.random((9, 13, 3)) * 3).astype(np.float32)
    scene = {name: straight[..., c] * alpha for c, name in enumerate("RGB")} | {"A": alpha}
    write_float_exr(tmp_path / "p.exr", scene)
    picture = engine.read_picture(str(tmp_path / "p.exr"))
    assert picture.has_alpha
    np.testing.assert_allclose(picture.image[..., :3], exact_srgb(straight) * alpha[..., None], rtol=3e-6)
    np.testing.assert_array_equal(picture.image[..., 3], alpha)
    as_srgb = engine.read_picture(str(tmp_path / "p.exr"), engine.colour_space_named("srgb"))
    np.testing.assert_array_equal(as_srgb.image[..., 0], scene["R"])


def test_a_linear_png_goes_through_the_curve(tmp_path):
    Image.fromarray(COLOURS).save(tmp_path / "p.png")
    image = engine.read_picture(str(tmp_path / "p.png"), engine.colour_space_named("linear")).image
    np.testing.assert_allclose(image[..., :3], exact_srgb(SHARES[..., :3]) * SHARES[..., 3:], rtol=3e-6, atol=1e-7)


def test_of_named_layers_the_one_without_a_name_else_the_first(tmp_path):
    planes = RNG.random((7, 4, 5)).astype(np.float32)
    layers = {f"Near.{c}": planes[i] for i, c in enumerate("RGB")} | {
        f"Far.{c}": planes[i + 3] for i, c in enumerate("RGB")
    }
    write_float_exr(tmp_path / "named.exr", layers)
    image = engine.read_picture(str(tmp_path / "named.exr")).image
    np.testing.assert_allclose(image[..., 0], exact_srgb(layers["Far.R"]), rtol=2e-6)
    write_float_exr(tmp_path / "plain.exr", layers | {c: planes[6] * (i + 1) for i, c in enumerate("RGB")})
    image = engine.read_picture(str(tmp_path / "plain.exr")).image
    np.testing.assert_allclose(image[..., 1], exact_srgb(planes[6] * 2), rtol=2e-6)


def test_what_is_not_a_number_is_black_and_counted(tmp_path):
    planes = {c: np.full((4, 5), 0.5, np.float32) for c in "RGBA"}
    planes["R"][0, 0] = np.nan
    planes["G"][0, 0] = np.inf
    planes["B"][3, 4] = -np.inf
    planes["A"][2, 2] = np.nan
    write_float_exr(tmp_path / "p.exr", planes)
    picture = engine.read_picture(str(tmp_path / "p.exr"))
    assert picture.bad_pixels == 3
    np.testing.assert_array_equal(picture.image[[0, 3, 2], [0, 4, 2]], [[0, 0, 0, 0.5], [0, 0, 0, 0.5], [0, 0, 0, 0]])
    assert np.isfinite(picture.image).all()


@needs_oiiotool
def test_an_exr_is_its_display_window(tmp_path):
    oiiotool(
        "--pattern",
        "constant:color=1,1,1",
        "6x4",
        3,
        "--origin",
        "+3+2",
        "--fullsize",
        "12x10+1+1",
        "-o",
        tmp_path / "p.exr",
    )
    picture = engine.read_picture(str(tmp_path / "p.exr"))
    assert picture.image.shape == (10, 12, 4)
    assert picture.has_alpha
    inside = np.zeros((10, 12), bool)
    inside[1:5, 2:8] = True
    np.testing.assert_allclose(picture.image, np.repeat(inside[..., None], 4, 2), atol=1e-6)


@needs_oiiotool
def test_the_part_that_holds_the_colours(tmp_path):
    oiiotool(
        "--pattern",
        "constant:color=9",
        "6x4",
        1,
        "--chnames",
        "Depth.Z",
        "--pattern",
        "constant:color=1,0,0",
        "6x4",
        3,
        "--siappend",
        "-o",
        tmp_path / "p.exr",
    )
    np.testing.assert_allclose(engine.read_picture(str(tmp_path / "p.exr")).image[0, 0], [1, 0, 0, 1], atol=1e-6)


@needs_oiiotool
def test_a_radiance_picture_is_linear(tmp_path):
    oiiotool("--pattern", "constant:color=4,0.25,0.5", "16x16", 3, "-o", tmp_path / "p.hdr")
    np.testing.assert_allclose(
        engine.read_picture(str(tmp_path / "p.hdr")).image[5, 5, :3], exact_srgb([4, 0.25, 0.5]), rtol=0.01
    )


def test_a_photoshop_file_is_its_merged_picture(tmp_path):
    rows = COLOURS[..., :3].transpose(2, 0, 1).tobytes()
    header = b"8BPS" + struct.pack(">H6xHIIHH", 1, 3, 23, 31, 8, 3)
    (tmp_path / "p.psd").write_bytes(header + struct.pack(">IIIH", 0, 0, 0, 0) + rows)
    np.testing.assert_array_equal(engine.read_picture(str(tmp_path / "p.psd")).image[..., :3], SHARES[..., :3])


def test_the_header_alone(tmp_path):
    Image.fromarray(COLOURS).save(tmp_path / "p.png")
    facts = engine.inspect_picture(str(tmp_path / "p.png"))
    assert (facts.width, facts.height, facts.channels, facts.pixel_type, facts.format) == (31, 23, 4, "uint8", "png")
    assert facts.channel_names == ["R", "G", "B", "A"]


def test_one_pixel(tmp_path):
    Image.new("RGB", (1, 1), (255, 0, 51)).save(tmp_path / "p.png")
    np.testing.assert_allclose(engine.read_picture(str(tmp_path / "p.png")).image, [[[1, 0, 0.2, 1]]])


# What can't be read.


def sentence_of(path, read=engine.read_picture):
    with pytest.raises((OSError, ValueError)) as caught:
        read(str(path))
    sentence = str(caught.value)
    assert "\n" not in sentence
    assert sentence.startswith(f"{path}: ")
    return type(caught.value), sentence.removeprefix(f"{path}: ")


READERS = [engine.read_picture, engine.read_matte, engine.read_labels, engine.inspect_picture, engine.Clip]


@pytest.mark.parametrize("read", READERS, ids=lambda r: r.__name__)
def test_no_file_to_read(tmp_path, read):
    (tmp_path / "empty.png").touch()
    (tmp_path / "words.png").write_text("not a picture " * 100)
    assert sentence_of(tmp_path / "none.png", read) == (engine.FileError, "there is no such file")
    assert sentence_of(tmp_path, read) == (engine.FileError, "is a folder, not a file")
    assert sentence_of(tmp_path / "empty.png", read) == (engine.FileError, "the file is empty")
    assert sentence_of(tmp_path / "words.png", read)[1].startswith("is not a picture or clip that can be read")


@pytest.mark.parametrize("share", [0.5, 0.9, 0.99])
@pytest.mark.parametrize(
    "name", ["p.png", "p.jpg", "progressive.jpg", "p.tif", "lzw.tif", "p.bmp", "p.tga", "p.webp", "p.gif"]
)
def test_a_file_that_was_cut_short(tmp_path, name, share):
    options = {"progressive.jpg": {"progressive": True}, "lzw.tif": {"compression": "tiff_lzw"}}.get(name, {})
    noise = RNG.integers(0, 256, (64, 80, 3), np.uint8)
    Image.fromarray(noise).save(tmp_path / name, **options)
    engine.read_picture(str(tmp_path / name))
    whole = (tmp_path / name).read_bytes()
    (tmp_path / name).write_bytes(whole[: int(len(whole) * share)])
    kind, sentence = sentence_of(tmp_path / name)
    assert kind is engine.FileError
    assert sentence.startswith(("is cut short or damaged", "is not a picture or clip that can be read"))


def test_an_exr_that_was_cut_short(tmp_path):
    engine.write_picture(str(tmp_path / "p.exr"), SHARES, 32)
    whole = (tmp_path / "p.exr").read_bytes()
    (tmp_path / "p.exr").write_bytes(whole[:-100])
    assert sentence_of(tmp_path / "p.exr")[1].startswith("is cut short or damaged")


def test_a_jpeg_whose_thumbnail_is_whole(tmp_path):
    noise = Image.fromarray(RNG.integers(0, 256, (64, 80, 3), np.uint8))
    noise.save(tmp_path / "thumbnail.jpg")
    exif = b"Exif\0\0" + (tmp_path / "thumbnail.jpg").read_bytes()
    noise.save(tmp_path / "p.jpg", exif=exif)
    whole = (tmp_path / "p.jpg").read_bytes()
    assert whole.count(b"\xff\xd9") == 2
    (tmp_path / "p.jpg").write_bytes(whole[:-200])
    assert sentence_of(tmp_path / "p.jpg") == (engine.FileError, "is cut short or damaged (its end is missing)")


def png_of_size(path, width, height):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(b"")) + chunk(b"IEND", b"")
    )


def test_a_picture_that_is_too_large_is_refused_by_its_header(tmp_path):
    png_of_size(tmp_path / "p.png", 30000, 30000)
    assert sentence_of(tmp_path / "p.png") == (
        engine.BadInput,
        "30000 x 30000 is not between 1 and 16384 pixels a side",
    )
    png_of_size(tmp_path / "p.png", 16385, 1)
    assert sentence_of(tmp_path / "p.png")[0] is engine.BadInput


def test_a_picture_of_no_pixels(tmp_path):
    png_of_size(tmp_path / "p.png", 0, 0)
    assert sentence_of(tmp_path / "p.png")[1].startswith("is not a picture or clip that can be read")


def test_a_file_that_may_not_be_read(tmp_path):
    path = tmp_path / "p.png"
    Image.fromarray(COLOURS).save(path)
    path.chmod(0)
    if os.geteuid() != 0:
        assert sentence_of(path) == (engine.FileError, "cannot be read (Permission denied)")
        return
    # Root may read everything: try as nobody, in a process of its own that has the engine loaded already.
    program = (
        "import os, sys\nfrom stillwater import _stillwater as e\nos.setuid(65534)\n"
        "try: e.read_picture(sys.argv[1])\nexcept OSError as error: print(error)"
    )
    for folder in [tmp_path, *tmp_path.parents[:-2]]:
        folder.chmod(folder.stat().st_mode | 0o011)
    run = subprocess.run([sys.executable, "-c", program, str(path)], capture_output=True, text=True, timeout=60)
    assert run.stdout == f"{path}: cannot be read (Permission denied)\n"


# Mattes and label maps.


def test_a_matte_is_a_channel_or_grey(tmp_path):
    Image.fromarray(COLOURS).save(tmp_path / "p.png")
    Image.fromarray(COLOURS[..., 0]).save(tmp_path / "grey.png")
    path, grey = str(tmp_path / "p.png"), str(tmp_path / "grey.png")
    np.testing.assert_array_equal(engine.read_matte(path, "A"), SHARES[..., 3])
    np.testing.assert_array_equal(engine.read_matte(path, "g"), SHARES[..., 1])
    np.testing.assert_allclose(engine.read_matte(path), SHARES[..., :3] @ [0.2126, 0.7152, 0.0722], atol=1e-6)
    for channel in ("", "A"):
        np.testing.assert_array_equal(engine.read_matte(grey, channel), SHARES[..., 0])
    with pytest.raises(ValueError, match="p.png: tree.A is not one of its channels \\(R, G, B, A\\)$"):
        engine.read_matte(path, "tree.A")


def test_a_mask_saved_with_an_opaque_alpha_is_its_grey(tmp_path):
    mask = np.repeat(COLOURS[..., :1], 4, 2)
    mask[..., 3] = 255
    Image.fromarray(mask).save(tmp_path / "p.png")
    np.testing.assert_array_equal(engine.read_matte(str(tmp_path / "p.png"), "A"), SHARES[..., 0])


def test_a_matte_is_not_curved_and_lies_within_0_and_1(tmp_path):
    values = np.array([[-1, 0.25, 2], [np.nan, np.inf, 1]], np.float32)
    write_float_exr(tmp_path / "p.exr", {"tree.A": values})
    np.testing.assert_array_equal(engine.read_matte(str(tmp_path / "p.exr"), "tree.A"), [[0, 0.25, 1], [0, 1, 1]])


@pytest.mark.parametrize("kind", [np.uint8, np.uint16, np.int32, np.float32])
def test_labels_stand_as_they_are(tmp_path, kind):
    labels = RNG.integers(0, min(np.iinfo(kind).max if kind != np.float32 else 2**24, 2**31 - 1), (9, 13)).astype(kind)
    Image.fromarray(labels).save(tmp_path / "p.tif")
    read = engine.read_labels(str(tmp_path / "p.tif"))
    assert read.dtype == np.int32
    np.testing.assert_array_equal(read, labels)


def test_labels_saved_as_grey_colours(tmp_path):
    Image.fromarray(np.repeat(COLOURS[..., :1], 3, 2)).save(tmp_path / "p.png")
    np.testing.assert_array_equal(engine.read_labels(str(tmp_path / "p.png")), COLOURS[..., 0])


def test_what_is_no_label_map(tmp_path):
    Image.fromarray(COLOURS[..., :3]).save(tmp_path / "p.png")
    assert sentence_of(tmp_path / "p.png", engine.read_labels) == (
        engine.BadInput,
        "a coloured picture is not a label map (one channel of whole numbers)",
    )
    write_float_exr(tmp_path / "p.exr", {"Y": np.array([[1, 2.5]], np.float32)})
    assert sentence_of(tmp_path / "p.exr", engine.read_labels) == (
        engine.BadInput,
        "2.5 is not a label (a whole number from 0 to 2147483647)",
    )
