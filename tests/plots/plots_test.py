"""Tests that every figure can be drawn from the golden results, and that the reader refuses what must not be plotted."""
import copy
import json
import pathlib
import re
import unittest

from base import ALL_CASES, GOLDEN, ROOT, InFolder, Raw, golden  # first: it adds the source root to sys.path

from plots.console import frame_table
from plots.draw import cell_map, figure, pipelines, style
from plots.figures import catalog, fig8, frame_bars, overview, roofline, scaling, swept_bars, table1
from plots.files import output
from plots.read import results
from plots.read.cells import Cell
from plots.read.crossing import crossing
from plots.words import names, tables
from PIL import Image
from plots.draw.style import plt


def svg(run: results.Run, name: str) -> str:
    """Returns the text of a figure."""
    return style.content(catalog.pictures_of(run)[name](), ".svg").decode()


class Drawn(InFolder):
    """A test that draws, in this process."""

    def setUp(self) -> None:
        super().setUp()
        style.set_up()
        self.addCleanup(plt.close, "all")

    def drawn(self, name: str, document: Raw, picture: str = "") -> str:
        return svg(results.load(self.written(document, f"{name}.json")), picture or name)


class Scripts(InFolder):
    def assert_pictures(self, name: str) -> None:
        png, svg = (self.folder / "out" / f"{name}{end}" for end in (".png", ".svg"))
        self.assertTrue(png.read_bytes().startswith(b"\x89PNG"), png)
        self.assertGreater(png.stat().st_size, 20_000, png)
        self.assertIn("</svg>", svg.read_text(encoding="utf-8"), svg)

    def test_all_draws_every_figure_and_one_alone_is_the_same_byte_for_byte(self) -> None:
        axes = ("narrow", "classes", "sums", "codes", "input", "boxes", "swept", "frames", "impacts")
        figures = {name: (name,) for name in ("table3", "table4", "fig8", "fig13", "scaling", "roofline", "stress", "swept", "skips",
                                              "rebuild", "pairs", "families", "quality", "table1", "effects")}
        figures |= {"accuracy": tuple(f"accuracy-{axis}" for axis in axes), "table2": ("table2", "table2-fig9", "table2-fig10")}
        files = [*figures, "headlines"] if ALL_CASES else ["table1", "table2", "headlines"]  # .ci/run draws all by `reproduce all`
        self.made("__main__.py plot", *(GOLDEN / f"{file}.json" for file in files), "--out", self.folder / "out")
        pictures = {picture for file in files for picture in figures.get(file, ())}
        for picture in pictures:
            self.assert_pictures(picture)
        self.assertEqual({path.stem for path in (self.folder / "out").iterdir()}, {*pictures, "headlines-overview"})  # a small one
        self.assert_says_what_a_reader_must_know(self.folder / "out" / "table1.svg")
        self.made("__main__.py plot --only fig9", GOLDEN / "table2.json", "--out", self.folder / "one")
        for alone in (self.folder / "one").iterdir():
            self.assertEqual(alone.read_bytes(), (self.folder / "out" / alone.name).read_bytes(), alone.name)

    def assert_says_what_a_reader_must_know(self, svg: pathlib.Path) -> None:
        text = svg.read_text(encoding="utf-8")
        for words in ("hairball*", "GTX 1080, another machine", "Invented GPU", "slower than the time allowed",
                      "On the host and its clock", "million triangles/s"):
            self.assertIn(words, text)

    def test_a_wrong_answer_makes_no_picture(self) -> None:
        self.document["cells"][4]["check"] = {"verdict": "differs", "detail": "box 7"}
        done = self.made("__main__.py plot", self.written(self.document), "--out", self.folder / "out", code=3)
        self.assertIn("gave a wrong answer on bunny: box 7", done.stderr)
        self.assertFalse((self.folder / "out").exists())

    def test_a_file_without_a_figure_is_told_what_it_holds(self) -> None:
        for cell in self.document["cells"]:
            cell["experiment"] = "smoke"
            cell.pop("samples", None)
            cell.update(status="skipped", reason="too large")
        path = self.written(self.document, "no.json")
        done = self.made("__main__.py plot", path, "--out", self.folder / "out", code=3)
        self.assertIn(f"{path}: there is no figure of what it holds: smoke ({len(self.document['cells'])} cells)", done.stderr)
        (self.folder / "table1.json").unlink(missing_ok=True)
        done = self.run_script("__main__.py plot", self.folder, "--out", self.folder / "out")
        self.assertEqual((done.returncode, done.stderr), (0, ""), "in a folder it is passed over")

    def test_cells_of_several_devices_make_no_picture(self) -> None:
        source = {"id": "a", "started_at": "", "command": [], "commit": "", "host": "", "device": "one", "driver": "1"}
        self.document["merged_from"] = [source, source | {"id": "b", "driver": "2"}]
        done = self.made("__main__.py plot", self.written(self.document), "--out", self.folder / "out", code=3)
        self.assertIn("merged from several devices, which no figure tells apart: one, driver 1; one, driver 2", done.stderr)


