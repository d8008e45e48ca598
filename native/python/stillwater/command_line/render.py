"""`stillwater render FILE`: the frames of a recipe."""

import argparse
import re
import sys
from pathlib import Path

from . import cache_options
from .files import frame_range


def add_to(commands) -> None:
    parser = commands.add_parser("render", help="render a recipe's frames")
    parser.add_argument("file", help="recipe (JSON)")
    parser.add_argument("--frames", type=frame_range, metavar="A-B", help="only these, both included")
    parser.add_argument("--output", type=Path, metavar="DIR", help="folder of the frames, instead of the recipe's")
    parser.add_argument("--scale", type=_scale, metavar="S", help="output pixels for a picture pixel, instead of the recipe's")
    parser.add_argument("--threads", type=_threads, default=0, metavar="N", help="0: one a core")
    cache_options.add_to(parser)
    parser.add_argument("--movie", type=Path, metavar="OUT.mp4", help="a film of the frames too (needs ffmpeg)")
    parser.add_argument("--progress", choices=("json", "bar", "none"), help="default: bar in a terminal, else none")
    parser.add_argument("--fresh", action="store_true", help="render anew what stands already")
    parser.add_argument("--parent", action="store_true", help="end when standard input ends")
    parser.set_defaults(run=_run)


def _run(given) -> None:
    from .. import _stillwater as engine

    engine.install_signal_handler()  # before all else: from here on an interrupt is certain and clean
    if given.parent:
        engine.end_with_standard_input()
    engine.set_threads(given.threads)
    from .show import shown

    with shown(given.progress or ("bar" if sys.stderr.isatty() else "none")) as show:
        from ..recipe import load
        from ..render.loop import Order, render

        order = Order(
            frames=given.frames,
            folder=given.output and given.output.absolute(),
            scale=given.scale,
            movie=given.movie,
            fresh=given.fresh,
            cache=given.cache and given.cache.absolute(),
            cache_limit=given.cache_limit,
        )
        for event in render(load(given.file), order):
            show(event)


def _scale(text: str) -> float:
    try:
        scale = float(text)
    except ValueError:
        scale = 0
    if not 0.001 <= scale <= 16:
        raise argparse.ArgumentTypeError(f"{text} is not between 0.001 and 16")
    return scale


def _threads(text: str) -> int:
    if not re.fullmatch(r"\d{1,4}", text) or int(text) > 1024:
        raise argparse.ArgumentTypeError(f"{text} is not between 0 and 1024")
    return int(text)
