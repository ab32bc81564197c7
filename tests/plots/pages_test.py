"""Tests console tables and numbers, what `show` prints for axes of accuracy and for stress, what `reproduce` prints beside the
paper's numbers, how `show` reads and writes, and what a report says was found."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from typing import Any

import base  # first: it adds the source root to sys.path
from base import GOLDEN, ROOT, Raw, run_of

from plots.commands import show
from plots.console import accuracy_table, cells as cells_page, paper, stress_table, tree_costs
from plots.page import cell_data, findings, report, tables as page_tables
from plots.read import results
from plots.read.cells import Cell
from plots.words import tables
from plots.words.tables import Table, counted, duration, exact, size


class OfTables(unittest.TestCase):
    def test_words_stand_left_and_numbers_right_by_characters(self) -> None:
        table = Table("<name", "ms")
        for row in (["a–b", "1"], ["longer", "10"], ["c"]):
            table.row(*row)
        self.assertEqual(table.text(), "name    ms\na–b      1\nlonger  10\nc\n")

    def test_without_titles_there_are_only_rows(self) -> None:
        table = Table("<", "")
        table.row("a", "10")
        self.assertEqual(table.text(), "a  10\n")


class OfNumbers(unittest.TestCase):
    def test_have_three_digits_and_a_unit(self) -> None:
        self.assertEqual([duration(ns) for ns in (0, 950, 999.7, 71230, 1300000)],
                         ["0 ns", "950 ns", "1.00 us", "71.2 us", "1.30 ms"])
        self.assertEqual([size(512), size(6914400)], ["512 B", "6.91 MB"])
        self.assertEqual([counted(1, "cell"), counted(1200, "cell")], ["1 cell", "1,200 cells"])

    def test_exact_ones_have_the_digits_that_tell_them_from_others(self) -> None:
        self.assertEqual([exact(value) for value in (3.0, 0.1, 1e-7, 1234.5)], ["3", "0.1", "1e-07", "1234.5"])


def page(*cells: Raw) -> list[list[str]]:
    """Returns the words of each line."""
    return [line.split() for line in accuracy_table.text(run_of(*cells)).splitlines()]


def on_axis(axis: str, method: str, counters: dict[str, float], *samples: dict[str, int]) -> Raw:
    """Returns a cell of an axis. A sample maps stages to nanoseconds on the host; stages run one after the other."""
    return {"experiment": "accuracy", "operation": "accuracy", "scene": {"name": "slivers"}, "builder": {"name": "none"},
            "accuracy": {"axis": axis, "method": method, "seed": 5}, "status": "measured", "check": {"verdict": "counted"},
            "counters": counters,
            "samples": [{"order": 0, "stages": [{"stage": name, "wall_ns": ns} for name, ns in stages.items()]}
                        for stages in samples]}


def narrow(method: str, pairs: int, ns: int, missed: int = 0) -> Raw:
    return on_axis("narrow", method, {"pairs_count": pairs, "meeting_count": 3, "missed_count": missed, "false_count": 0,
                                   "narrow_exact_count": 0}, {"narrow": ns})


class OfNarrow(unittest.TestCase):
    def test_times_stand_beside_those_of_the_yardstick(self) -> None:
        _, yardstick, fast, *totals = page(narrow("guigue-f64", 10, 1000), narrow("guigue-f32", 10, 250, missed=2))
        self.assertEqual(yardstick[-3:], ["100.00", "1.00", "counted"])
        self.assertEqual(fast[-3:], ["25.00", "0.25", "counted"])
        self.assertEqual([" ".join(line) for line in totals], [
            "guigue-f64: 0 missed and 0 false of 10 pairs, wrong in 0 of 1 classes",
            "guigue-f32: 2 missed and 0 false of 10 pairs, wrong in 1 of 1 classes", "seed 5"])

    def test_a_class_without_pairs_and_a_time_of_0_are_told(self) -> None:
        _, none, no_time, *_ = page(narrow("guigue-f64", 0, 1000), narrow("guigue-f32", 10, 0))
        self.assertEqual(none, ["slivers", "guigue-f64", "0", "3", "0", "0", "inf", "nan", "counted"])
        self.assertEqual(no_time[-3:], ["0.00", "0.00", "counted"])

    def test_a_counter_that_must_be_there_is_missed(self) -> None:
        for key in ("pairs_count", "meeting_count", "missed_count", "false_count", "narrow_exact_count"):
            raw = narrow("guigue-f32", 10, 250)
            del raw["counters"][key]
            with self.assertRaisesRegex(KeyError, key):
                page(raw)


class OfCodes(unittest.TestCase):
    def test_a_build_is_all_but_the_query_of_samples_that_have_one(self) -> None:
        counters = {"duplicates_count": 1, "longest_run_count": 1, "box_tests_count": 1, "missed_count": 0, "false_count": 0}
        stages = {"codes": 1000, "sort": 2000, "broad": 50000}
        for samples, build, query in (((stages, stages), "3.00", "50.0"),
                                      ((stages, {"codes": 900000, "sort": 1}), "3.00", "50.0"),
                                      (({"codes": 1000, "sort": 2000},), "0", "0")):
            row = page(on_axis("codes", "morton30", counters, *samples))[1]
            times = [word for word, unit in zip(row, row[1:]) if unit in ("ns", "us", "ms")]
            self.assertEqual(times[1:], [build, query], row)


def cell(builder: str, ns: int = 100000, scene: str = "bunny", sah_cost: float | None = None, **facts: Any) -> Raw:
    return base.cell(builder, ns, scene={"name": scene, "triangles": 144046, **facts},
                     counters={"nodes_count": 288100} if sah_cost is None else {"sah_cost": sah_cost})


def data_of(*cells: Raw, **facts: Any) -> dict[str, Any]:
    """Returns what the report says about a made file."""
    made = base.document(*cells, **facts)
    merged = made["run"].pop("merged_from", [])
    return report.file_data(pathlib.Path("made.json"), made | {"merged_from": merged}, [Cell(one) for one in made["cells"]])


def found_in(*cells: Raw) -> dict[str, Any]:
    """Returns question, answer and rows of a file's only experiment."""
    found, = findings.findings_of([Cell(one) for one in base.document(*cells)["cells"]])
    return found


