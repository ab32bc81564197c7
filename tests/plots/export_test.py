"""Tests what `export` writes, read back by pandas and checked against a schema of Google Benchmark's format, and what the reader for
notebooks gives."""
import io
import json
import lzma
import pathlib
import tempfile
import unittest

import jsonschema
import pandas

from base import GOLDEN, ROOT, InFolder, Raw, cell, document, run_of, stage  # first: it adds the source root to sys.path

from plots.exporting import cell_names
from plots.files.json_files import Refused
from plots.read import results, sample_rows
from plots.read.cells import Cell

SCHEMA = json.loads((ROOT / "tests" / "google_benchmark.schema.json").read_text(encoding="utf-8"))
TABLE1, TABLE2 = GOLDEN / "table1.json", GOLDEN / "table2.json"
WITH_CELLS = [path for path in sorted(GOLDEN.glob("*.json")) if path.name != "stress.json"]


def staged(*times: tuple[int, int]) -> Raw:
    """Returns a cell with two stages; times of one sample each."""
    samples = [{"order": place, "stages": [stage("sort", first, start_ns=0), stage("hierarchy", second, start_ns=first + 5)]}
               for place, (first, second) in enumerate(times)]
    return cell(samples=samples)


class Exports(InFolder):
    def exported(self, kind: str, *files: object) -> str:
        return self.made("__main__.py", "export", *files, "--format", kind).stdout

    def benchmarks(self, *files: object) -> list[Raw]:
        """Exports for Google Benchmark and returns the entries, after checking the whole against the schema."""
        made = json.loads(self.exported("google-benchmark", *files))
        jsonschema.Draft202012Validator(SCHEMA).validate(made)
        self.assertEqual(made["context"]["json_schema_version"], 1)
        return made["benchmarks"]


class OfGoogleBenchmark(Exports):
    def test_every_golden_file_is_of_the_format_and_keeps_every_median(self) -> None:
        for path in WITH_CELLS:
            frame = pandas.DataFrame(self.benchmarks(path))
            medians = frame.groupby("name", sort=False).real_time.median()
            run = results.everything(path)
            cells = [(run, one) for one in run.all_cells]
            wanted = {name: one.median_ns() for name, (_, one) in zip(cell_names.names_of(cells), cells) if one.has_times}
            self.assertGreater(len(wanted), 0, path)
            self.assertEqual({name: medians[name] for name in wanted}, wanted)
            for (_, one), name in zip(cells, cell_names.names_of(cells)):
                rows = frame[frame.name == name]
                self.assertEqual(len(rows), max(len(one.samples), 1) if one.has_times else 1)
                self.assertEqual(set(rows.label), {one.verdict})
                self.assertEqual(sorted(rows.repetition_index), list(range(rows.repetitions.iloc[0])))

    def test_a_sample_is_a_repetition_and_a_stage_an_entry(self) -> None:
        entries = self.benchmarks(self.written(document(staged((100, 200), (110, 190)))))
        name = "table1/bunny/oibvh-multi"
        self.assertEqual([(entry["name"], entry["repetition_index"], entry["real_time"]) for entry in entries],
                         [(name, 0, 305), (name, 1, 305), (f"{name}/sort", 0, 100), (f"{name}/sort", 1, 110),
                          (f"{name}/hierarchy", 0, 200), (f"{name}/hierarchy", 1, 190)])
        self.assertEqual([entry["per_family_instance_index"] for entry in entries], [0, 0, 1, 1, 2, 2])
        self.assertEqual((entries[0]["nodes_count"], "nodes_count" in entries[2]), (288100, False))

    def test_files_of_older_formats_are_read(self) -> None:
        for minor in (1, 4, 8):
            entries = self.benchmarks(self.written({**document(cell()), "format": f"1.{minor}"}))
            self.assertEqual([entry["real_time"] for entry in entries], [110000, 100000, 90000])

    def test_cells_without_times_say_why(self) -> None:
        failed = {**cell(), "status": "failed", "reason": "it crashed"}
        skipped = {**cell("karras"), "status": "skipped", "reason": "too large"}
        for one in (failed, skipped):
            del one["samples"], one["check"]
        wrong = cell("perfect", check={"verdict": "differs", "detail": "node 3 is lost"})
        entries = self.benchmarks(self.written(document(failed, skipped, wrong)))
        self.assertEqual([entry.get("error_message") for entry in entries], ["failed: it crashed", None, "differs: node 3 is lost"])
        self.assertEqual(entries[1]["skip_message"], "too large")
        self.assertEqual([entry["real_time"] for entry in entries], [0, 0, 0])

    def test_the_context_is_what_files_share(self) -> None:
        one, other = document(cell()), document(cell())
        one["run"] |= {"started_at": "2026-01-02T00:00:00Z", "conditions": {"governor": "powersave", "load": 1.5, "warnings": []}}
        other["run"] = {**other["run"], "started_at": "2026-01-01T00:00:00Z", "conditions": {"load": 2.5, "warnings": []},
                        "host": {**other["run"]["host"], "threads": 999}}
        context = json.loads(self.exported("google-benchmark", self.written(one)))["context"]
        self.assertEqual((context["cpu_scaling_enabled"], context["load_avg"]), (True, [1.5]))
        both = json.loads(self.exported("google-benchmark", self.written(one, "a.json"), self.written(other, "b.json")))["context"]
        self.assertEqual(both["date"], "2026-01-01T00:00:00Z")
        self.assertEqual({"cpu_scaling_enabled", "load_avg", "num_cpus"} & both.keys(), set())


