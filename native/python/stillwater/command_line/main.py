"""The arguments of all commands, and the one place where errors become a sentence and an exit code."""

import argparse
import sys

from ..recipe import RecipeError
from . import check, schema

DONE, FAILED, BAD_INPUT, INTERRUPTED = 0, 1, 2, 130

COMMANDS = (check, schema)


class Parser(argparse.ArgumentParser):
    def error(self, message):
        say(f"{message} ({self.prog} --help shows what there is)")
        raise SystemExit(BAD_INPUT)


def say(sentence: str) -> None:
    print(f"stillwater: {sentence}", file=sys.stderr, flush=True)


def run(arguments: list[str]) -> int:
    """Runs one command; whatever goes wrong ends as a sentence on standard error."""
    parser = Parser(prog="stillwater", description="Brings still pictures to life.")
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND", parser_class=Parser)
    for command in COMMANDS:
        command.add_to(commands)
    try:
        given = parser.parse_args(arguments)
        return given.run(given) or DONE
    except RecipeError as error:
        for problem in error.problems:
            say(f"{given.file}: {problem}")
        return BAD_INPUT
    except FileNotFoundError as error:
        say(f"{error.filename}: there is no such file")
        return BAD_INPUT
    except BrokenPipeError:
        sys.stderr.close()
        return FAILED
    except OSError as error:
        say(f"{error.filename}: {error.strerror}" if error.filename else str(error))
        return BAD_INPUT
    except KeyboardInterrupt:
        return INTERRUPTED
