"""A cell of a sweep: what its process is told, and what the program says of it: what it is in full, or why there is none."""
import hashlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import cells

Json = dict[str, Any]
Settle = Callable[[list[Json]], list[Json]]  # the program's answers to experiments

NO_BUILDER = "none"  # of a collider that wants no tree
# Options that a sweep goes through values of, in the order in which they are applied: whose each is, and its key there.
OPTIONS = {"grid": ("builder", "grid"), "builder.group_size": ("builder", "group_size"), "items": ("builder", "items"),
           "boxes": ("builder", "boxes"), "leaves": ("builder", "leaves"), "pairs_of": ("query", "pairs_of"),
           "adjacent": ("query", "adjacent"), "narrow": ("query", "narrow"), "no_skip": ("query", "no_skip"),
           "jump": ("collider", "jump"), "start_level": ("collider", "start_level"),
           "collider.group_size": ("collider", "group_size"), "frames": ("scene", "frames"), "between": ("scene", "between"),
           "objects": ("scene", "objects"), "swept": ("scene", "swept")}


@dataclass
class Planned:
    """A cell that is to be measured, or `why_not`."""

    scene: Json  # as an experiment has it, and so all four
    builder: Json | None  # None: the collider wants no tree
    collider: Json | None  # None: a build
    query: Json
    triangles: int = 0  # as far as the scene's name tells; else 0
    files: list[str] = field(default_factory=list)  # that the scene is read from
    raw: Json = field(default_factory=dict)  # as the result file will have it, without samples
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
        """What the process of some cells of one scene runs."""
        collides = those[0].collider is not None
        described: Json = {"experiment": self.name} | ({"question": self.question} if self.question else {})
        described["scenes"] = [those[0].scene if collides else those[0].scene["scene"]]
        pipelines = [({"builder": one.builder} if one.builder else {}) | {"collider": one.collider, **one.query}
                     for one in those]
        described |= {"pipelines": pipelines} if collides else {"builders": [one.builder for one in those]}
        described |= {"samples": self.samples, "warm_up": self.warm_up}
        return described if collides else described | {"quality": self.quality}


def settled(planned: list[Planned], sweep: Sweep, settle: Settle) -> list[Planned]:
    for one, answer in zip(planned, settle([sweep.experiment([one]) for one in planned])):
        one.why_not = answer.get("error", "")
        one.raw = unsettled(one, sweep) if one.why_not else answer["cells"][0]
        if not one.why_not:
            say_all_options(one)
    return planned


def say_all_options(one: Planned) -> None:
    """However a cell was described, it is the same experiment, also for a program whose usual options are others."""
    if one.builder is not None:
        one.builder = {"name": one.raw["builder"]["name"], **one.raw["builder"]["options"]}
    if one.collider is not None:
        options, said = dict(one.raw["collider"]["options"]), one.query
        one.query = {key: options.pop(key) for key, (whose, _) in OPTIONS.items() if whose == "query" and key in options}
        if one.query.pop("no_skip"):  # a list of rules there, which experiments name one by one, or all
            one.query["no_skip"] = said["no_skip"]
        one.collider = {"name": one.raw["collider"]["name"], **options}


def unsettled(one: Planned, sweep: Sweep) -> Json:
    """What can be said of a cell that there is not."""
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
        of_scene = {"adjacent": "drop"} if one.scene.get("swept") else {}
        of_scene |= {"pairs_of": one.scene["pairs_of"]} if "pairs_of" in one.scene else {}
        raw["collider"] = choice(one.collider | one.query | of_scene)
    return raw


def hash_of(*parts: str) -> str:
    """16 hexadecimal digits, of all parts and of where each ends."""
    return hashlib.sha256(b"".join(part.encode(errors="surrogateescape") + b"\0" for part in parts)).hexdigest()[:16]
