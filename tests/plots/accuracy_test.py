"""Tests that figures of accuracy show every method, mark the best ones, and refuse wrong answers."""
import math
import statistics
import unittest

from matplotlib.legend import Legend

from base import GOLDEN, InFolder, golden  # first: it adds the source root to sys.path

from plots.draw import style
from plots.figures import accuracy, accuracy_frames, accuracy_narrow, catalog
from plots.figures.accuracy import Cost
from plots.read import results


class Cheapest(unittest.TestCase):
    def test_changes_where_a_better_tree_has_paid_for_its_build(self) -> None:
        quick, middle, slow = Cost(10, 10, "quick"), Cost(40, 5, "middle"), Cost(100, 2, "slow")
        useless = Cost(90, 4.9, "useless")
        best = accuracy.cheapest([useless, slow, middle, quick], 1000)
        self.assertEqual([(queries, cost.method) for queries, cost in best], [(1, "quick"), (6, "middle"), (20, "slow")])
        for queries in (1, 5, 7, 19, 21, 900):
            least = min((quick, middle, slow, useless), key=lambda cost: cost.of(queries))
            self.assertEqual([cost for start, cost in best if start <= queries][-1], least)
        self.assertEqual(len(accuracy.cheapest([useless, slow, middle, quick], 10)), 2)
        self.assertEqual(len(accuracy.cheapest([quick, slow._replace(query=10)], 1000)), 1)


class Figures(InFolder):
    def setUp(self) -> None:
        super().setUp()
        style.set_up()
        self.document = golden("accuracy")

    def run_of(self, cells: list[dict]) -> results.Run:
        return results.load(self.written(self.document | {"cells": cells}, "accuracy.json"))

    def axis(self, name: str) -> list[dict]:
        return [cell for cell in self.document["cells"] if cell["accuracy"]["axis"] == name]

    def drawn(self, name: str) -> accuracy.plt.Figure:
        figures = catalog.pictures_of(self.run_of(self.axis(name)))
        self.assertEqual(list(figures), [f"accuracy-{name}"])
        drawing = figures[f"accuracy-{name}"]()
        drawing.draw_without_rendering()
        return drawing

    def test_of_narrow_phases_show_each_methods_worst_and_typical_class(self) -> None:
        drawing = self.drawn("narrow")
        errors, times = drawing.axes
        methods = list(dict.fromkeys(cell["accuracy"]["method"] for cell in self.axis("narrow")))
        self.assertEqual(sorted(label.get_text() for label in errors.get_yticklabels()), sorted(methods))
        for axes, value in ((errors, accuracy_narrow.wrong), (times, accuracy_narrow.ns_a_pair)):
            self.assertEqual(len(axes.lines), 3 * len(methods))  # all classes, the worst and the median
            for row, (_, cells) in enumerate(accuracy_narrow.by_method(self.run_of(self.axis("narrow")).cells).items()):
                classes, worst, typical = axes.lines[3 * row:3 * row + 3]
                values = sorted(value(cell) for cell in cells)
                self.assertEqual(sorted(classes.get_xdata()), values)
                self.assertEqual((worst.get_xdata()[0], typical.get_xdata()[0]), (values[-1], statistics.median(values)))
        self.assertIn("150,000 pairs of triangles in 3 classes, seed 1", drawing.texts[0].get_text())
        self.assertIn("guigue-f64 needs doubles", drawing.texts[0].get_text())

    def test_of_sums_codes_and_input_show_all_that_was_measured(self) -> None:
        self.assertEqual([len(axes.lines) for axes in self.drawn("sums").axes], [7, 7])
        self.assertEqual([len(axes.lines) for axes in self.drawn("codes").axes[:2]], [13, 13])
        pairs, frame = self.drawn("input").axes
        self.assertEqual([list(line.get_xdata()) for line in pairs.lines], 2 * [[0, 1e3, 1e6]])
        self.assertEqual([max(line.get_ydata()) for line in pairs.lines], [10, 1])
        self.assertEqual(len(frame.lines), 2)

    def test_of_impacts_have_a_point_for_each_tolerance(self) -> None:
        drawing = self.drawn("impacts")
        for axes in drawing.axes:
            self.assertEqual(len(axes.lines), 4)  # the front and three tolerances
            self.assertEqual(sorted(line.get_ydata()[0] for line in axes.lines[1:]), [127, 4105, 411000])
        self.assertIn("0 right ones are missed", drawing.texts[0].get_text())

    def test_of_frames_have_false_contacts_above_the_band_of_none_and_missed_ones_below(self) -> None:
        drawing = self.drawn("frames")
        *scenes, legend = drawing.axes
        self.assertEqual([axes.get_title(loc="left").split("\n") for axes in scenes], [
            ["unc_cloth_ball", "92,230 triangles, 2 frames, 158,000 contacts"],
            ["funnel* (cloth-funnel:18484)", "18,484 triangles, 2 frames, 800 contacts"]])
        settings = accuracy_frames.settings_of([cell for cell in self.run_of(self.axis("frames")).cells
                                                if cell.scene == "unc_cloth_ball"])
        exact, narrow, none, boxes, coarse, everything = settings
        self.assertEqual((coarse.missed, coarse.false), (26000, 700000))  # of both frames
        self.assertAlmostEqual(exact.time.median, 0.33, places=5)  # mean of 0.30 and 0.36 ms
        heights = accuracy_frames.heights(settings)
        self.assertEqual([heights[setting.method] for setting in (exact, boxes)], [[accuracy_frames.NONE / 2], [-accuracy_frames.NONE / 2]])
        for setting, above, below in ((narrow, 0, 60), (none, 1400000, 0), (coarse, 700000, 26000), (everything, 6000, 5400)):
            expected = [sign * (accuracy_frames.ONE + math.log10(count)) for sign, count in ((1, above), (-1, below)) if count]
            self.assertEqual(heights[setting.method], expected, setting.method)
        points = sorted(point for line in scenes[0].lines if line.get_marker() not in ("None", "|", "")
                        for point in line.get_ydata())
        self.assertEqual(points, sorted(height for those in heights.values() for height in those))
        joins = sorted(tuple(line.get_segments()[0][:, 1]) for line in scenes[0].collections if line.get_linewidth()[0] == 0.6)
        band = 2 * [(-accuracy_frames.NONE, accuracy_frames.NONE)]  # of those without wrong contacts: no height
        self.assertEqual(joins, sorted(band + [(min(those), max(those)) for those in heights.values() if abs(those[0]) > accuracy_frames.NONE]))
        low, high = scenes[0].get_ylim()
        self.assertTrue(low < points[0] and points[-1] < high, (low, high, points))
        texts = [text.get_text() for one in legend.get_children() if isinstance(one, Legend) for text in one.get_texts()]
        self.assertIn("none: pairs of boxes", texts)
        self.assertIn("the scene in brackets stands in", drawing.texts[0].get_text())

    def test_refuse_an_exact_method_that_was_wrong_and_a_method_without_a_look(self) -> None:
        cells = self.axis("narrow")
        cells[0]["check"]["verdict"] = "differs"
        with self.assertRaises(results.Refused):
            self.run_of(cells)
        cells = self.axis("boxes")
        cells[1]["accuracy"]["method"] = "guess"
        with self.assertRaisesRegex(results.Refused, "no look for the method 'guess'"):
            catalog.pictures_of(self.run_of(cells))["accuracy-boxes"]()

    def test_a_file_without_an_axis_has_none(self) -> None:
        self.assertEqual(accuracy.draws_of(results.load(GOLDEN / "table1.json")), {})
