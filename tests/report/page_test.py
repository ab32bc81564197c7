#!/usr/bin/env python3
"""Tests a report in a browser: charts draw the files' values, tables sort and filter, numbers link to their samples, and missing
times are marked. The page sends no network requests."""
import json
import unittest

from page import FILES, Page, golden, report  # first: it takes the arguments and adds plots to sys.path

from charts import Charts  # noqa: F401
from findings import Findings  # noqa: F401
from page_tables import Tables  # noqa: F401

WIDTHS = (1280, 400)


class Whole(Page):
    def test_nothing_is_wider_than_the_window(self) -> None:
        for width in WIDTHS:
            self.browser.resize(width)
            self.browser.open(self.report.page)
            for part in ("#overview", *(f"#file-{place}" for place in range(len(FILES) + 1)), "#cell=2.3.broad"):
                self.browser.go(part)
                self.browser.all_drawn()
                sizes = self.browser.run("""const dialog = document.querySelector("dialog");
                    return [document.documentElement.scrollWidth, innerWidth, dialog.scrollWidth - dialog.clientWidth];""")
                self.assertEqual(sizes, [width, width, 0], part)

    def test_the_same_files_make_the_same_page(self) -> None:
        again = self.report.folder / "again.html"
        report(again, *self.report.files)
        self.assertEqual(again.read_bytes(), self.report.page.read_bytes())


class History(Page):
    def test_a_line_has_a_band_and_a_ring_where_it_changed(self) -> None:
        page, files = self.report.folder / "history.html", [self.report.folder / f"{day}.json" for day in (2, 1)]
        for day, file in zip((2, 1), files, strict=True):
            made = golden("table1")
            made["run"] |= {"started_at": f"2026-01-0{day}T00:00:00Z", "program": made["run"]["program"] | {"commit": 10 * str(day)}}
            for cell in made["cells"] if day == 2 else ():
                if cell["builder"]["name"] == "karras":
                    cell["counters"]["nodes_count"] += 1
            file.write_text(json.dumps(made), encoding="utf-8")
        done = report(page, "--history", *files)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.browser.open(page, "#file-0")
        self.browser.all_drawn()
        drawn = self.chart("Over commits", """return [drawing.layout.xaxis.ticktext, drawing.data.filter((trace) => trace.name === "karras").map(
            (trace) => [trace.mode, trace.fill ?? "", trace.x, trace.y])];""")
        self.assertEqual(drawn[0], ["1111111111<br>2026-01-01", "2222222222<br>2026-01-02"])
        (_, fill, around, band), (mode, _, places, line), (_, _, rings, heights) = drawn[1]
        self.assertEqual((fill, around, mode, places, rings, heights), ("toself", [0, 1, 1, 0], "lines+markers", [0, 1], [1], [line[1]]))
        self.assertTrue(band[3] <= line[0] <= band[0] and band[2] <= line[1] <= band[1])
        self.assertEqual({row[3] for row in self.rows("What changed")}, {"worse"})


if __name__ == "__main__":
    unittest.main()
