#!/usr/bin/env python3
"""Figure 9: where a frame's time goes, the stages of each pipeline stacked.

    plots/fig9.py FILE... --out DIR
"""
import functools
import sys

import figure
import frames

draw = functools.partial(frames.draw, experiment="table2")

if __name__ == "__main__":
    sys.exit(figure.command_line("fig9", __doc__, draw))
