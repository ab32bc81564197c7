"""The product that a sweep measures: scenes, sizes, builders, orders, colliders and values of options (docs/sweeps.md). The
program describes each cell, or says why it is impossible."""
import itertools
import json
import re
from typing import Any

from ..files.output import WrongUsage
from ..words import tables
from . import sizes
from .planned import NO_BUILDER, OPTIONS, Expand, Json, Planned, Sweep, expanded

KEYS = ("sweep", "question", "scenes", "sizes", "builders", "orders", "colliders", "set", "samples", "warm_up", "quality")
HOLE = "{size}"
MOST_CELLS = 1_000_000
USUAL_BUILDER, USUAL_COLLIDER = "oibvh-multi", "leaf"
UNTOLD = ("frames", "swept", "features")  # result files do not distinguish cells by these


def listed(described: Json, key: str) -> list[Any]:
    if not isinstance(described[key], list) or not described[key]:
        raise WrongUsage(f"'{key}' must be a list of at least one")
    return described[key]


def word(value: Any) -> str:
    """Returns a value in command-line syntax."""
    return value if isinstance(value, str) else json.dumps(value)


def whole(described: Json, key: str, least: int, usual: int) -> int:
    value = described.get(key, usual)
    if type(value) is not int or not least <= value <= 1_000_000:
        raise WrongUsage(f"{key} must be a whole number from {least} to 1000000, not {word(value)}")
    return value


def all_named(described: Json, key: str) -> list[Json]:
    """Returns builders or colliders as objects."""
    items = [{"name": item} if isinstance(item, str) else item for item in listed(described, key)]
    for item in items:
        if not isinstance(item, dict) or not isinstance(item.get("name"), str):
            raise WrongUsage(f"'{key}' must be names, or objects with a name")
    return items


def swept_of(described: Json, expand: Expand) -> Sweep:
    """Returns the sweep. Raises WrongUsage, naming the key. An impossible combination of valid parts is a cell with a reason."""
    for key in described:
        if key not in KEYS:
            raise WrongUsage(f"'{key}' is no key of a sweep; there are: {', '.join(KEYS)}")
    if "scenes" not in described:
        raise WrongUsage("a sweep needs scenes")
    name = described.get("sweep", "sweep")
    if not isinstance(name, str) or not re.fullmatch(r"[A-Za-z0-9_-]+", name):
        raise WrongUsage(f"'sweep' must be letters, digits, - and _, not '{word(name)}'")
    if not isinstance(described.get("quality", False), bool):
        raise WrongUsage(f"'quality' is true or false, not {word(described['quality'])}")
    if not isinstance(described.get("question", ""), str):
        raise WrongUsage("'question' must be text")
    sweep = Sweep(name, described.get("question", ""), whole(described, "samples", 1, 20), whole(described, "warm_up", 0, 3),
                  described.get("quality", False), "", [])
    scenes = scenes_of(described, sweep, expand)
    options = options_of(described)
    builders, colliders = builders_of(described), all_named(described, "colliders") if "colliders" in described else [None]
    of_colliders, of_scenes = check_each(described, sweep, scenes, builders, colliders, options, expand)
    count = len(scenes) * len(builders) * len(colliders)
    for _, values in options:
        count *= len(values)
    if count > MOST_CELLS:
        raise WrongUsage(f"the sweep has more than {MOST_CELLS} cells")
    trees = [answer["cells"][0]["builder"]["name"] != NO_BUILDER for answer in of_colliders] or [True]
    planned = [with_options(Planned(dict(scene), dict(builder) if wants_tree else None, dict(collider) if collider else None, {},
                                    about["triangles"], about["files"]), options, chosen)
               for (scene, about), builder, (collider, wants_tree) in itertools.product(zip(scenes, of_scenes, strict=True), builders,
                                                                                        zip(colliders, trees, strict=True))
               for chosen in itertools.product(*(values for _, values in options))]
    sweep.cells = each_once(expanded(planned, sweep, expand))
    counts = [("scene", len(scenes))]
    counts += [(key[:-1], len(described[key])) for key in ("builders", "orders", "colliders") if key in described]
    sweep.product = " x ".join([tables.counted(number, what) for what, number in counts]
                               + [f"{tables.counted(len(values), 'value')} of {key}" for key, values in options])
    return sweep


def scenes_of(described: Json, sweep: Sweep, expand: Expand) -> list[Json]:
    """Returns each scene once, or once for each size if its name has a place for one."""
    given = described.get("sizes", [])
    of_sizes = [] if "sizes" not in described else sizes.called(
        given if isinstance(given, str) else ",".join(map(word, listed(described, "sizes"))))
    items = [{"scene": item} if isinstance(item, str) else item for item in listed(described, "scenes")]
    for item in items:
        if not isinstance(item, dict) or not isinstance(item.get("scene"), str):
            raise WrongUsage("'scene' must be text")
    scenes, has_sized = [], False
    for scene, answer in zip(items, expand([experiment_over({"scene": item["scene"]}, sweep) for item in items]), strict=True):
        name = scene["scene"]
        if of_sizes and answer.get("sized"):
            name += f":{HOLE}"
        if HOLE not in name:
            scenes.append(scene)
            continue
        if not of_sizes:
            raise WrongUsage(f"the scene '{name}' asks for sizes, and the sweep has none")
        has_sized = True
        scenes += [scene | {"scene": name.replace(HOLE, str(size), 1)} for size in of_sizes]
    if of_sizes and not has_sized:
        raise WrongUsage(f"none of the scenes has room for a size: name a generator, as torus, or write {HOLE} where it goes, as "
                         f"in refine:bunny:{HOLE}")
    return scenes


