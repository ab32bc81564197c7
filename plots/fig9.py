#!/usr/bin/env python3
"""Figure 9: where a frame's time goes, the stages of each pipeline stacked.

    plots/fig9.py FILE... --out DIR
"""
import sys

import matplotlib.pyplot as plt

import figure
import frame_stages
import results


def draw(run: results.Run) -> plt.Figure:
    return frame_stages.draw(run, "table2")


if __name__ == "__main__":
    sys.exit(figure.command_line("fig9", __doc__, draw))
