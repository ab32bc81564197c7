"""Tests the ranking of builders and pipelines, the sentence and the tables made of it, and the candidates of `best`."""
import json
import unittest
from typing import Any

from base import ROOT, InFolder, Raw, cell, document, run_of, stage  # first: it adds the source root to sys.path

from plots.console import best_table as page
from plots.console import run as circumstances
from plots.draw import style
from plots.figures import best_bars, overview
from plots.racing import alone, candidates
from plots.read import families, ranking, ranking_text, results
from plots.read.cells import Cell


def frame(name: str, times: list[int], builder: str = "oibvh-multi", scene: str = "bunny", number: int = 0, order: int = 0,
          memory: int = 0, stopped: str = "", options: dict[str, Any] | None = None, **more: Any) -> Raw:
    """Returns a frame of a collision with these times in microseconds, of which the query takes half."""
    made = cell(builder, operation="collide", collider={"name": name, "options": {}}, **more)
    made["builder"]["options"] = options or {}
    made["scene"] = {"name": scene, "triangles": 70, "frame": number}
    made["samples"] = [{"order": order + place, "stages": [stage("hierarchy", 500 * time), stage("broad", 500 * time, start_ns=500 * time)]}
                       for place, time in enumerate(times)]
    made.setdefault("counters", {})["memory_bytes"] = memory
    if stopped:
        made["sampling"] = {"stopped": stopped, "caches": "hot", "race": "whole"}
    return made


def ranked(*raw: Raw, objective: str = "frame") -> ranking.Ranking:
    return ranking.ranked([Cell(one) for one in raw], objective)


def names(found: ranking.Ranking) -> list[str]:
    return [row.first.collider or row.first.builder for row in found.rows]


NARROW = [98, 99, 100, 101, 102]


class TheFilesOfFamilies(unittest.TestCase):
    def test_have_enough_samples_of_the_best(self) -> None:
        """The README quotes their medians (results/quotes/README.py)."""
        for machine in ("h200", "pocl-2-cores"):
            found = ranking.ranked(results.load(ROOT / "results" / machine / "families.json.xz").frames("families"))
            self.assertEqual(list(found.scenes), ["bunny", "unc_cloth_ball", "unc_nbody"])
            bests = [row for rows in found.scenes.values() for row in ranking_text.best_of_families(rows)]
            self.assertGreaterEqual(min(len(cell.samples) for row in bests for cell in row.cells), 15)


