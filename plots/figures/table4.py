"""Table 4 as points: the surface area cost of the radix tree and of the Oi-BVH over the same leaves, per mesh.

Over each pair stands how many times the one is the other. The paper's printed costs are marked; a cost has no
machine, so they can be compared with ours wherever the mesh is the same. They are left out for other costs of a
node and a triangle than the usual ones.
"""
import matplotlib.pyplot as plt
from matplotlib.lines import Line2D

from ..draw import figure, style
from ..read import results

RADIX = ("apetrei", "apetrei-fused", "karras", "lbvh-levels", "radix-reference")  # all build the same tree
OIBVH = ("oibvh-multi", "oibvh-single", "oibvh-single-printed", "oibvh-reference")
KINDS = (("apetrei", RADIX), ("oibvh-multi", OIBVH))  # the paper's builder for each kind of tree, and ours
WIDTH = 0.36


def cost_of(cells: list[results.Cell], builders: tuple[str, ...]) -> tuple[str, float] | None:
    for builder in builders:
        for cell in cells:
            if cell.builder == builder and "sah_cost" in cell.counters:
                return builder, cell.counters["sah_cost"]
    return None


def title(cell: results.Cell, printed: dict) -> str:
    if cell.stand_in_for:
        return f"{cell.stand_in_for}*\n{cell.triangles:,}"
    return f"{cell.scene}{'+' if cell.scene in printed['other_editions'] else ''}\n{cell.triangles:,}"


def draw_mesh(axes: plt.Axes, x: int, cells: list[results.Cell], printed: dict) -> set[str]:
    """Draws the points of one mesh and returns the builders shown."""
    scene = cells[0].stand_in_for or cells[0].scene
    model = printed["other_editions"].get(scene, scene)
    paper = {row["builder"]: row["sah_cost"] for row in printed["rows"] if row["scene"] == model}
    shown, costs = set(), []
    for side, (name, builders) in enumerate(KINDS):
        place = x + (side - 0.5) * WIDTH
        if name in paper:
            axes.plot(place, paper[name], zorder=4, **style.PAPER_MARK)
        if found := cost_of(cells, builders):
            builder, cost = found
            axes.plot(place, cost, style.look(builder).marker, color=style.look(builder).colour, markersize=7)
            axes.text(place, 0.02, f"{cost:,.2f}" if cost < 1000 else f"{cost:,.0f}", transform=axes.get_xaxis_transform(), ha="center", va="bottom", fontsize=7)
            shown.add(builder)
            costs.append(cost)
    if len(costs) == 2:
        top = max(*costs, *paper.values()) if paper else max(costs)
        ours = f"{costs[1] / costs[0]:.2f}×"
        theirs = f"\n(paper {paper['oibvh-multi'] / paper['apetrei']:.2f}×)" if paper else ""
        axes.annotate(ours + theirs, (x, top), (0, 6), textcoords="offset points", ha="center", va="bottom",
                      fontsize=7)
    return shown


def scale(axes: plt.Axes, cells: list[results.Cell], printed: dict) -> None:
    """Sets a logarithmic axis with room for the numbers below and above the points."""
    values = [cell.counters["sah_cost"] for cell in cells] + [row["sah_cost"] for row in printed["rows"]]
    low, high = min(values), max(values)
    axes.set_yscale("log")
    axes.set_ylim(low / (high / low) ** 0.25, high * (high / low) ** 0.25)
    figure.log_ticks(axes.yaxis, low, high)


def draw(run: results.Run) -> plt.Figure:
    cells = [cell for cell in run.of("table4") if "sah_cost" in cell.counters]
    if not cells:
        raise results.Refused(f"{run.path}: no cell of table4 has a surface area cost")
    printed = results.printed("table4")
    if run.costs != results.USUAL_COSTS:
        printed |= {"rows": [], "other_editions": {}}
    scenes = list(results.grouped(cells, lambda cell: cell.scene).values())
    drawing, [[axes]] = figure.grid(1, 1, 3.4)
    shown: set[str] = set()
    for x, scene in enumerate(scenes):
        shown |= draw_mesh(axes, x, scene, printed)
    axes.set_xticks(range(len(scenes)), [title(scene[0], printed) for scene in scenes])
    axes.set_xlim(-0.6, len(scenes) - 0.4)
    scale(axes, cells, printed)
    axes.tick_params(axis="x", length=0)
    axes.set(ylabel="surface area cost")
    handles = [Line2D([], [], color=style.look(builder).colour, marker=style.look(builder).marker, markersize=7, linestyle="none", label=builder)
               for builder in style.LOOKS if builder in shown]
    if any(line.get_marker() == style.PAPER_MARK["marker"] for line in axes.lines):
        handles.append(Line2D([], [], **style.PAPER_MARK, label="printed in the paper"))
    height = figure.legend_above(drawing, handles)
    remarks = [f"{run.costs_remark()} Under the names: triangles."]
    if any(cell.scene in printed["other_editions"] for cell in cells):
        remarks.append("+ another edition of the paper's model, with another triangle count.")
    if any(cell.stand_in_for for cell in cells):
        remarks.append("* generated stand-in with the mesh's triangle count.")
    figure.footer(drawing, run, "table4", tuple(remarks), height)
    return drawing
