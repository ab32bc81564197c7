"""A cell of a sweep, and what its process is told."""
from dataclasses import dataclass, field
from typing import Any

import cells

Json = dict[str, Any]

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
        described["pipelines" if collides else "builders"] = [pipeline_of(one) if collides else one.builder for one in those]
        described |= {"samples": self.samples, "warm_up": self.warm_up}
        return described if collides else described | {"quality": self.quality}


def pipeline_of(one: Planned) -> Json:
    return ({"builder": one.builder} if one.builder else {}) | {"collider": one.collider, **one.query}
