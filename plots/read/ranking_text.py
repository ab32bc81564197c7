"""The answer that a ranking gives: which builder or pipeline to take, how much faster it is than the next family, which others are
no slower within noise, and the command that measures it alone. Warns of methods from outside whose stages leave out most of their time."""
import shlex
from collections.abc import Sequence

from ..words import names, terminal
from ..words.tables import counted, duration, size
from . import families
from .cells import Cell, grouped
from .ranking import Ranking, Row, ranked

UNIT = {"frame": "a frame", "query": "a query", "build": "a build", "memory": ""}
MOST_TIED = 3  # that the sentence names
MOST_WARNINGS = 5
BY_WALL = " by the wall clock"
QUESTION = ("adjacent", "narrow", "pairs_of", "first", "within")  # options of a collider that change what is found


def options_of(cell: Cell) -> dict[str, str]:
    """Returns the options in which the cell differs from the defaults, by the name of the builder's or collider's option."""
    both = dict(cell.collider_options) | (dict(cell.options) if cell.builder != "none" else {})
    shown = {key: both[key] for key in names.OPTIONS if both.get(key, names.USUAL[key]) != names.USUAL[key]}
    if shown.get("boxes"):
        shown.pop("leaves", None)
    return shown


def words_of(key: str, value: str) -> str:
    if key == "order":
        return f"order {value}"
    return names.OPTIONS[key][1].format(value)


def called(cell: Cell) -> str:
    """Returns "`block` over `oibvh-single`, order hilbert30"."""
    head = f"`{cell.builder}`" if cell.collider is None else f"`{cell.collider}`"
    if cell.collider is not None and cell.builder != "none":
        head += f" over `{cell.builder}`"
    return ", ".join([head, *(words_of(key, value) for key, value in options_of(cell).items())])


def label(cell: Cell) -> str:
    """Returns the same for tables and figures: "block over oibvh-single, order hilbert30"."""
    return called(cell).replace("`", "")


def beside(cell: Cell, best: Cell) -> str:
    """Returns in what a cell differs from the best: "`bvtt`", "`bvtt` over `karras`", "order morton30"."""
    if "none" in (cell.builder, best.builder):
        return called(cell)
    parts = [f"`{cell.collider}`"] if cell.collider != best.collider else []
    if cell.builder != best.builder:
        parts = [f"`{cell.collider}` over `{cell.builder}`" if cell.collider else f"`{cell.builder}`"]
    own, other = options_of(cell), options_of(best)
    parts += [words_of(key, own.get(key, names.USUAL[key])) for key in names.OPTIONS if own.get(key) != other.get(key)
              and not (key == "leaves" and ("boxes" in own or families.of_cell(cell) in families.OWN_LEAVES))]
    return ", ".join(parts) or called(cell)


def family(row: Row) -> str:
    return families.of_cell(row.first)


def best_of_families(rows: Sequence[Row]) -> list[Row]:
    """Returns the first row of each family."""
    return [own[0] for own in grouped(rows, family).values()]


def kind_of(row: Row) -> tuple[str, str | None]:
    return family(row), row.first.collider


