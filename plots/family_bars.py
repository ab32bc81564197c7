#!/usr/bin/env python3
"""The experiments families and rivals: the fastest pipeline of each family or library over each scene, by stage.

    plots/family_bars.py FILE... --out DIR
"""
import dataclasses
import functools
import sys

import answer
import best_bars
import families
import figure
import ranking
import results

RIVALS = "rivals"
REMARKS = {families.EXPERIMENT: "A frame is all from moved vertices to exact contacts; FCL finds them in its broad phase.",
           RIVALS: "A frame is all from triangles to written pairs of overlapping boxes, by the device's clock."}


def label(row: ranking.Row) -> str:
    family, pipeline = answer.family(row), answer.label(row.first)
    return pipeline if pipeline.startswith(family.lower()) else f"{family}: {pipeline}"


def refits_outside(row: ranking.Row) -> bool:
    """True for a tree from outside that is refitted, not built, in each frame."""
    return bool(row.first.outside) and (row.first.collider or "").endswith("-refit")


def draw(experiment: str, run: results.Run) -> figure.plt.Figure:
    found = ranking.ranked(run.frames(experiment), trusts_stages=True)
    firsts = {scene: answer.best_of_families([row for row in rows if not refits_outside(row)]) for scene, rows in found.scenes.items()}
    return best_bars.draw(run, dataclasses.replace(found, scenes=firsts), label, (REMARKS[experiment],))


FIGURES: dict[str, figure.Draw] = {name: functools.partial(draw, name) for name in REMARKS}


def some_figures_of(run: results.Run) -> figure.Figures:
    there = {name: made for name, made in FIGURES.items() if run.all_frames(name)}
    return figure.named(run, there, f"no measured frame of {' or '.join(REMARKS)}")


if __name__ == "__main__":
    sys.exit(figure.draw_from(__doc__, some_figures_of))
