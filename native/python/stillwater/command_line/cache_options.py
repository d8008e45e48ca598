"""`--cache` and `--cache-limit`, of every command that prepares."""

import argparse
from pathlib import Path


def add_to(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--cache", type=Path, metavar="DIR", help="folder of the cache, instead of one beside the recipe")
    parser.add_argument("--cache-limit", type=_gigabytes, metavar="GB", help="how large the cache may grow (default 4)")


def _gigabytes(text: str) -> int:
    """A size in GB as bytes."""
    try:
        size = float(text)
    except ValueError:
        size = 0
    if not 0.001 <= size <= 1e6:
        raise argparse.ArgumentTypeError(f"{text} is not between 0.001 and 1000000")
    return round(size * 1e9)
