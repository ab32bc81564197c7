"""Checks whether a value matches a JSON Schema, for the keywords that results/schema uses.

Checks are created from the schema once, and a place in the value is put into words only if it is wrong: a result file of 5.7 MB
takes 0.3 s, where Debian's fastjsonschema takes 2.5 s. Keys that the schema does not know may hold anything, since a newer minor
format may have them."""
import math
import re
from collections.abc import Callable, Iterable
from typing import Any

MOST_LEVELS = 20  # nested lists and objects in a value that may be anything
LARGEST = 1e100  # so that sums and products of numbers are still numbers
KINDS = {"object": dict, "array": list, "string": str, "boolean": bool}

Json = dict[str, Any]
Check = Callable[[Any], None]  # raises Wrong


class Wrong(Exception):
    def __init__(self, what: str):
        super().__init__(what)
        self.what, self.place = what, ""

    def __str__(self) -> str:
        return f"{self.place.lstrip('.')} {self.what}".lstrip()

    def inside(self, key: str | int) -> "Wrong":
        """Prefixes the place of the error with the key of the object or list around it."""
        self.place = (f"[{key}]" if isinstance(key, int) else f".{key}") + self.place
        return self


def check_of(schema: Json, root: Json) -> Check:
    """Returns a check that raises Wrong for a value that does not match. Raises KeyError for a keyword missing in MAKERS."""
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


def where(holds: Callable[[Any], bool], what: str) -> Check:
    def check(value: Any) -> None:
        if not holds(value):
            raise Wrong(what)

    return check


def of_type(name: str, schema: Json) -> Check:
    if name in KINDS:
        right = where(lambda value: type(value) is KINDS[name], f"is no {name}")
    elif name == "integer":
        right = all_of([where(lambda value: type(value) is int, "is no integer"),
                        where(lambda value: -(2**63) <= value < 2**64, "is too large a number")])
    else:
        right = all_of([where(lambda value: type(value) is int or isinstance(value, float), "is no number"),
                        where(lambda value: -LARGEST <= value <= LARGEST, "is too large a number")])
    return all_of([right] + [check_any] * (schema.keys() <= {"type", *SILENT}))


def of_parts(kind: type, parts: Callable[[Any], Iterable[tuple[str | int, Any]]],
             check_for: Callable[[str | int], Check]) -> Check:
    """Checks each part of an object or list with the check for its key or index."""
    def check(value: Any) -> None:
        for key, item in parts(value) if type(value) is kind else ():
            try:
                check_for(key)(item)
            except Wrong as wrong:
                raise wrong.inside(key)

    return check


def of_properties(known: Json, others: Json | bool, root: Json) -> Check:
    checks = {key: check_of(schema, root) for key, schema in known.items()}
    other = check_of(others, root) if isinstance(others, dict) else check_any
    return of_parts(dict, dict.items, lambda key: checks.get(key, other))


def of_items(schema: Json, root: Json) -> Check:
    one = check_of(schema, root)
    return of_parts(list, enumerate, lambda _: one)


def of_names(schema: Json, root: Json) -> Check:
    one = check_of(schema, root)

    def check(value: Any) -> None:
        for key in value if type(value) is dict else ():
            for wrong in wrongs([one], key):
                raise Wrong(f"has the key '{key}', which {wrong.what}")

    return check


def among(values: list[Any]) -> Check:
    return where(lambda value: value in values, f"is none of {', '.join(map(str, values))}")


def wrongs(checks: list[Check], value: Any) -> list[Wrong]:
    """Returns the errors of the checks that fail."""
    found = []
    for check in checks:
        try:
            check(value)
        except Wrong as wrong:
            found.append(wrong)
    return found


def fitting(schemas: list[Json], root: Json, most: int) -> Check:
    """Checks that a value fits at least one of the schemas and at most `most` of them."""
    checks = [check_of(schema, root) for schema in schemas]

    def check(value: Any) -> None:
        found = wrongs(checks, value)
        if len(found) == len(checks):
            raise Wrong(", or ".join(map(str, found)))
        if len(checks) - len(found) > most:
            raise Wrong("is two things at once")

    return check


def conditional(condition: Json, then: Json, root: Json) -> Check:
    asked, check_then = check_of(condition, root), check_of(then, root)
    return lambda value: None if wrongs([asked], value) else check_then(value)


def length(least: int, most: float) -> Check:
    return where(lambda value: type(value) not in (list, dict) or least <= len(value) <= most, f"has not {least} or more entries"
                 if most == math.inf else f"has more than {most:g} entries")


SILENT = {"$schema", "$id", "$defs", "title", "description", "format", "then"}
# Makes the check of each keyword from the keyword's value, the schema around it and the whole schema.
MAKERS: dict[str, Callable[[Any, Json, Json], Check]] = {
    "$ref": lambda asked, _, root: check_of(root["$defs"][asked.removeprefix("#/$defs/")], root),
    "type": lambda asked, schema, root: of_type(asked, schema),
    "properties": lambda asked, schema, root: of_properties(asked, schema.get("additionalProperties", True), root),
    "additionalProperties": lambda asked, schema, root: of_properties({}, asked, root),
    "propertyNames": lambda asked, _, root: of_names(asked, root),
    "required": lambda asked, _, root: all_of([
        where(lambda value, key=key: type(value) is not dict or key in value, f"has no '{key}'") for key in asked]),
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
