"""Tests that the figure of orders shows every point, marks the best ones, and keeps its numbers apart."""
import copy
import itertools
import math
import random
import re
import unittest

from base import ROOT, InFolder, golden  # first: it adds the source root to sys.path

from plots.draw import figure, labels, style
from plots.figures import pareto_orders
from plots.read import pareto, results
from plots.words import names
from matplotlib.text import Text

ORDERS = names.ORDERS


class Labels(unittest.TestCase):
    def test_cover_neither_each_other_nor_points(self) -> None:
        noise = random.Random(4)
        frame = labels.Box(0, 0, 170, 120)
        points = [(noise.gauss(60, 14), noise.gauss(50, 14)) for _ in range(28)]
        texts = [str(number) for number in range(1, 29)]
        found = labels.offsets(points, texts, frame, [])
        boxes = [labels.box_at(x + dx, y + dy, text) for (x, y), (dx, dy), text in zip(points, found, texts)]
        for one, other in itertools.combinations(boxes, 2):
            self.assertEqual(labels.shared(one, other), 0)
        for box, (x, y) in itertools.product(boxes, points):
            self.assertFalse(labels.meets(box, (x, y), (x, y)))
        for box in boxes:
            self.assertAlmostEqual(labels.shared(box, frame), box.area)

    def test_are_nearest_to_their_own_point(self) -> None:
        points = [(40.0, 50.0), (48.0, 50.0), (60.0, 50.0)]
        found = labels.offsets(points, ["1", "2", "3"], labels.Box(0, 0, 100, 100), [])
        for (x, y), (dx, dy) in zip(points, found):
            place = (x + dx, y + dy)
            self.assertEqual(min(points, key=lambda point: math.dist(point, place)), (x, y))

    def test_keep_off_lines(self) -> None:
        line = ((50.0, 0.0), (50.0, 100.0))
        (dx, dy), = labels.offsets([(50.0, 50.0)], ["10"], labels.Box(0, 0, 100, 100), [line])
        self.assertFalse(labels.meets(labels.box_at(50 + dx, 50 + dy, "10"), *line))

    def test_know_the_lines_that_meet_a_box(self) -> None:
        box = labels.Box(0, 0, 2, 1)
        for start, end, expected in (((-1, 0.5), (3, 0.5), True), ((1, 0.5), (1, 0.6), True), ((-1, 2), (3, 2), False),
                                     ((-1, 0), (1, 3), False), ((3, 0), (5, 1), False), ((1, -1), (1, 2), True)):
            self.assertEqual(labels.meets(box, start, end), expected, (start, end))


class Figure(InFolder):
    def setUp(self) -> None:
        super().setUp()
        style.set_up()
        self.document = golden("quality")

    def many(self, with_tests: bool) -> results.Run:
        """Returns fourteen orders of two builders on two scenes, one order much worse than all others, and a host builder."""
        noise = random.Random(6)
        scenes = list(dict.fromkeys(cell["scene"]["name"] for cell in self.document["cells"]))[:2]
        cells = []
        for scene, builder, order in itertools.product(scenes, ("oibvh-multi", "apetrei-fused", "sah-binned"), ORDERS):
            if builder == "sah-binned" and order != ORDERS[0]:
                continue
            cell = copy.deepcopy(next(c for c in self.document["cells"] if c["scene"]["name"] == scene))
            cell["builder"] = {"name": builder, "options": {"order": order}}
            worse = 9 if order == ORDERS[11] else 1
            cell["counters"]["sah_cost"] = worse * noise.uniform(100, 140)
            time = int(noise.uniform(2e5, 3e5))
            stage = {"stage": "hierarchy", "launches": 1, "busy_ns": time, "span_ns": time, "moved_bytes": 1}
            if builder == "sah-binned":
                stage = {"stage": "hierarchy", "wall_ns": 400 * time}
            elif with_tests:
                cell["counters"]["box_tests_count"] = int(worse * noise.uniform(1e6, 2e6))
            cell["samples"] = [{"order": 0, "stages": [stage]}]
            cells.append(cell)
        return results.load(self.written(self.document | {"cells": cells}, "quality.json"))

    def test_shows_every_point_with_its_number(self) -> None:
        drawing = pareto_orders.draw(self.many(with_tests=False))
        device, host = drawing.axes[:2]
        self.assertEqual(len(drawing.axes), 4)
        self.assertEqual(len(device.lines) - 1, 32)  # without the front
        self.assertEqual(sorted(int(text.get_text()) for text in device.texts), sorted(2 * list(range(1, 17))))
        self.assertEqual((len(host.lines) - 1, len(host.texts)), (1, 0))
        low, high = device.get_ylim()
        for line in device.lines:
            self.assertTrue(all(low < y < high for y in line.get_ydata()))

    def test_numbers_builders_that_sort_and_has_no_wide_one_on_the_front(self) -> None:
        run = self.many(with_tests=False)
        for cell in run.cells:
            cell.builder = {"apetrei-fused": "hploc", "oibvh-multi": "oibvh-wide8"}.get(cell.builder, cell.builder)
        device = pareto_orders.draw(run).axes[0]
        self.assertEqual(len(device.texts), 32)
        wide = [line for line in device.lines if line.get_marker() == style.look("oibvh-wide8").marker]
        self.assertEqual([(len(wide), line.get_markerfacecolor()) for line in wide], 16 * [(16, "white")])

    def test_numbers_an_order_alike_in_all_files(self) -> None:
        catalog = (ROOT / "builders" / "orders.cpp").read_text(encoding="utf-8")
        self.assertEqual(tuple(re.findall(r'^    \{"([^"]+)", ', catalog, re.MULTILINE)), names.ORDERS)
        self.assertEqual(names.numbers(["morton63", "mine", "morton30-axis"]), {"morton63": 3, "morton30-axis": 7, "mine": 17})
        self.assertEqual(names.numbers(["morton30-axis", "morton63"]), {"morton63": 3, "morton30-axis": 7})

    def test_has_a_second_row_for_box_tests_and_keeps_its_numbers_apart(self) -> None:
        drawing = pareto_orders.draw(self.many(with_tests=True))
        names = [axes.get_ylabel() for axes in drawing.axes if axes.get_ylabel()]
        self.assertEqual(sorted(names), 2 * ["box tests of a query"] + 2 * ["surface area cost"])
        self.assertEqual(len(drawing.axes), 6)  # no query uses a host builder's tree
        drawing.draw_without_rendering()
        for axes in drawing.axes:
            # Boxes of the texts without leader lines. Digits are lower than their line height.
            boxes = [labels.Box(*Text.get_window_extent(text).padded(-1).extents) for text in axes.texts]
            for one, other in itertools.combinations(boxes, 2):
                self.assertEqual(labels.shared(one, other), 0)

    def test_fills_what_no_other_is_as_good_as(self) -> None:
        run = self.many(with_tests=False)
        points = pareto_orders.points_of([cell for cell in run.cells if cell.scene == run.cells[0].scene])
        best = pareto.front(points)
        for time, cost, cell in points:
            beaten = any(t <= time and c <= cost and other is not cell for t, c, other in points)
            self.assertEqual(any(cell is other for _, _, other in best), not beaten)

    def test_takes_few_round_numbers_for_an_axis(self) -> None:
        self.assertEqual(figure.ticks_between(0.16, 0.42, 6), [0.2, 0.25, 0.3, 0.4])
        self.assertEqual(figure.ticks_between(4, 600, 3), [10, 100])
        self.assertEqual(figure.ticks_between(0.1, 2, 6), [0.1, 0.2, 0.5, 1, 2])
