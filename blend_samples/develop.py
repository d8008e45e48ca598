"""From a sample's rendered frames to its movie and contact sheet; prints both paths.

    python develop.py --recipe FILE --frames FOLDER --movie NAME.mp4 --sheet NAME.png
"""

import argparse
import json
import math
import subprocess
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

SHOWN = 8  # frames on the sheet
SHORTEST = 8.0  # seconds a looped movie lasts at least
TIME_LIMIT = 300  # seconds for ffmpeg


def write_movie(frames: list[Path], fps: float, turns: int, movie: Path) -> None:
    """H.264 in yuv420p, which every player reads, of `frames` (numbered without a gap) shown `turns` times."""
    colours = ["-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"]
    command = ["ffmpeg", "-y", "-loglevel", "error", "-framerate", str(fps), "-stream_loop", str(turns - 1),
               "-start_number", str(int(frames[0].stem)), "-i", str(frames[0].parent / "%04d.png"),
               "-frames:v", str(turns * len(frames)),
               "-vf", "crop=trunc(iw/2)*2:trunc(ih/2)*2,scale=out_color_matrix=bt709", "-pix_fmt", "yuv420p", *colours,
               "-c:v", "libx264", "-crf", "17", "-preset", "medium", "-movflags", "+faststart", str(movie)]
    subprocess.run(command, check=True, stdin=subprocess.DEVNULL, timeout=TIME_LIMIT)


def write_sheet(frames: list[Path], sheet: Path, columns: int = 4, width: int = 480, gap: int = 6) -> None:
    """Frames spread evenly over the whole, each with its number."""
    shown = [frames[round(k * (len(frames) - 1) / max(SHOWN - 1, 1))] for k in range(min(SHOWN, len(frames)))]
    first = Image.open(shown[0])
    height = round(first.height * width / first.width)
    rows = math.ceil(len(shown) / columns)
    whole = Image.new("RGB", (columns * (width + gap) + gap, rows * (height + gap) + gap), (24, 24, 24))
    pen, font = ImageDraw.Draw(whole), ImageFont.load_default(18)
    for k, path in enumerate(shown):
        x, y = gap + k % columns * (width + gap), gap + k // columns * (height + gap)
        whole.paste(Image.open(path).convert("RGB").resize((width, height), Image.Resampling.LANCZOS), (x, y))
        pen.text((x + 8, y + 6), str(int(path.stem)), font=font, fill="white", stroke_width=2, stroke_fill="black")
    whole.save(sheet)


def main() -> None:
    arguments = argparse.ArgumentParser(description="Movie and contact sheet of a sample.")
    for name in ("recipe", "frames", "movie", "sheet"):
        arguments.add_argument(f"--{name}", type=Path, required=True)
    given = arguments.parse_args()
    recipe = json.loads(given.recipe.read_text(encoding="utf-8"))
    frames = sorted(given.frames.glob("*.png"))
    first, last = recipe["frames"]
    fps = recipe.get("fps", 24)
    whole = recipe.get("loop", False) and len(frames) == last - first + 1
    turns = max(1, math.ceil(SHORTEST * fps / len(frames))) if whole else 1
    write_movie(frames, fps, turns, given.movie)
    write_sheet(frames, given.sheet)
    print(given.movie)
    print(given.sheet)


if __name__ == "__main__":
    main()
