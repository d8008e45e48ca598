"""How rendering can end before its frames are done, apart from a wrong recipe (recipe.RecipeError)."""


class Refused(ValueError):
    """What was asked for can't be done as things stand; nothing was written."""


class Failed(OSError):
    """Something went wrong at work; what is finished is kept."""
