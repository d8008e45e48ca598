"""From the scene's properties to a recipe and back. Reads what it is given and never imports bpy: tested without it.

Start with write.py. The engine alone checks recipes; nothing is checked twice here.
"""