class Documents(Drawn):
    def test_variants_of_one_builder_are_told_apart(self) -> None:
        first = next(c for c in self.document["cells"] if c["builder"]["name"] == "oibvh-multi")
        second = copy.deepcopy(first)
        first["builder"]["options"] = {"order": "morton30", "leaves": "mesh"}
        second["builder"]["options"] = {"order": "morton30", "leaves": "sorted"}
        text = self.drawn("table1", self.document | {"cells": [first, second]})
        self.assertIn("oibvh-multi (mesh leaves)", text)
        self.assertIn("oibvh-multi (sorted leaves)", text)

    def test_experiments_of_ones_own_are_drawn_as_what_they_can_be(self) -> None:
        for name, picture in (("scaling", "mine-scaling"), ("quality", "mine-orders"), ("pairs", "mine-frames")):
            document = golden(name)
            for cell in document["cells"]:
                cell["experiment"] = "one-of-mine"
            self.assertIn("</svg>", self.drawn("mine", document, picture))

    def test_a_file_without_a_figure_of_its_own_gets_bars_of_medians(self) -> None:
        self.document["cells"] = [{**cell, "experiment": "mine"} for cell in self.document["cells"]
                                  if cell["scene"]["name"] == "bunny"]
        run = results.Run(pathlib.Path("a.json"), self.document, [Cell(cell) for cell in self.document["cells"]
                                                                  if cell["status"] == "measured"])
        bars = overview.bars_of(run)
        self.assertEqual([scene for _, scene, _ in bars], list(dict.fromkeys(cell.scene for cell in run.cells if cell.has_times)))
        for (_, scene, _), panel in bars.items():
            wanted = sorted((cell.median_ns(), cell.pipeline) for cell in run.cells if cell.scene == scene and cell.has_times)
            self.assertEqual([(ns, name) for name, ns, _ in panel], wanted)
        self.assertIn("bunny, build, mine", self.drawn("mine", self.document, "mine-overview"))

    def test_bars_of_frames_are_of_the_later_and_many_scenes_are_counted(self) -> None:
        def made(scene: str, frame: int, ns: int) -> dict:
            cell = copy.deepcopy(self.document["cells"][0])
            cell["scene"] = {"name": scene, "triangles": 9, "frame": frame}
            cell["builder"] = {"name": "none"}
            cell["samples"] = [{"order": 0, "stages": [{"stage": "broad", "wall_ns": ns}]}]
            return {**cell, "experiment": "mine", "operation": "collide", "collider": {"name": "grid"}}

        self.document["cells"] = [made(f"scene{number}", frame, 1000 * (1 + frame)) for number in range(14) for frame in (0, 1)]
        run = results.Run(pathlib.Path("a.json"), self.document, [Cell(cell) for cell in self.document["cells"]])
        self.assertEqual([panel[0][:2] for panel in overview.bars_of(run).values()], [("hierarchical grid", 2000.0)] * 14)
        texts = "".join(text.get_text() for text in overview.draw(run).texts)
        self.assertIn("2 more scenes not drawn.", texts)

    def test_other_costs_are_named_and_not_held_against_the_papers(self) -> None:
        document = golden("table4")
        document["run"]["node_costs"] = {"inner": 2, "triangle": 0.5}
        text = self.drawn("table4", document)
        self.assertIn("An inner node costs 2.0, a triangle 0.5", text)
        self.assertNotIn("paper", text)


