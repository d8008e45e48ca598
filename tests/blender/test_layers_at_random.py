"""Fifty seeded sequences of what can be done to layers: what is said stays right and can be undone."""

import random

import bpy
import pytest
from invariants import of_layers
from layered import fill, key, now, said

LAYERS = "stillwater.pictures[0].layers"
STEPS = 9  # of 32 that Blender can undo


def steps(dice: random.Random) -> list[tuple]:
    """Operators with their options, none of which depends on what is there."""
    some = [
        ("add_layer", {"motion": dice.choice(["still", "sway", "ripple", "bob", "drift"])}),
        ("remove_layer", {}),
        ("duplicate_layer", {}),
        ("move_layer", {"direction": dice.choice(["UP", "DOWN", "TOP", "BOTTOM"])}),
        ("select_layers", {"action": dice.choice(["SELECT", "DESELECT", "INVERT", "MOTION"])}),
        ("show_layers", {"visible": dice.choice([True, False])}),
        ("set_motion", {"type": dice.choice(["sway", "bob"])}),
        ("copy_to_selected", {"path": dice.choice(["opacity", "motion", "motion.bob.amount"])}),
        ("copy_layers", {}),
        ("paste_layers", {}),
    ]
    return dice.sample(some, k=STEPS)


@pytest.mark.parametrize("seed", range(50))
def test_any_sequence_can_be_undone_and_done_again(extension, scene, picture, seed):
    dice = random.Random(seed)
    fill(extension, picture, "a", "b", "c", "d")
    picture.layers[3].motion.type, picture.layers[1].motion.type = "ripple", "bob"
    picture.layers[1].motion.bob.water, picture.layers[2].follows.layer = "d", "b"
    key(extension, f"{LAYERS}[0].opacity", (1, 0.1), (4, 0.4))
    variable = scene.driver_add(f"{LAYERS}[1].motion.bob.amount").driver.variables.new()
    variable.targets[0].id_type, variable.targets[0].id = "SCENE", scene
    variable.targets[0].data_path = f"{LAYERS}[0].opacity"
    bpy.ops.stillwater.copy_layers()
    picture.active_layer = dice.randrange(4)
    bpy.ops.ed.undo_push(message="start")
    seen = [said(extension)]
    for operator, options in steps(dice):
        call = getattr(bpy.ops.stillwater, operator)
        if not call.poll() or call("EXEC_DEFAULT", True, **options) != {"FINISHED"} or operator == "copy_layers":
            continue  # these push no step
        of_layers(extension, now())
        seen.append(said(extension))
    for before in reversed(seen[:-1]):
        bpy.ops.ed.undo()
        assert said(extension) == before
    for after in seen[1:]:
        bpy.ops.ed.redo()
        assert said(extension) == after
    of_layers(extension, now())