def answer_of(*cells: Raw) -> str:
    return found_in(*cells)["answer"]


class OfTheReport(unittest.TestCase):
    def test_shares_are_of_the_copy_rate_of_the_cells_own_run_and_those_of_show(self) -> None:
        runs = [{"id": name, "copy_rate_bytes_per_s": rate} for name, rate in (("slow", 7e11), ("fast", 2e12))]
        of_runs = (("oibvh-multi", "slow"), ("oibvh-single", "fast"), ("karras", "none"))
        made = [{**cell(builder), "run": run} for builder, run in of_runs]
        data = data_of(*made, merged_from=runs)
        self.assertEqual([one["copy_share"] for one in data["cells"]], [0.71429, 0.25, 0.5])
        run = results.Run(pathlib.Path("made.json"), base.document(*made) | {"merged_from": runs})
        shown = [re.search(r"[\d.]+ %", line)[0] for line in cells_page.text(run).splitlines()[1:4]]
        self.assertEqual(shown, ["71.4 %", "25.0 %", "50.0 %"])

    def test_what_moves_faster_than_a_copy_is_in_cache(self) -> None:
        self.assertEqual([tables.of_copy_rate(share) for share in (0.7, 1, 1.001)], [0.7, 1, "in cache"])
        self.assertEqual(data_of(cell("karras", 1000))["cells"][0]["copy_share"], "in cache")
        line = cells_page.text(run_of(cell("karras", 1000))).splitlines()[1]
        self.assertRegex(line, r" in cache +agrees$")
        self.assertNotIn("%", line)

    def test_the_answer_names_the_soonest_and_how_far_the_next_is_behind(self) -> None:
        self.assertEqual(answer_of(cell("karras", 100000), cell("perfect", 150000), cell("apetrei", 400000)),
                         "karras is soonest on bunny: 100 µs; the next, perfect, takes 1.50 times as long. "
                         "All 3 answers are right.")
        scenes = (("a", (100000, 120000)), ("b", (100000, 300000)), ("c", (500000, 400000)))
        several = [cell(builder, ns, scene) for scene, times in scenes for builder, ns in zip(("karras", "perfect"), times)]
        self.assertEqual(answer_of(*several),
                         "karras is soonest on 2 of 3 scenes, perfect on 1; the next takes 1.20 to 3.0 times as long, on 1 "
                         "within noise. All 6 answers are right.")
        self.assertEqual(answer_of(*several[:4]),
                         "karras is soonest on both scenes; the next takes 1.20 to 3.0 times as long, on 1 within noise. "
                         "All 4 answers are right.")
        self.assertIn(" takes 1.01 times as long, within noise.",
                      answer_of(cell("karras", 100000), cell("perfect", 101000)))
        self.assertEqual(answer_of(cell("karras", 100000)), "Only karras was measured: 100 µs. 1 answer is right.")

    def test_a_wrong_answer_is_not_the_best_and_a_librarys_is_named(self) -> None:
        wrong = {"check": {"verdict": "differs", "against": "contract"}}
        text = answer_of({**cell("karras", 100000), **wrong}, {**cell("embree-low", 100000), **wrong}, cell("perfect", 300000),
                         cell("fcl-aabb", 900000))
        self.assertEqual(text, "perfect is soonest on bunny: 300 µs; the next, fcl-aabb, takes 3.0 times as long; "
                               "the best library takes 3.0 times as long. 2 answers are right; 1 cell gave a wrong answer; "
                               "1 cell of Embree gave a wrong answer.")

    def test_table4_is_answered_by_costs(self) -> None:
        made = [{**cell(builder, 1000, sah_cost=cost), "experiment": "table4"}
                for builder, cost in (("oibvh-multi", 200), ("karras", 80))]
        self.assertEqual(answer_of(*made),
                         "karras has the lowest surface area cost on bunny: 80; the next, oibvh-multi, costs 2.5 times as much. "
                         "All 2 answers are right.")

    def test_sums_are_answered_by_errors_and_none_is_a_multiple_of_zero(self) -> None:
        made = [{**cell("none"), "accuracy": {"axis": "sums", "method": method}, "counters": {"relative_error": error}}
                for method, error in (("f32", 3e-7), ("f64", 1e-7), ("exact", 0))]
        self.assertEqual(answer_of(*made[:2]), "f64 errs least on bunny: 1e-07; the next, f32, errs by 3.0 times as much.")
        self.assertEqual(answer_of(*made), "exact errs least on bunny: 0.")
        self.assertEqual([row[6] for row in found_in(*made)["rows"]], [None])

    def test_of_frames_only_those_without_wrong_contacts_are_ranked(self) -> None:
        made = [{**cell("oibvh-single", ns), "accuracy": {"axis": "frames", "method": method}, "operation": "accuracy",
                 "counters": {"pairs_count": 9, "right_contacts_count": 3, "missed_count": missed, "false_count": false}}
                for method, ns, missed, false in (("exact", 300000, 0, 0), ("narrow none", 100000, 0, 6), ("input 8 bits", 200000, 1, 0),
                                                  ("boxes u8", 600000, 0, 0))]
        self.assertEqual(answer_of(*made), "exact is soonest on bunny: 300 µs; the next, boxes u8, takes 2.0 times as long.")
        self.assertEqual([one["errors"] for one in data_of(*made)["cells"]], [{"wrong contacts": count} for count in (0, 6, 1, 0)])

    def test_states_are_counted_by_library(self) -> None:
        failed = {"status": "failed", "reason": "why", "samples": []}
        data = data_of({**cell("embree-low"), **failed}, {**cell("karras"), **failed}, cell("perfect"))
        self.assertEqual([(one["state"], one["count"] + one["of"]) for one in data["states"]],
                         [("agrees", "1"), ("failed", "2, 1 of libraries: Embree 1")])

    def test_a_rank_needs_every_frame(self) -> None:
        made = [{**cell(builder, ns), "scene": {"name": "cloth", "triangles": 8, "frame": frame}}
                for builder, times in (("karras", (100000, 500000)), ("perfect", (200000, 300000)), ("apetrei", (1000,)))
                for frame, ns in enumerate(times)]
        answer = "perfect is soonest on cloth: 250 µs; the next, karras, takes 1.20 times as long"
        self.assertTrue(answer_of(*made).startswith(answer))
        made[-1] |= {"status": "failed", "reason": "why", "samples": []}
        self.assertTrue(answer_of(*made).startswith(answer))

        wrong = {"check": {"verdict": "differs", "against": "contract"}}
        self.assertEqual(answer_of(made[0], {**made[1], **wrong}), "1 answer is right; 1 cell gave a wrong answer.")

    def test_the_mean_of_frames_is_over_those_after_the_first(self) -> None:
        made = [{**cell("karras", ns), "scene": {"name": "cloth", "triangles": 8, "frame": frame}, "operation": "collide",
                 "collider": {"name": name, "options": {}}}
                for name, times in (("front", (900000, 100000, 300000)), ("leaf", (200000, 400000, 400000))) for frame, ns in enumerate(times)]
        self.assertIn("front over karras is soonest on cloth: 200 µs", answer_of(*made))
        cells = [cell_data.cell_data(Cell(one), 0) for one in base.document(*made)["cells"]]
        self.assertEqual([bar["whole"] for bar in cell_data.bars_of(cells)], [200000, 400000])
        summary, *_ = page_tables.tables_of(cells)
        self.assertEqual([row[5:7] for row in summary["rows"]], [[200, 900], [400, 400]])  # the mean and the slowest
        still = found_in(*made[::3])
        self.assertEqual((still["answer"], len(still["rows"])), ("Only leaf over karras was measured: 200 µs. All 2 answers are right.", 1))

    def test_cells_with_and_without_cold_caches_are_not_compared(self) -> None:
        made = [cell("karras", 100000), {**cell("karras", 900000), "sampling": {"caches": "cold"}}]
        self.assertEqual([row[3] for row in found_in(*made)["rows"]], [100, 900])

    def test_steps_swept_for_other_pairs_are_not_compared(self) -> None:
        made = [{**cell("karras"), "accuracy": {"axis": "swept", "method": "embree"}, "swept": {"pairs": pairs, "to_frame": 1}}
                for pairs in ("edge-edge", "vertex-face")]
        self.assertEqual([row[1] for row in found_in(*made)["rows"]], ["edge-edge", "vertex-face"])

    def test_a_narrow_phase_is_judged_before_it_is_ranked(self) -> None:
        made = [narrow("guigue-f64", 10, 1000), narrow("guigue-f32", 10, 250, missed=2), narrow("moller-f32", 10, 3000)]
        self.assertEqual(answer_of(*made),
                         "Right: guigue-f64 on 1 of 1 scene, moller-f32 on 1 of 1 scene, guigue-f32 on 0 of 1 scene. Of those that "
                         "are right: guigue-f64 is soonest on slivers: 1.00 µs; the next, moller-f32, takes 3.0 times as "
                         "long.")
        self.assertEqual(answer_of(made[1]), "Right: guigue-f32 on 0 of 1 scene.")