class Frames(Drawn):
    def test_tables_say_what_a_reader_must_know(self) -> None:
        text = self.drawn("table2", golden("table2"))
        for words in ("cloth-ball* (unc_cloth_ball): 92,230 triangles, 2 frames", "* was not there", "Invented GPU",
                      "Wang et al. 2018, printed (GTX 1080, another machine)", "n-body, between objects: 146,480 triangles, "
                      "1 frame", "bvtt (jump 2) over oibvh-multi", "front over oibvh-multi, 1 of 2 frames",
                      "front over oibvh-multi failed on unc_cloth_ball (frame 1): the device has too little memory",
                      "leaf over apetrei-fused skipped on cloth-funnel:18484 (frame 0): slower than the time allowed",
                      "Answers not checked: leaf over oibvh-multi.", "milliseconds a frame", " MB<"):
            self.assertIn(words, text)
        self.assertNotIn("n-body*", text)
        self.assertNotIn("On the host", text)

    def test_the_first_of_several_frames_is_apart_and_errors_are_counted(self) -> None:
        document = golden("table2")
        rounds = [cell for cell in document["cells"] if cell["collider"]["name"] == "group"][:2]
        for number, cell in enumerate(rounds):
            cell["collider"]["options"]["narrow"] = "sat-f32"
            cell["check"] = {"verdict": "counted"}
            cell["counters"] |= {"missed_count": 0, "false_count": 5 + number, "contacts_count": 100}
        run = results.load(self.written(document, "made.json"))
        shown, *_ = pipelines.of(run, "table2").values()
        ours = next(one for one in shown if one.is_counted)
        self.assertEqual([cell.frame for cell in ours.cells], [0, 1])
        self.assertEqual([cell.frame for cell in ours.later.cells], [1])
        self.assertEqual(ours.first_ms, ours.cells[0].median_ns() * 1e-6)
        self.assertEqual(ours.label, "group over oibvh-multi (hilbert30, sorted leaves), contacts sat-f32 †")
        text = self.drawn("table2", document)
        for words in (f", first {tables.three_digits(ours.first_ms)}<", "0 missed, 11 false of 200 found"):
            self.assertIn(words, text)
        self.assertEqual(pipelines.apart({"": [ours]}), "over frames after the first")
        self.assertEqual(pipelines.apart({"": [ours.later]}), "over frames")

    def test_names_the_real_step_of_a_sequence_apart_from_the_steps_between(self) -> None:
        document = golden("table2")
        for cell in [cell for cell in document["cells"] if cell["scene"]["name"] == "unc_cloth_ball"]:
            cell["scene"]["source"] = "dynamic/unc_cloth_ball"
            document["cells"].append({**copy.deepcopy(cell), "scene": cell["scene"] | {"between": 15}})
        for picture in ("table2", "table2-fig9", "table2-fig10"):
            text = self.drawn("table2", document, picture)
            words = " ".join(re.findall(r">([^<>]+)</text>", text))
            self.assertIn("cloth-ball*, real step (unc_cloth_ball)", words)
            self.assertNotIn("cloth-ball* (unc_cloth_ball, 15 between)", words)  # the table alone has both
        rows = [line.split(" for ")[0] for line in frame_table.text(results.load(self.written(document, "made.json")), "table2").splitlines()]
        self.assertLess(rows.index("unc_cloth_ball"), rows.index("unc_cloth_ball, 15 between"))
        self.assertEqual(rows.count("unc_cloth_ball"), rows.count("unc_cloth_ball, 15 between"))

    def test_says_nothing_of_stand_ins_and_the_paper_where_there_are_none(self) -> None:
        document = golden("table2")
        for cell in document["cells"]:
            cell["scene"] |= {"name": "mine"}
            cell["scene"].pop("stand_in_for", None)
        text = self.drawn("table2", document)
        self.assertIn("mine: ", text)
        for words in ("was not there", "printed", "mine*"):
            self.assertNotIn(words, text)

    def test_libraries_are_said_to_be_on_the_host_and_long_bars_to_be_shortened(self) -> None:
        text = self.drawn("families", golden("families"))
        for words in ("On the host and its clock: embree, fcl (Invented CPU).", "cloth-ball* (unc_cloth_ball)",
                      "implicit trees: leaf over oibvh-multi", "shortened to 12 times", " 173 ms<",  # no ratio of the host's clock to the device's
                      "No bar: what starts from the frame before, where there is one frame."):
            self.assertIn(words, text)

    def test_the_most_pairs_that_wait_are_of_those_that_count_them(self) -> None:
        text = self.drawn("table2", golden("table2"), "table2-fig10")
        self.assertIn("784,955 for 738,840 pairs", text)  # of the second of two frames
        self.assertIn("* was not there", text)
        self.assertNotIn("leaf over oibvh-multi<", text)

    def test_a_wrong_answer_from_outside_is_a_failure_beside_the_others(self) -> None:
        document = golden("families")
        for cell in document["cells"]:
            cell["experiment"] = "rivals"
        wrong = document["cells"][3]
        wrong["check"] = {"verdict": "differs", "detail": "pair 7"}
        wrong["outside"] = {"name": wrong["collider"]["name"], "library": "Mine", "version": "1", "licence": "MIT", "device": "host",
                            "file": "mine.so", "as": "plugin"}
        text = self.drawn("rivals", document)
        self.assertIn("wrong answer: pair 7", text)
        self.assertIn("written pairs of overlapping boxes", text)

    def test_a_file_without_frames_makes_no_picture(self) -> None:
        for name in ("table2", "fig9", "fig10", "pairs", "swept"):
            with self.assertRaisesRegex(results.Refused, "no measured frame of "):
                catalog.NAMED[name](results.load(GOLDEN / "table1.json"))

    def test_a_frame_is_from_its_first_start_to_its_last_end(self) -> None:
        run = results.load(GOLDEN / "table2.json")
        cell = run.frames("table2")[0]
        narrow = cell.samples[0]["narrow"]
        self.assertAlmostEqual(cell.times_s()[0] * 1e9, narrow["start_ns"] + narrow["span_ns"])
        embree = next(cell for cell in results.load(GOLDEN / "families.json").cells if cell.collider == "embree")
        times = [entry.get("wall_ns", entry.get("span_ns")) for entry in embree.samples[0].values()]
        self.assertAlmostEqual(embree.times_s()[0] * 1e9, sum(times))

    def test_parts_are_all_stages_and_add_up_to_the_frame(self) -> None:
        schema = json.loads((ROOT / "results" / "schema" / "result-1.schema.json").read_text(encoding="utf-8"))
        sample = schema["$defs"]["cell"]["properties"]["samples"]["items"]["properties"]
        stages = sample["stages"]["items"]["properties"]["stage"]["enum"]
        of_frames = set(stages) - {"sum"}  # which is on an axis of accuracy
        self.assertEqual(sorted(names.STAGES), sorted(of_frames))
        self.assertEqual([those for those, _ in frame_bars.PARTS], list(names.PARTS))
        for name in ("table2", "families", "rebuild"):
            for shown in pipelines.of(results.load(GOLDEN / f"{name}.json"), name).values():
                for one in shown:
                    parts = sum(width for _, width in frame_bars.parts_of(one))
                    self.assertAlmostEqual(parts, one.frame_ms().mean(), places=9)

    def test_parts_are_named_after_their_stages_as_tables_name_them(self) -> None:
        shown = [one for those in pipelines.of(results.load(GOLDEN / "rebuild.json"), "rebuild").values() for one in those]
        stages = {stage for one in shown for cell in one.cells for sample in cell.samples for stage in sample}
        words = [word for patch in frame_bars.legend_of(shown) for word in patch.get_label().split(" + ")]
        self.assertEqual(set(words) - {names.BETWEEN}, stages)

    def test_pipelines_of_one_scene_are_told_apart(self) -> None:
        for name in ("table2", "table3", "rebuild", "pairs", "families"):
            for shown in pipelines.of(results.load(GOLDEN / f"{name}.json"), name).values():
                self.assertEqual(len({one.label for one in shown}), len(shown))
        labels = {one.label for those in pipelines.of(results.load(GOLDEN / "families.json"), "families").values() for one in those}
        self.assertIn("leaf (without near) over oibvh-multi", labels)

    def test_every_collider_has_a_look(self) -> None:
        catalog = (ROOT / "harness" / "choice" / "catalog.cpp").read_text(encoding="utf-8")
        listed = catalog.split("constexpr ColliderEntry own_colliders[]")[1]
        colliders = re.findall(r"^    (?:\{(?:\.name = )?|filtering\()\"([a-z-]+)\"", listed, re.MULTILINE)
        self.assertGreater(len(colliders), 8)
        for collider in colliders:
            self.assertTrue(collider in pipelines.MARKERS or collider in pipelines.COLOURS, collider)
        looks = {(pipelines.COLOURS.get(name), pipelines.MARKERS.get(name, "")) for name in colliders}
        self.assertEqual(len(looks), len(colliders))


