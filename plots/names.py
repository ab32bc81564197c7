"""What pipelines are called: a collider and the builder of its tree, with options that are not the usual ones."""
from __future__ import annotations

from collections.abc import Mapping

# An option's usual value and how another one is said, in the order in which they are.
OPTIONS = {"no_skip": ("", "without {}"), "jump": ("0", "jump {}"), "start_level": ("0", "from level {}"),
           "order": ("morton30", "{}"), "grid": ("object", "grid over the {}"), "group_size": ("0", "groups of {}"), "items": ("0", "{} items"),
           "leaves": ("mesh", "{} leaves"), "boxes": ("f32", "{} boxes")}


def variant(name: str, options: Mapping[str, object]) -> str:
    said = [words.format(options[key]) for key, (usual, words) in OPTIONS.items()
            if str(options.get(key, usual)) != usual]
    return f"{name} ({', '.join(said)})" if said else name


def pipeline(collider: str, collider_options: Mapping[str, object], builder: str, options: Mapping[str, object]) -> str:
    text = variant(collider, collider_options)
    return text if builder == "none" else f"{text} over {variant(builder, options)}"


def scene(facts: Mapping[str, object]) -> str:
    """A scene, with what was asked of it that is not usual."""
    objects, between = facts.get("objects_by"), facts.get("between", 0)
    return f"{facts['name']}{f', objects: {objects}' if objects else ''}{f', {between} between' if between else ''}"


def frames(numbers: list[int]) -> str:
    return f"frame {numbers[0]}" if len(numbers) == 1 else f"{len(numbers)} frames"