class OfTable1(unittest.TestCase):
    def test_stands_beside_the_paper_and_marks_stand_ins(self) -> None:
        run = run_of(cell("oibvh-multi"), cell("oibvh-single", scene="torus:144046", stand_in_for="bunny"))
        titles, *lines, about, mark = paper.table1(run).splitlines()
        self.assertEqual(titles.split()[3:], "nodes padding % paper ms p10–p90 Mtris/s moved % of copy paper ms".split())
        self.assertEqual([line.split() for line in lines], [
            "bunny 144,046 oibvh-multi 288,100 3.1e-3 3.1e-3 0.1000 0.0920–0.1080 1440 50.0 MB 50.0 % 0.077".split(),
            "bunny * 144,046 oibvh-single 288,100 3.1e-3 3.1e-3 0.1000 0.0920–0.1080 1440 50.0 MB 50.0 % 0.074".split()])
        self.assertEqual(about, "ms: the stage hierarchy from sorted leaves, median; paper ms: NVIDIA GeForce GTX 1080")
        self.assertTrue(mark.startswith("* a generated stand-in"))
        absent = [{**cell("perfect", scene=name), "status": "skipped"} for name in ("bunny", "no-mesh-of-the-paper")]
        self.assertEqual([line.split()[0] for line in paper.table1(run_of(*absent)).splitlines()], ["mesh", "bunny", "ms:"])

    def test_a_wrong_tree_has_no_time(self) -> None:
        wrong = {**cell("oibvh-multi"), "check": {"verdict": "differs"}}
        line = paper.table1(run_of(wrong)).splitlines()[1]
        self.assertEqual(line.split(), ["bunny", "144,046", "oibvh-multi", "288,100", "3.1e-3", "3.1e-3", "differs", "0.077"])

    def test_padding_is_cut_as_in_the_paper(self) -> None:
        perfect = Cell(cell("perfect"))
        perfect.counters["nodes_count"] = 524287
        self.assertEqual(paper.padding_text(paper.padding_percent(perfect)), "45.05")
        shares = (0, 100 * 7 / 825337, 100 * 10 / 2174947, 100 * 5 / 5759999, 0.01)
        self.assertEqual([paper.padding_text(share) for share in shares], ["0", "8.4e-4", "4.5e-4", "8.6e-5", "1.0e-2"])


