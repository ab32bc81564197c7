"""Figure 13: how many times the radix tree's surface area cost the Oi-BVH's is, as one triangle moves away.

The triangle moves along its normal, by multiples of the diagonal of the mesh's box (the paper's Fig. 12).
Left the costs, right their ratio, which is what the paper plots. An Oi-BVH in another order than the radix
tree's is compared with the same radix tree, and drawn in a colour of its own.
"""
import matplotlib.pyplot as plt

from ..draw import figure, style
from ..read import results
from . import table4

SAYS = "In the paper: “the SAH cost of our method grows much faster compared to the LBVH” (Sec. 7)."
ORDER_COLOURS = ("#222222", "#009e73", "#cc79a7", "#e69f00")  # of ratios: the paper's order first
DASHES = ("-", "--", ":", "-.")  # of meshes; markers of the first are filled
Costs = dict[float, tuple[tuple[str, float], tuple[str, float]]]  # by diameters: (builder, cost) of the radix tree and Oi-BVH


def order_of(cell: results.Cell) -> str:
    return dict(cell.options).get("order", "")


def costs_of(cells: list[results.Cell], order: str) -> Costs:
    """Returns the costs of the Oi-BVH in one order, paired with those of the radix tree."""
    found = {}
    for diameters, here in sorted(results.grouped(cells, lambda cell: cell.outlier["diameters"]).items()):
        radix = table4.cost_of(here, table4.RADIX)
        oibvh = table4.cost_of([cell for cell in here if order_of(cell) == order], table4.OIBVH)
        if radix and oibvh:
            found[diameters] = (radix, oibvh)
    return found


def draw(run: results.Run) -> plt.Figure:
    cells = [cell for cell in run.of("fig13") if cell.outlier]
    by_model = results.grouped(cells, lambda cell: cell.outlier["of"])
    models = list(by_model)
    orders = list(dict.fromkeys(order_of(cell) for cell in cells if cell.builder in table4.OIBVH))
    curves = {(model, order): costs for model in models for order in orders if (costs := costs_of(by_model[model], order))}
    if not curves:
        raise results.Refused(f"{run.path}: no mesh of fig13 has the costs of a radix tree and an Oi-BVH")
    drawing, [[cost_axes, ratio_axes]] = figure.grid(1, 2, 3.4)
    several = len(orders) > 1
    for (model, order), costs in curves.items():
        line = DASHES[models.index(model) % len(DASHES)]
        colour = ORDER_COLOURS[orders.index(order) % len(ORDER_COLOURS)]
        for side in (0, 1) if order == orders[0] else (1,):
            builder = next(iter(costs.values()))[side][0]
            look = style.look(builder)
            label = f"{builder}, {model}" + (f", {order}" if several and side == 1 else "")
            own = look.colour if order == orders[0] else colour
            cost_axes.plot(list(costs), [pair[side][1] for pair in costs.values()], color=own, marker=look.marker, linestyle=line,
                           markerfacecolor=own if model == models[0] else "white", label=label)
        ratio_axes.plot(list(costs), [oibvh[1] / radix[1] for radix, oibvh in costs.values()], color=colour,
                        marker="o", markersize=3, markerfacecolor=colour if model == models[0] else "white", linestyle=line,
                        label=model + (f", {order}" if several else ""))
        last = max(costs)
        ratio = costs[last][1][1] / costs[last][0][1]
        ratio_axes.annotate(f"{ratio:.2f}×", (last, ratio), (5, 0), textcoords="offset points", ha="left",
                            va="top" if order == orders[0] and several else "bottom" if several else "center",
                            fontsize=style.SMALL)
    triangles = sorted({str(cell.outlier["triangle"]) for cell in cells})
    cost_axes.set(xlabel="distance of the triangle, diameters of the mesh", ylabel="surface area cost")
    ratio_axes.set(xlabel="distance of the triangle, diameters of the mesh", ylabel="Oi-BVH over radix tree")
    for axes in (cost_axes, ratio_axes):
        axes.set_ylim(0, 1.08 * axes.get_ylim()[1])
    ratio_axes.margins(x=0.13)  # room for the last values
    ratio_axes.legend(loc="upper left")
    costs = () if run.costs == results.USUAL_COSTS else (run.costs_remark(),)
    height = figure.legend_above(drawing, cost_axes.get_legend_handles_labels()[0], 2)
    figure.footer(drawing, run, "fig13", (f"Moved: triangle {', '.join(triangles)}. {SAYS}", *costs), height)
    return drawing