def number(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 1.995 else f"{ratio:.1f}" if ratio < 99.5 else f"{ratio:.0f}"


def next_words(found: Ranking) -> str:
    """Returns how much better the best is than the next family, or else than the next row; empty if that is within the noise."""
    best = found.rows[0]
    others = [row for row in found.rows[1:] if family(row) != family(best)]
    rival = others[0] if others else next((row for row in found.rows[1:] if not row.tied), None)
    if rival is None or rival.tied:
        return ""
    has_tree = rival.first.builder != "none" and families.of_collider(rival.first.collider or "") is None
    name = rival.first.builder if has_tree else rival.first.collider
    who = f"the next family (`{name}`)" if others else f"the next, {beside(rival.first, best.first)}"
    by = rival.ratio / best.ratio if best.ratio > 0 else rival.ratio
    if found.objective == "memory":
        return f"; {who} holds {number(by)} times as much"
    return f", {number(by)} times as fast as {who}"


def tied_words(found: Ranking) -> str:
    best = found.rows[0]
    tied = [row for row in found.rows[1:] if row.tied]
    if not tied:
        return ""
    # The first of each kind: another family or collider says more than another order.
    kinds = {kind_of(row): row for row in reversed(tied)}
    others = [row for row in tied if row is kinds[kind_of(row)] and kind_of(row) != kind_of(best)]
    shown = (others or tied)[:MOST_TIED]
    said = [beside(row.first, best.first) for row in shown]
    if len(tied) == 1:
        return f"; {said[0]} is no slower within noise"
    more = [f"{len(tied) - len(shown)} more"] if len(tied) > len(shown) else []
    return "; no slower within noise: " + "; ".join([*said, *more])


def error_words(row: Row) -> str:
    if row.is_right and all(cell.verdict == "agrees" for cell in row.cells):
        return ""
    if not row.is_right:
        return "; its answer was not checked"
    return f"; of what it finds {row.wrong}" if row.wrong else ""


def sentence(found: Ranking) -> str:
    """Returns the answer as one sentence; empty if nothing has times."""
    if not found.rows:
        return ""
    best = found.rows[0]
    if len(found.scenes) > 1:
        what = "memory" if found.objective == "memory" else "time"
        amount = f"{number(best.ratio)} times the {what} of each scene's best, in the geometric mean over {len(found.scenes)} scenes"
        amount += BY_WALL * (found.by_wall and what == "time")
    elif found.objective == "memory":
        amount = f"{size(best.bytes)} and {duration(best.ns)} {'a build' if best.first.collider is None else 'a frame'}"
        amount += BY_WALL * found.by_wall
    else:
        amount = f"{duration(best.ns)} {UNIT[found.objective]}{BY_WALL * found.by_wall}"
    return f"take {called(best.first)}: {amount}{next_words(found)}{tied_words(found)}{error_words(best)}."


def warnings(cells: Sequence[Cell]) -> list[str]:
    """Returns a sentence for each cell from outside whose stages leave out most of the time of its calls (Cell.leaves_out)."""
    found = [cell for cell in cells if cell.leaves_out]
    said = [f"{cell.label}: its stages take {duration(cell.median_ns())}, and {duration(cell.wall_ns)} pass by the wall clock"
            for cell in found[:MOST_WARNINGS]]
    return said + [f"the same of {counted(len(found) - MOST_WARNINGS, 'more cell')}"] * (len(found) > MOST_WARNINGS)


def warning_lines(cells: Sequence[Cell]) -> str:
    return "".join(terminal.prose(f"warning: {said}") + "\n" for said in warnings(cells))


def of_cells(cells: Sequence[Cell]) -> str:
    """Returns the answer of a result file's cells as a line, or nothing where they give none: they must be several builders or
    pipelines over one scene, that answer one question, all with right answers."""
    kinds = {(cell.operation, cell.raw.get("experiment"), cell.caches, cell.scene, bool(cell.swept), cell.starts_from_leaves, cell.features.get("pairs"),
              *(dict(cell.collider_options).get(key, names.USUAL[key]) for key in QUESTION)) for cell in cells if cell.has_times}
    measured = [cell for cell in cells if cell.status == "measured"]
    if len(kinds) != 1 or not all(cell.checked for cell in measured):
        return ""
    operation, _, _, _, is_swept, from_leaves, *_ = next(iter(kinds))
    is_ranked = operation in ("build", "collide") and not is_swept and not from_leaves
    if not is_ranked or len({cell.key("builder", "collider") for cell in measured}) < 2:
        return ""
    races = {cell.raw.get("sampling", {}).get("race", "") for cell in measured}
    objective = {"query": "query", "memory": "memory"}.get(races.pop() if len(races) == 1 else "", "")
    said = sentence(ranked(cells, objective or ("build" if operation == "build" else "frame")))
    return terminal.prose(said) + "\n" if said else ""


def repeated(row: Row, scene: str, words: Sequence[str]) -> str:
    """Returns the command line that measures the row's pipeline or builder alone. `words` are options about the scene, the question
    and the device."""
    cell = row.first
    line = ["bvhbench", "build" if cell.collider is None else "collide"]
    if cell.builder != "none":
        line += ["--builder", cell.builder]
    if cell.collider is not None:
        line += ["--collider", cell.collider]
    for key, value in options_of(cell).items():
        if key != "no_skip":
            line += ["--" + key.replace("_", "-"), value]
    return shlex.join([*line, "--scene", scene, *words])
