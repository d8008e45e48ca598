"""Lets the tests of this room import the script that they test."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
