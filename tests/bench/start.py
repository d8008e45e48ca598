"""From the start of `render` to the first frame of the `tree` sample on disk; and what loading the libraries takes."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from bench import Row, medians

SAMPLE = Path(__file__).parents[2] / "blend_samples" / "tree"
LIMIT = 1.0  # seconds


def rows():
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        shutil.copytree(SAMPLE, work / "tree")

        def first_frame():
            shutil.rmtree(work / "tree" / ".stillwater-cache", ignore_errors=True)
            command = [sys.executable, "-m", "stillwater", "render", str(work / "tree" / "recipe.json")]
            subprocess.run([*command, "--frames", "1-1", "--fresh"], check=True, timeout=60, capture_output=True)

        def libraries_alone():
            subprocess.run([sys.executable, "-c", "import stillwater._stillwater"], check=True, timeout=60)

        ours, loading = medians(first_frame, libraries_alone, runs=7, warmup=1)
    note = f"{loading * 1e3:.0f} ms of it load the libraries"
    yield Row("start of `render` to the first frame on disk, tree", ours * 1e3, LIMIT * 1e3, 1.0, note=note)