class OfNames(unittest.TestCase):
    def test_are_different_for_different_cells_of_all_golden_files(self) -> None:
        cells = [(run, one) for run in map(results.everything, WITH_CELLS) for one in run.all_cells]
        found = cell_names.names_of(cells)
        self.assertEqual(len(set(found)), len(cells))
        self.assertEqual(len({cell_names.name_of(one) for _, one in cells}), len({(one.identity, one.starts_from_leaves) for _, one in cells}))

    def test_have_what_is_not_the_default_and_are_equal_in_two_files(self) -> None:
        made = cell(collider={"name": "bvtt", "options": {"jump": "2"}}, operation="collide", sampling={"caches": "cold"})
        made["builder"] = {"name": "karras", "options": {"order": "hilbert30", "boxes": "f32"}}
        made["scene"] |= {"frame": 3, "between": 2}
        self.assertEqual(cell_names.name_of(Cell(made)), "table1/bunny/frame:3/between:2/karras/order:hilbert30/bvtt/jump:2/cold")
        self.assertEqual(cell_names.name_of(Cell({**made, "counters": {}})), cell_names.name_of(Cell(made)))

    def test_of_a_cell_measured_twice_are_numbered_or_have_the_file(self) -> None:
        one, other = run_of(cell(), cell()), run_of(cell())
        one.path, other.path = pathlib.Path("a.json"), pathlib.Path("b.json.xz")
        name = cell_names.name_of(Cell(cell()))
        self.assertEqual(cell_names.names_of([(one, each) for each in one.all_cells]), [name, f"{name}/again:2"])
        self.assertEqual(cell_names.names_of([(run, each) for run in (one, other) for each in run.all_cells[:1]]),
                         [f"{name}/file:a", f"{name}/file:b"])


class OfTables(Exports):
    def test_csv_is_the_table_of_the_reader(self) -> None:
        for path in WITH_CELLS:
            made = pandas.read_csv(io.StringIO(self.exported("csv", path)), float_precision="round_trip", low_memory=False)
            wanted = sample_rows.read(path).replace("", float("nan"))
            self.assertEqual(list(made), list(wanted))
            for column in made:
                self.assertTrue(((made[column].astype(str) == wanted[column].astype(str)) | (made[column] == wanted[column])
                                 | (made[column].isna() & wanted[column].isna())).all(), (path, column))


