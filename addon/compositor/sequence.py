"""The frames as a strip of the sequencer, which reads the plain channels of the same files."""

from pathlib import Path

import bpy

from .. import versions
from . import frames


def add_strip(editor, tree):
    """An image strip of all frames from the first to the last; a missing one shows the nearest. Returns the strip."""
    state = tree.stillwater
    folder = Path(bpy.path.abspath(state.folder))
    there = [n for n in frames.present(folder, state.name) if state.first <= n <= state.last]
    wanted = range(state.first, state.last + 1)
    files = [frames.path_of(folder, state.name, frames.nearest(n, there)) for n in wanted]
    first = str(files[0])
    if bpy.data.filepath and state.folder.startswith("//"):
        first = bpy.path.relpath(first)
    strip = editor.strips.new_image(tree.name, first, _free_channel(editor, wanted), state.first, fit_method="ORIGINAL")
    for file in files[1:]:
        strip.elements.append(file.name)
    versions.set_strip_length(strip, len(files))
    return strip


def _free_channel(editor, wanted: range) -> int:
    """The lowest channel above whatever lies at these frames."""
    covered = [(strip.channel, versions.strip_frames(strip)) for strip in editor.strips]
    channels = [channel for channel, there in covered if there.start < wanted.stop and there.stop > wanted.start]
    return max(channels, default=0) + 1
