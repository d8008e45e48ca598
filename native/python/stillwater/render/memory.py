"""How much memory a render will need."""
