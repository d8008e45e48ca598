"""The schema speaks of the same fields as the classes, each with what it means."""

import msgspec
import pytest
from stillwater.recipe import Recipe
from stillwater.recipe.schema import schema

SCHEMA = schema()


def test_nothing_points_nowhere():
    def references(node):
        if isinstance(node, dict):
            yield from ([node["$ref"]] if "$ref" in node else [])
            for part in node.values():
                yield from references(part)
        elif isinstance(node, list):
            for part in node:
                yield from references(part)

    names = {reference.removeprefix("#/$defs/") for reference in references(SCHEMA)}
    assert names <= set(SCHEMA["$defs"])
    assert not any("Annotated" in name for name in SCHEMA["$defs"])


@pytest.mark.parametrize("name", ["Sway", "Ripple", "Bob", "Drift", "Wind", "View", "Output", "Example", "Keyframes"])
def test_every_number_has_a_description(name):
    for field, part in SCHEMA["$defs"][name]["properties"].items():
        kinds = [part, *part.get("anyOf", [])]
        if any(kind.get("type") in ("number", "integer") for kind in kinds):
            assert any("description" in kind for kind in kinds), field


def test_units_and_ranges_are_said():
    speed, animated = SCHEMA["$defs"]["Wind"]["properties"]["speed"]["anyOf"]
    assert (speed["minimum"], speed["maximum"], speed["unit"]) == (0, 40, "m/s")
    assert animated["properties"]["values"]["items"] == speed


def test_fields_are_those_of_the_classes():
    assert set(SCHEMA["$defs"]["Recipe"]["properties"]) == {f.name for f in msgspec.structs.fields(Recipe)}
    assert SCHEMA["$defs"]["Sway"]["properties"]["type"] == {"enum": ["sway"]}


def test_the_forms_of_a_matte():
    names = [form["$ref"].split("/")[-1] for form in SCHEMA["$defs"]["Matte"]["anyOf"]]
    assert names == ["FileMatte", "LabelMatte", "TrimapMatte", "ScribbleMatte", "LassoMatte"]
