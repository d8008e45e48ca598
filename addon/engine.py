"""The one door to the engine: whether it can be imported, why not, and how its worker is started.

Nothing else in the extension says `import stillwater`. The extension registers without the engine too; its panel then
shows `problem()`.
"""

import sys
from pathlib import Path

_engine = None
_problem = "the engine was not looked for yet"

# -I: nothing of the user's own Python gets in. The engine's folder comes first, Blender's own modules after it.
_START = """
import sys, runpy
sys.path.insert(0, {site!r})
runpy.run_module("stillwater", run_name="__main__", alter_sys=True)
"""


def load() -> None:
    """Imports the engine, or keeps the reason why that can't be."""
    global _engine, _problem
    try:
        import stillwater
        stillwater.__version__  # noqa: B018  loads the compiled part
    except ImportError as error:
        _engine, _problem = None, f"The engine can't be loaded: {error}"
    else:
        _engine, _problem = stillwater, ""


def problem() -> str:
    """Why the engine can't be used, as a sentence; empty where it can."""
    return _problem


def version() -> str:
    """The engine's version; empty without an engine."""
    return _engine.__version__ if _engine else ""


def read_recipe(path: str) -> dict:
    """A checked recipe with every default filled in. Throws ValueError with the engine's sentences, OSError."""
    if _engine is None:
        raise ValueError(_problem)
    import msgspec

    return msgspec.to_builtins(_engine.load(path).recipe)


def worker_command() -> list[str]:
    """What starts `python -m stillwater` with the Python that Blender runs. Throws ValueError without an engine."""
    if _engine is None:
        raise ValueError(_problem)
    site = str(Path(_engine.__file__).resolve().parents[1])
    return [sys.executable, "-I", "-c", _START.format(site=site)]


def serve_command() -> list[str]:
    """What starts `python -m stillwater serve`. Throws ValueError without an engine."""
    return [*worker_command(), "serve"]


def live():
    """A new stillwater.Live. Throws ValueError without an engine."""
    if _engine is None:
        raise ValueError(_problem)
    return _engine.Live()
