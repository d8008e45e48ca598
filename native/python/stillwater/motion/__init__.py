"""Motions of METHODS.md 1 (Chuang et al. 2005) as displacement maps: what one wind does to trees, water, boats and clouds."""

from .bob import bob
from .drift import drift
from .ripple import Ripple, ripple, wave_heights
from .sway import sway
from .wind import Wind

__all__ = ["Ripple", "Wind", "bob", "drift", "ripple", "sway", "wave_heights"]
