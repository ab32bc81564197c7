"""What each choice of a pipeline decides of a frame's time, everything else equal, and which measure of a tree predicts a query's
time: the experiment effects, with one frame of each scene."""
import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy

from ..words import names
from . import families, student
from .cells import Cell, grouped
from .ranking import ERROR, FEWEST, Measure

EXPERIMENT = "effects"
# Kinds of trees within which a measure is compared, by their families. Costs of wide trees are of another kind.
IMPLICIT, POINTERS = "implicit trees", "trees with pointers"
KINDS = {IMPLICIT: ("implicit trees", "padded implicit trees"), POINTERS: ("radix trees", "clustered trees", "host builders")}
KINDS["both"] = KINDS[IMPLICIT] + KINDS[POINTERS]
# Measures of a tree, and their counters.
MEASURES = {"SAH cost": "sah_cost", "end-point overlap": "epo", "box tests": "box_tests_count"}
# Each choice, with the level that others are compared with.
CHOICES = {"builder": "oibvh-single", "order": "hilbert30", "leaves": "sorted", "collider": "block"}
# Levels of each choice that all combine.
BALANCED = (("oibvh-single", "perfect", "apetrei-fused", "hploc"), ("morton30", "hilbert30"), ("mesh", "sorted"),
            ("leaf", "group", "block", "bvtt"))
REST = "the rest"
Levels = tuple[str, ...]  # one for each choice; "" of a choice that the builder does not have


@dataclass
class Ratio:
    """The time of a level over that of its choice's reference: by scene the geometric mean over pairs of cells that differ in this
    choice alone."""

    by_scene: dict[str, float]
    pairs: int

    @property
    def logs(self) -> numpy.ndarray:
        return numpy.log(list(self.by_scene.values()))

    @property
    def mean(self) -> float:
        """Returns the geometric mean over scenes."""
        return math.exp(numpy.mean(self.logs))

    @property
    def interval(self) -> tuple[float, float]:
        """Returns Student's interval, which holds the mean over scenes like these with a probability of 95 %; NaN of one scene."""
        count = len(self.by_scene)
        if count < 2:
            return math.nan, math.nan
        factor = math.exp(student.quantile(ERROR, count - 1) * numpy.std(self.logs, ddof=1) / math.sqrt(count))
        return self.mean / factor, self.mean * factor


class Effect(NamedTuple):
    """What a level does to the time of the whole frame and of the query. The host's builds have no frame to compare."""

    choice: str
    level: str
    frame: Ratio | None
    query: Ratio


def frames_of(cells: Iterable[Cell], of_any: bool = False) -> list[Cell]:
    """Returns the frames of the experiment, or of any whose trees were measured, that have times."""
    return [cell for cell in cells if cell.operation == "collide" and cell.has_times
            and (MEASURES["SAH cost"] in cell.counters if of_any else cell.experiment == EXPERIMENT)]


def levels_of(cell: Cell) -> Levels:
    options, family = {**names.USUAL, **dict(cell.options)}, families.of_builder(cell.builder)
    return (cell.builder, "" if family in families.ON_HOST else options["order"],
            "" if family in families.OWN_LEAVES else options["leaves"], cell.collider or "")


def query_ns(cell: Cell) -> float:
    """Returns the median time of the stages after the tree."""
    return Measure("query", False).middle(cell)


def logs_of(cells: list[Cell], of_query: bool) -> dict[str, dict[Levels, float]]:
    """Returns the logarithm of the time of each combination of levels, by scene: of the query, or of the whole frame of trees that
    the device builds."""
    found: dict[str, dict[Levels, float]] = {}
    for cell in cells:
        if of_query or families.of_builder(cell.builder) not in families.ON_HOST:
            found.setdefault(cell.scene, {})[levels_of(cell)] = math.log(max(query_ns(cell) if of_query else cell.median_ns(), 1))
    return found


def beside(levels: Levels, place: int) -> Levels:
    """Returns the levels with the reference at `place`. Another builder may have choices that this one does not have: those are at
    their references."""
    return tuple(reference if other == place or place == 0 and not level else level
                 for other, (level, reference) in enumerate(zip(levels, CHOICES.values(), strict=True)))


