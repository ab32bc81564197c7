"""Display names of scenes, builders, colliders and pipelines: the name, and each option that is not the default."""
from collections.abc import Mapping
from typing import Any

# The default of each option and the wording of another value, in the order in which names show them.
OPTIONS = {"no_skip": ("", "without {}"), "jump": ("0", "jump {}"), "start_level": ("0", "from level {}"),
           "order": ("morton30", "{}"), "grid": ("object", "grid over the {}"), "group_size": ("0", "groups of {}"), "items": ("0", "{} items"),
           "leaves": ("mesh", "{} leaves"), "boxes": ("f32", "{} boxes")}
# Options that change what is found. Figures show them elsewhere.
ANSWERS = {"pairs_of": ("all", "{} objects"), "adjacent": ("keep", "adjacent {}ped"), "narrow": ("none", "contacts {}")}
USUAL = {key: usual for key, (usual, _) in {**ANSWERS, **OPTIONS}.items()}


def said(options: Mapping[str, object], table: Mapping[str, tuple[str, str]]) -> list[str]:
    return [words.format(options[key]) for key, (usual, words) in table.items() if str(options.get(key, usual)) != usual]


def variant(name: str, options: Mapping[str, object]) -> str:
    """Returns the name in figures: "bvtt (jump 2)"."""
    words = said(options, OPTIONS)
    return f"{name} ({', '.join(words)})" if words else name


def pipeline(collider: str, collider_options: Mapping[str, object], builder: str, options: Mapping[str, object]) -> str:
    text = variant(collider, collider_options)
    return text if builder == "none" else f"{text} over {variant(builder, options)}"


def in_full(choice: Mapping[str, Any]) -> str:
    """Returns the name of a result file's builder or collider on the console: "bvtt, between objects, jump 2"."""
    options = choice.get("options", {})
    shown = {key: value for key, value in options.items() if key != "leaves" or options.get("boxes", "f32") == "f32"}
    return ", ".join([choice["name"], *said(shown, ANSWERS), *said(shown, OPTIONS)])


def scene(facts: Mapping[str, object]) -> str:
    """Returns the name of a scene, with its settings that are not the defaults."""
    objects, between = facts.get("objects_by"), facts.get("between", 0)
    return f"{facts['name']}{f', objects: {objects}' if objects else ''}{f', {between} between' if between else ''}"


def frames(numbers: list[int]) -> str:
    return f"frame {numbers[0]}" if len(numbers) == 1 else f"{len(numbers)} frames"
