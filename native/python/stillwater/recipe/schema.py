"""The JSON Schema of the recipe, made from the classes that read it."""

import msgspec

from .keyframes import Guide
from .mattes import Fill, Matte
from .parts import Choice
from .picture import Recipe

_CHOICES = (Matte, Fill, Guide)


def schema() -> dict:
    """JSON Schema (2020-12), with descriptions, ranges and units."""
    forms = [form for kind in _CHOICES for form in kind.forms.values()]
    (whole, *_), parts = msgspec.json.schema_components([Recipe, *forms], schema_hook=_choice, ref_template="#/$defs/{name}")
    parts.update({kind.__name__: _any_form(kind) for kind in _CHOICES})
    keys = {f"#/$defs/{name}": parts.pop(name) for name in list(parts) if name.startswith("Keys_")}
    for part in keys.values():
        part["title"] = "Animated"
    return _with_keys(
        {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "Stillwater recipe", **whole, "$defs": parts}, keys
    )


def _choice(kind):
    if issubclass(kind, Choice):
        return {"$ref": f"#/$defs/{kind.__name__}"}
    raise NotImplementedError


def _any_form(kind: type[Choice]) -> dict:
    forms = dict.fromkeys(form.__name__ for form in kind.forms.values())
    return {"description": kind.__doc__, "anyOf": [{"$ref": f"#/$defs/{name}"} for name in forms]}


def _with_keys(node, keys):
    """Puts the small schemas of animated numbers in their place: their names would be long."""
    if isinstance(node, dict):
        if node.get("$ref") in keys:
            return _with_keys(keys[node["$ref"]], keys)
        return {name: _with_keys(part, keys) for name, part in node.items()}
    return [_with_keys(part, keys) for part in node] if isinstance(node, list) else node