def builders_of(described: Json) -> list[Json]:
    if "builders" not in described and "colliders" not in described:
        raise WrongUsage("a sweep needs builders or colliders")
    builders = all_named(described, "builders") if "builders" in described else [{"name": USUAL_BUILDER}]
    if "orders" not in described:
        return builders
    if any("order" in builder for builder in builders):
        raise WrongUsage("a builder that names its order leaves none to the sweep's orders")
    return [builder | {"order": order} for builder in builders for order in listed(described, "orders")]


def options_of(described: Json) -> list[tuple[str, list[str]]]:
    """Returns the options of `set` and their values, in the order of OPTIONS."""
    chosen = described.get("set", {})
    if not isinstance(chosen, dict):
        raise WrongUsage("'set' must be an object of options, each with a list of values")
    for key in chosen:
        if key not in OPTIONS:
            raise WrongUsage(f"a sweep sets no '{key}'; there are: {', '.join(OPTIONS)}")
        if OPTIONS[key][0] != "builder" and "colliders" not in described:
            raise WrongUsage(f"'{key}' is for colliders, and the sweep has none")
    options = [(key, [word(value) for value in listed(chosen, key)]) for key in OPTIONS if key in chosen]
    for key, values in options:
        if key in UNTOLD and len(values) > 1:
            raise WrongUsage(f"'{key}' may have one value: result files do not tell cells of several apart; make it several "
                             "sweeps")
    return options


def with_options(one: Planned, options: list[tuple[str, list[str]]], chosen: tuple[str, ...]) -> Planned:
    for (key, _), value in zip(options, chosen, strict=True):
        whose, own = OPTIONS[key]
        place = {"builder": one.builder, "collider": one.collider, "query": one.query, "scene": one.scene}[whose]
        if place is not None:
            place[own] = value == "true" if own in ("swept", "features") and value in ("true", "false") else value
    return one


def experiment_over(scene: Json, sweep: Sweep, builder: Json | None = None, collider: Json | None = None,
                    query: Json | None = None) -> Json:
    """Returns an experiment over a scene, with default parts where none are given."""
    if collider is None and len(scene) == 1:
        return {"experiment": sweep.name, "scenes": [scene["scene"]], "builders": [builder or USUAL_BUILDER]}
    return {"experiment": sweep.name, "scenes": [scene], "pipelines": [
        {"builder": builder or USUAL_BUILDER, "collider": collider or USUAL_COLLIDER, "adjacent": "drop"} | (query or {})]}


def check_each(described: Json, sweep: Sweep, scenes: list[Json], builders: list[Json], colliders: list[Json | None],
               options: list[tuple[str, list[str]]], expand: Expand) -> tuple[list[Json], list[Json]]:
    """Returns the program's answers for each collider and each scene. Raises WrongUsage for a part that is always invalid."""
    usual = {"scene": "soup:1"}
    asked = [("", experiment_over(usual, sweep, builder)) for builder in builders]
    asked += [("", experiment_over(usual, sweep, None, collider)) for collider in colliders if collider]
    asked += [(f"the scene '{scene['scene']}': ", experiment_over(scene, sweep)) for scene in scenes]
    for key, values in options:
        whose, own = OPTIONS[key]
        for value in values:
            one = Planned(dict(usual), {"name": USUAL_BUILDER}, {"name": USUAL_COLLIDER}, {})
            with_options(one, [(key, values)], (value,))
            asked.append((f"--set {key}: " if own != key else "",
                          experiment_over(one.scene, sweep, one.builder, one.collider, one.query)))
    answers = expand([experiment for _, experiment in asked])
    for (where, _), answer in zip(asked, answers, strict=True):
        if answer.get("error"):
            raise WrongUsage(where + answer["error"])
    for scene in scenes:
        if len(scene) > 1 and "colliders" not in described:
            raise WrongUsage(f"the scene '{scene['scene']}' says what is for colliders, and the sweep has none")
        if "pairs_of" in scene and "pairs_of" in dict(options):
            raise WrongUsage(f"the scene '{scene['scene']}' says which pairs it is about, which leaves none to the sweep")
        if (scene.get("swept") or scene.get("features")) and len(dict(options).get("pairs_of", ())) > 1:
            raise WrongUsage(f"the scene '{scene['scene']}' has features: all its pairs are those between and within, so 'pairs_of' "
                             "may have one value")
    first_scene = len(builders) + sum(collider is not None for collider in colliders)
    return answers[len(builders):first_scene], answers[first_scene:first_scene + len(scenes)]


def each_once(planned: list[Planned]) -> list[Planned]:
    """Removes duplicate cells, such as those that differ in a builder that the collider does not use. Raises WrongUsage for
    scenes that differ only in what result files do not contain."""
    seen: dict[str, Json] = {}
    once = []
    for one in planned:
        scene = seen.setdefault(one.cell.identity, one.scene)
        if scene is one.scene:
            once.append(one)
        elif scene != one.scene:
            raise WrongUsage(f"the scene '{one.scene['scene']}' is there twice, and result files do not tell which is which; "
                             "make it two sweeps")
    return once
