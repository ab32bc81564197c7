"""The experiments families and rivals: the fastest pipeline of each family or library over each scene, by stage."""
import dataclasses
import functools

from ..draw import figure
from ..read import families, ranking, ranking_text, results
from . import best_bars

RIVALS = "rivals"
REMARKS = {families.EXPERIMENT: "A frame is all from moved vertices to exact contacts; FCL finds them in its broad phase.",
           RIVALS: "A frame is all from triangles to written pairs of overlapping boxes, by the device's clock."}


def label(row: ranking.Row) -> str:
    family, pipeline = ranking_text.family(row), ranking_text.label(row.first)
    return pipeline if pipeline.startswith(family.lower()) else f"{family}: {pipeline}"


def short_label(row: ranking.Row) -> str:
    """Returns the own name of a library's method, or else the family, so that two panels fit beside each other."""
    return ranking_text.label(row.first) if row.first.outside else ranking_text.family(row)


def draw(experiment: str, run: results.Run) -> figure.plt.Figure:
    found = ranking.ranked(run.frames(experiment), trusts_stages=True)
    found = dataclasses.replace(found, scenes={scene: ranking_text.best_of_families(rows) for scene, rows in found.scenes.items()}, rows=[])
    if experiment == families.EXPERIMENT:
        return best_bars.draw(run, found, label, (REMARKS[experiment],))
    ours = "; ".join(dict.fromkeys(label(row) for rows in found.scenes.values() for row in rows if not row.first.outside))
    return best_bars.draw(run, found, short_label, (REMARKS[experiment], f"Ours: {ours}."), columns=min(2, len(found.scenes)))


FIGURES: dict[str, figure.Draw] = {name: functools.partial(draw, name) for name in REMARKS}
