"""From a recipe's file, text or dictionary to a checked Recipe."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import msgspec

from .checks import problems_of
from .errors import RecipeError
from .parts import Choice
from .picture import Recipe


@dataclass(frozen=True)
class Document:
    """A recipe and the folder that its relative paths start at."""

    recipe: Recipe
    folder: Path

    def locate(self, name: str) -> Path:
        """The file that `name` stands for in this recipe."""
        return self.folder / name


def load(path: str | os.PathLike) -> Document:
    """Reads and checks a recipe file. Throws RecipeError with every problem found, OSError where it can't be read."""
    path = Path(path)
    return parse(path.read_bytes(), path.resolve().parent)


def parse(source: bytes | str | Mapping, folder: str | os.PathLike = ".") -> Document:
    """Checks a recipe given as JSON text or as a dictionary; its relative paths start at `folder`.

    Looks at the recipe alone, not yet into its files. Throws RecipeError with every problem found.
    """
    value = decode(source)
    try:
        recipe = msgspec.convert(value, Recipe, dec_hook=_form)
    except msgspec.ValidationError as error:
        from .explain import explain

        raise RecipeError(*(explain(value, Recipe) or [str(error)])) from None
    document = Document(recipe, Path(folder))
    problems = problems_of(recipe)
    if problems:
        raise RecipeError(*problems)
    return document


def _form(kind: type, value):
    """msgspec's hook for objects whose form is told by their fields."""
    form = kind.form_of(value) if issubclass(kind, Choice) and isinstance(value, dict) else None
    if form is None:
        raise ValueError(f"not a form of {kind.__name__}")
    return msgspec.convert(value, form, dec_hook=_form)


def decode(source):
    """JSON as bytes, text or already a dictionary. Throws RecipeError."""
    if isinstance(source, Mapping):
        return msgspec.to_builtins(dict(source))
    if not source.strip():
        raise RecipeError("recipe: the file is empty")
    try:
        return msgspec.json.decode(source)
    except RecursionError:
        raise RecipeError("recipe: not JSON (nested too deep)") from None
    except (msgspec.DecodeError, UnicodeDecodeError):
        return _decode_leniently(source)


def _decode_leniently(source):
    """Reads what msgspec would not: numbers that are no numbers get through, and are refused at their place."""
    import json

    try:
        return json.loads(source)
    except json.JSONDecodeError as error:
        raise RecipeError(f"recipe: not JSON (line {error.lineno}, column {error.colno}: {error.msg})") from None
    except UnicodeDecodeError:
        raise RecipeError("recipe: not JSON (not UTF-8)") from None
