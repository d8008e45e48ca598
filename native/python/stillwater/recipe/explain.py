"""Says what is wrong with a recipe that msgspec refused: every place, what was given, what is allowed.

Reads the same classes as the decoder (through msgspec.inspect), so there is nothing to keep in step.
"""

import difflib
import json
import math
from collections.abc import Iterator

from msgspec import inspect

from .parts import Choice

_NAMES = {
    inspect.IntType: "a whole number",
    inspect.FloatType: "a number",
    inspect.StrType: "a text",
    inspect.BoolType: "true or false",
    inspect.NoneType: "null",
    inspect.ListType: "a list",
    inspect.StructType: "an object",
    inspect.CustomType: "an object",
}


def explain(value, kind: type) -> list[str]:
    """One sentence for each thing in `value` (decoded JSON) that does not fit the class `kind`, in the order of the file."""
    return list(_check(value, inspect.type_info(kind), "", ""))


def show(value) -> str:
    """`value` as JSON, shortened."""
    line = json.dumps(value, ensure_ascii=False, default=str)
    return line if len(line) <= 60 else line[:57] + "..."


def _check(value, kind, place: str, unit: str) -> Iterator[str]:
    match kind:
        case inspect.Metadata():
            yield from _check(value, kind.type, place, (kind.extra or {}).get("unit", unit))
        case inspect.UnionType():
            yield from _union(value, kind, place, unit)
        case inspect.CustomType():
            yield from _form(value, kind.cls, place)
        case inspect.StructType():
            yield from _struct(value, kind, place)
        case inspect.LiteralType():
            if not any(value == allowed and type(value) is type(allowed) for allowed in kind.values):
                yield _refuse(place, value, _one_of(kind.values), unit)
        case inspect.ListType():
            yield from _list(value, kind, place, unit)
        case inspect.TupleType():
            yield from _tuple(value, kind, place, unit)
        case inspect.IntType() | inspect.FloatType():
            yield from _number(value, kind, place, unit)
        case inspect.StrType():
            yield from _text(value, kind, place)
        case _:
            if not _fits_roughly(value, kind):
                yield _refuse(place, value, _name(kind), unit)


def _refuse(place, value, allowed, unit=""):
    return f"{place or 'recipe'}: {show(value)} is not {allowed}" + (f" ({unit})" if unit else "")


def _one_of(values) -> str:
    values = sorted(values, key=str) if all(isinstance(v, str) for v in values) else sorted(values)
    return " or ".join(filter(None, [", ".join(map(show, values[:-1])), show(values[-1])]))


def _plain(kind):
    while isinstance(kind, inspect.Metadata):
        kind = kind.type
    return kind


def _name(kind) -> str:
    kind = _plain(kind)
    if isinstance(kind, inspect.UnionType):
        names = [_name(part) for part in kind.types]
        return " or ".join(dict.fromkeys(names))
    if isinstance(kind, inspect.TupleType):
        return f"a list of {len(kind.item_types)}"
    if isinstance(kind, inspect.LiteralType):
        return _one_of(kind.values)
    if isinstance(kind, inspect.StructType) and kind.tag is None and {f.name for f in kind.fields} == {"first", "values"}:
        return '{"first": FRAME, "values": [one a frame]}'
    return _NAMES[type(kind)]


def _fits_roughly(value, kind) -> bool:
    """Whether `value` is of the JSON kind that `kind` is read from."""
    match _plain(kind):
        case inspect.NoneType():
            return value is None
        case inspect.BoolType():
            return isinstance(value, bool)
        case inspect.IntType() | inspect.FloatType():
            return isinstance(value, int | float) and not isinstance(value, bool)
        case inspect.StrType():
            return isinstance(value, str)
        case inspect.LiteralType() as literal:
            return isinstance(value, type(literal.values[0]))
        case inspect.ListType() | inspect.TupleType():
            return isinstance(value, list | tuple)
        case inspect.StructType() | inspect.CustomType():
            return isinstance(value, dict)
    raise AssertionError(f"the recipe uses a type without sentences: {kind}")


def _union(value, kind, place, unit):
    fitting = [part for part in kind.types if _fits_roughly(value, part)]
    tagged = [part for part in kind.types if isinstance(_plain(part), inspect.StructType) and part.tag is not None]
    if not fitting:
        yield _refuse(place, value, _name(kind), _unit_of(kind) or unit)
    elif tagged and isinstance(value, dict):
        field = tagged[0].tag_field
        tags = {part.tag: part for part in tagged}
        if field not in value:
            yield f"{place}.{field}: missing (one of {', '.join(map(show, tags))})"
        elif not isinstance(value[field], str) or value[field] not in tags:
            yield _refuse(f"{place}.{field}", value[field], _one_of(list(tags)))
        else:
            yield from _check(value, tags[value[field]], place, unit)
    else:
        yield from _check(value, fitting[0], place, unit)


