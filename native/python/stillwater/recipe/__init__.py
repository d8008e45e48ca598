"""The recipe: what it may say (parts, strokes, mattes, motions, picture), and how it is read and checked.

Start with picture.py (the top level), then read.py. Nothing here opens a picture or renders.
"""

from .errors import RecipeError
from .picture import Layer, Output, Recipe, View, Wind
from .read import Document, load, parse

__all__ = ["Document", "Layer", "Output", "Recipe", "RecipeError", "View", "Wind", "load", "parse"]
