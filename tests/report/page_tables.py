"""Tests that tables sort and filter, show the reader's numbers and missing ones, and link to raw samples."""
import re

from plots.read import results
from page import DETAIL, GOLDEN, Page, golden


class Tables(Page):
    def test_headers_sort_and_what_has_no_value_is_last(self) -> None:
        self.show("faulty")
        column = self.heads("Builds").index("whole, median")
        press = "titled.querySelectorAll('thead th')[arguments[0]].querySelector('button').click();"
        as_it_was = self.rows("Builds")
        seen = {}
        for way in ("ascending", "descending"):
            self.table("Builds", press, column)
            told = self.table("Builds", "return titled.querySelectorAll('thead th')[arguments[0]].ariaSort;", column)
            self.assertEqual(told, way)
            seen[way] = [row[column] for row in self.rows("Builds")]
            timed = [float(text.replace(",", "")) for text in seen[way] if text[0].isdigit()]
            self.assertEqual(timed, sorted(timed, reverse=way == "descending"))
            self.assertEqual({*seen[way][len(timed):]}, {"differs", "failed", "skipped"})
        self.table("Builds", press, column)
        self.assertEqual(self.rows("Builds"), as_it_was)
        self.assertNotEqual(seen["ascending"], [row[column] for row in as_it_was])

    def test_words_and_choices_filter(self) -> None:
        run = self.show("table1")
        count = "return titled.querySelector('.count').textContent;"
        everything = len(run.cells) + len(run.without_numbers)
        self.assertEqual(self.table("Builds", count), f"{everything} of {everything} rows")
        self.table("Builds", """const box = titled.querySelector("input[type=search]");
            box.value = "BUNNY oibvh";
            box.dispatchEvent(new Event("input"));""")
        expected = [cell.builder for cell in run.cells if cell.scene == "bunny" and "oibvh" in cell.builder]
        self.assertEqual([row[1] for row in self.rows("Builds")], expected)
        self.table("Builds", """const named = [...titled.querySelectorAll("label")].find((one) => one.textContent.startsWith("builder"));
            const select = named.querySelector("select");
            select.value = 'oibvh-multi'; select.dispatchEvent(new Event('change'));""")
        self.assertEqual([row[:2] for row in self.rows("Builds")], [["bunny", "oibvh-multi"]])
        self.assertEqual(self.table("Builds", count), f"1 of {everything} rows")

    def test_times_are_the_readers_medians(self) -> None:
        run = self.show("table1")
        heads = self.heads("Builds")
        unit = self.per_second("Builds")
        found = {(row[0], row[1]): row[heads.index("hierarchy")] for row in self.rows("Builds")}
        for cell in run.cells:
            expected = unit * results.quantiles(cell.times_s("hierarchy")).median
            text = next(text for (scene, builder), text in found.items()
                        if builder == cell.builder and scene.split(" ")[0] == cell.scene)
            self.assertAlmostEqual(float(text.replace(",", "")), expected, delta=6e-4 * expected)

    def test_what_has_no_time_says_so(self) -> None:
        self.assertEqual((self.report.made.returncode, self.report.made.stderr), (1, ""))
        self.show("faulty")
        column = self.heads("Builds").index("whole, median")
        bad = self.table("Builds", """return [...titled.querySelectorAll("tbody :is(tr.bad, tr.absent)")].map(
            (row) => [cells(row), row.querySelectorAll("a").length]);""")
        self.assertEqual([(row[column], links) for row, links in bad], [("differs", 0), ("failed", 0), ("skipped", 0)])
        reasons = [row[-1] for row in self.rows("Without a time, and why")]
        self.assertEqual(reasons, [DETAIL, "out of device memory: 9 bytes", "slower than the time allowed a cell"])
        wrong = next(cell for cell in self.report.faulty["cells"] if cell["status"] == "measured")
        traces = self.chart("Time against size", "return drawing.data.map((trace) => [trace.name, trace.text]);")
        shown = {(name, scene) for name, scenes in traces for scene in scenes}
        self.assertNotIn((wrong["builder"]["name"], wrong["scene"]["name"]), shown)
        said = self.chart("Time against size", "return chart.querySelector('.note').textContent;")
        self.assertIn(f"{wrong['builder']['name']} gave a wrong answer on {wrong['scene']['name']}: {DETAIL}", said)
        self.choose("Time by stage", "Scene", wrong["scene"]["name"])
        said = self.chart("Time by stage", "return [...drawing.querySelectorAll('.annotation')].map((one) => one.textContent);")
        self.assertIn(f"differs: {DETAIL}", said)
        tally = self.browser.run("return document.querySelector('section:not([hidden]) .verdicts').innerText")
        agreeing = len(self.report.faulty["cells"]) - 3
        self.assertEqual(tally.split(), ["agrees", str(agreeing), "differs", "1", "failed", "1", "skipped", "1"])

    def test_a_text_of_the_csv_is_no_formula_of_a_spreadsheet(self) -> None:
        self.show("faulty")
        text = self.table("Without a time, and why", """const [create, click] = [URL.createObjectURL, HTMLAnchorElement.prototype.click];
            const buttons = [...titled.querySelectorAll("button")];
            let saved;
            URL.createObjectURL = (blob) => { saved = blob; return "#"; };
            HTMLAnchorElement.prototype.click = () => {};
            buttons.find((button) => button.textContent === "CSV").click();
            [URL.createObjectURL, HTMLAnchorElement.prototype.click] = [create, click];
            return saved.text();""")
        self.assertIn(f",'{DETAIL}\n", text)
        self.assertNotIn(f",{DETAIL}", text)

    def test_stress_shows_what_broke(self) -> None:
        self.show("stress")
        self.table("Stress", "titled.open = true;")
        self.browser.wait_for("document.querySelector('section:not([hidden]) details.titled[open] tbody')")
        document = golden("stress")
        broken = sum(finding["verdict"] == "broken" for cell in document["stress"] for finding in cell["findings"].values())
        self.assertEqual(self.table("Stress", "return titled.querySelectorAll('.state-broken').length;"), broken)

    def test_a_number_leads_to_its_raw_samples(self) -> None:
        self.show("table2")
        document = golden("table2")
        link = self.table("Frames", """const link = titled.querySelectorAll("tbody tr")[3].querySelector('a[href$=".broad"]');
            link.click();
            return link.getAttribute("href");""")
        self.browser.wait_for("document.querySelector('dialog[open] .drawing.drawn')")
        place = int(re.fullmatch(r"#cell=2\.(\d+)\.broad", link)[1])
        frames = [k for k, cell in enumerate(document["cells"]) if cell["operation"] == "collide"]
        self.assertEqual(place, frames[3])  # rows are in the file's order
        samples = document["cells"][place]["samples"]
        rows, heads = self.browser.run("""const dialog = document.querySelector("dialog");
            return [[...dialog.querySelectorAll("tbody tr")].map((row) => [...row.children].map((cell) => cell.innerText)),
                [...dialog.querySelectorAll("thead button")].map((head) => head.firstChild.data.trim())];""")
        numbers = [[int(text.replace(",", "")) for text in row] for row in rows]
        self.assertEqual([row[0] for row in numbers], [sample["order"] for sample in samples])
        for number, sample in zip(numbers, samples, strict=True):
            for entry in sample["stages"]:
                self.assertEqual(number[heads.index(entry["stage"])], entry.get("span_ns", entry.get("wall_ns")))
        self.assertEqual(self.browser.run("return document.querySelector('dialog .drawing').data[0].y.length"), len(samples))
        whole = [1e9 * time for time in results.load(GOLDEN / "table2.json").cells[place].times_s()]
        self.assertEqual([row[heads.index("whole")] for row in numbers], [round(time) for time in whole])
        self.browser.run("document.querySelector('dialog button').click()")
        self.browser.wait_for("!document.querySelector('dialog[open]') && location.hash === '#file-2'")

    def test_an_address_leads_to_samples(self) -> None:
        self.browser.open(self.report.page, "#cell=0.0.hierarchy")
        self.browser.wait_for("document.querySelector('dialog[open] .drawing.drawn')")
        text = self.browser.run("return document.querySelector('dialog').innerText")
        first = golden("table1")["cells"][0]
        self.assertIn(f"{first['builder']['name']} on {first['scene']['name']}", text)
        self.assertIn(f"{first['counters']['tree_bytes']}", text)
