"""What each rule that skips work avoided and saved, and all of them: frames with the rule beside the same frames without it. A rule that the device
does without by default is forced in the frames with it, where the file has them."""
from collections.abc import Hashable, Iterable
from dataclasses import dataclass

from .cells import Cell, grouped

FEW = 1000  # a group's box tests vary from run to run: smaller relative differences, 1 in FEW, are ignored
ALL = "all"  # the name, in place of a rule's, of the sum: frames with the rules that the device uses beside frames with none
# What a rule avoids most of, by the name of its amount (Saving.amounts).
WORK = {"unchanged": "updates", "rigid": "rebuilds", "near": "triangles", "apart": "box tests", "overlap": "box tests",
        "start-level": "box tests", "empty-queue": "launches", "deforming": "rebuilds", "margin": "updates"}
COUNTERS = {"rebuilds": ("rebuilt_objects_count",), "updates": ("rebuilt_objects_count", "refitted_objects_count"),
            "sorts": ("sorts_count",), "tasks": ("tasks_count",), "box tests": ("box_tests_count",)}
AMOUNTS = ("triangles", "launches", *COUNTERS)


@dataclass
class Saving:
    """A rule in one or several frames of a scene by one pipeline. Each frame is a cell with the rule and one without it."""

    rule: str
    frames: list[tuple[Cell, Cell]]
    is_forced: bool  # the device does without the rule by default

    @property
    def first(self) -> Cell:
        return self.frames[0][0]

    @property
    def pipeline(self) -> str:
        collider, builder = self.first.collider, self.first.builder
        over = f"{collider} over {builder}" if builder != "none" else str(collider)
        return over + (" to contacts" if dict(self.first.collider_options).get("narrow", "none") != "none" else "")

    @property
    def work(self) -> str:
        """Returns the amount that the rule avoids most of. Where a tree is made on the host, `near` avoids trees."""
        return "updates" if self.rule == "near" and self.first.builder == "none" else WORK.get(self.rule, "box tests")

    def total(self, amount: str) -> tuple[int, int]:
        """Returns an amount of work over all frames, with the rule and without it."""
        return tuple(sum(int(amount_of(cells[side], amount)) for cells in self.frames) for side in (0, 1))

    def avoided(self, amount: str) -> int:
        own, other = self.total(amount)
        return other - own

    def share(self, amount: str) -> float:
        """Returns the avoided share of an amount: 0 of none, below 0 if there is more with the rule."""
        own, other = self.total(amount)
        return (other - own) / other if other else 0.0

    @property
    def skips_something(self) -> bool:
        few = self.total("box tests")[0] / FEW
        return any(abs(self.avoided(amount)) > (few if amount == "box tests" else 0) for amount in AMOUNTS)

    def ns(self) -> tuple[float, float]:
        """Returns the mean over frames of the median times, with the rule and without it."""
        return tuple(sum(cells[side].median_ns() for cells in self.frames) / len(self.frames) for side in (0, 1))

    @property
    def is_same(self) -> bool:
        return all(one.check.get(key) == other.check.get(key) for one, other in self.frames for key in ("pairs_hash", "contacts_hash"))


def amount_of(cell: Cell, amount: str) -> float:
    if amount == "triangles":  # that the frame's work starts with
        return cell.counters.get("entered_count", cell.triangles)
    if amount == "launches":
        return sum(stage.get("launches", 0) for stage in cell.all_samples[0]["stages"])
    return sum(cell.counters.get(counter, 0) for counter in COUNTERS[amount])


def order(rule: str) -> int:
    """Returns the place of a rule in `list skips`."""
    return [*WORK, rule].index(rule)


def rules_of(cell: Cell, option: str) -> frozenset[str]:
    return frozenset(rule for rule in dict(cell.collider_options).get(option, "").split(", ") if rule)


def key_of(cell: Cell) -> tuple[Hashable, ...]:
    """Returns the identity of a cell without the options about rules."""
    *others, (name, options) = cell.key("scene", "frame", "experiment", "builder", "collider", without="no_skip")
    return *others, name, tuple(option for option in options if option[0] != "force_skip")


def of_frames(cells: Iterable[Cell]) -> list[Saving]:
    """Returns a saving of one frame for each right cell without a rule that has a right cell with it beside it."""
    right = [cell for cell in cells if cell.operation == "collide" and cell.verdict == "agrees" and cell.samples]
    there = {(key_of(cell), rules_of(cell, "no_skip"), rules_of(cell, "force_skip")): cell for cell in reversed(right)}
    fewest: dict[Hashable, frozenset[str]] = {}  # rules that are off in the cell of a frame and pipeline that has most
    for key, off, _ in there:
        fewest[key] = min(off, fewest.get(key, off), key=len)
    found = []
    for cell in right:
        key, off, forced = key_of(cell), rules_of(cell, "no_skip"), rules_of(cell, "force_skip")
        more = sorted(off - fewest[key])
        for rule in more if len(more) == 1 else ():
            usual = there.get((key, off - {rule}, forced))
            beside = there.get((key, off - {rule}, forced | {rule}), usual)
            if beside is not None:
                found.append(Saving(rule, [(beside, cell)], usual is not None and does_less(beside, usual)))
        if len(more) > 1 and (usual := there.get((key, fewest[key], forced))) is not None:
            found.append(Saving(ALL, [(usual, cell)], False))
    return found


def does_less(one: Cell, other: Cell) -> bool:
    """True if the rule that is forced in one is not used in the other: other triangles enter the frame, or others are rebuilt."""
    return one is not other and any(amount_of(one, amount) != amount_of(other, amount) for amount in AMOUNTS if amount != "box tests")


def of_scenes(cells: Iterable[Cell]) -> list[Saving]:
    """Returns the saving of each scene, pipeline and rule: of the frames in which it skipped something together, or else of all."""
    def pipeline(one: Saving) -> Hashable:
        scene, _, *others = key_of(one.first)
        return one.first.scene, scene, *others, one.rule

    found = []
    for same in grouped(of_frames(cells), pipeline).values():
        those = [one for one in same if one.skips_something] or same
        found.append(Saving(same[0].rule, [frame for one in those for frame in one.frames], any(one.is_forced for one in those)))
    return found


def times(one: Saving) -> float:
    """Returns the time without the rule over the time with it."""
    own, other = one.ns()
    return other / own if own > 0 else 1.0


def sentence(cells: Iterable[Cell]) -> str:
    """Returns what the rules that are used by default saved at best and at worst, as one sentence; empty if they had nothing to skip."""
    used = [one for one in of_scenes(cells) if one.skips_something and not one.is_forced and one.rule != ALL]
    if not used:
        return ""
    said = [f"{times(one):.2f} times as long ({one.rule}, {one.pipeline}, {one.first.scene})"
            for one in (max(used, key=times), min(used, key=times))]
    return f"A frame without a rule takes at most {said[0]} and at least {said[1]} as with it."
