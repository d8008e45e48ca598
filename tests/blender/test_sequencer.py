"""The frames in the sequencer: the same files, at their own frames."""

import bpy
import numpy as np
import pytest
from pixels import oiio, write_frame


def rendered(scene, frame, folder):
    """What the sequencer gives; it works in sRGB and comes back."""
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGBA", "32"
    scene.render.filepath = str(folder / "sequence.exr")
    scene.frame_set(frame)
    bpy.ops.render.render(write_still=True)
    return oiio.ImageBuf(scene.render.filepath).get_pixels("float")


def plain(folder, frame):
    return oiio.ImageBuf(str(folder / f"frame_{frame:04d}.exr")).get_pixels("float")[..., :4]


def strips(scene):
    return list(scene.sequence_editor.strips)


def test_without_frames_the_button_is_greyed_out(scene, picture):
    assert not bpy.ops.stillwater.add_to_sequencer.poll()


def test_each_frame_is_shown_at_its_own_place(extension, painted, tmp_path):
    scene = bpy.context.scene
    bpy.ops.stillwater.bake()
    assert bpy.ops.stillwater.add_to_sequencer() == {"FINISHED"}
    strip = strips(scene)[0]
    assert (extension.versions.strip_frames(strip), strip.name) == (range(5, 9), "Stillwater lake")
    assert strip.directory.startswith("//stillwater/lake/frames")
    for frame in range(5, 9):
        np.testing.assert_allclose(rendered(scene, frame, tmp_path), plain(painted, frame), atol=1e-3)
    assert np.abs(plain(painted, 5) - plain(painted, 8)).max() > 0.01


def test_a_missing_frame_shows_the_nearest(extension, scene, baked, tmp_path):
    (tmp_path / "frames" / "frame_0006.exr").unlink()
    (tmp_path / "frames" / "frame_0005.exr").unlink()
    bpy.ops.stillwater.add_to_sequencer()
    files = [element.filename for element in strips(scene)[0].elements]
    assert files == ["frame_0007.exr", "frame_0007.exr", "frame_0007.exr", "frame_0008.exr"]


def test_what_stands_in_the_sequencer_is_not_covered(scene, baked):
    editor = scene.sequence_editor_create()
    editor.strips.new_effect("colour", "COLOR", 1, 1, **_length(editor, 20))
    for channel in (2, 3):
        bpy.ops.stillwater.add_to_sequencer()
        assert max(strip.channel for strip in editor.strips) == channel


def test_frames_that_are_gone_are_a_sentence(scene, baked, tmp_path):
    for file in (tmp_path / "frames").iterdir():
        file.unlink()
    with pytest.raises(RuntimeError, match="holds no frames; bake the picture first"):
        bpy.ops.stillwater.add_to_sequencer()
    write_frame(tmp_path / "frames" / "frame_0005.exr", 5)


def _length(editor, frames):
    """new_effect takes the strip's end before 5.0 and its length from then on."""
    names = editor.strips.bl_rna.functions["new_effect"].parameters.keys()
    return {"length": frames} if "length" in names else {"frame_end": frames + 1}
