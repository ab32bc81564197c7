"""Tests what the experiment effects is said to show, on cells of known effects: ratios, shares, correlations, figure, tables."""
import itertools
import math
import unittest
from collections.abc import Callable
from typing import Any

import numpy

from base import Raw, cell, golden, run_of, stage  # first: it adds the source root to sys.path

from plots.console import effects_table
from plots.draw import style
from plots.figures import effects as drawing
from plots.read import effects
from plots.read.cells import Cell
from plots.read.effects import BALANCED, IMPLICIT, MEASURES, POINTERS, REST

UNIT = 2**20  # nanoseconds
USUAL = ("oibvh-single", "hilbert30", "sorted", "block")


def frame(scene: str, levels: effects.Levels, build: float, query: float, **counters: float) -> Raw:
    """Returns a frame whose build and query have these median times."""
    builder, order, leaves, collider = levels
    made = cell(builder, experiment="effects", scene={"name": scene, "triangles": 1000}, collider={"name": collider},
                operation="collide", counters=counters)
    made["builder"]["options"] = {"order": order, "leaves": leaves}
    ropes = int(query) // 4
    made["samples"] = [{"order": place, "stages": [stage("hierarchy", int(build) + off), stage("ropes", ropes),
                                                   stage("broad", int(query) - ropes + off)]}
                       for place, off in enumerate((0, 100, -100))]
    return made


def cells(raws: list[Raw]) -> list[Cell]:
    return effects.frames_of(map(Cell, raws))


def balanced(exponent: Callable[[int, Any], int], scenes: int = 2) -> list[Cell]:
    """Returns all combinations, with build and query of 2^exponent units each."""
    return cells([frame(f"s{scene}", levels, *[UNIT * 2.0**exponent(scene, levels)] * 2)
                  for scene in range(scenes) for levels in itertools.product(*BALANCED)])


def found_by(those: list[Cell]) -> dict[tuple[str, str], effects.Effect]:
    return {(one.choice, one.level): one for one in effects.effects(those)}


class Ratios(unittest.TestCase):
    def test_are_those_of_each_choice_alone(self) -> None:
        powers = {"hploc": 1, "perfect": -1, "morton30": 3, "mesh": 2, "leaf": 4, "group": 5, "bvtt": -2}
        found = found_by(balanced(lambda scene, levels: 7 * scene + sum(powers.get(level, 0) for level in levels)))
        self.assertEqual({level for _, level in found}, {*powers, "apetrei-fused"})
        for (_, level), one in found.items():
            for ratio in (one.frame, one.query):
                self.assertAlmostEqual(ratio.mean, 2.0**powers.get(level, 0), places=5)
                numpy.testing.assert_allclose(ratio.interval, ratio.mean, rtol=1e-5)
        pairs = [found[key].query.pairs for key in (("builder", "hploc"), ("order", "morton30"), ("collider", "leaf"))]
        self.assertEqual(pairs, [32, 64, 32])

    def test_have_student_s_interval_over_scenes_for_frames_and_queries(self) -> None:
        other = (*USUAL[:3], "bvtt")
        found = found_by(cells([raw for power in (1, 2, 3) for raw in (frame(f"s{power}", USUAL, UNIT, UNIT),
                                                                       frame(f"s{power}", other, UNIT, UNIT * 2**power))]))
        one = found["collider", "bvtt"]
        half = 4.30265 * math.log(2) / math.sqrt(3)  # t of two degrees of freedom
        numpy.testing.assert_allclose(one.query.interval, (4 * math.exp(-half), 4 * math.exp(half)), rtol=1e-4)
        numpy.testing.assert_allclose(list(one.frame.by_scene.values()), [1.5, 2.5, 4.5], rtol=1e-5)
        alone = found_by(cells([frame("s", USUAL, UNIT, UNIT), frame("s", other, UNIT, UNIT)]))["collider", "bvtt"]
        self.assertTrue(all(map(math.isnan, alone.query.interval)))

    def test_of_builders_without_a_choice_are_against_its_reference(self) -> None:
        found = found_by(cells([frame("s", USUAL, UNIT, UNIT), frame("s", (*USUAL[:2], "mesh", "block"), UNIT, 8 * UNIT),
                                frame("s", ("oibvh-wide4", "hilbert30", "mesh", "block"), UNIT, 3 * UNIT),
                                frame("s", ("sah-binned", "morton30", "mesh", "block"), 99 * UNIT, 5 * UNIT)]))
        self.assertEqual([*found], [("builder", "oibvh-wide4"), ("builder", "sah-binned"), ("leaves", "mesh")])
        self.assertAlmostEqual(found["builder", "oibvh-wide4"].query.mean, 3, places=5)
        self.assertAlmostEqual(found["builder", "oibvh-wide4"].frame.mean, 2, places=5)
        self.assertAlmostEqual(found["builder", "sah-binned"].query.mean, 5, places=5)
        self.assertIsNone(found["builder", "sah-binned"].frame)

    def test_leave_out_wrong_answers(self) -> None:
        wrong = frame("s", (*USUAL[:3], "bvtt"), UNIT, UNIT) | {"check": {"verdict": "differs"}}
        self.assertEqual(found_by(cells([frame("s", USUAL, UNIT, UNIT), wrong])), {})


