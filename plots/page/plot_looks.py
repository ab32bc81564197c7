"""Colours and markers of lines and points on a page: those of style.py in Plotly's terms."""
from typing import Any

from ..draw import pipelines, style
from ..figures import accuracy, frame_bars
from ..read import results
from ..read.cells import grouped
from ..words import names
from .cell_data import BETWEEN

SYMBOLS = {"s": "square", "^": "triangle-up", "v": "triangle-down", "D": "diamond", "o": "circle", "d": "diamond-tall",
           "p": "pentagon", "*": "star", "P": "cross", "h": "hexagon", "H": "hexagon2", "x": "x", "+": "x",
           "<": "triangle-left", ">": "triangle-right"}
# Symbols that distinguish variants of one colour, in order. The first variant keeps the builder's marker.
MORE_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "triangle-down", "star", "hexagon", "cross", "x", "pentagon",
                "triangle-left", "triangle-right", "diamond-tall", "hexagon2")
DASHES = ("solid", "dash", "dot", "dashdot", "longdash", "longdashdot")
HATCHED = {"near": "/", "margin": "x", "pad": ".", "exact": "/", "filter": "/", "order": "/", "gather": "/", "build": "+", "refit": ".", "ropes": "x", "collapse": "o", "copy": "/"}
# Colours of figures that are too dark on a dark page, and those that replace them there.
IN_THE_DARK = {"#000000": "#F4F4F4", "#0072B2": "#3C95D6", "#8C510A": "#C07A35", "#666666": "#A0A0A0"}
UNKNOWN = style.Look("#666666", "o")


def look_of(cell: dict[str, Any]) -> style.Look:
    """Returns the look of a cell's data (report_cells). A cell without a known look is grey."""
    try:
        if cell["axis"] in accuracy.METHODS:
            return accuracy.look(cell["axis"], cell["who"])
        if cell["collider"] in pipelines.COLOURS:
            return style.Look(pipelines.COLOURS[cell["collider"]], "o")
        return style.look(cell["collider"] if cell["collider"] in names.OUTSIDE else cell["builder"])
    except results.Refused:
        return UNKNOWN


def looks_of(cells: list[dict[str, Any]]) -> dict[str, dict[str, str]]:
    """Returns the colour, symbol and dash of each name in a file, in the order of legends; no two names look alike."""
    order = list(style.LOOKS)
    firsts = [own[0] for own in grouped(cells, lambda cell: cell["who"]).values()]
    firsts.sort(key=lambda cell: order.index(cell["builder"]) if cell["builder"] in order else len(order))
    looks, taken = {}, {}
    for cell in firsts:  # the sort is stable, so equal places keep the file's order
        look = look_of(cell)
        colour, symbol = look.colour, SYMBOLS[look.marker]
        used = taken.setdefault(colour, [])
        if symbol in used:
            symbol = next((other for other in MORE_SYMBOLS if other not in used), symbol)
        looks[cell["who"]] = {"colour": colour, "symbol": symbol, "dash": DASHES[len(used) % len(DASHES)]}
        used.append(symbol)
    return looks


def stage_looks() -> dict[str, dict[str, str]]:
    """Returns the colours of frame_bars.py, by the words of `show`. Of stages that share a colour, all but the main one are
    hatched."""
    looks = {stage: {"colour": colour, "pattern": HATCHED.get(stage, "")}
             for stages, colour in frame_bars.PARTS for stage in stages}
    return looks | {BETWEEN: {"colour": frame_bars.BETWEEN, "pattern": ""}, "sum": {"colour": "#CC79A7", "pattern": ""}}
