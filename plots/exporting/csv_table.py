"""Writes a row for each stage of each sample as CSV, with the columns of bvhbench.read."""
import csv
import io

from ..read import sample_rows
from ..read.results import Run


def text(runs: list[Run]) -> str:
    rows = [row for run in runs for row in sample_rows.rows(run, counters=False)]
    file = io.StringIO()
    writer = csv.DictWriter(file, sample_rows.columns_of(rows), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return file.getvalue()