class OfFig8(unittest.TestCase):
    def test_finds_the_size_from_which_multi_stays_ahead(self) -> None:
        made = [cell(builder, ns, triangles=1024 << size) for size, times in enumerate(((20, 25), (30, 29), (50, 51), (80, 70)))
                for builder, ns in zip(("oibvh-single", "oibvh-multi"), (1000 * time for time in times))]
        self.assertIn("oibvh-multi is faster than oibvh-single from about 4,480 triangles on;", paper.fig8(run_of(*made)))
        self.assertIn("oibvh-single and oibvh-multi do not cross here", paper.fig8(run_of(*made[:2])))
        printed = paper.fig8(run_of(*made, cell("oibvh-single-printed", 1000, triangles=4096)))
        self.assertIn("oibvh-multi is faster than oibvh-single from", printed)
        self.assertIn("oibvh-single-printed and oibvh-multi do not cross here", printed)


class OfTreeCosts(unittest.TestCase):
    def test_table4_stands_beside_the_paper_and_says_what_is_missing(self) -> None:
        buddha = "happy_buddha_1087716"
        absent = {**cell("apetrei-fused", sah_cost=0), "status": "skipped", "reason": "no such builder"}
        run = run_of(cell("apetrei-fused", scene=buddha, sah_cost=86.02), cell("oibvh-multi", scene=buddha, sah_cost=228.01),
                     cell("oibvh-single", scene=buddha, sah_cost=228.01), absent, cell("oibvh-multi", sah_cost=100))
        self.assertEqual(tree_costs.table4(run), (
            "mesh                    triangles  order     radix  paper  Oi-BVH   paper  times  paper\n"
            "happy_buddha_1087716 +    144,046  morton30  86.02  86.00  228.01  229.16   2.65   2.66\n"
            "bunny                     144,046  morton30                100.00                        skipped: no such builder\n"
            "surface area cost, an inner node 1.2, a triangle 1\n"
            "+ another edition of the paper's model, with another triangle count\n"))

    def test_table4_does_not_compare_costs_of_other_constants(self) -> None:
        made = [cell(builder, scene="buddha", sah_cost=90) for builder in ("apetrei-fused", "oibvh-multi")]
        usual, text = (tree_costs.table4(run_of(*made, **facts))
                       for facts in ({}, {"node_costs": {"inner": 2.5, "triangle": 1}}))
        self.assertEqual([len(page.splitlines()[1].split()) for page in (usual, text)], [9, 6])
        self.assertIn("an inner node 2.5, a triangle 1; the paper's are for others\n", text)

    def test_fig13_says_which_tree_suffers_more(self) -> None:
        made = [cell(builder, 1000, f"outlier:bunny:0:{far}", cost, outlier={"of": "bunny", "triangle": 0, "diameters": far})
                for far, costs in ((0, (10, 20)), (10, (10, 70))) for builder, cost in zip(("karras", "oibvh-single"), costs)]
        text = tree_costs.fig13(run_of(*made))
        self.assertIn("bunny  morton30         0       10.0  10.00   70.00   7.00\n", text)
        self.assertIn("relative to the radix tree's grows, from 2.00 to 7.00 times", text)


