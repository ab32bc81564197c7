"""The builders and pipelines among which `best` chooses: a product of what the program lists for the device and the question."""
import itertools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from ..read import families
from ..sweeping.planned import Json

BOXES = "f32"
ON_THE_HOST = "on the host, and the device is a GPU: --with-libraries"
OUTSIDE = "(from outside: "  # in the text of what a plug-in or program adds
PLACES = ("mesh", "sorted")  # of leaf boxes
# What is tried first, by kind of device: the fastest in docs/collisions.md. It decides the order only.
FIRST = {"gpu": {"name": "oibvh-single", "collider": "block"}, "cpu": {"name": "oibvh-multi", "collider": "group"}}
FIRST_OPTIONS = {"order": "hilbert30", "leaves": "sorted", "boxes": BOXES}
List = dict[str, str]  # names of a list of the program, each with its text


@dataclass(frozen=True)
class Asked:
    """What narrows the product. Empty lists leave the choice to the rules of this file."""

    objective: str
    on_cpu: bool
    with_libraries: bool
    has_narrow: bool  # contacts are asked for, not pairs of boxes
    has_frames: bool  # several frames
    builders: list[str] = field(default_factory=list)
    orders: list[str] = field(default_factory=list)
    colliders: list[str] = field(default_factory=list)
    boxes: list[str] = field(default_factory=list)


class Product:
    """The candidates, likely ones first, and what the rules leave out: names by reason."""

    def __init__(self, asked: Asked, list_of: Callable[[str], List]) -> None:
        self.asked, self.without = asked, {}
        self.outside = {name for what in ("builders", "colliders") for name, text in list_of(what).items() if OUTSIDE in text}
        self.orders = asked.orders or self.kept(list_of("orders"), self.why_no_order)
        self.boxes = asked.boxes or (list(list_of("formats")) if asked.objective == "memory" else [BOXES])
        self.builders = asked.builders or self.kept(list_of("builders"), self.why_no_builder)
        self.colliders = [] if asked.objective == "build" else \
            asked.colliders or self.kept(list_of("colliders"), self.why_no_collider)

    def kept(self, listed: List, why_not: Callable[[str, str], str]) -> list[str]:
        names = []
        for name, text in listed.items():
            if why := why_not(name, text):
                self.without.setdefault(why, []).append(name)
            else:
                names.append(name)
        return names

    def why_not_at_all(self, text: str) -> str:
        if text.startswith("built without"):
            return text
        if OUTSIDE in text:
            return ""  # whoever names a plug-in wants it
        if text.endswith("the oracle"):
            return "what others are checked against"
        if "host" in text and not (self.asked.on_cpu or self.asked.with_libraries):
            return ON_THE_HOST
        return ""

    def why_no_builder(self, name: str, text: str) -> str:
        if self.asked.objective != "build" and name in self.outside:
            return "their trees are in a process of their own, where no other collider queries them"
        if self.asked.objective != "build" and families.of_builder(name) in families.ON_HOST:
            return "their trees are on the host, where no collider of the device queries them"
        return self.why_not_at_all(text)

    def why_no_collider(self, name: str, text: str) -> str:
        if families.keeps(name) and not self.asked.has_frames:
            return f"they {families.NO_FRAME_BEFORE}: --frames"
        if families.of_collider(name) in families.ON_HOST and not (self.asked.on_cpu or self.asked.with_libraries):
            return ON_THE_HOST
        if families.of_collider(name) == "FCL" and not self.asked.has_narrow:
            return "they find contacts, and the question is about pairs of boxes: --narrow exact"
        return self.why_not_at_all(text)

    def why_no_order(self, name: str, text: str) -> str:
        if self.asked.objective == "memory":
            return "orders hold equal memory" if name != FIRST_OPTIONS["order"] else ""
        is_short = text.startswith(("30 bits", "no codes")) and not name.endswith("-axis")
        return "" if is_short else "codes of another length than 30 bits, or of stretched cells: --orders"

    def all_builders(self) -> list[Json]:
        choices = []
        for name, order, boxes in itertools.product(self.builders, self.orders, self.boxes):
            has_own = name in self.outside or families.of_builder(name) in families.OWN_LEAVES
            if (name in self.outside or families.of_builder(name) in families.ON_HOST) and order != self.orders[0]:
                continue  # they do not sort
            for leaves in PLACES[:1] if has_own else PLACES if boxes == BOXES else PLACES[1:]:
                choices.append({"name": name, "order": order, "leaves": leaves, "boxes": boxes})
        return choices

    def candidates(self) -> list[tuple[Json | None, Json | None]]:
        """Returns pairs of a builder and a collider, None where there is none: first those that differ least from FIRST."""
        builders: list[Json | None] = list(self.all_builders())
        if self.asked.objective == "build":
            pairs: list[Any] = [(builder, None) for builder in builders]
        else:
            alone = [name for name in self.colliders if name in self.outside or families.of_collider(name) not in (None, "front tracking")]
            pairs = [(builder, {"name": name}) for builder in builders for name in self.colliders if name not in alone]
            pairs += [(None, {"name": name}) for name in alone]
        return sorted(pairs, key=lambda pair: self.distance(*pair))

    def distance(self, builder: Json | None, collider: Json | None) -> int:
        first = FIRST["cpu" if self.asked.on_cpu else "gpu"]
        wanted = FIRST_OPTIONS | {"name": first["name"]}
        apart = 2 if builder is None else sum(builder[key] != value for key, value in wanted.items())
        return apart + (collider is not None and collider["name"] != first["collider"])