def ratio_of(scenes: dict[str, dict[Levels, float]], place: int, level: str) -> Ratio | None:
    """Returns the ratio of a level of the choice at `place`, or None if no cell has the reference beside it."""
    logs = {scene: [there[own] - there[other] for own in there if own[place] == level and (other := beside(own, place)) in there]
            for scene, there in scenes.items()}
    by_scene = {scene: math.exp(numpy.mean(those)) for scene, those in logs.items() if those}
    return Ratio(by_scene, sum(map(len, logs.values()))) if by_scene else None


def effects(cells: list[Cell]) -> list[Effect]:
    """Returns the effect of each level that has cells beside the reference, by choice."""
    frames, queries = logs_of(cells, False), logs_of(cells, True)
    found = []
    for place, (choice, reference) in enumerate(CHOICES.items()):
        for level in dict.fromkeys(levels[place] for there in queries.values() for levels in there):
            if level not in ("", reference) and (query := ratio_of(queries, place, level)):
                found.append(Effect(choice, level, ratio_of(frames, place, level), query))
    return found


def lacking(cells: list[Cell]) -> dict[str, list[Levels]]:
    """Returns the combinations of BALANCED that each scene lacks."""
    return {scene: [levels for levels in itertools.product(*BALANCED) if levels not in there]
            for scene, there in logs_of(cells, False).items()}


def shares(cells: list[Cell], of_query: bool) -> dict[str, float]:
    """Returns the share of the sum of squares of the logarithms of times, within scenes, that each choice explains, that each two
    explain together beyond both, and the rest. Scenes that lack a combination do not count; empty if all do."""
    whole = [scene for scene, missing in lacking(cells).items() if not missing]
    if not whole:
        return {}
    there = logs_of(cells, of_query)
    logs = numpy.array([[there[scene][levels] for levels in itertools.product(*BALANCED)] for scene in whole])
    logs = (logs - logs.mean(axis=1, keepdims=True)).reshape(len(whole), *map(len, BALANCED))
    total, found = float((logs**2).sum()) or 1.0, {}
    places = range(1, logs.ndim)  # axis 0 is the scene
    for chosen in [*itertools.combinations(places, 1), *itertools.combinations(places, 2)]:
        means = logs.mean(axis=tuple(axis for axis in range(logs.ndim) if axis not in chosen))
        own = logs.size / means.size * float((means**2).sum()) / total
        found[chosen] = max(0.0, own - sum(found[place,] for place in chosen if len(chosen) > 1))  # rounding may go below 0
    choices = list(CHOICES)
    named = {" × ".join(choices[place - 1] for place in chosen): share for chosen, share in found.items()}
    return named | {REST: max(0.0, 1 - sum(named.values()))}


def ranks(values: numpy.ndarray) -> numpy.ndarray:
    """Returns the rank of each value, from 1; equal values have the mean of their ranks."""
    _, places, counts = numpy.unique(values, return_inverse=True, return_counts=True)
    return (numpy.cumsum(counts) - (counts - 1) / 2)[places]


def spearman(points: list[tuple[float, float]]) -> float:
    """Returns the rank correlation; NaN of few points, and where all are equal in one."""
    if len(points) < FEWEST or any(len(set(column)) == 1 for column in zip(*points, strict=True)):
        return math.nan
    return float(numpy.corrcoef(*map(ranks, numpy.array(points).T))[0, 1])


def correlations(cells: list[Cell], measure: str, kind: str) -> dict[str, dict[str, float]]:
    """Returns the rank correlation of a measure with the time of the stage `broad`, over the trees of a kind, by collider and scene."""
    counter = MEASURES[measure]
    those = [cell for cell in cells if counter in cell.counters and families.of_builder(cell.builder) in KINDS[kind]]
    found: dict[str, dict[str, float]] = {}
    for (collider, scene), there in grouped(those, lambda cell: (cell.collider or "", cell.scene + f", frame {cell.frame}" * (cell.frame > 0))).items():
        rho = spearman([(cell.counters[counter], cell.median_ns("broad")) for cell in there])
        if not math.isnan(rho):
            found.setdefault(collider, {})[scene] = rho
    return found
