#!/usr/bin/env python3
"""Tests a report in a browser: charts draw the files' values, tables sort and filter, numbers link to their samples, and missing
times are marked. The page sends no network requests."""
import unittest

from page import FILES, GOLDEN, Page, report  # first: it takes the arguments and adds plots to sys.path

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


class Brief(Page):
    def test_figures_stand_for_charts_and_numbers_lead_nowhere(self) -> None:
        page = self.report.folder / "brief.html"
        done = report(page, *(GOLDEN / f"{name}.json" for name in ("table1", "table2")), "--brief")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertLess(page.stat().st_size, 1e6)
        for place, figures in enumerate((["table1"], ["table2", "table2-fig10", "table2-fig9"])):
            self.browser.open(page, f"#file-{place}")
            here = "document.querySelectorAll('section:not([hidden]) .drawn')"
            self.browser.wait_for(f"{here}.length && [...{here}].every((one) => one.querySelector('img').naturalWidth > 0)")
            self.assertEqual(sorted(self.browser.run(f"return [...{here}].map((one) => one.innerText.trim())")), figures)
            self.assertTrue(self.browser.run("return document.querySelectorAll('section:not([hidden]) tbody tr').length"))
        self.browser.go("#overview")
        self.assertEqual(self.browser.run("return document.querySelectorAll('a[href^=\"#cell\"], .drawing, dialog[open]').length"), 0)


if __name__ == "__main__":
    unittest.main()