class Shares(unittest.TestCase):
    @staticmethod
    def exponent(scene: int, levels: effects.Levels) -> int:
        order, leaves = 2 * (levels[1] == "morton30") - 1, 2 * (levels[2] == "mesh") - 1
        return 4 * order + 2 * leaves + order * leaves + (2 * scene - 1) * order + 3 * scene  # orthogonal, but for the scene

    def test_are_those_of_orthogonal_effects(self) -> None:
        found = effects.shares(balanced(self.exponent), of_query=True)
        expected = {"order": 16 / 22, "leaves": 4 / 22, "order × leaves": 1 / 22, REST: 1 / 22}
        self.assertEqual(len(found), 4 + 6 + 1)
        for name, share in found.items():
            self.assertAlmostEqual(share, expected.get(name, 0), places=5, msg=name)

    def test_are_of_complete_scenes_alone(self) -> None:
        whole, part = balanced(self.exponent, 1), balanced(self.exponent)[:-1]
        self.assertEqual(effects.shares(part, False), effects.shares(whole, False))
        self.assertEqual(effects.lacking(part), {"s0": [], "s1": [("hploc", "hilbert30", "sorted", "bvtt")]})
        self.assertEqual(effects.shares(whole[1:], False), {})
        text = effects_table.text(run_of(*(one.raw for one in part)))
        self.assertIn("s1 does not count in shares: 1 cell missing, as hploc, hilbert30, sorted, bvtt\n", text)
        self.assertRegex(text, r"order +64\.3 % +64\.3 %")  # 9 of 14


class Ranks(unittest.TestCase):
    def test_of_equal_values_are_their_mean(self) -> None:
        self.assertEqual(list(effects.ranks(numpy.array([30.0, 10.0, 30.0, 20.0]))), [3.5, 1, 3.5, 2])
        self.assertAlmostEqual(effects.spearman([(1, 1), (2, 3), (2, 2), (3, 4)]), 4.5 / math.sqrt(4.5 * 5))
        self.assertAlmostEqual(effects.spearman([(1, 8), (2, 4), (3, 1)]), -1)
        self.assertTrue(all(map(math.isnan, (effects.spearman([(1, 1), (2, 2)]), effects.spearman([(1, 1), (1, 2), (1, 3)])))))

    def test_correlate_by_collider_within_a_kind_of_trees(self) -> None:
        of_kind = {IMPLICIT: ("oibvh-single", "perfect", "oibvh-multi"), POINTERS: ("karras", "hploc", "sah-binned")}
        those = cells([frame("s", (builder, "hilbert30", "sorted", collider), UNIT, UNIT * (place if collider == "leaf" else 9 - place),
                             sah_cost=(10 if kind == IMPLICIT else -10) * place, box_tests_count=place)
                       for kind, builders in of_kind.items() for place, builder in enumerate(builders, 1) for collider in ("leaf", "bvtt")]
                      + [frame("s", ("oibvh-wide4", "hilbert30", "sorted", "leaf"), UNIT, UNIT, sah_cost=99, box_tests_count=99)])
        for kind, leaf in ((IMPLICIT, 1), (POINTERS, -1), ("both", 0)):
            found = effects.correlations(those, "SAH cost", kind)
            self.assertAlmostEqual(found["leaf"]["s"], leaf)
            self.assertAlmostEqual(found["bvtt"]["s"], -leaf)
        self.assertAlmostEqual(effects.correlations(those, "box tests", "both")["leaf"]["s"], 1)
        self.assertEqual(effects.correlations(those, "end-point overlap", "both"), {})

    def test_are_those_of_any_experiment_that_measured_trees(self) -> None:
        run = run_of()
        run.document["cells"] = [one | {"experiment": "mine"} for one in golden("effects")["cells"]]
        self.assertTrue(effects_table.text(run).startswith("rank correlation with the time of the stage broad"))


class Shown(unittest.TestCase):
    def test_the_figure_has_a_row_a_level_and_a_dot_a_scene(self) -> None:
        style.set_up()
        run = run_of()
        run.document["cells"] = golden("effects")["cells"]
        run.cells = [one for one in run.all_cells if one.status == "measured"]
        left, right = drawing.draw(run).axes
        self.addCleanup(style.plt.close, "all")
        self.assertEqual([label.get_text() for label in left.get_yticklabels()],
                         ["", "hploc", "oibvh-wide4", "sah-binned", "", "morton30", "", "mesh", "", "bvtt"])
        dots = [line for line in left.lines if line.get_marker() == "."]
        self.assertEqual((len(dots), {len(line.get_xdata()) for line in dots}), (11, {3}))  # the host's tree has no frame
        self.assertEqual([text.get_text() for text in right.texts], [*MEASURES])
        self.assertRegex(effects_table.text(run), r"builder +sah-binned +oibvh-single +0\.8")