class ARanking(unittest.TestCase):
    def test_is_by_time_and_marks_what_the_noise_hides(self) -> None:
        found = ranked(frame("leaf", [200] * 5), frame("group", NARROW), frame("bvtt", [101, 102, 103, 104, 105]))
        self.assertEqual(names(found), ["group", "bvtt", "leaf"])
        self.assertEqual([row.tied for row in found.rows], [True, True, False])
        self.assertEqual([round(row.ratio, 2) for row in found.rows], [1, 1.03, 2])
        apart = ranked(frame("group", NARROW), frame("bvtt", [103, 104, 105, 106, 107]))
        self.assertFalse(apart.rows[1].tied)
        hardly = ranked(frame("group", [1000] * 9), frame("bvtt", [1004] * 9), frame("leaf", [1006] * 9))
        self.assertEqual([row.tied for row in hardly.rows], [True, True, False])

    def test_takes_the_spread_between_processes_for_noise(self) -> None:
        """Medians of one process are far apart in the noise of that process, and within what another process may take."""
        fast, slow = frame("group", [100, 101, 102] * 9), frame("bvtt", [107, 108, 109] * 9)
        self.assertFalse(ranked(fast, slow).rows[1].tied)
        for raw, more in ((fast, (0, 0, 7)), (slow, (0, -1, 1))):
            raw["processes"] = ["a", "b", "c"]
            for place, sample in enumerate(raw["samples"]):
                sample["process"] = place // 9
                for one in sample["stages"]:
                    one["span_ns"] += 500 * more[place // 9]
        self.assertEqual([row.tied for row in ranked(fast, slow).rows], [True, True])
        self.assertEqual([cell.median_ns() for cell in Cell(fast).processes], [101e3, 101e3, 108e3])

    def test_of_few_samples_tells_what_is_far_apart_only(self) -> None:
        found = ranked(frame("group", [100]), frame("bvtt", [250]), frame("leaf", [301]))
        self.assertEqual([row.tied for row in found.rows], [True, True, False])

    def test_never_has_a_wrong_answer_first(self) -> None:
        wrong = frame("leaf", [1] * 5, check={"verdict": "differs", "detail": "3 pairs are lost"})
        found = ranked(wrong, frame("group", NARROW), frame("leaf", [1] * 5, number=1))
        self.assertEqual(names(found), ["group"])
        self.assertIn("WRONG: bunny, frame 0: leaf over oibvh-multi: 3 pairs are lost\n", page.text(found))
        only = ranked(wrong)
        self.assertEqual((only.rows, ranking_text.sentence(only)), ([], ""))
        self.assertIn("WRONG", page.text(only))

    def test_for_memory_is_by_bytes_and_then_by_time(self) -> None:
        found = ranked(frame("leaf", [200] * 5, memory=4000), frame("group", NARROW, memory=5000),
                       frame("bvtt", [150] * 5, memory=4000), objective="memory")
        self.assertEqual(names(found), ["bvtt", "leaf", "group"])
        self.assertEqual([row.tied for row in found.rows], [True, False, False])
        self.assertEqual(found.rows[2].ratio, 1.25)
        self.assertIn("take `bvtt` over `oibvh-multi`: 4.00 kB and 150 us a frame", ranking_text.sentence(found))

    def test_for_queries_leaves_the_tree_out(self) -> None:
        slow_tree = frame("group", NARROW)
        for sample in slow_tree["samples"]:
            sample["stages"][0]["span_ns"] = 10**9
        found = ranked(slow_tree, frame("leaf", [200] * 5), objective="query")
        self.assertEqual(names(found), ["group", "leaf"])
        self.assertEqual(round(found.rows[0].ns), 50000)

    def test_over_scenes_is_by_the_geometric_mean_of_ratios(self) -> None:
        found = ranked(frame("leaf", [100] * 5), frame("group", [400] * 5), frame("bvtt", [120] * 5),
                       frame("leaf", [400] * 5, scene="cow"), frame("group", [100] * 5, scene="cow"),
                       frame("bvtt", [120] * 5, scene="cow"), frame("block", [1] * 5, scene="cow"))
        self.assertEqual(names(found), ["bvtt", "leaf", "group"])  # block has no time on the bunny
        self.assertEqual([round(row.ratio, 1) for row in found.rows], [12.0, 20.0, 20.0])
        found = ranked(*(frame(name, [time] * 5, scene=scene) for scene, times in (("a", (100, 400)), ("b", (900, 100)))
                         for name, time in zip(("leaf", "group"), times)))
        self.assertEqual([round(row.ratio, 1) for row in found.rows], [2.0, 3.0])
        self.assertEqual(found.rows[0].by_scene, [4.0, 1.0])
        self.assertIn("all scenes", page.text(found))
        self.assertIn("2.0 times the time of each scene's best, in the geometric mean over 2 scenes", ranking_text.sentence(found))

    def test_sums_frames_and_puts_what_lacks_some_behind(self) -> None:
        found = ranked(frame("leaf", [100] * 5, number=1), frame("leaf", [300] * 5, number=2), frame("group", [150] * 5, number=1),
                       frame("group", [200] * 5, number=2), frame("bvtt", [340] * 5, number=1),
                       *(frame(name, [9] * 5) for name in ("leaf", "group", "bvtt")))
        self.assertEqual(names(found), ["group", "leaf", "bvtt"])
        self.assertEqual([row.complete for row in found.rows], [True, True, False])
        self.assertEqual(round(found.rows[2].ratio, 2), 2.27)  # to the best on its own frame
        self.assertIn("1 frame only", page.text(found))

    def test_is_over_the_frames_after_the_first(self) -> None:
        found = ranked(frame("front", [900] * 5), frame("front", [80] * 5, number=1), frame("group", [100] * 5),
                       frame("group", [100] * 5, number=1))
        self.assertEqual([(row.first.collider, row.ns, row.complete) for row in found.rows], [("front", 80e3, True), ("group", 100e3, True)])
        self.assertEqual(found.unplaced, [])

    def test_has_no_place_on_a_still_scene_for_what_starts_from_the_frame_before(self) -> None:
        kept = [frame("front", [1] * 5), frame("embree-refit", [2] * 5), frame("group", [3] * 5)]
        kept[2]["collider"]["options"] = {"update": "refit"}
        fresh = frame("front", [200] * 5, "karras")
        fresh["collider"]["options"] = {"update": "rebuild"}
        found = ranked(*kept, fresh, frame("leaf", NARROW))
        self.assertEqual((names(found), len(found.unplaced)), (["leaf", "front"], 3))
        self.assertIn("3 cells without a place: they start from the frame before, and there is one frame\n", page.text(found))

    def test_compares_the_beaten_with_what_the_best_took_then(self) -> None:
        # The machine became slower after `leaf` had lost: its times are shorter, and it lost all the same.
        best = frame("group", [100, 100, 100, 200, 200, 200, 200], stopped="most")
        found = ranked(frame("leaf", [130, 130, 130], stopped="beaten"), best)
        self.assertEqual(names(found), ["group", "leaf"])
        self.assertEqual((found.rows[1].ratio, found.rows[1].tied), (1.3, False))
        self.assertEqual([row.ns for row in found.rows], [200000, 260000])

    def test_intervals_are_those_of_the_race(self) -> None:
        import numpy

        for count, low, high in ((1, 1, 1), (5, 1, 5), (8, 1, 8), (9, 2, 8), (20, 6, 15)):
            self.assertEqual(ranking.ends_of(numpy.arange(1.0, count + 1)), (low, high), count)


class ASentence(unittest.TestCase):
    def test_names_the_best_the_next_family_and_those_as_fast(self) -> None:
        order = {"order": "hilbert30", "leaves": "sorted"}
        found = ranked(frame("block", NARROW, "oibvh-single", options=order), frame("bvtt", NARROW, "oibvh-single", options=order),
                       frame("group", [190] * 5, "karras"), frame("front", [250] * 5))
        self.assertEqual(ranking_text.sentence(found), "take `block` over `oibvh-single`, order hilbert30, sorted leaves: 100 us a frame, "
                         "1.90 times as fast as the next family, radix trees (`group` over `karras`, order morton30); as fast within noise: "
                         "`bvtt` over `oibvh-single`, order hilbert30, sorted leaves.")
        self.assertEqual(ranking_text.repeated(found.rows[0], "my mesh.obj", ["--narrow", "exact"]),
                         "bvhbench collide --builder oibvh-single --collider block --order hilbert30 --leaves sorted "
                         "--scene 'my mesh.obj' --narrow exact")
        alone = ranked(frame("leaf", NARROW), frame("grid", [210] * 5))
        self.assertIn("2.1 times as fast as the next family, hierarchical grid (`grid` over `oibvh-multi`).", ranking_text.sentence(alone))

    def test_without_another_family_names_the_next(self) -> None:
        found = ranked(frame("leaf", NARROW), frame("leaf", [150] * 5, options={"order": "kd"}))
        self.assertIn(", 1.50 times as fast as the next, `leaf` over `oibvh-multi`, order kd.", ranking_text.sentence(found))
        many = ranked(*(frame("leaf", NARROW, builder) for builder in ("karras", "perfect", "oibvh-multi", "apetrei", "oibvh-wide4", "lbvh", "hploc")))
        self.assertRegex(ranking_text.sentence(many), "; as fast within noise: `leaf` over `[a-z0-9-]+`; .*; 1 more.$")

    def test_compares_families_by_all_that_tie_and_names_ties_in_full(self) -> None:
        """Of karras one row ties and one does not; all of the grid is slower."""
        found = ranked(frame("group", NARROW, options={"order": "hilbert30"}), frame("bvtt", [150] * 5, "karras"),
                       frame("leaf", [101, 102, 103, 104, 105], "karras", memory=9), {**frame("grid", [300] * 5), "builder": {"name": "none"}})
        self.assertEqual(ranking_text.sentence(found), "take `group` over `oibvh-multi`, order hilbert30: 100 us a frame, 3.0 times as fast as "
                         "the next family, hierarchical grid (`grid`); as fast within noise: `leaf` over `karras`, order morton30.")

    def test_takes_the_least_memory_of_those_that_tie_then_the_plain_builder_and_forms_as_printed_last(self) -> None:
        def taken(*given: tuple[str, int, int]) -> str:
            found = ranked(*(frame("leaf", [time * 10 + k for k in range(5)], builder, memory=memory) for builder, time, memory in given))
            return ranking_text.sentence(found).removeprefix("take `leaf` over ").partition(":")[0]

        self.assertEqual(taken(("karras", 100, 5), ("perfect", 100, 4), ("hploc", 200, 3)), "`perfect`")
        self.assertEqual(taken(("apetrei-fused", 100, 1_010_000), ("apetrei", 100, 1_040_000), ("hploc", 100, 1_060_000)), "`apetrei`")
        self.assertEqual(taken(("oibvh-single-printed", 100, 3), ("oibvh-single", 100, 5)), "`oibvh-single`")
        self.assertEqual(taken(("oibvh-single-printed", 100, 3), ("oibvh-single", 200, 5)), "`oibvh-single-printed`")
        # What ties by noise of its own, far from the best, is not taken.
        self.assertIn("take `leaf` over `oibvh-multi`: 100 us a frame; as fast within noise: `bvtt`", ranking_text.sentence(ranked(
            frame("leaf", NARROW, memory=5), frame("bvtt", [90, 95, 130, 131, 132], memory=1))))

    def test_names_no_winner_of_too_few_samples(self) -> None:
        self.assertEqual(ranking_text.sentence(ranked(frame("leaf", [100] * 4), frame("group", [900] * 4))), "no winner: `leaf` over "
                         "`oibvh-multi` is the best so far, 100 us a frame, by 4 samples without drift, and a winner needs 5, of each frame 3 without drift.")
        (drifted := frame("leaf", [100] * 5))["samples"][0]["drifted"] = True
        self.assertIn("take `leaf`", ranking_text.sentence(ranked(drifted, frame("group", [900] * 4))))
        self.assertIn("take `leaf`", ranking_text.sentence(ranked(*(frame(name, [time] * 3, number=number) for number in range(3)
                                                                    for name, time in (("leaf", 100), ("group", 900))))))
        self.assertEqual(names(ranked(frame("leaf", [90]), frame("group", NARROW))), ["group", "leaf"])  # which is not enough to be first

    def test_is_given_for_files_that_have_one_question_and_right_answers(self) -> None:
        def of(*raw: Raw) -> str:
            return ranking_text.of_cells(run_of(*raw).all_cells)

        two = frame("leaf", NARROW), frame("group", [200] * 5)
        self.assertTrue(of(*two).startswith("take `leaf`"))
        self.assertEqual(of(two[0]), "")
        self.assertEqual(of(*two, frame("bvtt", NARROW, check={"verdict": "differs"})), "")
        self.assertEqual(of(*two, frame("bvtt", NARROW, check={"verdict": "not_checked"})), "")
        self.assertEqual(of(*two, frame("leaf", NARROW, scene="cow")), "")
        other = frame("bvtt", NARROW)
        other["collider"]["options"]["narrow"] = "exact"
        self.assertEqual(of(*two, other), "")
        self.assertEqual(of(cell(), cell("karras")), "")  # from sorted leaves
        self.assertEqual(of(frame("front", NARROW), frame("front", NARROW, "karras")), "")  # of one frame
        queries = [{**one, "sampling": {"stopped": "most", "caches": "hot", "race": "query"}} for one in two]
        self.assertIn("50.0 us a query", of(*queries))

    def test_families_are_those_of_the_catalog(self) -> None:
        self.assertEqual([families.of_cell(Cell(frame(*words))) for words in (("front", [1], "karras"), ("group", [1], "karras"),
                                                                             ("grid", [1], "none"), ("leaf", [1], "oibvh-wide8"))],
                         ["front tracking", "radix trees", "hierarchical grid", "wide trees"])
        for name in style.LOOKS:
            self.assertNotEqual(families.of_builder(name), name, f"plots/read/families.py has no family for {name}")


def walled(made: Raw, walls: list[int], round_trip: int = 0, outside: bool = False) -> Raw:
    """Adds the wall clock of each sample, and the least round trip, in microseconds; with `outside`, to a collider of a program."""
    for sample, wall in zip(made["samples"], walls, strict=True):
        sample["wall_ns"] = 1000 * wall
    if outside:
        made["builder"] = {"name": "none"}
        made["counters"]["round_trip_ns"] = 1000 * round_trip
        made["outside"] = {"name": made["collider"]["name"], "library": "Theirs", "version": "1", "licence": "MIT", "device": "host",
                           "file": "theirs.py", "as": "program"}
    return made


class OfADevice(InFolder):
    def test_that_was_not_tuned_is_said(self) -> None:
        for origin, said in (("none", "values are the defaults"), ("h.json, of H, the nearest", "values are from h.json, of H, the nearest")):
            made = document(frame("group", [9] * 5))
            made["run"]["tuning"] = {"from": origin, "values": {}}
            self.assertIn(said, circumstances.untuned(results.load(self.written(made))))
        made["run"]["tuning"]["from"] = "h.json"
        self.assertEqual(circumstances.untuned(results.load(self.written(made))), "")


class AMethodFromOutside(InFolder):
    """`fast` takes 9 ms a call. It gives its nanoseconds as microseconds."""

    def setUp(self) -> None:
        super().setUp()
        self.slip = walled(frame("fast", [9] * 5), [9000, 9001, 9002, 9003, 9004], outside=True)
        self.ours = [walled(frame("group", [1000] * 5), [1200] * 5), walled(frame("leaf", [990] * 5), [1800] * 5)]

    def test_ranks_all_by_the_wall_clock(self) -> None:
        found = ranked(self.slip, *self.ours)
        self.assertEqual((names(found), [row.ratio for row in found.rows]), (["group", "leaf", "fast"], [1, 1.5, 9002 / 1200]))
        self.assertEqual([row.tied for row in found.rows], [True, False, False])
        self.assertIn("take `group` over `oibvh-multi`: 1.20 ms a frame by the wall clock, 7.5 times as fast as the next family, Theirs (`fast`).",
                      ranking_text.sentence(found))
        self.assertIn(" wall ms ", page.text(found))
        self.assertEqual(names(ranked(*self.ours)), ["leaf", "group"])  # by their stages
        self.assertNotIn("wall", page.text(ranked(*self.ours)))

    def test_ranks_builds_and_several_scenes_so_too(self) -> None:
        build = walled(cell("theirs", ns=9000), [9000] * 3)
        build["outside"] = self.slip["outside"] | {"name": "theirs"}
        ours = walled(cell("karras", ns=400000), [500] * 3)
        self.assertEqual(names(ranked(build, ours, objective="build")), ["karras", "theirs"])
        elsewhere = [walled(frame("group", [100] * 5, scene="cow"), [100] * 5), walled(frame("leaf", [90] * 5, scene="cow"), [180] * 5)]
        several = ranked(self.slip, *self.ours, *elsewhere)
        self.assertEqual([(row.first.collider, round(row.ratio, 2)) for row in several.rows], [("group", 1), ("leaf", 1.64)])
        self.assertIn("of each scene's best, in the geometric mean over 2 scenes by the wall clock", ranking_text.sentence(several))

    def test_leaves_a_query_what_the_tree_leaves_of_the_wall_clock(self) -> None:
        found = ranked(self.slip, *self.ours, objective="query")
        self.assertEqual([(row.first.collider, round(row.ns)) for row in found.rows],
                         [("group", 700000), ("leaf", 1305000), ("fast", 8997500)])

    def test_compares_the_beaten_with_the_wall_clock_of_the_best_then(self) -> None:
        best = walled(frame("group", [50] * 6, stopped="most"), [100, 100, 100, 200, 200, 200])
        beaten = walled(frame("fast", [1] * 3, stopped="beaten"), [130] * 3, outside=True)
        self.assertEqual([(row.first.collider, row.ns) for row in ranked(best, beaten).rows], [("group", 150000), ("fast", 195000)])

    def test_is_compared_with_a_library_of_the_host_by_its_clock_and_with_copies(self) -> None:
        embree, ours = walled(frame("embree", [3000] * 5), [4000] * 5), walled(frame("group", [1000] * 5), [1200] * 5)
        ours["counters"] |= {"upload_ns": 300_000, "read_back_ns": 100_000}
        found = ranked(embree, ours, walled(frame("leaf", [1500] * 5), [9000] * 5))
        self.assertEqual([(row.first.collider, row.ratio) for row in found.rows], [("group", 1), ("leaf", 1.5), ("embree", 4000 / 1600)])

    def test_samples_without_a_wall_clock_count_by_their_stages(self) -> None:
        self.assertEqual(names(ranked(self.slip, frame("leaf", NARROW))), ["leaf", "fast"])

    def test_is_warned_of_where_stages_leave_out_most_of_the_time(self) -> None:
        said = "bunny, frame 0: fast: its stages take 9.00 us, and 9.00 ms pass by the wall clock"
        self.assertEqual(ranking_text.warnings([*map(Cell, self.ours), Cell(self.slip)]), [said])
        self.assertIn(f"\nwarning: {said}\n", page.text(ranked(self.slip, *self.ours)))
        path = self.written(document(self.slip, *self.ours))
        shown = self.made("__main__.py", "show", path).stdout
        self.assertTrue(shown.startswith("take `group` over `oibvh-multi`: 1.20 ms a frame by the wall clock"), shown)
        self.assertIn(f"\nwarning: {said}\n", shown)
        self.assertIn(said, self.made("__main__.py", "show", self.written(document(self.slip), "alone.json")).stdout)
        self.made("__main__.py report", path, "-o", self.folder / "page.html")
        report = (self.folder / "page.html").read_text(encoding="utf-8")
        for words in (f'<p class="warning">{said}</p>', "group over oibvh-multi is soonest on bunny: 1.20 ms; ",
                      "Times are by the wall clock where a method from outside is compared."):
            self.assertEqual(report.count(words) > 0, True, words)

    def test_is_not_warned_of_for_the_round_trip(self) -> None:
        for stages, wall, round_trip, is_said in ((9, 100, 10, False), (9, 118, 10, False), (9, 119, 10, True), (500, 1100, 10, False),
                                                  (500, 1101, 10, True), (500, 1500, 600, False), (500, 1700, 600, True)):
            made = Cell(walled(frame("fast", [stages] * 5), [wall] * 5, round_trip, outside=True))
            self.assertEqual(made.leaves_out, is_said, (stages, wall, round_trip))
        self.assertFalse(Cell(walled(frame("leaf", [9] * 5), [9000] * 5)).leaves_out)  # not from outside: its head start

    def test_many_are_warned_of_in_six_lines(self) -> None:
        cells = [Cell(walled(frame("fast", [9] * 5, number=number), [9000] * 5, outside=True)) for number in range(8)]
        self.assertEqual(len(ranking_text.warnings(cells)), 6)
        self.assertEqual(ranking_text.warnings(cells)[-1], "the same of 3 more cells")

    def test_is_drawn_with_its_wall_clock(self) -> None:
        style.set_up()
        found = ranked(self.slip, *self.ours)
        text = style.content(best_bars.draw(run_of(self.slip, *self.ours), found), ".svg").decode()
        for words in ("in no stage", "Times are by the wall clock: some are from outside.", "9.00 ms"):
            self.assertIn(words, text)
        run = run_of(self.slip, *self.ours)
        run.cells = run.all_cells
        panel, = overview.bars_of(run).values()
        self.assertEqual([ns for _, ns, _ in panel], [1200000, 1800000, 9002000])
        self.assertIn("by the wall clock", overview.draw(run).axes[-1].get_xlabel())


class ATable(unittest.TestCase):
    def test_has_twelve_rows_unless_all_are_asked_for(self) -> None:
        found = ranked(*(frame("leaf", [100 + place], options={"order": f"o{place}"}) for place in range(15)),
                       *({**frame("bvtt", [1], options={"order": f"o{place}"}), "status": "skipped",
                          "reason": f"cannot win: it takes {place} ms"} for place in range(2)))
        text = page.text(found)
        self.assertEqual(text.partition("no winner")[0].count("leaf over"), page.MOST_ROWS + 1)  # and the best of the family
        self.assertRegex(text, "\nand 2 more; `best --all` and `show --wide` print them\n(.*\n)*2 cells skipped: cannot win\n")
        self.assertIn("bvtt over oibvh-multi, o1: it takes 1 ms\n", page.text(found, True))
        self.assertEqual(page.text(found, True).partition("no winner")[0].count("leaf over"), 15)

    def test_has_a_mark_where_the_column_beside_it_says_so_and_explains_marks_and_dashes(self) -> None:
        """`group` was beaten, so its interval begins at its median."""
        found = ranked(frame("leaf", NARROW, memory=3_000_000, counters={"sah_cost": 7, "pairs_count": 70, "contacts_count": 9}),
                       frame("bvtt", [101, 102, 103, 104, 105]), frame("group", [100, 104, 104, 106], stopped="beaten"), frame("block", [101] * 4, stopped="beaten"))
        lines = page.text(found).splitlines()
        self.assertEqual([line.split()[5:9] for line in lines[1:5]], [["0.100", "1.00", "0.96", "take"], ["0.102", "1.02", "1.00", "="],
                                                                     ["0.103", "1.03", "0.99", "="], ["0.105", "1.05", "1.02", "0.0"]])
        self.assertIn(" SAH  pairs  contacts  samples  verdict", lines[0])
        self.assertRegex(lines[1], " 3.0 +7.00 +70 +9 +5  agrees$")
        self.assertEqual([line.partition(" ")[0] for line in lines[5:8]], ["=", "take:", "-:"])

    def test_says_errors_of_formats(self) -> None:
        made = frame("leaf", NARROW, options={"boxes": "u16", "leaves": "sorted"}, check={"verdict": "counted"})
        made["counters"] |= {"false_pairs_count": 12, "sah_inner": 10, "sah_leaf": 2}
        text = page.text(ranked(made))
        self.assertRegex(text, r"leaf over oibvh-multi, u16 boxes .* 14\.00 .* 12 false +5  counted\n")
        self.assertIn("; of what it finds 12 false.", text)
        made["counters"] = {"missed_count": 3, "false_count": 7}
        self.assertIn("; of what it finds 3 missed, 7 false.", page.text(ranked(made)))


class AFigure(unittest.TestCase):
    def test_is_drawn_for_each_objective(self) -> None:
        cells = [frame("leaf", NARROW, memory=100), frame("group", [2000] * 5, memory=50), frame("leaf", NARROW, scene="cow"),
                 frame("group", NARROW, scene="cow")]
        for made in cells:
            made["counters"] |= {"tree_bytes": 30, "query_bytes": 20}
        style.set_up()
        for objective in ("frame", "query", "memory"):
            drawing = best_bars.draw(run_of(*cells), ranked(*cells, objective=objective))
            self.assertIn(b"group over oibvh-multi", style.content(drawing, ".svg"))


    def test_has_the_best_of_each_family_and_five_more(self) -> None:
        cells = [*(frame("leaf", [100 + place] * 5, options={"order": f"o{place}"}) for place in range(9)), frame("grid", [300] * 5),
                 frame("leaf", [200] * 5, "karras")]
        axes, = best_bars.draw(run_of(*cells), ranked(*cells)).axes
        labels = [label.get_text() for label in axes.get_yticklabels()]
        self.assertEqual((len(labels), labels[-2:], sum("take" in text.get_text() for text in axes.texts)),
                         (1 + 5 + 2, ["leaf over karras", "grid over oibvh-multi"], 1))


class AnotherRun(unittest.TestCase):
    def test_is_within_the_interval_of_the_race_or_says_what_differs(self) -> None:
        race, found = run_of(frame("leaf", NARROW)), ranked(frame("leaf", NARROW))
        race.document["run"] |= {"copy_rate_bytes_per_s": 24e9, "conditions": {"other_processes": 0.5}}
        same, slow = run_of(frame("leaf", [101, 102, 103])), run_of(frame("leaf", [200, 201, 202]))
        slow.document["run"] |= {"copy_rate_bytes_per_s": 12e9, "conditions": {"other_processes": 3.0}}
        self.assertEqual(alone.compared(same, found.rows[0], found, race), "101 us to 103 us, within the noise of the race's, 98.0 us to 102 us")
        self.assertEqual(alone.compared(slow, found.rows[0], found, race), "200 us to 202 us, not the race's, 98.0 us to 102 us: the machine copied "
                         "0.50 times as fast as then, beside 3.0 other processes, then 0.5; and alone, no other candidate runs between samples")


LISTS = {"builders": {"oibvh-multi": "trees", "karras": "trees", "oibvh-host": "by threads on the host", "sah-binned": "on a host core",
                      "embree-low": "built without Embree", "oibvh-reference": "slowly: the oracle", "oibvh-wide8": "trees"},
         "orders": {"morton30": "30 bits   Morton", "hilbert30": "30 bits  Hilbert", "morton48": "48 bits  Morton",
                    "morton30-axis": "30 bits  as morton30", "kd": "no codes"},
         "colliders": {"leaf": "each leaf", "group": "groups", "front": "where the frame before", "grid": "no tree", "brute": "the oracle",
                       "embree-refit": "refit", "fcl": "contacts, on a host core"},
         "formats": {"f32": "24 bytes", "u16": "12 bytes"}}


class TheCandidates(unittest.TestCase):
    def product(self, objective: str = "frame", on_cpu: bool = True, **more: Any) -> candidates.Product:
        asked = {"with_libraries": False, "has_narrow": False, "has_frames": False} | more
        return candidates.Product(candidates.Asked(objective, on_cpu, **asked), LISTS.__getitem__)

    def test_are_what_the_device_and_the_question_allow(self) -> None:
        product = self.product()
        self.assertEqual(product.builders, ["oibvh-multi", "karras", "oibvh-host", "oibvh-wide8"])
        self.assertEqual(product.orders, ["morton30", "hilbert30", "kd"])
        self.assertEqual(product.colliders, ["leaf", "group", "grid"])
        self.assertEqual(self.product(on_cpu=False).builders, ["oibvh-multi", "karras", "oibvh-wide8"])
        self.assertIn("fcl", self.product(has_narrow=True).colliders)
        self.assertNotIn("fcl", self.product(on_cpu=False, has_narrow=True).colliders)
        self.assertIn("fcl", self.product(on_cpu=False, has_narrow=True, with_libraries=True).colliders)
        self.assertIn("front", self.product(has_frames=True).colliders)
        self.assertIn("embree-refit", self.product(has_frames=True).colliders)
        self.assertIn("sah-binned", self.product("build").builders)
        self.assertEqual(self.product(builders=["sah-binned"]).builders, ["sah-binned"])
        self.assertEqual([names for why, names in product.without.items() if "built without" in why], [])
        self.assertEqual(self.product("build").without["built without Embree"], ["embree-low"])

    def test_from_outside_are_there_on_any_device(self) -> None:
        text = "every two (from outside: Halves 1.0, MIT, on host)"
        lists = LISTS | {"builders": LISTS["builders"] | {"halves": text},
                         "colliders": LISTS["colliders"] | {"halves": text, "halves-refit": text}}
        for objective, on_cpu in (("frame", False), ("build", True)):
            asked = candidates.Asked(objective, on_cpu, with_libraries=False, has_narrow=False, has_frames=False)
            product = candidates.Product(asked, lists.__getitem__)
            self.assertEqual("halves" in product.builders, objective == "build")
            pairs = [pair for pair in product.candidates() if {"name": "halves"} in pair or (pair[0] or {}).get("name") == "halves"]
            self.assertEqual(len(pairs), 1, pairs)
            self.assertNotIn("halves-refit", product.colliders)

    def test_are_each_there_once_and_likely_ones_first(self) -> None:
        pairs = self.product().candidates()
        self.assertEqual(len({json.dumps(pair) for pair in pairs}), len(pairs))
        # Two places of leaves for three of the builders, one for wide trees; three orders; two colliders; and the grid.
        self.assertEqual(len(pairs), (3 * 2 + 1) * 3 * 2 + 1)
        self.assertEqual(pairs[0], ({"name": "oibvh-multi", "order": "hilbert30", "leaves": "sorted", "boxes": "f32"}, {"name": "group"}))
        self.assertEqual(pairs[-1][0]["order"], "kd")
        self.assertIn((None, {"name": "grid"}), pairs)
        of_host = [builder for builder, _ in self.product("build", builders=["sah-binned", "karras"]).candidates()]
        self.assertEqual(len(of_host), 1 + 2 * 3)

    def test_of_other_boxes_have_sorted_leaves(self) -> None:
        places = {(builder["boxes"], builder["leaves"]) for builder, _ in self.product(boxes=["f32", "u16"]).candidates() if builder}
        self.assertEqual(places, {("f32", "mesh"), ("f32", "sorted"), ("u16", "sorted"), ("u16", "mesh")})
        self.assertEqual({builder["boxes"] for builder, _ in self.product("memory").candidates() if builder}, {"f32", "u16"})
