#!/usr/bin/env python3
"""Figure 13: how many times the radix tree's surface area cost the Oi-BVH's is, as one triangle moves away.

    plots/fig13.py FILE... --out DIR

The triangle moves along its normal, by multiples of the diagonal of the mesh's box (the paper's Fig. 12).
Left both costs, right their ratio, which is what the paper plots.
"""
from __future__ import annotations

import sys

import matplotlib.pyplot as plt

import figure
import results
import style
import table4

SAYS = "In the paper: “the SAH cost of our method grows much faster compared to the LBVH” (Sec. 7)."
Costs = dict[float, tuple[tuple[str, float], tuple[str, float]]]  # by diameters: (builder, cost) of radix and Oi


def costs_of(cells: list[results.Cell]) -> Costs:
    found = {}
    for diameters in sorted({cell.outlier["diameters"] for cell in cells}):
        here = [cell for cell in cells if cell.outlier["diameters"] == diameters]
        radix, oibvh = (table4.cost_of(here, builders) for _, builders in table4.KINDS)
        if radix and oibvh:
            found[diameters] = (radix, oibvh)
    return found


def draw(run: results.Run) -> plt.Figure:
    cells = [cell for cell in run.of("fig13") if cell.outlier]
    models = list(dict.fromkeys(cell.outlier["of"] for cell in cells))
    curves = {model: costs_of([cell for cell in cells if cell.outlier["of"] == model]) for model in models}
    curves = {model: costs for model, costs in curves.items() if costs}
    if not curves:
        raise results.Refused(f"{run.path}: no mesh of fig13 has the costs of a radix tree and an Oi-BVH")
    drawing, (cost_axes, ratio_axes) = plt.subplots(1, 2, figsize=(style.PAGE_WIDTH, 3.2), layout="constrained")
    for model, line in zip(curves, style.VARIANT_LINES):
        costs = curves[model]
        for side in (0, 1):
            builder = next(iter(costs.values()))[side][0]
            look = style.look(builder)
            cost_axes.plot(list(costs), [pair[side][1] for pair in costs.values()], color=look.colour,
                           marker=look.marker, linestyle=line, label=f"{builder}, {model}")
        ratio_axes.plot(list(costs), [oibvh[1] / radix[1] for radix, oibvh in costs.values()], color="#222222",
                        marker=".", linestyle=line, label=model)
        last = max(costs)
        ratio = costs[last][1][1] / costs[last][0][1]
        ratio_axes.annotate(f"{ratio:.2f}×", (last, ratio), (5, 0), textcoords="offset points", ha="left",
                            va="center", fontsize=style.SMALL)
    triangles = sorted({str(cell.outlier["triangle"]) for cell in cells})
    cost_axes.set(xlabel="distance of the triangle, diameters of the mesh", ylabel="surface area cost")
    ratio_axes.set(xlabel="distance of the triangle, diameters of the mesh", ylabel="Oi-BVH over radix tree")
    for axes in (cost_axes, ratio_axes):
        axes.set_ylim(0, 1.08 * axes.get_ylim()[1])
    ratio_axes.margins(x=0.13)  # room for the last values
    ratio_axes.legend(loc="upper left")
    costs = () if run.costs == table4.PAPER_COSTS else (run.costs_remark(),)
    height = figure.legend_above(drawing, cost_axes.get_legend_handles_labels()[0], 2)
    figure.footer(drawing, run, "fig13", (f"Moved: triangle {', '.join(triangles)}. {SAYS}", *costs), height)
    return drawing


if __name__ == "__main__":
    sys.exit(figure.command_line("fig13", __doc__, draw))
