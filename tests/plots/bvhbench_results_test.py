#!/usr/bin/env python3
"""Tests reading result files into pandas tables."""
import importlib.util
import lzma
import pathlib
import tempfile
import unittest

from base import GOLDEN, ROOT  # first: it adds the source root to sys.path

import bvhbench_results
from plots.read import results

TABLE1, TABLE2 = GOLDEN / "table1.json", GOLDEN / "table2.json"


@unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not there")
class OfRead(unittest.TestCase):
    def test_there_is_a_row_for_each_stage_of_each_sample(self) -> None:
        frame = bvhbench_results.read(str(TABLE2))
        cells = results.everything(TABLE2).all_cells
        wanted = [(stage["stage"], stage.get("span_ns", stage.get("wall_ns"))) for cell in cells for sample in cell.all_samples
                  for stage in sample["stages"]]
        timed = frame[frame.stage.notna()]
        self.assertEqual(list(zip(timed.stage, timed.ns)), wanted)
        self.assertEqual(tuple(frame.columns[:len(bvhbench_results.CELL)]), bvhbench_results.CELL)
        self.assertEqual(set(timed.collider_narrow), {dict(cell.collider_options)["narrow"] for cell in cells})
        self.assertEqual(set(timed.option_order), {dict(cell.options)["order"] for cell in cells if cell.all_samples})
        self.assertEqual(frame.file.unique().tolist(), [str(TABLE2)])

    def test_a_cell_without_samples_is_not_lost(self) -> None:
        frame = bvhbench_results.read(TABLE1)
        skipped = [cell for cell in results.everything(TABLE1).all_cells if cell.status == "skipped"]
        self.assertEqual(len(skipped), 1)
        row, = frame[frame.status == "skipped"].to_dict("records")
        self.assertEqual((row["builder"], row["ns"] == row["ns"]), (skipped[0].builder, False))

    def test_several_files_packed_or_not_and_their_counters(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            packed = pathlib.Path(folder) / "packed.json.xz"
            packed.write_bytes(lzma.compress(TABLE1.read_bytes()))
            frame = bvhbench_results.read([TABLE1, packed], counters=True)
        self.assertNotIn("nodes_count", bvhbench_results.read(TABLE1))
        one, other = (frame[frame.file == str(path)].drop(columns="file").reset_index(drop=True) for path in (TABLE1, packed))
        self.assertTrue(one.equals(other))
        cell = results.everything(TABLE1).all_cells[0]
        self.assertEqual(one.nodes_count[0], cell.counters["nodes_count"])

    def test_what_is_no_result_file_is_refused(self) -> None:
        with self.assertRaisesRegex(bvhbench_results.Refused, "is no result file"):
            bvhbench_results.read(ROOT / "results" / "paper" / "table1.json")


if __name__ == "__main__":
    unittest.main()
