"""The README's picture: four moments of each sample, from the frames that run.sh has baked.

    build/venv/bin/python blend_samples/strip.py tree lake harbour
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image
from stillwater import _stillwater as engine

HERE = Path(__file__).parent
BAKED = HERE.parent / "build" / "samples"
WIDTH = 320  # of one moment


def row(sample: str) -> Image.Image:
    """Four frames, evenly spread over what is baked."""
    frames = sorted((BAKED / sample / "frames").glob("frame_*.exr"))
    strip = None
    for i in range(4):
        combined = engine.read_frame(str(frames[i * len(frames) // 4]))
        picture = Image.fromarray((np.clip(combined[..., :3], 0, 1) * 255 + 0.5).astype(np.uint8))
        picture = picture.resize((WIDTH, round(WIDTH * picture.height / picture.width)), Image.Resampling.LANCZOS)
        strip = strip or Image.new("RGB", (4 * WIDTH, picture.height))
        strip.paste(picture, (i * WIDTH, 0))
    return strip


def main() -> None:
    rows = [row(sample) for sample in sys.argv[1:]]
    whole = Image.new("RGB", (4 * WIDTH, sum(picture.height for picture in rows)))
    top = 0
    for picture in rows:
        whole.paste(picture, (0, top))
        top += picture.height
    whole.save(HERE / "strip.jpg", quality=88)


if __name__ == "__main__":
    main()
