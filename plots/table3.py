#!/usr/bin/env python3
"""Table 3 as bars: milliseconds a frame, from vertices to exact contacts, of each scene by each pipeline.

    plots/table3.py FILE... --out DIR
"""
import functools
import sys

import figure
import table2

draw = functools.partial(table2.draw, table="table3")

if __name__ == "__main__":
    sys.exit(figure.command_line("table3", __doc__, draw))
