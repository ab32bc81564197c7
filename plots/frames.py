#!/usr/bin/env python3
"""The experiments rebuild, pairs and libraries: milliseconds a frame of each scene by each pipeline, by stage.

    plots/frames.py FILE... --out DIR
"""
import functools
import sys

import matplotlib.pyplot as plt

import figure
import frame_stages
import results

# An experiment, and what a frame of it is.
EXPERIMENTS = {
    "rebuild": "A frame is all from moved vertices to exact contacts: trees built anew, or refitted and a front moved.",
    "pairs": "A frame is all from vertices to pairs of overlapping boxes, in one set of triangles.",
    "libraries": "A frame is all from moved vertices to exact contacts; FCL finds them in its broad phase.",
}


def draw(run: results.Run, experiment: str) -> plt.Figure:
    return frame_stages.draw(run, experiment, (EXPERIMENTS[experiment],))


# By name of picture.
FIGURES: dict[str, figure.Draw] = {name: functools.partial(draw, experiment=name) for name in EXPERIMENTS}

if __name__ == "__main__":
    sys.exit(figure.command_line_of_frames(FIGURES, __doc__))
