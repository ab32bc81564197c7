"""A cell of a sweep: the experiment of its process, and the program's description of it or the reason why it is impossible."""
from collections.abc import Callable
from dataclasses import dataclass, field

from ..files.json_files import Json
from ..read import cells

Expand = Callable[[list[Json]], list[Json]]  # returns the program's answers to experiments

NO_BUILDER = "none"  # for colliders without a tree
# Options that a sweep varies, in the order in which they are applied: the part that each belongs to, and its key there.
OPTIONS = {"grid": ("builder", "grid"), "builder.group_size": ("builder", "group_size"), "items": ("builder", "items"),
           "boxes": ("builder", "boxes"), "leaves": ("builder", "leaves"), "pairs_of": ("query", "pairs_of"),
           "adjacent": ("query", "adjacent"), "narrow": ("query", "narrow"), "first": ("query", "first"), "within": ("query", "within"),
           "separation": ("query", "separation"), "no_skip": ("query", "no_skip"), "force_skip": ("query", "force_skip"),
           "update": ("query", "update"), "trees": ("query", "trees"), "jump": ("collider", "jump"), "start_level": ("collider", "start_level"),
           "collider.group_size": ("collider", "group_size"), "frames": ("scene", "frames"), "between": ("scene", "between"),
           "objects": ("scene", "objects"), "swept": ("scene", "swept"),
           "features": ("scene", "features")}


@dataclass
class Planned:
    """A cell to be measured, or one with `why_not`."""

    scene: Json  # as in an experiment; so are builder, collider and query
    builder: Json | None  # None: the collider needs no tree
    collider: Json | None  # None: a build
    query: Json
    triangles: int = 0  # 0 unless the scene's name tells it
    files: list[str] = field(default_factory=list)  # input files of the scene
    raw: Json = field(default_factory=dict)  # the cell as in the result file, without samples
    why_not: str = ""

    @property
    def cell(self) -> cells.Cell:
        return cells.Cell(self.raw)


@dataclass
class Sweep:
    name: str
    question: str
    samples: int
    warm_up: int
    quality: bool
    product: str  # "2 scenes x 3 builders"
    cells: list[Planned]

    def experiment(self, those: list[Planned]) -> Json:
        """Returns the experiment that the process of these cells, all of one scene, runs."""
        collides = those[0].collider is not None
        described: Json = {"experiment": self.name} | ({"question": self.question} if self.question else {})
        described["scenes"] = [those[0].scene if collides else those[0].scene["scene"]]
        pipelines = [({"builder": one.builder} if one.builder else {}) | {"collider": one.collider, **one.query}
                     for one in those]
        described |= {"pipelines": pipelines} if collides else {"builders": [one.builder for one in those]}
        described |= {"samples": self.samples, "warm_up": self.warm_up}
        return described if collides else described | {"quality": self.quality}


def expanded(planned: list[Planned], sweep: Sweep, expand: Expand) -> list[Planned]:
    for one, answer in zip(planned, expand([sweep.experiment([one]) for one in planned]), strict=True):
        one.why_not = answer.get("error", "")
        one.raw = unexpanded(one, sweep) if one.why_not else answer["cells"][0]
        if not one.why_not:
            say_all_options(one)
    return planned


def say_all_options(one: Planned) -> None:
    """Spells out all options, so that the experiment does not depend on the description or on a program's defaults."""
    if one.builder is not None:
        one.builder = {"name": one.raw["builder"]["name"], **one.raw["builder"]["options"]}
    if one.collider is not None:
        options, said = dict(one.raw["collider"]["options"]), one.query
        one.query = {key: options.pop(key) for key, (whose, _) in OPTIONS.items() if whose == "query" and key in options}
        for key in ("no_skip", "force_skip"):  # the answer has a list of rules; experiments name one rule or all
            if one.query.pop(key, ""):
                one.query[key] = said[key]
        one.collider = {"name": one.raw["collider"]["name"], **options}


def unexpanded(one: Planned, sweep: Sweep) -> Json:
    """Returns a skipped cell's JSON, from its description."""
    def choice(described: Json) -> Json:
        options = {key: int(value) if str(value).isdecimal() else value for key, value in described.items() if key != "name"}
        return {"name": described["name"], "options": options}

    scene = {"name": one.scene["scene"]}
    if int(one.scene.get("between", 0)) > 0:
        scene["between"] = int(one.scene["between"])
    if one.scene.get("objects", "auto") != "auto":
        scene["objects_by"] = one.scene["objects"]
    raw = {"experiment": sweep.name, "scene": scene, "builder": choice(one.builder or {"name": NO_BUILDER}),
           "operation": "build" if one.collider is None else "collide", "status": "skipped"}
    if one.collider is not None:
        of_scene = {"adjacent": "drop"} if one.scene.get("swept") or one.scene.get("features") else {}
        of_scene |= {"pairs_of": one.scene["pairs_of"]} if "pairs_of" in one.scene else {}
        raw["collider"] = choice(one.collider | one.query | of_scene)
    return raw