class OfGoldenFiles(unittest.TestCase):
    def test_the_axes_and_what_stress_found_have_their_pages(self) -> None:
        axes = results.everything(GOLDEN / "accuracy.json")
        self.assertEqual(show.pages(axes), accuracy_table.text(axes))
        self.assertEqual(sorted(set(re.findall(r"^seed \d+$", accuracy_table.text(axes), re.M))), ["seed 1"])
        self.assertIn("guigue-f64: 8,000 missed and 40 false of 150,000 pairs, wrong in 2 of 3 classes\n", accuracy_table.text(axes))
        self.assertRegex(accuracy_table.text(axes), r"\ngeneric +filter-f64\+exact +50,000 +20,000 +0 +0 +0.0 % +19.30 +0.41  agrees\n")
        self.assertRegex(accuracy_table.text(axes), r"\nunc_cloth_ball +input 8 bits +2 +990 us +1,600,000 +158,000 +26,000 +700,000 +counted\n")
        self.assertEqual(accuracy_table.text(results.everything(GOLDEN / "table1.json")), "")
        found = results.everything(GOLDEN / "stress.json")
        self.assertEqual(show.pages(found), stress_table.text(found))
        self.assertTrue(stress_table.text(found).endswith("9 cells of ours, all right\n"))

    def test_what_stress_found_wrong_of_ours_is_told_at_the_end(self) -> None:
        found = results.everything(GOLDEN / "stress.json")
        first, second = [one for one in found.stress if not one.get("library") and one["kind"] != "host"][:2]
        for one, verdict in ((first, "broken"), (second, "refused")):
            one["findings"] = {"pairs": {"verdict": verdict, "checked": 9, "wrong": 5, "missed": 2, "detail": "why"}}
        where = [f"{one['family']}: {one['scene']}, {one['system']}, pairs: why" for one in (first, second)]
        text = stress_table.text(found)
        self.assertTrue(text.endswith(f"\nWRONG {where[0]}\nrefused {where[1]}\n9 cells of ours, 1 wrong, 1 refused\n"))
        self.assertRegex(text, rf"(?m)^{re.escape(first['system'])} .* -2 \+3")


