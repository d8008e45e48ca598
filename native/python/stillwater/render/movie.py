"""Frames to a film, by the program ffmpeg: H.264, 8-bit sRGB over black."""

import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .. import _stillwater as engine
from .errors import Failed, Refused


class Movie:
    """A film that grows frame by frame and gets its name when it is whole.

    Throws Refused where there is no ffmpeg or the name can't be one, Failed where ffmpeg ends badly.
    """

    def __init__(self, path: Path):
        self.path = path
        self._program = shutil.which("ffmpeg")
        if self._program is None:
            raise Refused("--movie: there is no program called ffmpeg on this machine (frames need none)")
        if not path.suffix:
            raise Refused(f"--movie: {path} is not a file name that says what kind of film (such as film.mp4)")
        if not path.parent.is_dir():
            raise Refused(f"--movie: {path.parent}: there is no such folder")
        self._aside = engine.temporary_name(str(path.absolute()))
        self._process = None

    def begin(self, size: tuple[int, int], fps: float) -> None:
        """Starts ffmpeg for frames of this size, `fps` a second."""
        engine.sweep_temporaries(str(self.path.absolute().parent))
        self._file = engine.TemporaryFile(self._aside)
        self._complaints = tempfile.TemporaryFile()
        command = [self._program, "-loglevel", "error", "-nostdin", "-y"]
        command += ["-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{size[0]}x{size[1]}", "-r", repr(fps), "-i", "pipe:"]
        # Even sides are what 4:2:0 needs; sRGB's primaries are those of BT.709.
        command += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=yuv420p"]
        command += ["-c:v", "libx264", "-crf", "16", "-colorspace", "bt709", "-color_primaries", "bt709"]
        command += ["-color_trc", "iec61966-2-1", "-color_range", "tv", "-movflags", "+faststart", self._aside]
        self._process = subprocess.Popen(
            command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=self._complaints
        )

    def add(self, picture: np.ndarray) -> None:
        """One more frame, H x W x 3 bytes."""
        try:
            self._process.stdin.write(np.ascontiguousarray(picture).data)
        except BrokenPipeError:
            self._fail()

    def end(self) -> None:
        """Closes the film and gives it its name."""
        try:
            self._process.stdin.close()
        except BrokenPipeError:
            pass  # its exit code says it
        if self._process.wait() != 0:
            self._fail()
        self._file.keep_as(str(self.path))

    def _fail(self):
        self._process.wait()
        self._complaints.seek(0)
        lines = self._complaints.read().decode(errors="replace").strip().splitlines()
        raise Failed(f"{self.path}: ffmpeg could not write it ({lines[-1] if lines else 'it says nothing'})")
