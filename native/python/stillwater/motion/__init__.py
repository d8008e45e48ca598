"""Motions of METHODS.md 1 (Chuang et al. 2005) as displacement maps: what one wind does to trees, water, boats and clouds."""

from .drift import drift
from .sway import sway
from .wind import Wind

__all__ = ["Wind", "drift", "sway"]
