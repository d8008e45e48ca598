"""What all classes of the recipe are made of: parts, numbers with range and unit, animated numbers."""

from typing import Annotated, ClassVar, Generic, TypeVar

from msgspec import Meta, Struct

Value = TypeVar("Value")


class Part(Struct, forbid_unknown_fields=True, frozen=True):
    """Base of every object of the recipe: nothing but its own fields is allowed."""


class Choice:
    """Base of objects that come in several forms, told apart by their fields.

    `forms` maps "FIELD", or "FIELD=VALUE", to the form that has it; the first that fits counts.
    """

    forms: ClassVar[dict[str, type]]

    @classmethod
    def form_of(cls, value: dict) -> type | None:
        for mark, form in cls.forms.items():
            field, _, wanted = mark.partition("=")
            if field in value and (not wanted or value[field] == wanted):
                return form
        return None


class Keys(Part, Generic[Value], kw_only=True):
    """A value for each frame, from frame `first` on; the end values are held outside."""

    first: Annotated[int, Meta(ge=-1_000_000, le=1_000_000, description="frame of the first value")] = 1
    values: Annotated[list[Value], Meta(min_length=1, max_length=1_000_000, description="one value a frame")]


def _meta(description, unit, limits):
    return Meta(
        description=f"{description} [{unit}]" if unit else description,
        extra_json_schema={"unit": unit} if unit else None,
        extra={"unit": unit} if unit else None,
        **limits,
    )


def number(description, unit="", **limits):
    """A float with its range (gt, ge, lt, le) and unit."""
    return Annotated[float, _meta(description, unit, limits)]


def whole(description, unit="", **limits):
    """An int with its range and unit."""
    return Annotated[int, _meta(description, unit, limits)]


def text(description, **limits):
    return Annotated[str, Meta(description=description, min_length=1, **limits)]


def choice(kind, description):
    """A Literal or another type, with its description."""
    return Annotated[kind, Meta(description=description)]


def animated(value):
    """An animated number (`~` in the recipe): `value`, or one `value` a frame."""
    return value | Keys[value]


Seed = whole("seed of the noise", ge=0, le=2**53)
File = text("file, relative to the recipe's folder", max_length=4096)
Coordinate = number("place in the picture", "px", ge=-1e6, le=1e6)
Place = tuple[Coordinate, Coordinate]
Line = Annotated[tuple[Place, Place], Meta(description="two points of the picture")]
