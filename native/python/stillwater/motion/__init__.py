"""What one wind does to trees, water, boats and clouds, as displacement maps (Chuang et al. 2005; METHODS.md 1)."""

from .bob import bob
from .drift import drift
from .ripple import Ripple, ripple, wave_heights
from .sway import sway
from .wind import Wind

__all__ = ["Ripple", "Wind", "bob", "drift", "ripple", "sway", "wave_heights"]