class Reader(InFolder):
    def assert_refused(self, document: dict, words: str) -> None:
        with self.assertRaisesRegex(results.Refused, words):
            results.load(self.written(document))

    def test_refuses_another_major_format_and_takes_any_minor(self) -> None:
        self.assert_refused(self.document | {"format": "2.0"}, "format 2.0")
        self.assertEqual(len(results.load(self.written(self.document | {"format": "1.99"})).cells), 44)

    def test_refuses_what_was_made_under_a_test_hook(self) -> None:
        self.document["run"]["test_hooks"] = {"BVHBENCH_SLOW": "karras:2"}
        self.assert_refused(self.document, "made under the test hook BVHBENCH_SLOW=karras:2: it is no result")

    def test_leaves_out_samples_beside_drift_unless_most_are(self) -> None:
        cell = self.document["cells"][0]
        count = len(cell["samples"])
        self.assertGreater(count, 2)
        cell["samples"][0]["drifted"] = True
        self.assertEqual(len(results.load(self.written(self.document)).cells[0].samples), count - 1)
        for sample in cell["samples"]:
            sample["drifted"] = True
        self.assertEqual(len(results.load(self.written(self.document)).cells[0].samples), count)

    def test_counts_no_refit_as_a_build(self) -> None:
        refit = copy.deepcopy(self.document["cells"][0]) | {"operation": "refit"}
        self.document["cells"].append(refit)
        run = results.load(self.written(self.document))
        self.assertEqual([cell.operation for cell in run.cells[-2:]], ["build", "refit"])
        self.assertEqual(len(run.of("table1")), len(results.load(GOLDEN / "table1.json").of("table1")))
        self.assertEqual(len(run.builds), len(run.cells) - 1)

    def test_keeps_the_reason_of_cells_without_numbers(self) -> None:
        run = results.load(GOLDEN / "table1.json")
        self.assertEqual(run.left_out("table1"), [
            "oibvh-reference skipped on torus:2880000: slower than the time allowed a cell"])

    def test_reads_the_levels_of_leaves_and_why_a_counter_is_missing(self) -> None:
        for cell in results.load(GOLDEN / "quality.json").cells:
            self.assertEqual(sum(cell.leaves_by_depth), cell.triangles)
            self.assertEqual(len(cell.leaves_by_depth) - 1, cell.counters["depth_max"])
            self.assertEqual(cell.left_out, {"epo": "not asked for: --epo"})
        self.assertEqual(results.load(GOLDEN / "table1.json").cells[0].leaves_by_depth, [])

    def test_groups_cells_without_numbers_by_reason(self) -> None:
        cells = [{"experiment": "table1", "builder": {"name": builder}, "scene": {"name": scene},
                  "status": "failed", "reason": reason}
                 for builder, scene, reason in (("karras", "a", "memory"), ("karras", "b", "memory"),
                                                ("perfect", "a", "memory"), ("perfect", "b", "memory"),
                                                ("apetrei", "a", "memory"), ("karras", "c", "driver"))]
        run = results.load(self.written(self.document | {"cells": cells}))
        self.assertEqual(run.left_out("table1"), ["karras, perfect failed on a, b: memory",
                                                  "apetrei failed on a: memory",
                                                  "karras failed on c: driver"])

    def test_quantiles_are_those_of_the_raw_samples(self) -> None:
        found = results.quantiles(range(101))
        self.assertEqual(found, results.Quantiles(10.0, 50.0, 90.0))


