"""The arguments of all commands, and the one place where errors become a sentence and an exit code."""

import argparse
import os
import signal
import sys

from ..recipe import RecipeError
from ..render.errors import Refused
from . import analyse, check, flow, info, inpaint, layers, matte, render, schema, serve

DONE, FAILED, BAD_INPUT = 0, 1, 2

COMMANDS = (check, schema, info, render, serve, layers, matte, inpaint, flow, analyse)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        say(f"{message} ({self.prog} --help shows what there is)")
        raise SystemExit(BAD_INPUT)


def say(sentence: str) -> None:
    print(f"stillwater: {sentence}", file=sys.stderr, flush=True)


def own_standard_error() -> None:
    """Keeps standard error for our sentences: what libraries print there by themselves (libpng, FFmpeg) is dropped."""
    sys.stderr = os.fdopen(os.dup(2), "w", buffering=1, errors="backslashreplace")
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 2)


def run(arguments: list[str]) -> int:
    """Runs one command; whatever goes wrong ends as a sentence on standard error.

    With STILLWATER_TRACEBACK=1 in the environment the way there is shown too.
    """
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # an interrupt ends the process at once
    parser = Parser(prog="stillwater", description="Brings still pictures to life.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=Parser)
    for command in COMMANDS:
        command.add_to(commands)
    given = parser.parse_args(arguments)
    try:
        return given.run(given) or DONE
    except BrokenPipeError:  # whoever read the output is gone
        sys.stdout = None
        return FAILED
    except Exception as error:  # noqa: BLE001
        if os.environ.get("STILLWATER_TRACEBACK") == "1":
            import traceback

            traceback.print_exc()
        return _end(error, given)


def _end(error: Exception, given) -> int:
    """Says what went wrong; answers whether the input was bad, or the work failed."""
    if isinstance(error, RecipeError):
        for problem in error.problems:
            say(f"{given.file}: {problem}")
        return BAD_INPUT
    if isinstance(error, OSError) and error.filename is not None:
        gone = isinstance(error, FileNotFoundError)
        say(f"{error.filename}: {'there is no such file' if gone else error.strerror}")
        return BAD_INPUT if str(error.filename) == given.file else FAILED
    say("; ".join(str(error).splitlines()) or type(error).__name__)
    return BAD_INPUT if isinstance(error, Refused) else FAILED
