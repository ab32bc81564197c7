#!/usr/bin/env python3
"""Table 1 as bars: what one hierarchy takes once the triangles are sorted, per mesh and builder.

    plots/table1.py FILE... --out DIR

Above: median time, whiskers from the 10th to the 90th percentile, throughput in the bars, and the paper's
printed times, which are another machine's. Below: how near the builder comes to a plain copy of the bytes it
must move, measured in the same run.
"""
import sys

import matplotlib.pyplot as plt
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

import figure
import results
import style

STAGE = "hierarchy"
GROUP_WIDTH = 0.88  # most width of a mesh's bars, relative to the distance between two meshes
BAR_WIDTH = 0.16  # most width of one bar, relative to that distance, so that few builders do not give wide blocks
FOOT = 0.15  # height below the lowest value for the numbers, relative to the panel's height


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


def million_per_s(per_s: float) -> str:
    """Returns a number with three significant digits and no exponent."""
    million = per_s / 1e6
    return f"{million:,.0f}" if million >= 100 else f"{million:.3g}"


class Bars:
    """Two panels over the same bars: time, and share of the copy rate."""

    def __init__(self, run: results.Run, cells: list[results.Cell]):
        self.series = style.in_order(cells)
        self.scenes = list(dict.fromkeys(cell.scene for cell in cells))
        self.width = min(GROUP_WIDTH / len(self.series), BAR_WIDTH)
        self.copy_rate = run.copy_rate
        self.rows = results.printed("table1")["rows"]
        self.figure, (self.time, self.rate) = plt.subplots(
            2, 1, figsize=(style.PAGE_WIDTH, 5.4), sharex=True, layout="constrained",
            gridspec_kw={"height_ratios": (3, 1)})

    def draw(self, cell: results.Cell) -> None:
        series = style.series_of(cell)
        look = style.look(cell.builder)
        place = self.series.index(series) - (len(self.series) - 1) / 2
        x = self.scenes.index(cell.scene) + place * self.width
        hatch = style.hatch(series, self.series)
        dress = {"width": 0.9 * self.width, "color": look.colour, "hatch": hatch, "edgecolor": "white", "linewidth": 0}
        seconds = results.quantiles(cell.times_s(STAGE))
        spread = [[1e3 * (seconds.median - seconds.p10)], [1e3 * (seconds.p90 - seconds.median)]]
        self.time.bar(x, 1e3 * seconds.median, **dress)
        self.time.errorbar(x, 1e3 * seconds.median, yerr=spread, color="#222222", elinewidth=0.7, capsize=1.2,
                           capthick=0.7)
        self.time.text(x, 0.012, million_per_s(cell.triangles / seconds.median), rotation=90,
                       transform=self.time.get_xaxis_transform(), ha="center", va="bottom", fontsize=style.SMALL, color=style.ink_on(look.colour),
                       bbox={"facecolor": look.colour, "linewidth": 0, "pad": 0} if hatch else None)
        printed = paper_time_ms(cell, self.rows)
        if printed is not None:
            self.time.plot(x, printed, zorder=4, **style.PAPER_MARK)
        moved = cell.moved_bytes(STAGE)
        if moved and self.copy_rate:
            self.rate.bar(x, 100 * moved / seconds.median / self.copy_rate, **dress)

    def scale(self, cells: list[results.Cell]) -> None:
        """Sets a logarithmic axis that holds all values, measured and printed, above the numbers at the bottom."""
        values = [1e3 * value for cell in cells for value in results.quantiles(cell.times_s(STAGE))]
        values += [printed for cell in cells if (printed := paper_time_ms(cell, self.rows)) is not None]
        low, high = min(values) / 1.2, max(values) * 1.3
        self.time.set_ylim(low / (high / low) ** (FOOT / (1 - FOOT)), high)
        figure.log_ticks(self.time.yaxis, low, high)

    def finish(self, run: results.Run, cells: list[results.Cell]) -> None:
        titles = {cell.scene: scene_title(cell) for cell in cells}
        self.rate.set_xlim(-0.5, len(self.scenes) - 0.5)
        self.rate.set_xticks(range(len(self.scenes)), [titles[scene] for scene in self.scenes])
        self.rate.tick_params(axis="x", length=0)
        self.time.tick_params(axis="x", length=0)
        self.time.set(yscale="log", ylabel="hierarchy, ms")
        self.scale(cells)
        self.rate.set(ylabel="% of copy rate")
        self.rate.set_ylim(0, max(100, self.rate.get_ylim()[1]))
        handles = [Patch(facecolor=style.look(series[0]).colour, edgecolor="white", linewidth=0,
                         hatch=style.hatch(series, self.series), label=style.label(series, self.series))
                   for series in self.series]
        printed = f"printed in the paper ({results.printed_device('table1')}, another machine)"
        handles.append(Line2D([], [], **style.PAPER_MARK, label=printed))
        self.time.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.48, 1.0), ncols=5, columnspacing=1.2,
                           handlelength=1.4)
        copy = f"; copy rate {self.copy_rate / 1e9:,.0f} GB/s" if self.copy_rate else ""
        remarks = [f"Numbers in bars: million triangles per second. Whiskers: 10th to 90th percentile{copy}."]
        if any(cell.stand_in_for for cell in cells):
            remarks.append("* generated stand-in with the mesh's triangle count.")
        figure.footer(self.figure, run, "table1", tuple(remarks))


def draw(run: results.Run) -> plt.Figure:
    cells = run.timed("table1", STAGE)
    cells.sort(key=lambda cell: cell.triangles)
    bars = Bars(run, cells)
    for cell in cells:
        bars.draw(cell)
    bars.finish(run, cells)
    return bars.figure


if __name__ == "__main__":
    sys.exit(figure.command_line("table1", __doc__, draw))