class Table1(Drawn):
    def test_has_no_bar_on_a_logarithmic_axis_and_says_in_cache_where_the_table_does(self) -> None:
        for cell in self.document["cells"]:
            for sample in cell.get("samples", []) if cell["builder"]["name"] == "apetrei" else ():
                sample["stages"][0]["moved_bytes"] = 10**12
        time, _, rate = table1.draw(results.load(self.written(self.document))).axes
        self.assertEqual((time.get_yscale(), list(time.patches)), ("log", []))
        meshes = {cell["scene"]["name"] for cell in self.document["cells"] if cell["builder"]["name"] == "apetrei" and cell.get("samples")}
        self.assertEqual([text.get_text() for text in rate.texts], len(meshes) * [tables.IN_CACHE])


class Crossing(unittest.TestCase):
    @staticmethod
    def curve(times: list[float]) -> dict[int, float]:
        return {2 ** (10 + i): t for i, t in enumerate(times)}

    def test_lies_where_the_multi_kernel_construction_stays_ahead(self) -> None:
        found = crossing(self.curve([1, 3, 1, 2, 4]), self.curve([2, 2, 2, 1, 1]))
        self.assertAlmostEqual(found, 2**12.5)  # not where it first leads, since it falls behind again

    def test_is_none_when_nothing_crosses(self) -> None:
        slow, fast = self.curve([2, 2, 2]), self.curve([1, 1, 1])
        self.assertIsNone(crossing(slow, fast))
        self.assertIsNone(crossing(fast, slow))


