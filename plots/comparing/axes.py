"""What two files without a common cell differ in, and how one builder is compared with another."""
import argparse
import copy
import pathlib
from typing import Any

from ..files.json_files import Json
from ..files.output import WrongUsage
from ..read.cells import Cell, parts

MOST_TOLD, MOST_VALUES = 3, 3
FIRST = ("builder", "collider", "scene", "frame", "operation", "experiment")  # the order in which differences are told
NAMES = {"objects_by": "objects", "between": "frames between", "swept": "swept pairs"}


def words_of(key: str, value: Any) -> str:
    """Returns the value of a part of a cell's identity as it is typed: "karras, order hilbert30"."""
    if key in ("builder", "collider") and value:
        return ", ".join([value[0], *(f"{name} {setting}" for name, setting in value[1])])
    if isinstance(value, dict):
        return " ".join(str(each) for each in value.values())
    return str(value)


def values_of(cells: list[Cell]) -> dict[str, list[str]]:
    """Returns the different values of each part of the cells' identities."""
    own = [parts(cell.raw) for cell in cells]
    keys = dict.fromkeys(key for part in own for key in part)
    return {key: list(dict.fromkeys(words_of(key, part.get(key)) for part in own)) for key in keys}


def difference(first: list[Cell], second: list[Cell]) -> str:
    """Returns in what no cell of one file equals a cell of the other: "builder: karras against oibvh-single". May be empty."""
    one, other = values_of(first), values_of(second)
    keys = [key for key in dict.fromkeys((*FIRST, *one)) if key in one and key in other and not set(one[key]) & set(other[key])]
    return "; ".join(f"{NAMES.get(key, key)}: {listed(one[key])} against {listed(other[key])}" for key in keys[:MOST_TOLD])


def listed(values: list[str]) -> str:
    named = [value or "none" for value in values[:MOST_VALUES]]
    return " or ".join(named) + (f" and {len(values) - MOST_VALUES} more" if len(values) > MOST_VALUES else "")


def require_shared(names: tuple[pathlib.Path, pathlib.Path], first: list[Cell], second: list[Cell]) -> None:
    """Raises WrongUsage if no cell of one file is in the other. The sentence says in what the cells differ, and what to do."""
    if {cell.identity for cell in first} & {cell.identity for cell in second}:
        return
    differ = difference(first, second)
    text = f"{names[0]} and {names[1]} have no cell in common" + (f": they differ in {differ}" if differ else "")
    builders = [dict.fromkeys(cell.builder for cell in cells) for cells in (first, second)]
    if differ.startswith("builder: ") and ";" not in differ and builders[0].keys().isdisjoint(builders[1]):
        pair = f"{next(iter(builders[0]))},{next(iter(builders[1]))}"
        raise WrongUsage(f"{text}; to compare builders: bvhbench compare {names[0]} {names[1]} --builders {pair}")
    raise WrongUsage(f"{text}; `bvhbench report {names[0]} {names[1]}` shows both on one page, and `bvhbench sweep` measures "
                     "several builders and scenes into one file")


def pair_of(text: str) -> tuple[str, str]:
    """Parses "A,B", for an argument parser."""
    names = tuple(text.split(","))
    if len(names) != 2 or not all(names) or names[0] == names[1]:
        raise argparse.ArgumentTypeError(f"must be two builders, as karras,oibvh-single, not '{text}'")
    return names


def between_builders(paths: tuple[pathlib.Path, pathlib.Path], first: Json, second: Json,
                     builders: tuple[str, str]) -> tuple[Json, Json]:
    """Returns the cells of the first builder in the first document, and those of the second in the second, under one name, so
    that they are the same cells to a comparison. Raises WrongUsage if there are none, or if they share no scene and options."""
    made = []
    for path, document, builder in zip(paths, (first, second), builders, strict=True):
        cells = [copy.copy(raw) for raw in document["cells"] if raw["builder"]["name"] == builder]
        if not cells:
            there = dict.fromkeys(raw["builder"]["name"] for raw in document["cells"])
            raise WrongUsage(f"--builders: {path} has no cell of {builder}; it has {', '.join(there)}")
        for raw in cells:
            raw["builder"] = {**raw["builder"], "name": f"{builders[1]} against {builders[0]}"}
        made.append({**document, "cells": cells})
    one, other = ([Cell(raw) for raw in document["cells"]] for document in made)
    if not {cell.identity for cell in one} & {cell.identity for cell in other}:
        raise WrongUsage(f"--builders: no cell of {builders[1]} has the scene and options of one of {builders[0]}: "
                         f"they differ in {difference(one, other)}")
    return made[0], made[1]
