"""Tests what the history of an experiment marks at which commit, and which files have no place in it."""
import unittest
from typing import Any

from base import InFolder, Raw, cell, document, golden, stage  # first: it adds the source root to sys.path

from plots.files.json_files import Refused
from plots.files.output import WrongUsage
from plots.page import history, report

RUN = golden("table1")["run"]


def timed(ns: float, builder: str = "karras", **more: Any) -> Raw:
    return cell(builder, **{"samples": [{"order": place, "stages": [stage("hierarchy", int(ns) + place)]} for place in range(9)], **more})


def at(day: int, *cells: Raw, **facts: Any) -> Raw:
    """Returns a result file of a commit of that day."""
    return document(*cells, **{"started_at": f"2026-01-{day:02}T00:00:00Z", "program": RUN["program"] | {"commit": 10 * str(day)}, **facts})


class Histories(InFolder):
    def part(self, *documents: Raw) -> report.Part:
        files = [self.written(one, f"{place}.json") for place, one in enumerate(documents)]
        ((experiment, axis, _), found), = history.histories_of(files[::-1]).items()
        return history.part_of(experiment, axis, found, "")

    def rows(self, *documents: Raw) -> list[list[str]]:
        """Returns the commit's day and the kind of each change."""
        return [[commit[0], kind] for table in self.part(*documents).data["tables"] for commit, _, _, kind, _ in table["rows"]]

    def test_a_time_is_marked_where_it_changed_and_a_slow_drift_is_found(self) -> None:
        for times, marked in (((1e5, 1.1e5, 3e5, 3.1e5), [["3", "slower"]]), ([1e5 * 1.2 ** day for day in range(5)], [["4", "slower"]]),
                              ((3e5, 1e5), [["2", "faster"]]), ((1e5, 1.3e5), [])):
            self.assertEqual(self.rows(*(at(day, timed(ns)) for day, ns in enumerate(times, 1))), marked)

    def test_counters_verdicts_and_circumstances_are_marked(self) -> None:
        wrong, other = {"check": {"verdict": "differs"}, "counters": {"nodes_count": 7}}, {"host": RUN["host"] | {"os": "B"}}
        made = [at(1, timed(9)), at(2, timed(9, counters={"nodes_count": 7})), at(3, timed(9, **wrong)), *(at(day, timed(9, "perfect"), **other) for day in (4, 5))]
        self.assertEqual(self.rows(*made), [["4", "new"], ["4", "gone"], ["4", "circumstance"], ["3", "worse"], ["2", "worse"], ["2", "changed"]])
        self.assertEqual([(one["state"], bool(one["times"]), one["frame"], len(one["told"])) for one in self.part(*made).data["cells"]],
                         [("agrees", True, 0, 0), ("agrees", True, 1, 3), ("differs", False, 2, 1), ("absent", False, 3, 1),
                          ("agrees", True, 3, 1), ("agrees", True, 4, 0)])
        for count, code in ((3, 1), (5, 0)):
            files = [self.written(one, f"{place}.json") for place, one in enumerate(made[:count])]
            self.made("__main__.py", "report", "--history", *files, "-o", self.folder / "page.html", code=code)

    def test_times_beside_warnings_are_not_judged_and_not_judged_by(self) -> None:
        noisy = {"conditions": {"warnings": ["load 9"]}}
        made = [at(1, timed(1e5), **noisy), at(2, timed(9e5), **noisy), at(3, timed(1e5)), at(4, timed(9e5))]
        self.assertEqual(self.rows(*made), [["4", "slower"], ["2", "warning"], ["1", "warning"]])
        self.assertEqual(self.part(*made).warnings, ["No change of a time is told at 2 commits whose runs warn, nor against them."])

    def test_files_without_a_place_are_refused_and_machines_apart(self) -> None:
        merged = at(2, timed(9)) | {"merged_from": [{"id": name, "commit": name} for name in "ab"]}
        for other, error, says in ((at(1, timed(9)), WrongUsage, "both have table1 of commit 1111111111: leave one of them out"),
                                   (at(2, timed(9), started_at="yesterday"), Refused, "has no date: it says that it started at 'yesterday'"),
                                   (at(2, timed(9), program=RUN["program"] | {"dirty": True}), WrongUsage, "it has no place among commits"),
                                   (merged, WrongUsage, "is merged from several commits"), (at(2), WrongUsage, "is of no cells")):
            with self.assertRaisesRegex(error, says):
                self.part(at(1, timed(9)), other)
        files = [self.written(at(2, timed(9), host=RUN["host"] | {"cpu": name}), f"{name}.json") for name in "AB"]
        done = self.run_script("__main__.py", "report", "--history", *files, "-o", self.folder / "page.html")
        self.assertEqual((done.returncode, done.stderr), (0, "bvhbench: the files are of several machines, and each has a history of its own\n"))
        self.made("__main__.py", "report", "--history", *files, "--scene", "torus:100", code=2)


if __name__ == "__main__":
    unittest.main()