class Throughput(InFolder):
    def test_panels_of_figure_8_have_one_scale(self) -> None:
        nodes, triangles = fig8.draw(results.load(GOLDEN / "fig8.json")).axes
        self.assertEqual(nodes.get_ylim(), triangles.get_ylim())

    def test_of_table_1_has_a_panel_of_its_own(self) -> None:
        time, throughput, rate = table1.draw(results.load(GOLDEN / "table1.json")).axes
        self.assertEqual([axes.get_ylabel() for axes in (time, throughput, rate)],
                         ["hierarchy, ms", "million triangles/s", "% of copy rate"])
        self.assertEqual((len(time.texts), len(throughput.texts)), (0, len(throughput.patches)))


class Stress(unittest.TestCase):
    def test_no_text_is_wider_than_its_cell(self) -> None:
        style.set_up()
        drawing = plt.figure(figsize=(7, 3))
        axes = drawing.add_axes((0.2, 0.1, 0.75, 0.6))
        texts = ("−1.2k\n+310k", "−999k", "+9.9M", "failed")
        columns = [str(number) for number in range(19)]
        cell_map.draw(axes, {("row", column): ("#E69F00", texts[place % 4]) for place, column in enumerate(columns)}, ["row"], columns)
        drawing.draw_without_rendering()
        width = axes.get_window_extent().width / len(columns)
        for text in axes.texts:
            self.assertLess(text.get_window_extent().width, width, text.get_text())


