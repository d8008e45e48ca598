"""The one door to the engine: whether it can be imported, why not, and how its worker is started.

Nothing else in the extension says `import stillwater`. The extension registers without the engine too; its panel then
shows `problem()`.
"""

import subprocess
import sys
from pathlib import Path

TRIAL = 20  # s: how long a Python may take to load the engine

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


def worker_command(python: str = "") -> list[str]:
    """What starts `python -m stillwater` with the Python given, or the one that Blender runs.

    Throws ValueError without an engine.
    """
    if _engine is None:
        raise ValueError(_problem)
    return [python or sys.executable, "-I", "-c", _START.format(site=_site())]


def python_problem(python: str) -> str:
    """Why this Python can't run the worker, as a sentence, found by trying; empty where it can."""
    if _engine is None:
        return _problem
    program = f"import sys; sys.path.insert(0, {_site()!r}); import stillwater; print(stillwater.__version__)"
    try:
        done = subprocess.run(
            [python or sys.executable, "-I", "-c", program],
            stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", timeout=TRIAL,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return f"{python}: gave no answer within {TRIAL} s; is it a Python?"
    except OSError as error:
        return f"{python}: can't be started ({error.strerror})"
    if done.returncode == 0 and done.stdout.strip() == version():
        return ""
    words = (done.stderr.strip() or done.stdout.strip()).splitlines()
    mine = f"Python {sys.version_info.major}.{sys.version_info.minor}"
    return f"{python}: can't load the engine, which is built for {mine}" + (f" ({words[-1]})" if words else "")


def _site() -> str:
    """The folder that holds the engine's package."""
    return str(Path(_engine.__file__).resolve().parents[1])
