"""Files that a command is given: what is wrong with one is said with its name, once."""

import argparse
import contextlib
import re
import sys


def frame_range(text: str) -> tuple[int, int]:
    """Of an argument: first and last."""
    match = re.fullmatch(r"(-?\d{1,9})(?:-(-?\d{1,9}))?", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text} is not a frame or FIRST-LAST")
    return int(match[1]), int(match[2] or match[1])


def check_ending(path: str, endings: tuple[str, ...]) -> None:
    from ..render.errors import Refused

    if not path.lower().endswith(endings):
        raise Refused(f"{path}: its ending is not one of {', '.join(endings)}")


@contextlib.contextmanager
def named(path: str):
    """Within, what the engine refuses is said of this file."""
    from .. import _stillwater as engine
    from ..render.errors import Refused

    try:
        yield
    except (engine.BadInput, engine.FileError) as error:
        sentence = str(error).removeprefix("trimap: ")
        raise Refused(sentence if sentence.startswith(path) else f"{path}: {sentence}") from None


def read_picture(path: str):
    """The picture, height x width x 4, and what there is to be said of it."""
    import warnings

    from ..images import read

    with warnings.catch_warnings(record=True) as said, named(path):
        warnings.simplefilter("always")
        picture = read(path)
    return picture, [str(warning.message) for warning in said]


def warn(sentences: list[str]) -> None:
    for sentence in sentences:
        print(f"stillwater: warning: {sentence}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def drawing(path: str):
    """Within, a file of strokes is read: what is wrong with it is said with its name, one sentence a line."""
    from ..recipe import RecipeError
    from ..render.errors import Refused

    try:
        yield
    except RecipeError as error:
        raise Refused("\n".join(f"{path}: {problem}" for problem in error.problems)) from None
    except OSError as error:
        gone = isinstance(error, FileNotFoundError)
        raise Refused(f"{path}: {'there is no such file' if gone else error.strerror}") from None
