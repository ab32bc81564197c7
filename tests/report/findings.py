"""Tests that the overview answers each experiment's question, that stand-ins, skips and libraries are told apart from the rest,
and that the page is dark where the reader wants it so."""
import json

from plots.read import results
from page import FILES, GOLDEN, ROOT, Page, golden

STAR = "* a stand-in: the scene itself is not there."


def called(cell: results.Cell) -> str:
    """Returns the name that a page should show for a scene."""
    other = cell.stand_in_for
    return cell.scene + (" *" if other else "") + (f" (for {other})" if other and other != cell.scene else "")


class Findings(Page):
    def test_the_overview_first_says_what_was_found(self) -> None:
        self.browser.open(self.report.page, "#overview")
        heads = self.browser.run("return [...document.querySelectorAll('#overview h3')].map((head) => head.textContent);")
        self.assertEqual(heads, ["What was found", "The best of each scene", "What was run on what"])
        found = self.browser.run("""const parts = ["h4", ".question", ".answer"];
            const texts = (one) => parts.map((part) => one.querySelector(part)?.textContent);
            return [...document.querySelectorAll("#overview .finding")].map(texts);""")
        question = json.loads((ROOT / "harness" / "experiments" / "table1.json").read_text(encoding="utf-8"))["question"]
        self.assertEqual(found[0][:2], ["table1", question])
        self.assertTrue(found[0][2].endswith(" 44 answers are right; 1 cell skipped."), found[0])
        stress = next(answer for head, _, answer in found if head == "stress")
        self.assertEqual(stress, "Ours: none of 9 cells broken, none refused. Embree: 4 of 7 cells broken. "
                                 "FCL: 8 of 8 cells broken.")

    def scenes_of_table1(self) -> dict[str, list[results.Cell]]:
        return results.grouped(results.load(GOLDEN / "table1.json").cells, lambda cell: cell.scene)

    def test_the_best_of_each_scene_is_the_readers(self) -> None:
        self.browser.open(self.report.page, "#overview")
        heads, title = self.heads("The best of each scene"), "The best of each scene"
        rows = [dict(zip(heads, row)) for row in self.rows(title) if row[0] == "table1"]
        for row, cells in zip(rows, self.scenes_of_table1().values(), strict=True):
            first, second = sorted(cells, key=lambda cell: cell.median_ns())[:2]
            self.assertEqual((row["scene"], row["best"], row["next"]), (called(first), first.builder, second.builder))
            us = first.median_ns() / 1e3
            self.assertAlmostEqual(float(row["time"].replace(",", "")), us, delta=1e-3 * us)
            self.assertAlmostEqual(float(row["ratio"]), second.median_ns() / first.median_ns(), delta=1e-3)
        links = self.table(title, "return titled.querySelector('tbody').rows[0].querySelectorAll('a').length;")
        self.assertEqual(links, 2)  # to the file and to the samples

    def test_stand_ins_have_a_star_and_a_note_in_every_chart_and_table(self) -> None:
        run = self.show("table1")
        starred = {called(cell) for cell in run.all_cells if cell.stand_in_for}
        self.assertIn("torus:412669 * (for erato)", starred)
        named = self.chart("Time against size", "return drawing.layout.annotations.map((one) => one.text);")
        self.assertLessEqual(starred, set(named))
        for title in ("Time by stage", "Time against quality or error"):
            options = self.chart(title, "return [...chart.querySelectorAll('select')[0].options].map((one) => one.value);")
            self.assertEqual({one for one in options if "*" in one}, starred)
            self.choose(title, "Scene", sorted(starred)[0])
        for title in ("Time against size", "Time by stage", "Time against quality or error"):
            self.assertIn(STAR, self.chart(title, "return chart.querySelector('.note').textContent;"), title)
        self.assertEqual({row[0] for row in self.rows("Builds") if "*" in row[0]}, starred)
        self.assertIn(STAR, self.table("Builds", "return titled.querySelector('.note').textContent;"))
        self.show("faulty")
        self.choose("Time by stage", "Scene", "bunny")
        self.assertNotIn("*", self.chart("Time by stage", "return chart.querySelector('.note').textContent;"))

    def test_scenes_are_told_apart_where_time_is_drawn_against_size(self) -> None:
        self.show("faulty")
        looks = """return drawing.data.filter((trace) => trace.meta).map(
            (trace) => [trace.name, trace.meta, trace.line.dash, trace.marker.symbol, trace.visible ?? true]);"""
        drawn = self.chart("Time against size", looks)
        self.assertEqual({family for _, family, *_ in drawn}, {"torus", "soup"})
        for _, family, dash, symbol, _ in drawn:
            self.assertEqual((dash == "solid", symbol.endswith("-open")), (family == "torus", family == "soup"))
        self.chart("Time against size", """[...chart.querySelectorAll(".legend button")].find(
            (button) => button.textContent === "soup").click();""")
        hidden = {family for _, family, *_, visible in self.chart("Time against size", looks) if visible == "legendonly"}
        self.assertEqual(hidden, {"soup"})
        self.choose("Time against size", "Scenes", "soup")
        self.assertEqual({family for _, family, *_ in self.chart("Time against size", looks)}, {"soup"})

    def test_what_is_in_cache_says_so_instead_of_a_share(self) -> None:
        self.show("faulty")  # its copy rate is very low
        column = self.heads("Builds").index("of copy rate")
        texts = {row[column] for row in self.rows("Builds")}
        self.assertEqual(texts, {"in cache", "–"})
        self.show("table1")
        shares = [row[self.heads("Builds").index("of copy rate")] for row in self.rows("Builds")]
        self.assertTrue(any(text.endswith(" %") for text in shares))

    def test_a_skip_is_neutral_and_a_failure_is_not(self) -> None:
        self.show("faulty")
        style = """return Object.fromEntries([...titled.querySelectorAll("tbody tr")].map((row) => {
            const badge = row.querySelector(".state");
            const back = (one) => getComputedStyle(one).backgroundColor;
            return [badge.textContent, [back(row.children[1]), back(badge)]];}));"""
        seen = self.table("Builds", style)
        self.assertEqual(seen["skipped"], seen["agrees"])
        self.assertEqual(seen["failed"], seen["differs"])
        self.assertNotEqual(seen["failed"][0], seen["agrees"][0])
        self.assertNotEqual(seen["failed"][1], seen["agrees"][1])

    def test_what_libraries_broke_is_counted_apart(self) -> None:
        self.browser.open(self.report.page, "#overview")
        rows = {row[0]: row[1:] for row in self.rows("What was run on what")}
        self.assertEqual(list(rows), [*FILES, "faulty"])
        self.assertEqual((rows["stress"][2], rows["faulty"][2]),
                         ("12 broken, all of libraries: FCL 8, Embree 4", "1 differs; 1 failed; 1 skipped"))
        self.assertEqual({row[3] for row in rows.values()}, {"Invented GPU"})
        self.show("stress")
        tally = self.browser.run("return document.querySelector('section:not([hidden]) .verdicts').innerText;")
        self.assertEqual(" ".join(tally.split()), "holds 18 refused 3 broken 12, all of libraries: FCL 8, Embree 4")
        classes = self.browser.run("""const shown = document.querySelectorAll("section:not([hidden]) .state-broken");
            return [...shown].map((one) => one.className);""")
        self.assertTrue(all("of-library" in one for one in classes))
        bad = self.rows("Broken or refused")
        findings = [finding for cell in golden("stress")["stress"] for finding in cell["findings"].values()]
        self.assertEqual(len(bad), sum(finding["verdict"] != "holds" for finding in findings))
        self.assertEqual({row[self.heads("Broken or refused").index("whose")] for row in bad}, {"FCL", "Embree"})

    def test_the_page_is_dark_where_the_reader_wants_it(self) -> None:
        self.show("table1")
        colours = """return [drawing.layout.paper_bgcolor, getComputedStyle(chart).backgroundColor, drawing.layout.font.color,
            drawing.data.map((trace) => trace.marker.color)];"""
        paper = "document.querySelector('section:not([hidden]) .drawing').layout.paper_bgcolor"
        light = self.chart("Time against size", colours)
        emulate = self.browser.driver.execute_cdp_cmd
        emulate("Emulation.setEmulatedMedia", {"features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        try:
            self.browser.wait_for(f"{paper} !== '#ffffff'")
            dark = self.chart("Time against size", colours)
        finally:
            emulate("Emulation.setEmulatedMedia", {"features": []})
        self.assertTrue(all(one != other for one, other in zip(light, dark)))
        self.assertEqual((light[0], dark[0]), ("#ffffff", "#1f2327"))
        self.assertEqual((light[1], dark[1]), ("rgb(255, 255, 255)", "rgb(31, 35, 39)"))
        self.browser.wait_for(f"{paper} === '#ffffff'")