class OfFiles(Exports):
    def test_are_written_once_and_replaced_with_force_only(self) -> None:
        source, out = self.written(document(cell())), self.folder / "out.csv"
        words = ("export", source, "--format", "csv", "--out", out)
        self.assertEqual(self.made("__main__.py", *words).stdout, f"written: {out}\n")
        before = out.read_bytes()
        self.assertEqual(before.decode(), self.exported("csv", source))
        self.assertIn("--force replaces it", self.made("__main__.py", *words, code=2).stderr)
        self.made("__main__.py", *words, "--force")
        self.assertEqual(out.read_bytes(), before)
        self.assertIn("is read by this command", self.made("__main__.py", "export", source, "--format", "csv", "--out", source,
                                                           "--force", code=2).stderr)

    def test_a_folder_is_all_its_result_files(self) -> None:
        inner = self.folder / "inner"
        inner.mkdir()
        self.written(document(cell()), "b.json")
        self.written(document(cell("karras")), "inner/a.json")
        (self.folder / "c.json").write_text("{}")
        (inner / "d.json").write_bytes((GOLDEN / "stress.json").read_bytes())
        done = self.run_script("__main__.py", "export", self.folder, "--format", "google-benchmark")
        self.assertEqual(done.returncode, 0, done)
        self.assertEqual(list(dict.fromkeys(entry["name"].split("/")[2] for entry in json.loads(done.stdout)["benchmarks"])), ["oibvh-multi", "karras"])
        self.assertIn(f"passed over, because they are no result files: {self.folder / 'c.json'}\n", done.stderr)
        self.assertIn(f"{inner / 'd.json'}: there are no cells to export in it, its results are of stress", done.stderr)

    def test_what_cannot_be_exported_is_a_sentence(self) -> None:
        hooked = self.written(document(cell(), test_hooks={"LATE": "1"}), "hooked.json")
        empty = self.folder / "empty"
        empty.mkdir()
        for file, says in ((hooked, "under the test hook LATE=1"), (GOLDEN / "stress.json", "its results are of stress"),
                           (self.folder / "none.json", "No such file"), (empty, "has no result file (.json or .json.xz) in it")):
            done = self.made("__main__.py", "export", file, "--format", "csv", code=3)
            self.assertIn(says, done.stderr)
            self.assertEqual((done.stderr.count("\n"), done.stdout), (1, ""))
        for words, says in ((("--format", "xml"), "must be google-benchmark or csv, not 'xml'"),
                            ((), "--format is required")):
            self.assertIn(says, self.made("__main__.py", "export", hooked, *words, code=2).stderr)


class OfRead(unittest.TestCase):
    def test_there_is_a_row_for_each_stage_of_each_sample(self) -> None:
        frame = sample_rows.read(str(TABLE2))
        cells = results.everything(TABLE2).all_cells
        wanted = [(stage["stage"], stage.get("span_ns", stage.get("wall_ns"))) for cell in cells for sample in cell.all_samples
                  for stage in sample["stages"]]
        timed = frame[frame.stage.notna()]
        self.assertEqual(list(zip(timed.stage, timed.ns)), wanted)
        self.assertEqual(tuple(frame.columns[:len(sample_rows.CELL)]), sample_rows.CELL)
        self.assertEqual(set(timed.collider_narrow), {dict(cell.collider_options)["narrow"] for cell in cells})
        self.assertEqual(set(timed.option_order), {dict(cell.options)["order"] for cell in cells if cell.all_samples})
        self.assertEqual(frame.file.unique().tolist(), [str(TABLE2)])

    def test_a_cell_without_samples_is_not_lost(self) -> None:
        frame = sample_rows.read(TABLE1)
        skipped = [cell for cell in results.everything(TABLE1).all_cells if cell.status == "skipped"]
        self.assertEqual(len(skipped), 1)
        row, = frame[frame.status == "skipped"].to_dict("records")
        self.assertEqual((row["builder"], row["ns"] == row["ns"]), (skipped[0].builder, False))

    def test_several_files_packed_or_not_and_their_counters(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            packed = pathlib.Path(folder) / "packed.json.xz"
            packed.write_bytes(lzma.compress(TABLE1.read_bytes()))
            frame = sample_rows.read([TABLE1, packed], counters=True)
        self.assertNotIn("nodes_count", sample_rows.read(TABLE1))
        one, other = (frame[frame.file == str(path)].drop(columns="file").reset_index(drop=True) for path in (TABLE1, packed))
        self.assertTrue(one.equals(other))
        cell = results.everything(TABLE1).all_cells[0]
        self.assertEqual(one.nodes_count[0], cell.counters["nodes_count"])

    def test_what_is_no_result_file_is_refused(self) -> None:
        with self.assertRaisesRegex(Refused, "is no result file"):
            sample_rows.read(ROOT / "results" / "paper" / "table1.json")
