"""Tests what `show` prints for result files."""
import copy
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from typing import Any

from base import GOLDEN, ROOT, Raw, cell, document, run_of, stage  # first: it adds the source root to sys.path

from plots.console import builder_table, cell as one_cell, cells, frame_table, run as run_page, skip_table, swept_table, trees
from plots.read import results, savings
from plots.read.cells import Cell


def frame(number: int = 0, builder: str = "oibvh-multi", ns: int = 1000000, **collider: Any) -> Raw:
    """Returns a frame of a collision; the query takes half of its time."""
    made = cell(builder, ns // 2, operation="collide", collider={"name": "group", "options": collider},
                counters={"pairs_count": 1000, "box_tests_count": 50000})
    made["scene"]["frame"] = number
    made["check"] = {"verdict": "agrees", "pairs_hash": "00000000000000aa"}
    for sample in made["samples"]:
        sample["stages"].append(stage("broad", ns // 2, 7))
    return made


def wrong(raw: Raw, detail: str = "node 3 is lost") -> Raw:
    return {**copy.deepcopy(raw), "check": {"verdict": "differs", "detail": detail}}


def shown(raw: Raw) -> str:
    return one_cell.text(Cell(raw), run_of(raw))


class OfARun(unittest.TestCase):
    def test_says_what_it_ran_on_and_what_spoils_times(self) -> None:
        self.assertNotIn("warning", run_page.text(run_of()))
        text = run_page.text(run_of(conditions={"warnings": ["the host is on battery"]}, test_hooks={"LATE": "1"},
                                    launch_cost_ns=4000, node_costs={"inner": 2.5, "triangle": 1.0}))
        for line in ("warning: the host is on battery", "NO RESULT: made under the test hook LATE=1", "launch cost: 4.00 us",
                     "copy rate: 1000.0 GB/s, read plus written", "costs in sah_cost and epo: an inner node 2.5, a triangle 1"):
            self.assertIn(f"{line}\n", text)

    def test_a_merged_one_says_where_its_cells_are_from(self) -> None:
        run = run_of()
        self.assertEqual(run_page.merged(run), "")
        run.document["merged_from"] = [{"host": host, "device": "GPU", "driver": "1", "commit": commit, "dirty": host == "b"}
                                       for host, commit in (("a", "1" * 40), ("b", "2" * 40))]
        self.assertEqual(run_page.merged(run), "merged from 2 runs on a; b\n"
                                               "of several commits:  1111111111; 2222222222 with changes\n")


class OfACell(unittest.TestCase):
    def test_has_stages_counters_and_verdict(self) -> None:
        self.assertEqual(shown(cell()), (
            "oibvh-multi on bunny, 144,046 triangles\n"
            "stage      median      p10       q1      q3     p90  launches    bytes   GB/s  % of copy  queued  submitted\n"
            "hierarchy  100 us  92.0 us  95.0 us  105 us  108 us         2  50.0 MB  500.0     50.0 %\n"
            "3 samples; quartiles 10.0 % apart\n"
            "counters: nodes_count 288,100, scratch_bytes 0, tree_bytes 6,914,400\n"
            "verdict: agrees with oibvh-reference, tree 00000000000000ff\n"))

    def test_says_why_there_are_no_more_samples_and_leaves_out_those_beside_drift(self) -> None:
        raw = cell(first={"compile_ns": 2000, "run_ns": 3000000}, sampling={"stopped": "noisy", "until": 0.02, "caches": "cold"})
        raw["samples"][0]["drifted"] = True  # the slowest
        for sample, queued in zip(raw["samples"][1:], (4000, 6000)):
            sample["stages"][0] |= {"queued_ns": queued, "submitted_ns": 700}
        self.assertIn("3 samples, cold caches, 1 of them beside drift of the device and left out here; "
                      "quartiles 5.3 % apart and staying so, above 2.0 %\n"
                      "first run 3.00 ms on the host's clock, kernels compiled in 2.00 us\n", shown(raw))
        self.assertRegex(shown(raw), r"hierarchy  95\.0 us .* 5\.00 us +700 ns\n")
        raw["samples"][1]["stages"][0]["moved_bytes"] = 7  # bytes come from the first sample, even if it is left out
        self.assertRegex(cells.text(run_of(raw)), r" 95\.0 us .* 526\.3 +52\.6 %  agrees\n")
        raw["samples"][1]["drifted"] = True  # most have drift: then none is left out
        self.assertIn("hierarchy  100 us", shown(raw))
        self.assertNotIn("left out", shown(raw))
        raw["samples"][1:] = [{"order": 8, "stages": []}] * 2
        self.assertRegex(shown(raw), r"\nhierarchy +0 ns +0 ns ")

    def test_says_what_is_missing_and_where_the_leaves_are(self) -> None:
        self.assertIn("no epo: not asked for\nlevels of leaves: 1–3, half by 3\nverdict: ",
                      shown(cell(left_out={"epo": "not asked for"}, leaves_by_depth=[0, 1, 2, 4])))
        self.assertEqual([one_cell.depths(leaves) for leaves in ([0, 3, 2, 1], [0, 0, 7], [])], ["1–3, half by 1", "2", ""])

    def test_has_no_time_if_its_tree_is_wrong(self) -> None:
        self.assertEqual(re.findall(r"\d us", shown(wrong(cell()))), [])
        self.assertIn("verdict: differs: node 3 is lost\n", shown(wrong(cell())))


class OfCells(unittest.TestCase):
    def test_never_has_a_time_of_a_wrong_tree(self) -> None:
        failed = {**cell("perfect"), "status": "failed", "reason": "out of memory"}
        titles, right, *others, end = cells.text(run_of(cell(), wrong(cell("oibvh-single")), failed)).splitlines()
        self.assertEqual(titles.split()[3:], "median p10 q1 q3 p90 n Mtris/s ns/tri GB/s % of copy verdict".split())
        self.assertEqual(re.split("  +", right), [
            "bunny", "144,046", "oibvh-multi", "100 us", "92.0 us", "95.0 us", "105 us", "108 us", "3", "1440.5", "0.69", "500.0",
            "50.0 %", "agrees"])
        self.assertEqual([line.split() for line in others], [
            ["bunny", "144,046", "oibvh-single", "differs", "node", "3", "is", "lost"],
            ["bunny", "144,046", "perfect", "failed", "out", "of", "memory"]])
        self.assertEqual(end, "3 cells, 1 agree")

    def test_of_many_only_those_that_need_a_look_have_a_line(self) -> None:
        many = [cell() for _ in range(cells.MOST_LINES + 1)]
        self.assertEqual(cells.text(run_of(*many)), "101 cells, 101 agree\n")
        many[5] = wrong(many[5])
        self.assertEqual(len(cells.text(run_of(*many)).splitlines()), 3)
        self.assertEqual(len(cells.text(run_of(*many[:20])).splitlines()), 22)

    def test_of_many_builds_each_builder_has_a_line_relative_to_the_best_of_a_scene(self) -> None:
        costs = {"oibvh-multi": (20, 200), "oibvh-wide8": (10, 25), "karras": (10, 100)}
        built = [cell(name) for name in costs for _ in (0, 1)]
        for place, one in enumerate(built):
            one["scene"]["name"], one["counters"]["sah_cost"] = f"s{place % 2}", costs[one["builder"]["name"]][place % 2]
        lines = cells.text(run_of(*17 * built)).splitlines()
        self.assertEqual([line.split() for line in lines[1:4]], [["oibvh-multi", "34", "4.00", "1.00"], ["oibvh-wide8", "34", "1.00°", "1.00"],
                                                                 ["karras", "34", "2.00", "1.00"]])
        self.assertIn("not comparable", lines[5])
        self.assertEqual([line.split()[3] for line in cells.text(run_of(*built)).splitlines()[1:4]], ["20.00", "200.00", "10.00°"])
        self.assertEqual(cells.text(run_of(*17 * built), only_wrong=True).splitlines()[-1], "102 cells, 102 agree")

    def test_frames_have_a_table_of_their_own_unless_they_are_wrong(self) -> None:
        self.assertEqual(len(cells.text(run_of(cell(), frame())).splitlines()), 3)
        self.assertIn("group over oibvh-multi", cells.text(run_of(cell(), wrong(frame()))))


class OfFrames(unittest.TestCase):
    def test_those_of_a_pipeline_are_a_line_with_the_mean_and_deviation_of_their_medians(self) -> None:
        absent = frame(1, ns=3000000, jump=0)  # a file may omit an option with its default value
        titles, line = frame_table.text(run_of(frame(0), absent)).splitlines()
        self.assertEqual(titles.split(), "scene pipeline frames first ms ± broad up back MB pairs contacts peak BVTT verdict".split())
        self.assertEqual(line.split(), "bunny group over oibvh-multi 2 1.000 3.000 0.000 1.500 1,000 agrees".split())
        three = frame_table.text(run_of(frame(0), frame(1), absent | {"scene": {**absent["scene"], "frame": 2}})).splitlines()[1]
        self.assertEqual(three.split()[4:9], ["3", "1.000", "2.000", "1.000", "1.000"])  # over the last two
        copied = frame(0)
        copied["counters"] |= {"upload_ns": 1234000, "read_back_ns": 5000}
        self.assertEqual(frame_table.text(run_of(copied)).splitlines()[1].split()[5:9], ["1.000", "0.000", "0.500", "1.234"])
        self.assertEqual(frame_table.text(run_of(cell())), "")
        blank = frame_table.text(run_of(frame(0), {**frame(1), "status": "failed", "reason": "no memory"})).splitlines()[1]
        self.assertEqual(blank.split()[4:], ["2", "1.000", "1,000", "failed:", "no", "memory"])

    def test_that_round_have_times_and_their_errors_of_all_frames(self) -> None:
        counted = [{**frame(number), "check": {"verdict": "counted"}} for number in (0, 1)]
        for one, missed, false in zip(counted, (1, 2), (30, 400)):
            one["counters"] |= {"missed_count": missed, "false_count": false}
        line = frame_table.text(run_of(*counted)).splitlines()[1]
        self.assertIn("1.000", line)
        self.assertTrue(line.endswith("counted: 3 missed, 430 false"), line)

    def test_of_bvtt_say_where_it_started_whoever_chose_that(self) -> None:
        def named(level: int, **options: object) -> str:
            one = frame(0)
            one["collider"] = {"name": "bvtt", "options": options}
            one["counters"] |= {"used_start_level": level, "used_jump": 1}
            return run_of(one).all_cells[0].called

        self.assertEqual(named(8), "bvtt (jump 1, from level 8) over oibvh-multi")
        self.assertEqual(named(4, start_level=4), "bvtt (jump 1, from level 4) over oibvh-multi")
        self.assertEqual(named(0, no_skip="apart, start-level"), "bvtt (without apart, jump 1, from the root) over oibvh-multi")

    def test_of_collide_name_their_pipeline_once_and_end_with_a_mean(self) -> None:
        one, other = frame(0), frame(1, ns=3000000)
        other["counters"]["pairs_count"] = 2000
        name, titles, *rows = frame_table.each(run_of(one, other)).splitlines()
        self.assertEqual((name, titles.split()[:2]), ("group over oibvh-multi on bunny", ["frame", "median"]))
        self.assertEqual([row.split()[0] for row in rows], ["0", "1", "mean"])
        self.assertEqual(rows[-1].split(), "mean of later 3.00 ms 2,000".split())
        self.assertNotIn("mean", frame_table.each(run_of(one)))
        self.assertNotIn("mean", frame_table.each(run_of(one, wrong(other))), "a mean over some of the frames")
        several = frame_table.each(run_of(one, frame(1), frame(0, jump=2), frame(1, jump=2)))
        self.assertEqual(several.count("mean"), 2)

    def test_the_paper_stands_below_a_scene_that_it_has(self) -> None:
        raw = frame()
        raw["scene"] |= {"name": "cloth-funnel:18484", "stand_in_for": "funnel"}
        text = frame_table.text(run_of(raw), "table2")
        self.assertIn("cloth-funnel:18484 for funnel", text)
        printed = [row for row in results.printed("table2")["rows"] if row["scene"] == "funnel"]
        self.assertEqual(re.findall(r"paper: .*?  +\d+ +([0-9.]+) ", text), [f"{row['frame_ms']:.3f}" for row in printed])
        self.assertTrue(printed)

    def test_a_rule_is_held_to_the_same_frame_with_it(self) -> None:
        without = frame(ns=3000000, no_skip="near")
        without["counters"] |= {"entered_count": 150046, "box_tests_count": 90000}
        text = skip_table.text(run_of(frame(), without))
        self.assertEqual(text.splitlines()[2].split(),
                         "bunny 0 near 6,000 0 0 0 0 0 40,000 1.00 ms 3.00 ms 3.00 the same group over oibvh-multi".split())
        without["check"]["pairs_hash"] = "00000000000000bb"
        self.assertIn("NOT the same", skip_table.text(run_of(frame(), without)))
        saves_little = frame(ns=3000000, no_skip="near")
        for tests, is_noise in ((50040, True), (50060, False)):
            saves_little["counters"]["box_tests_count"] = tests
            self.assertEqual("nothing to skip" in skip_table.text(run_of(frame(), saves_little)), is_noise)
        self.assertEqual(skip_table.text(run_of(frame(1), without)), "")

    def test_rules_of_the_experiment_have_a_row_a_pipeline_and_one_that_had_to_be_forced_says_so(self) -> None:
        text, by_rule = skip_table.of_scenes(results.load(GOLDEN / "skips.json")).split("by rule:\n")
        _, titles, *rows = text.splitlines()
        self.assertEqual([re.split("  +", row) for row in by_rule.splitlines()[1:]], [
            ["near, forced", "n-body:61000:8", "1", "triangles", "80 %", "0.77"], ["apart", "n-body:61000:8", "1", "box tests", "94 %", "8.00"],
            ["overlap", "n-body:61000:8", "1", "box tests", "44 %", "1.10"]])
        self.assertEqual(titles.split()[-1], "pipeline")
        self.assertEqual([row.split()[2] for row in rows[:-1]], ["apart", "near,", "overlap"])
        self.assertRegex(rows[0], r"apart .* 45,960 +1,500,000 .* 8\.0\d +the same +bvtt over oibvh-multi$")
        self.assertRegex(rows[1], r"near, forced +49,000 .* 0\.77 +the same +group over oibvh-multi$")
        self.assertEqual(rows[-1], "nothing to skip on n-body:61000:8: empty-queue")
        self.assertEqual(skip_table.of_scenes(run_of(frame(), frame(no_skip="near"))), "", "of other experiments there is none")

    def test_a_rule_counts_where_it_skips_something(self) -> None:
        raws = [frame(number, ns=ns, no_skip=rule) for number, ns, rule in
                ((0, 1000000, ""), (0, 1000000, "near"), (1, 1000000, ""), (1, 2000000, "near"))]
        raws[3]["counters"]["entered_count"] = 150046
        found = savings.of_scenes(map(Cell, raws))
        self.assertEqual([(len(one.frames), savings.times(one)) for one in found], [(1, 2.0)])

    def test_each_builder_has_its_best_collider(self) -> None:
        group, leaf, host = frame(ns=3000000), frame(ns=2000000), cell("sah-binned")
        leaf["collider"]["name"] = "leaf"
        build = cell(counters={"tree_bytes": 3000000, "scratch_bytes": 1000000, "device_peak_bytes": 5000000, "sah_cost": 20.5})
        every = [{**raw, "experiment": "builders"} for raw in (build, host, group, leaf, wrong(frame(ns=1)))]
        _, titles, own, other = builder_table.text(run_of(*every)).splitlines()
        self.assertEqual(re.split("  +", own), ["bunny", "oibvh-multi", "device", "1440.5", "1440.5", "5.00 MB", "4.00 MB", "3.00 MB",
                                                "20.50", "-", "1.000", "2.000", "leaf"])
        self.assertEqual(other.split()[-3:], ["-", "-", "-"])
        self.assertEqual(builder_table.text(run_of(cell())), "")

    def test_queries_of_swept_boxes_are_added_up(self) -> None:
        pair = [frame(pairs_of=among) for among in ("between", "within")]
        for raw, pairs in zip(pair, ("vertex-face", "edge-edge")):
            raw["swept"] = {"pairs": pairs, "to_frame": 1, "primitives": 300}
        pair[0]["counters"] |= {"ground_truth_pairs": 10, "ground_truth_missed": 0}
        _, *lines = swept_table.text(run_of(*pair)).splitlines()
        self.assertEqual([line.split() for line in lines], [
            "bunny 0 vertex-face group over oibvh-multi 300 1,000 0.500 1.000 1.0 10 0 100.0 agrees".split(),
            "bunny 0 edge-edge group over oibvh-multi 300 1,000 0.500 1.000 1.0 agrees".split(),
            "both 600 2,000 1.000 2.000 1.0".split()])
        self.assertEqual(len(swept_table.text(run_of(pair[0])).splitlines()), 2)
        self.assertEqual(frame_table.text(run_of(*pair)), "")


class OfTrees(unittest.TestCase):
    def test_their_quality_is_there_if_end_point_overlap_is(self) -> None:
        raw = cell(leaves_by_depth=[0, 0, 4])
        raw["builder"]["options"] = {"order": "hilbert30"}
        raw["counters"]["sah_cost"] = 90
        self.assertEqual(trees.quality(run_of(raw)), "")
        raw["counters"]["epo"] = 12.345
        self.assertEqual(trees.quality(run_of(raw)), (
            "scene  builder                   SAH    EPO  sibling overlap  levels of leaves\n"
            "bunny  oibvh-multi, hilbert30  90.00  12.35                   2\n"))

    def test_kernels_are_held_to_threads_of_the_host_where_trees_are_equal(self) -> None:
        other = cell("karras", 400000)
        other["check"]["tree_hash"] = "000000000000007f"
        unchecked = cell("oibvh-single", 900000)
        unchecked["check"]["verdict"] = "not_checked"
        run = run_of(cell("oibvh-multi", 125000), cell("oibvh-host"), other, unchecked)
        self.assertEqual(trees.yardstick(run), (
            "scene  triangles  builder      hierarchy  oibvh-host  times\n"
            "bunny    144,046  oibvh-multi     125 us      100 us   1.25\n"
            "medians of the stage hierarchy, of trees that are equal: at most 1.25 times as long as by threads of the host\n"))
        self.assertEqual(trees.yardstick(run_of(cell("oibvh-multi"))), "")

    def test_a_rebuild_stands_beside_a_refit_by_the_same_builder(self) -> None:
        rebuild, again = cell("karras", 300000), cell("karras", 200000, operation="refit")
        rebuild["counters"]["sah_cost"], again["counters"]["sah_cost"] = 50, 51.5
        for sample in rebuild["samples"]:
            sample["stages"].append(stage("sort", 100000))
        for sample in again["samples"]:
            sample["stages"][0]["stage"] = "refit"
        other = {**again, "builder": {"name": "karras", "options": {"order": "morton63"}}}  # has no rebuild to be compared with
        _, line, *note = trees.refits(run_of(rebuild, other, wrong(again), again)).splitlines()
        self.assertEqual(line.split(), "bunny 144,046 karras 400 us 200 us 2.00 300 us 200 us 1.50 50.00 51.50".split())
        self.assertEqual(note[1], "rebuilding takes longer than refitting in 1 of 1 cases")
        self.assertEqual(trees.refits(run_of(rebuild, other, wrong(again))), "")
        self.assertTrue(shown(again).startswith("karras, refit on bunny"))


class OfFloors(unittest.TestCase):
    def of(self, *all_cells: Raw, **facts: Any) -> list[list[str]]:
        for raw in all_cells:
            raw["experiment"] = "roofline"
        return [line.split() for line in trees.roofline(run_of(*all_cells, **{"launch_cost_ns": 4000, **facts})).splitlines()[2:]]

    def test_are_bytes_at_the_copy_rate_and_launches_at_their_cost(self) -> None:
        self.assertEqual(self.of(cell()), ["bunny oibvh-multi hierarchy 2 50.0 MB 347.1 58.0 us 100 us 1.72".split()])
        self.assertEqual(trees.roofline(run_of(cell())), "", "of another experiment")

    def test_are_of_the_query_alone_where_frames_have_a_tree(self) -> None:
        lines = self.of(frame(), frame(builder="none"))
        self.assertEqual([(set(line) & {"broad", "hierarchy"}).pop() for line in lines], ["broad", "hierarchy", "broad"])

    def test_there_is_none_of_what_is_wrong_on_the_host_or_without_bytes(self) -> None:
        on_host, moves_nothing = cell(), cell()
        for one, other in zip(on_host["samples"], moves_nothing["samples"]):
            one["stages"] = [{"stage": "hierarchy", "wall_ns": 100}]
            del other["stages"][0]["moved_bytes"]
        self.assertEqual(self.of(wrong(cell()), on_host, moves_nothing), [])
        self.assertEqual(self.of(cell(), copy_rate_bytes_per_s=0), [])


class OfAFile(unittest.TestCase):
    def show(self, made: Raw, code: int = 0) -> str:
        with tempfile.TemporaryFile() as file:  # without a name, like those that the program passes
            file.write(json.dumps(made).encode())
            file.flush()
            done = subprocess.run([sys.executable, ROOT / "plots", "show", f"/proc/{os.getpid()}/fd/{file.fileno()}"], text=True,
                                  capture_output=True, check=False)
        self.assertEqual(done.returncode, code, done)
        return done.stdout if code == 0 else done.stderr

    def test_decides_which_pages_there_are(self) -> None:
        frame_of_collide = {**frame(no_skip="near"), "experiment": "collide"}
        other = {**frame(ns=900000), "experiment": "collide"}
        self.assertIn("verdict: agrees, pairs ", self.show(document(frame_of_collide)))
        two = self.show(document(other, frame_of_collide))
        self.assertRegex(two, r"\ngroup over oibvh-multi on bunny\nframe .*\n +0 +900 us .* agrees, pairs 00000000000000aa\n")
        self.assertIn("\nskips:\n", two)
        self.assertNotIn("cells, ", two)
        mixed = self.show(document(other, {**frame_of_collide, "experiment": "table2"}))
        self.assertIn("2 cells, 2 agree", mixed)
        self.assertNotIn("skips:", mixed)
        self.assertIn("verdict: ", self.show(document(cell())))
        self.assertIn("\n2 cells, 1 agree\n", self.show(document(cell(), wrong(cell()))))

    def test_times_of_years_and_a_cell_without_samples_are_shown(self) -> None:
        made = document(cell(ns=6 * 10**17))
        self.assertIn("600000000 s", self.show(made))
        made["cells"][0]["samples"] = []
        self.assertIn("verdict: agrees", self.show(made))

    def test_a_counter_that_must_be_there_is_missed_in_a_sentence(self) -> None:
        raw = cell(operation="accuracy", accuracy={"axis": "sums", "method": "f32"})
        self.assertRegex(self.show(document(raw), code=3), "^bvhbench: .* a cell has no 'sah_cost'\n$")