class Scaling(InFolder):
    def test_has_a_panel_a_stage_and_one_for_the_whole_build(self) -> None:
        run = results.load(GOLDEN / "scaling.json")
        self.assertEqual(scaling.stages_of(run.of("scaling")), ["bounds", "codes", "sort", "hierarchy"])
        drawing = scaling.draw(run)
        titles = [axes.get_title("left") for axes in drawing.axes]
        self.assertEqual(titles, ["bounds", "codes", "sort", "hierarchy", "whole build"] + 5 * [""])
        self.assertEqual([len(axes.lines) for axes in drawing.axes], 10 * [4])

    def test_adds_the_stages_up_and_divides_by_the_triangles(self) -> None:
        run = results.load(GOLDEN / "scaling.json")
        cell = run.of("scaling")[0]
        whole = results.quantiles(sum(cell.times_s(stage) for stage in scaling.stages_of([cell]))).median
        axes = scaling.draw(run).axes
        above, below = axes[4].lines[0], axes[9].lines[0]
        self.assertEqual(above.get_label(), cell.builder)
        self.assertAlmostEqual(above.get_ydata()[0], 1e3 * whole)
        self.assertAlmostEqual(below.get_ydata()[0], 1e9 * whole / cell.triangles)


class Roofline(InFolder):
    def setUp(self) -> None:
        super().setUp()
        self.document = golden("roofline")

    def drawn(self) -> roofline.plt.Figure:
        return roofline.draw(results.load(self.written(self.document, "roofline.json")))

    def test_has_a_panel_a_stage_with_a_line_a_builder_or_collider(self) -> None:
        panels = {axes.get_title("left"): axes for axes in self.drawn().axes}
        self.assertEqual(list(panels), ["bounds", "codes", "sort", "hierarchy", "broad", "narrow"])
        self.assertEqual([len(axes.lines) for axes in panels.values()], 6 * [5])  # and the floor
        labels = {line.get_label() for line in panels["broad"].lines[1:]}
        self.assertEqual(labels, {"leaf over oibvh-multi", "group over oibvh-multi (hilbert30, sorted leaves)",
                                  "bvtt (jump 2) over oibvh-multi", "hierarchical grid"})

    def test_divides_by_bytes_at_the_copy_rate_and_launches_at_their_cost(self) -> None:
        for cell in self.document["cells"]:
            for sample in cell["samples"]:
                for stage in sample["stages"]:
                    stage |= {"launches": 3, "moved_bytes": 24_000_000, "span_ns": 64_200}
        for axes in self.drawn().axes:  # 24 MB at 2.4 TB/s take 10 microseconds, 3 launches 11.4
            for line in axes.lines[1:]:
                for value in line.get_ydata():
                    self.assertAlmostEqual(value, 64.2 / 21.4)

    def test_files_without_a_launch_cost_have_floors_of_bytes_alone(self) -> None:
        del self.document["run"]["launch_cost_ns"]
        run = results.load(self.written(self.document, "roofline.json"))
        cell = run.of("roofline")[0]
        self.assertAlmostEqual(roofline.floor_s(run, cell, "bounds"), 36 * cell.triangles / 2.4e12)

    def test_stages_without_bytes_and_runs_without_a_copy_rate_have_none(self) -> None:
        for cell in self.document["cells"]:
            for sample in cell["samples"]:
                for stage in sample["stages"]:
                    if stage["stage"] in ("broad", "codes"):
                        stage["moved_bytes"] = 0
        titles = [axes.get_title("left") for axes in self.drawn().axes]
        self.assertEqual(titles, ["bounds", "sort", "hierarchy", "narrow"])
        del self.document["run"]["copy_rate_bytes_per_s"]
        with self.assertRaisesRegex(results.Refused, "no measured cell of roofline has a stage with a floor"):
            self.drawn()

    def test_no_two_of_its_lines_look_alike(self) -> None:
        looks = [(line.get_color(), line.get_marker()) for line in self.drawn().legends[0].get_lines()]
        self.assertGreater(len(looks), 7)
        self.assertEqual(len(set(looks)), len(looks))


