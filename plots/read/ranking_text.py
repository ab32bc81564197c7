"""The answer that a ranking gives: which builder or pipeline to take, how much faster it is than the next family, which others are
as fast within noise, and the command that measures it alone. Warns of methods from outside whose stages leave out most of their time."""
import shlex
from collections.abc import Sequence

from ..words import names, terminal
from ..words.tables import counted, duration, size
from . import families
from .cells import Cell, grouped
from .ranking import FEWEST, FEWEST_OF_BEST, Ranking, Row, chosen, method, ranked

UNIT = {"frame": "a frame", "query": "a query", "build": "a build", "memory": ""}
MOST_TIED = 5  # that the sentence names
MOST_WARNINGS = 5
BY_WALL = " by the wall clock"
QUESTION = ("adjacent", "narrow", "pairs_of", "first", "within", "separation")  # options of a collider that change what is found


def options_of(cell: Cell) -> dict[str, str]:
    """Returns the options in which the cell differs from the defaults, by the name of the builder's or collider's option."""
    both = dict(cell.collider_options) | (dict(cell.options) if cell.builder != "none" else {})
    shown = {key: both[key] for key in names.OPTIONS if both.get(key, names.USUAL[key]) != names.USUAL[key]}
    if shown.get("boxes"):
        shown.pop("leaves", None)
    return shown


def called(cell: Cell) -> str:
    """Returns "`block` over `oibvh-single`, order hilbert30"."""
    head = f"`{cell.builder}`" if cell.collider is None else f"`{cell.collider}`"
    if cell.collider is not None and cell.builder != "none":
        head += f" over `{cell.builder}`"
    return ", ".join([head, *("order " * (key == "order") + names.OPTIONS[key][1].format(value) for key, value in options_of(cell).items())])


def label(cell: Cell) -> str:
    """Returns the same for tables and figures: "block over oibvh-single, order hilbert30"."""
    return called(cell).replace("`", "")


def family(row: Row) -> str:
    return families.of_cell(row.first)


def best_of_families(rows: Sequence[Row]) -> list[Row]:
    """Returns the first row of each family."""
    return [own[0] for own in grouped(rows, family).values()]


def shown_of(rows: Sequence[Row], most: int, take: Row | None) -> list[Row]:
    """Returns the best of each family, the one to take, and the best `most` of the others, in their order."""
    kept = {method(row.first) for row in [*best_of_families(rows), *([take] if take else [])]}
    kept |= {method(row.first) for row in [row for row in rows if method(row.first) not in kept][:most]}
    return [row for row in rows if method(row.first) in kept]


def number(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 1.995 else f"{ratio:.1f}" if ratio < 99.5 else f"{ratio:.0f}"


def beside(cell: Cell, best: Cell) -> str:
    """Returns the full name of what is compared with the best. The usual order is named too where the best has another."""
    is_plain = cell.builder != "none" and "order" in options_of(best) and "order" not in options_of(cell)
    sorts = families.of_cell(cell) not in families.ON_HOST
    return called(cell) + f", order {names.USUAL['order']}" * (is_plain and sorts)


def next_words(found: Ranking, best: Row) -> str:
    """Returns how much better the best is than the next family none of which ties with it, or else than the next row that does not;
    empty without either."""
    others = [rows[0] for rows in grouped(found.rows, family).values() if not any(row is best or row.tied for row in rows)]
    rival = others[0] if others else next((row for row in found.rows if row is not best and not row.tied), None)
    if rival is None:
        return ""
    who = f"the next family, {family(rival)} ({beside(rival.first, best.first)})" if others else f"the next, {beside(rival.first, best.first)}"
    by = rival.ratio / best.ratio if best.ratio > 0 else rival.ratio
    if found.objective == "memory":
        return f"; {who}{',' * (not others)} holds {number(by)} times as much"
    return f", {number(by)} times as fast as {who}"


def tied_words(found: Ranking, best: Row) -> str:
    """Returns the full names of those that tie with the best, first one of each other family and collider, and how many more there are."""
    tied = [row for row in found.rows if row.tied and row is not best]
    kinds = {(family(row), row.first.collider): row for row in reversed([*tied, best])}
    shown = sorted(tied, key=lambda row: not any(row is one for one in kinds.values()))[:MOST_TIED]
    said = [beside(row.first, best.first) for row in shown]
    said += [f"{len(tied) - len(shown)} more"] if len(tied) > len(shown) else []
    return f"; as fast within noise: {'; '.join(said)}" if said else ""


def error_words(row: Row) -> str:
    if not all(cell.checked for cell in row.cells):
        return "; its answer was not checked"
    return f"; of what it finds {row.wrong}" if row.wrong else ""


def amount_words(found: Ranking, row: Row) -> str:
    """Returns the time or the bytes of a row: "100 us a frame"."""
    by_wall = BY_WALL * found.by_wall
    if len(found.scenes) > 1:
        what = "memory" if found.objective == "memory" else "time"
        return (f"{number(row.ratio)} times the {what} of each scene's best, in the geometric mean over {len(found.scenes)} scenes"
                + by_wall * (what == "time"))
    if found.objective == "memory":
        return f"{size(row.bytes)} and {duration(row.ns)} {'a build' if row.first.collider is None else 'a frame'}{by_wall}"
    least = f" (the least: {duration(found.rows[0].ns)})" if row is not found.rows[0] else ""
    return f"{duration(row.ns)} {UNIT[found.objective]}{least}{by_wall}"


def sentence(found: Ranking) -> str:
    """Returns the answer as one sentence; empty if nothing has times."""
    if not found.rows:
        return ""
    best, least = chosen(found.rows), found.rows[0]
    if best is None:
        return (f"no winner: {called(least.first)} is the best so far, {amount_words(found, least)}, by {counted(sum(least.counts), 'sample')} without drift, "
                f"and a winner needs {FEWEST_OF_BEST}, of each frame {FEWEST} without drift.")
    return f"take {called(best.first)}: {amount_words(found, best)}{next_words(found, best)}{tied_words(found, best)}{error_words(best)}."


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
    said = sentence(ranked(cells, objective_of(measured)))
    return terminal.prose(said) + "\n" if said else ""


def objective_of(measured: Sequence[Cell]) -> str:
    """Returns what cells raced for, or else a frame or a build."""
    races = {cell.raw.get("sampling", {}).get("race", "") for cell in measured}
    usual = "build" if all(cell.operation == "build" for cell in measured) else "frame"
    return {"query": "query", "memory": "memory"}.get(races.pop() if len(races) == 1 else "", usual)


def repeated(row: Row, scene: str, words: Sequence[str]) -> str:
    """Returns the command line that measures the row's pipeline or builder alone. `words` are options about the scene, the question
    and the device."""
    cell = row.first
    line = ["bvhbench", "build" if cell.collider is None else "collide", *["--builder", cell.builder] * (cell.builder != "none"),
            *["--collider", str(cell.collider)] * (cell.collider is not None)]
    line += [word for key, value in options_of(cell).items() if key != "no_skip" for word in ("--" + key.replace("_", "-"), value)]
    return shlex.join([*line, "--scene", scene, *words])
