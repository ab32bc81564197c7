"""Table 1: what one hierarchy takes once the triangles are sorted, per mesh and builder.

Above: median time on a logarithmic axis, whiskers from the 10th to the 90th percentile, and the paper's printed times, which are another
machine's. Below it: triangles per second, and how near the builder comes to a plain copy of the bytes it must move,
measured in the same run.
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FuncFormatter, MaxNLocator

from ..draw import figure, style
from ..read import results
from ..words import tables

STAGE = "hierarchy"
GROUP_WIDTH = 0.88  # most width of a mesh's bars, relative to the distance between two meshes
ROOM = 1.4  # of the axis of throughput, relative to the largest: for its number
BAR_WIDTH = 0.16  # most width of one bar, relative to that distance, so that few builders do not give wide blocks


def scene_title(cell: results.Cell) -> str:
    name = f"{cell.stand_in_for}*" if cell.stand_in_for else cell.scene
    return f"{name}\n{cell.triangles:,} triangles"


def paper_time_ms(cell: results.Cell, rows: list[dict]) -> float | None:
    """Returns the printed time of this builder on this mesh, or on the mesh that this one stands in for."""
    for row in rows:
        same = row["scene"] in (cell.scene, cell.stand_in_for) or row["triangles"] == cell.triangles
        if same and row["builder"] == cell.builder:
            return row["hierarchy_ms"]
    return None


class Bars:
    """Three panels over the same bars: time, throughput, and share of the copy rate."""

    def __init__(self, run: results.Run, cells: list[results.Cell]):
        self.series = style.in_order(cells)
        self.scenes = list(dict.fromkeys(cell.scene for cell in cells))
        self.width = min(GROUP_WIDTH / len(self.series), BAR_WIDTH)
        self.copy_rate = run.copy_rate
        self.rows = results.printed("table1")["rows"]
        self.figure, panels = figure.grid(3, 1, 6.2, sharex=True, height_ratios=(5, 3, 2))
        self.time, self.throughput, self.rate = panels[:, 0]

    def draw(self, cell: results.Cell) -> None:
        series = style.series_of(cell)
        look = style.look_in(series, self.series)
        place = self.series.index(series) - (len(self.series) - 1) / 2
        x = self.scenes.index(cell.scene) + place * self.width
        dress = {"width": 0.9 * self.width, "color": look.colour, "hatch": look.hatch, "edgecolor": "white", "linewidth": 0}
        seconds = results.quantiles(cell.times_s(STAGE))
        spread = [[1e3 * (seconds.median - seconds.p10)], [1e3 * (seconds.p90 - seconds.median)]]
        self.time.plot(x, 1e3 * seconds.median, look.marker, color=look.colour)
        self.time.errorbar(x, 1e3 * seconds.median, yerr=spread, color="#222222", elinewidth=0.7, capsize=1.2,
                           capthick=0.7)
        million = 1e-6 * cell.triangles / seconds.median
        self.throughput.bar(x, million, **dress)
        self.throughput.annotate(tables.three_digits(million), (x, million), (0, 2), textcoords="offset points", rotation=90,
                                 ha="center", va="bottom", fontsize=style.SMALL)
        printed = paper_time_ms(cell, self.rows)
        if printed is not None:
            self.time.plot(x, printed, zorder=4, **style.PAPER_MARK)
        moved = cell.moved_bytes(STAGE)
        if moved and self.copy_rate:
            share = tables.of_copy_rate(moved / seconds.median / self.copy_rate)
            if share == tables.IN_CACHE:
                self.rate.text(x, 2, share, rotation=90, ha="center", va="bottom", fontsize=style.SMALL, color="#777777")
            else:
                self.rate.bar(x, 100 * share, **dress)

    def scale(self, cells: list[results.Cell]) -> None:
        """Sets a logarithmic axis of times that holds all values, measured and printed, and room for numbers above the
        throughput."""
        values = [1e3 * value for cell in cells for value in results.quantiles(cell.times_s(STAGE))]
        values += [printed for cell in cells if (printed := paper_time_ms(cell, self.rows)) is not None]
        low, high = min(values) / 2, max(values) * 1.3
        self.time.set_ylim(low, high)
        figure.log_ticks(self.time.yaxis, low, high)
        self.throughput.set_ylim(0, ROOM * self.throughput.dataLim.y1)
        self.throughput.yaxis.set_major_locator(MaxNLocator(5))
        self.throughput.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,.10g}"))

    def finish(self, run: results.Run, cells: list[results.Cell]) -> None:
        titles = {cell.scene: scene_title(cell) for cell in cells}
        self.rate.set_xlim(-0.5, len(self.scenes) - 0.5)
        self.rate.set_xticks(range(len(self.scenes)), [titles[scene] for scene in self.scenes])
        for axes in (self.rate, self.time, self.throughput):
            axes.tick_params(axis="x", length=0)
        self.throughput.set(ylabel="million triangles/s")
        self.time.set(yscale="log", ylabel="hierarchy, ms")
        self.scale(cells)
        self.rate.set(ylabel="% of copy rate")
        self.rate.set_ylim(0, 100)
        looks = [(series, style.look_in(series, self.series)) for series in self.series]
        handles = [Patch(facecolor=look.colour, edgecolor="white", linewidth=0, hatch=look.hatch,
                         label=style.label(series, self.series)) for series, look in looks]
        printed = f"paper: {results.printed_device('table1')}, another machine"
        handles.append(Line2D([], [], **style.PAPER_MARK, label=printed))
        height = figure.legend_above(self.figure, handles)
        copy = f"; copy rate {self.copy_rate / 1e9:,.0f} GB/s" if self.copy_rate else ""
        remarks = [f"Medians; whiskers: 10th to 90th percentile{copy}."]
        if any(cell.stand_in_for for cell in cells):
            remarks.append("* generated stand-in with the mesh's triangle count.")
        figure.footer(self.figure, run, "table1", tuple(remarks), height)


def draw(run: results.Run) -> plt.Figure:
    cells = run.timed("table1", STAGE)
    cells.sort(key=lambda cell: cell.triangles)
    bars = Bars(run, cells)
    for cell in cells:
        bars.draw(cell)
    bars.finish(run, cells)
    return bars.figure