class Swept(InFolder):
    def test_has_a_panel_a_scene_and_two_bars_a_pipeline_of_both_its_queries(self) -> None:
        run = results.load(GOLDEN / "swept.json")
        panels = swept_bars.draw(run).axes
        self.assertEqual([axes.get_title("left") for axes in panels], [
            "unc_cloth_ball, 1 step: 3.7 M pairs, 100 for each of the ground truth",
            "funnel* (cloth-funnel:18484), 1 step: 0.7 M pairs"])
        labels = [label.get_text() for label in panels[0].get_yticklabels()]
        self.assertEqual(labels[2:], ["hierarchical grid", "embree", "bvtt (jump 2) over oibvh-multi, edge-edge only"])
        both = [cell for cell in run.cells if cell.scene == "unc_cloth_ball" and cell.collider == "grid"]
        self.assertEqual([cell.swept["pairs"] for cell in both], ["vertex-face", "edge-edge"])
        seconds = sum(results.quantiles(cell.times_s()).median for cell in both)
        whole, queries = panels[0].patches[4:6]
        self.assertAlmostEqual(whole.get_width(), 1e-6 * 40 * 92230 / seconds)
        self.assertGreater(queries.get_width(), whole.get_width())
        for bar, text in zip(panels[0].patches, panels[0].texts):  # each number is at the end of its own bar
            self.assertEqual(text.xy[0], bar.get_width())
            self.assertAlmostEqual(text.xy[1], bar.get_y() + bar.get_height() / 2)
            self.assertEqual(text.get_text().strip(), tables.three_digits(bar.get_width()))


class Looks(InFolder):
    def test_no_two_builders_look_alike(self) -> None:
        self.assertEqual(len(set(style.LOOKS.values())), len(style.LOOKS))
        markers = {(look.colour, look.marker) for look in style.LOOKS.values()}
        bars = {(look.colour, look.hatch) for look in style.LOOKS.values()}
        self.assertEqual((len(markers), len(bars)), (len(style.LOOKS),) * 2)

    def test_no_two_variants_of_builders_look_alike(self) -> None:
        among = [(name, (("order", order),)) for name in ("karras", "oibvh-multi") for order in ("kd", "morton30", "morton63")]
        looks = [style.look_in(series, among) for series in among]
        self.assertEqual(looks[::3], [style.look("karras"), style.look("oibvh-multi")])
        self.assertEqual(len({(look.colour, look.marker) for look in (*style.LOOKS.values(), *style.VARIANT_LOOKS)}),
                         len(style.LOOKS) + len(style.VARIANT_LOOKS))
        self.assertEqual((len({look.colour for look in looks}), len({look.marker for look in looks[3:]})), (6, 3))

    def test_a_legend_has_as_many_columns_as_fit(self) -> None:
        self.assertEqual([figure.columns_for([length * "m"] * 4, 7) for length in (5, 30, 50, 200)], [4, 3, 2, 1])

    def test_a_long_footer_takes_no_height_from_panels(self) -> None:
        style.set_up()
        run, heights = results.load(GOLDEN / "rebuild.json"), []
        for remarks in (2 * ("a remark",), 20 * ("a remark",)):
            drawing = frame_bars.draw(run, "rebuild", remarks)
            drawing.draw_without_rendering()
            heights.append(drawing.axes[0].get_window_extent().height)
        self.assertAlmostEqual(heights[0], heights[1], delta=0.1 * heights[0])

    def test_pictures_have_few_colours(self) -> None:
        style.set_up()
        png, _ = style.save(frame_bars.draw(results.load(GOLDEN / "rebuild.json"), "rebuild"), pathlib.Path(self.folder), "one", [], False)
        with Image.open(png) as picture:
            self.assertEqual((picture.mode, picture.size[0]), ("P", 1400))
        self.assertTrue(output.is_picture(png.read_bytes()[:output.HEAD_BYTES]))

    def test_a_builder_without_one_is_named(self) -> None:
        with self.assertRaisesRegex(results.Refused, "no look for the builder 'newcomer'"):
            style.look("newcomer")