def _unit_of(kind) -> str:
    if isinstance(kind, inspect.UnionType):
        return next(filter(None, map(_unit_of, kind.types)), "")
    return (kind.extra or {}).get("unit", "") if isinstance(kind, inspect.Metadata) else ""


def _form(value, cls: type[Choice], place):
    if not isinstance(value, dict):
        yield _refuse(place, value, "an object")
        return
    form = cls.form_of(value)
    if form is not None:
        yield from _check(value, inspect.type_info(form), place, "")
        return
    marks = [mark.split("=") for mark in cls.forms]
    for field in dict.fromkeys(mark[0] for mark in marks if len(mark) > 1 and mark[0] in value):
        yield _refuse(f"{place}.{field}", value[field], _one_of([mark[1] for mark in marks if mark[0] == field and len(mark) > 1]))
        return
    fields = dict.fromkeys(mark[0] for mark in marks)
    yield f"{place}: has none of the fields {', '.join(fields)}, one of which says its form"


def _struct(value, kind, place):
    if not isinstance(value, dict):
        yield _refuse(place, value, "an object")
        return
    fields = {field.encode_name: field for field in kind.fields}
    allowed = ([kind.tag_field] if kind.tag_field else []) + list(fields)
    inside = f"{place}." if place else ""
    for name, part in value.items():
        if name in fields:
            yield from _check(part, fields[name].type, inside + name, "")
        elif name not in allowed:
            near = difflib.get_close_matches(str(name), allowed, n=3, cutoff=0.6)
            meant = f"did you mean {' or '.join(near)}? " if near else ""
            yield f"{inside}{name}: no such field ({meant}allowed: {', '.join(allowed) or 'none'})"
    for name, field in fields.items():
        if field.required and name not in value:
            yield f"{inside}{name}: missing"


def _list(value, kind, place, unit):
    if not isinstance(value, list | tuple):
        yield _refuse(place, value, "a list", unit)
        return
    yield from _length(len(value), kind, place, "entry", "entries")
    for i, item in enumerate(value):
        yield from _check(item, kind.item_type, f"{place}[{i}]", unit)


def _length(count, kind, place, one, many):
    low, high = kind.min_length or 0, kind.max_length
    if count < low or (high is not None and count > high):
        allowed = f"{low} or more" if high is None or count < low else f"{high} or fewer"
        yield f"{place}: {count} {f'{one} is' if count == 1 else f'{many} are'} not {allowed}"


def _tuple(value, kind, place, unit):
    size = len(kind.item_types)
    if not isinstance(value, list | tuple) or len(value) != size:
        yield _refuse(place, value, f"a list of {size}", unit)
        return
    for i, (item, item_kind) in enumerate(zip(value, kind.item_types, strict=True)):
        yield from _check(item, item_kind, f"{place}[{i}]", unit)


def _number(value, kind, place, unit):
    if not _fits_roughly(value, kind):
        yield _refuse(place, value, _name(kind), unit)
    elif not math.isfinite(value):
        yield _refuse(place, value, "a finite number", unit)
    elif isinstance(kind, inspect.IntType) and not isinstance(value, int):
        yield _refuse(place, value, "a whole number", unit)
    elif not _in_range(value, kind):
        yield _refuse(place, value, _range(kind, value), unit)


def _in_range(value, kind) -> bool:
    return (
        (kind.gt is None or value > kind.gt)
        and (kind.ge is None or value >= kind.ge)
        and (kind.lt is None or value < kind.lt)
        and (kind.le is None or value <= kind.le)
    )


def _range(kind, value) -> str:
    if kind.ge is not None and kind.le is not None:
        return f"between {_bound(kind.ge)} and {_bound(kind.le)}"
    if kind.gt is not None and value <= kind.gt:
        return f"above {_bound(kind.gt)}"
    return f"at most {_bound(kind.le)}" if kind.le is not None and value > kind.le else f"{_bound(kind.ge)} or above"


def _bound(value) -> str:
    return str(int(value)) if value == int(value) else str(value)


def _text(value, kind, place):
    if not isinstance(value, str):
        yield _refuse(place, value, "a text")
        return
    yield from _length(len(value), kind, place, "character", "characters")
