"""What is wrong with a recipe."""


class RecipeError(ValueError):
    """One or more things in a recipe are wrong; `problems` holds a sentence for each, "PLACE: GIVEN is not ALLOWED"."""

    def __init__(self, *problems: str):
        super().__init__("\n".join(problems))
        self.problems = problems
