#!/usr/bin/env python3
"""The experiment families: the fastest pipeline of each family over each scene, by stage.

    plots/family_bars.py FILE... --out DIR
"""
import dataclasses
import sys

import answer
import best_bars
import families
import figure
import ranking
import results


def label(row: ranking.Row) -> str:
    family, pipeline = answer.family(row), answer.label(row.first)
    return pipeline if pipeline.startswith(family.lower()) else f"{family}: {pipeline}"


def draw(run: results.Run) -> figure.plt.Figure:
    found = ranking.ranked(run.frames(families.EXPERIMENT))
    firsts = {scene: answer.best_of_families(rows) for scene, rows in found.scenes.items()}
    return best_bars.draw(
        run, dataclasses.replace(found, scenes=firsts), label,
        ("A frame is all from moved vertices to exact contacts; FCL finds them in its broad phase.",))


FIGURES: dict[str, figure.Draw] = {families.EXPERIMENT: draw}


def some_figures_of(run: results.Run) -> figure.Figures:
    return figure.named(run, FIGURES if run.all_frames(families.EXPERIMENT) else {}, f"no measured frame of {families.EXPERIMENT}")


if __name__ == "__main__":
    sys.exit(figure.draw_from(__doc__, some_figures_of))
