"""Tests that charts draw the values of the reader of result files, one mark for each cell, in the colours of figures."""
from plots.draw import pipelines, style
from plots.figures import pareto_orders
from plots.read import pareto, results
from page import Page, golden


class Charts(Page):
    def test_charts_draw_a_mark_for_each_cell_in_its_builders_colour(self) -> None:
        run = self.show("table1")
        marks = self.chart("Time against size", """return {points: drawing.querySelectorAll(".scatterlayer .point").length,
            svg: drawing.querySelector("svg").getBoundingClientRect().height,
            colours: Object.fromEntries(drawing.data.map((trace) => [trace.name, trace.marker.color])),
            titles: [drawing.layout.xaxis.title.text, drawing.layout.yaxis.title.text]};""")
        self.assertEqual(marks["points"], len(run.timed("table1", "hierarchy")))
        self.assertGreater(marks["svg"], 300)
        self.assertEqual(marks["colours"], {name: style.look(name).colour for name in {cell.builder for cell in run.cells}})
        self.assertEqual(marks["titles"][0], "triangles")
        self.assertRegex(marks["titles"][1], r"^time, (ns|µs|ms|s)$")
        bars = self.chart("Time by stage", """return [...drawing.querySelectorAll(".barlayer .point path")].filter(
            (bar) => bar.getBoundingClientRect().width > 1).length;""")
        self.assertEqual(bars, len([cell for cell in run.cells if cell.scene == run.cells[0].scene]))

    def test_the_front_is_that_of_the_figures(self) -> None:
        run = self.show("quality")
        scene = run.builds[0].scene
        self.choose("Time against quality or error", "Scene", scene)
        points = pareto_orders.points_of([cell for cell in run.builds if cell.scene == scene])
        drawn = self.chart("Time against quality or error", """const [front, ...points] = drawing.data;
            const isFilled = (trace) => (_, k) => !trace.marker.symbol[k].endsWith("-open");
            return {front: front.y, filled: points.flatMap((trace) => trace.y.filter(isFilled(trace))),
                all: points.flatMap((trace) => trace.y)};""")
        front = [cost for _, cost, _ in pareto.front(points)]
        self.assertEqual(drawn["front"], front)
        self.assertEqual(sorted(drawn["filled"]), sorted(front))
        self.assertEqual(sorted(drawn["all"]), sorted(cost for _, cost, _ in points))

    def test_frames_are_the_medians_of_the_reader(self) -> None:
        run = self.show("table2")
        scene, shown = next((scene, shown) for scene, shown in pipelines.of(run, "table2").items() if len(shown[0].cells) > 1)
        self.choose("Time a frame", "Show", "whole")  # of the only scene that has several frames
        unit = {"s": 1e3, "ms": 1.0, "µs": 1e-3}
        drawn = self.chart("Time a frame", """const lines = drawing.data.map((trace) => [trace.name, trace.y]);
            return [drawing.layout.yaxis.title.text, Object.fromEntries(lines)];""")
        self.assertEqual(set(drawn[1]), {pipeline.label for pipeline in shown})
        for pipeline in shown:
            found_all = [found for found in drawn[1][pipeline.label] if found is not None]  # a frame without a time is a gap
            for found, expected in zip(found_all, pipeline.frame_ms(), strict=True):
                self.assertAlmostEqual(found * unit[drawn[0].split(", ")[1]], expected, delta=1e-4 * expected)

    def test_a_bar_of_several_frames_is_the_mean_of_the_medians_after_the_first(self) -> None:
        run = self.show("table2")
        scene, shown = next((scene, shown) for scene, shown in pipelines.of(run, "table2").items() if len(shown[0].cells) > 1)
        label = self.chart("Time by stage", """return [...chart.querySelectorAll("option")].map((one) => one.value).find(
            (one) => one.includes(arguments[0]));""", scene)
        self.choose("Time by stage", "Scene", label)
        title, bars = self.chart("Time by stage", """return [drawing.layout.xaxis.title.text,
            drawing.data.flatMap((trace) => trace.customdata.map((name, k) => [name, trace.x[k]]))];""")
        unit = {"s": 1e3, "ms": 1.0, "µs": 1e-3}[title.split(", ")[1]]
        there = {name for name, _ in bars}
        self.assertTrue(there)
        for pipeline in shown:
            if pipeline.label in there:
                drawn, expected = unit * sum(x for name, x in bars if name == pipeline.label), pipeline.later.frame_ms()
                self.assertAlmostEqual(drawn, sum(expected) / len(expected), delta=1e-4 * drawn)

    def test_the_slowest_frame_is_the_readers_and_leads_to_its_samples(self) -> None:
        run = self.show("table2")
        column = self.heads("Whole frames by scene").index("slowest frame")
        unit = 1e9 / self.per_second("Whole frames by scene")
        links = self.table("Whole frames by scene", """return [...titled.querySelectorAll("tbody tr")].map((row) => {
            const link = row.children[arguments[0]].querySelector("a");
            return link && [link.textContent, link.getAttribute("href")];});""", column)
        slowest = [max(pipeline.cells, key=lambda cell: results.quantiles(cell.times_s()).median)
                   for shown in pipelines.of(run, "table2").values() for pipeline in shown]
        document = golden("table2")
        measured = [place for place, cell in enumerate(document["cells"]) if cell["status"] == "measured"]
        expected = {f"#cell=2.{measured[run.cells.index(cell)]}.whole": 1e9 * results.quantiles(cell.times_s()).median
                    for cell in slowest}
        for text, link in filter(None, links):
            self.assertAlmostEqual(unit * float(text.replace(",", "")), expected[link], delta=6e-4 * expected[link])
        self.assertGreater(len(list(filter(None, links))), 1)

    def test_a_legend_hides_and_shows(self) -> None:
        self.show("table1")
        points = "return drawing.querySelectorAll('.scatterlayer .point').length;"
        before = self.chart("Time against size", points)
        self.chart("Time against size", "chart.querySelector('.legend button').click();")
        self.assertLess(self.chart("Time against size", points), before)
        self.chart("Time against size", "chart.querySelector('.legend button').click();")
        self.assertEqual(self.chart("Time against size", points), before)

    def test_a_mark_of_a_chart_leads_to_its_samples(self) -> None:
        self.show("table1")
        mark = self.chart("Time against size", """drawing.scrollIntoView({block: "center"});
            const last = drawing.data.length - 1; const place = drawing.data[last].x.length - 1;
            const marks = drawing.querySelectorAll(".scatterlayer .trace")[last].querySelectorAll(".point");
            const box = marks[place].getBoundingClientRect();
            return [drawing.data[last].name, drawing.data[last].text[place], box.x + box.width / 2, box.y + box.height / 2];""")
        self.browser.click(mark[2], mark[3])
        self.browser.wait_for("document.querySelector('dialog[open] .drawing.drawn')")
        title = self.browser.run("return document.querySelector('dialog h2').textContent")
        self.assertEqual(title, f"{mark[0]} on {mark[1]}")
