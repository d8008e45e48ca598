"""Stillwater brings still pictures to life. The engine, without Blender."""

from ._stillwater import __version__

__all__ = ["__version__"]
