import sys
from pathlib import Path

import pytest
from stillwater import _stillwater as engine

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(autouse=True)
def _default_threads():
    yield
    engine.set_threads(0)