class OfTheCommand(unittest.TestCase):
    def show(self, path: pathlib.Path | str, code: int = 0, **environment: str) -> str:
        done = subprocess.run([sys.executable, ROOT / "plots", "show", path], encoding="utf-8", capture_output=True, check=False,
                              env={**os.environ, **environment})
        self.assertEqual(done.returncode, code, done)
        return done.stderr if code else done.stdout

    def test_a_path_is_named_as_it_was_given(self) -> None:
        for path in ("./no//where.json", ""):
            self.assertEqual(self.show(path, 3), f"bvhbench: the result file '{path}' cannot be read: No such file or directory\n")

    def test_of_a_folder_is_of_every_result_file_in_it(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "inner").mkdir()
            for place, golden in (("b.json", "table1"), ("inner/a.json", "pairs")):
                (folder / place).write_bytes((GOLDEN / f"{golden}.json").read_bytes())
            (folder / "none.json").write_text("[]")
            text = self.show(folder)
            alone = [self.show(folder / place) for place in ("b.json", "inner/a.json")]
            self.assertEqual(text, f"== {folder / 'b.json'}\n{alone[0]}\n== {folder / 'inner/a.json'}\n{alone[1]}")

    def test_is_in_utf_8_in_any_locale(self) -> None:
        path = GOLDEN / "pairs.json"
        self.assertIn("±", self.show(path))
        self.assertEqual(self.show(path, PYTHONIOENCODING="ascii"), self.show(path))

    def test_a_mark_before_the_text_is_passed_over(self) -> None:
        path = GOLDEN / "table1.json"
        with tempfile.NamedTemporaryFile() as file:
            file.write(b"\xef\xbb\xbf" + path.read_bytes())
            file.flush()
            self.assertEqual(self.show(file.name), self.show(path))
