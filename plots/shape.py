"""Whether a value has the shape that a JSON Schema asks for: those keywords that results/schema uses.

Checks are made of the schema once, and a place in the value is put into words only where it is wrong: a result file of 5.7 MB
takes 0.3 s, where Debian's fastjsonschema takes 2.5 s. Keys that the schema does not know may hold anything, since a newer
minor format may have them.
"""
import math
import re
from collections.abc import Callable
from typing import Any

MOST_LEVELS = 20  # of lists and objects in what may be anything
LARGEST = 1e100  # so that sums and products of numbers are still numbers
KINDS = {"object": dict, "array": list, "string": str, "boolean": bool}

Check = Callable[[Any], None]


class Wrong(Exception):
    """What is wrong in a value, and where."""

    def __init__(self, what: str):
        super().__init__(what)
        self.what, self.place = what, ""

    def __str__(self) -> str:
        return f"{self.place.lstrip('.')} {self.what}".lstrip()

    def inside(self, key: str | int) -> "Wrong":
        """The same, seen from the object or list around it."""
        self.place = (f"[{key}]" if isinstance(key, int) else f".{key}") + self.place
        return self


def check_of(schema: dict[str, Any], root: dict[str, Any]) -> Check:
    """Raises Wrong for a value of another shape. Of a schema with a keyword that is not in MAKERS, raises KeyError."""
    silent = SILENT | ({"additionalProperties"} if "properties" in schema else set())
    return all_of([MAKERS[keyword](asked, schema, root) for keyword, asked in schema.items() if keyword not in silent])


def all_of(checks: list[Check]) -> Check:
    if len(checks) < 2:
        return checks[0] if checks else check_any

    def check(value: Any) -> None:
        for each in checks:
            each(value)

    return check


def check_any(value: Any, levels: int = MOST_LEVELS) -> None:
    if isinstance(value, (dict, list)):
        if levels == 0:
            raise Wrong(f"is nested more than {MOST_LEVELS} deep")
        for item in value.values() if isinstance(value, dict) else value:
            check_any(item, levels - 1)


def same_as(reference: str, root: dict[str, Any]) -> Check:
    return check_of(root["$defs"][reference.removeprefix("#/$defs/")], root)


def of_type(name: str) -> Check:
    if name in NUMBERS:
        return NUMBERS[name]
    kind = KINDS[name]
    return where(lambda value: type(value) is kind, f"is no {name}")


def check_number(value: Any) -> None:
    if type(value) is not int and not isinstance(value, float):
        raise Wrong("is no number")
    if not -LARGEST <= value <= LARGEST:
        raise Wrong("is too large a number")


def check_integer(value: Any) -> None:
    if type(value) is not int:
        raise Wrong("is no integer")
    if not -(2**63) <= value < 2**64:
        raise Wrong("is too large a number")


NUMBERS = {"number": check_number, "integer": check_integer}


def of_properties(known: dict[str, Any], others: dict[str, Any] | bool, root: dict[str, Any]) -> Check:
    checks = {key: check_of(schema, root) for key, schema in known.items()}
    other = check_of(others, root) if isinstance(others, dict) else check_any

    def check(value: Any) -> None:
        if type(value) is dict:
            for key, item in value.items():
                try:
                    checks.get(key, other)(item)
                except Wrong as wrong:
                    raise wrong.inside(key)

    return check


def of_items(schema: dict[str, Any], root: dict[str, Any]) -> Check:
    one = check_of(schema, root)

    def check(value: Any) -> None:
        if type(value) is list:
            for place, item in enumerate(value):
                try:
                    one(item)
                except Wrong as wrong:
                    raise wrong.inside(place)

    return check


def requiring(keys: list[str]) -> Check:
    def check(value: Any) -> None:
        for key in keys:
            if type(value) is dict and key not in value:
                raise Wrong(f"has no '{key}'")

    return check


def of_names(schema: dict[str, Any], root: dict[str, Any]) -> Check:
    one = check_of(schema, root)

    def check(value: Any) -> None:
        for key in value if type(value) is dict else ():
            try:
                one(key)
            except Wrong as wrong:
                raise Wrong(f"has the key '{key}', which {wrong.what}")

    return check


def where(holds: Callable[[Any], bool], what: str) -> Check:
    def check(value: Any) -> None:
        if not holds(value):
            raise Wrong(what)

    return check


def among(values: list[Any]) -> Check:
    return where(lambda value: value in values, f"is none of {', '.join(map(str, values))}")


def wrongs(checks: list[Check], value: Any) -> list[Wrong]:
    """Of those checks that do not hold."""
    found = []
    for check in checks:
        try:
            check(value)
        except Wrong as wrong:
            found.append(wrong)
    return found


def fitting(schemas: list[dict[str, Any]], root: dict[str, Any], most: int) -> Check:
    """A value that fits at least one of the schemas and at most `most` of them."""
    checks = [check_of(schema, root) for schema in schemas]

    def check(value: Any) -> None:
        found = wrongs(checks, value)
        if len(found) == len(checks):
            raise Wrong(", or ".join(map(str, found)))
        if len(checks) - len(found) > most:
            raise Wrong("is two things at once")

    return check


def conditional(condition: dict[str, Any], then: dict[str, Any], root: dict[str, Any]) -> Check:
    asked, check_then = check_of(condition, root), check_of(then, root)

    def check(value: Any) -> None:
        if not wrongs([asked], value):
            check_then(value)

    return check


def length(least: int, most: float) -> Check:
    return where(lambda value: type(value) not in (list, dict) or least <= len(value) <= most, f"has not {least} or more entries"
                 if most == math.inf else f"has more than {most:g} entries")


SILENT = {"$schema", "$id", "$defs", "title", "description", "format", "then"}
# By keyword: what the schema asks, the schema around it, the whole schema.
MAKERS: dict[str, Callable[[Any, dict[str, Any], dict[str, Any]], Check]] = {
    "$ref": lambda asked, _, root: same_as(asked, root),
    "type": lambda asked, schema, root: all_of([of_type(asked)] + [check_any] * (schema.keys() <= {"type", *SILENT})),
    "properties": lambda asked, schema, root: of_properties(asked, schema.get("additionalProperties", True), root),
    "additionalProperties": lambda asked, schema, root: of_properties({}, asked, root),
    "propertyNames": lambda asked, _, root: of_names(asked, root),
    "required": lambda asked, _, root: requiring(asked),
    "items": lambda asked, _, root: of_items(asked, root),
    "minItems": lambda asked, _, root: length(asked, math.inf),
    "minProperties": lambda asked, _, root: length(asked, math.inf),
    "maxItems": lambda asked, _, root: length(0, asked),
    "enum": lambda asked, _, root: among(asked),
    "const": lambda asked, _, root: among([asked]),
    "minimum": lambda asked, _, root: where(lambda value: value >= asked, f"is less than {asked}"),
    "exclusiveMinimum": lambda asked, _, root: where(lambda value: value > asked, f"is not more than {asked}"),
    "pattern": lambda asked, _, root: where(lambda value: re.search(asked, value), f"does not match {asked}"),
    "allOf": lambda asked, _, root: all_of([check_of(schema, root) for schema in asked]),
    "anyOf": lambda asked, _, root: fitting(asked, root, len(asked)),
    "oneOf": lambda asked, _, root: fitting(asked, root, 1),
    "if": lambda asked, schema, root: conditional(asked, schema["then"], root),
}
