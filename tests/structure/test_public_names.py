"""What is public is documented and typed: every name has a docstring, and stands in the package's .pyi."""

import inspect
import re
from pathlib import Path

import pytest
import stillwater

STUB = Path(__file__).resolve().parents[2] / "native" / "python" / "stillwater" / "__init__.pyi"
FUNCTIONS = [name for name in stillwater.__all__ if inspect.isfunction(getattr(stillwater, name))]


def test_the_stub_names_what_is_public():
    named = set(re.findall(r"import \w+ as (\w+)|^class (\w+)|^(\w+):", STUB.read_text(), re.MULTILINE))
    assert {part for parts in named for part in parts if part} == set(stillwater.__all__)


@pytest.mark.parametrize("name", [name for name in stillwater.__all__ if name != "__version__"])
def test_everything_public_is_documented(name):
    assert inspect.getdoc(getattr(stillwater, name))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_functions_are_typed(name):
    signature = inspect.signature(getattr(stillwater, name))
    untyped = [p.name for p in signature.parameters.values() if p.annotation is inspect.Parameter.empty]
    assert not untyped and signature.return_annotation is not inspect.Signature.empty
