"""The frames as a strip of the sequencer, which reads the plain channels of the same files."""

from pathlib import Path

import bpy

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
    strip.frame_final_duration = len(files)
    return strip


def _free_channel(editor, wanted: range) -> int:
    """The lowest channel above whatever lies at these frames."""
    covering = [
        strip.channel
        for strip in editor.strips
        if strip.frame_final_start < wanted.stop and strip.frame_final_end > wanted.start
    ]
    return max(covering, default=0) + 1
