"""What one wind does to trees, water, boats and clouds, as displacement maps (Chuang et al. 2005; METHODS.md 1)."""

from .drift import drift
from .sway import sway
from .wind import Wind

__all__ = ["Wind", "drift", "sway"]
