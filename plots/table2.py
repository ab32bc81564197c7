#!/usr/bin/env python3
"""Table 2 as bars: milliseconds a frame, from vertices to exact contacts, of each scene by each pipeline.

    plots/table2.py FILE... --out DIR
"""
import sys

import matplotlib.pyplot as plt

import figure
import frame_bars
import results


def draw(run: results.Run) -> plt.Figure:
    return frame_bars.draw(run, "table2")


if __name__ == "__main__":
    sys.exit(figure.command_line("table2", __doc__, draw))
