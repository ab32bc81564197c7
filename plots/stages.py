"""The words for the stages of a cell, in the order in which stages run, with the colours and hatches of bars. Figures, tables and
pages use these words, as `show` does. The paper calls `codes` "MC eval" and `sort` "MC sort"."""
from typing import NamedTuple


class Look(NamedTuple):
    colour: str
    hatch: str = ""  # distinguishes the stages of one colour; a pattern of Plotly


STAGES = {
    "near": Look("#999999", "/"), "bounds": Look("#999999"), "codes": Look("#56B4E9"), "sort": Look("#0072B2"),
    "order": Look("#0072B2", "/"), "gather": Look("#009E73", "/"), "hierarchy": Look("#009E73"), "refit": Look("#009E73", "."),
    "ropes": Look("#009E73", "x"), "copy": Look("#E69F00", "/"), "broad": Look("#E69F00"), "narrow": Look("#D55E00"),
    "sum": Look("#CC79A7"),
}
OF_FRAMES = tuple(stage for stage in STAGES if stage != "sum")  # which is on an axis of accuracy
BETWEEN = "between stages"
BETWEEN_COLOUR = "#DDDDDD"
