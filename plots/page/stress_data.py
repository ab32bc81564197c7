"""What `stress` found, for the page: a sentence, and tables of systems, of what broke, and of everything. What a library got
wrong is named and counted apart from what is ours."""
from ..console import stress_table as words
from ..files.json_files import Json
from ..read.cells import grouped
from ..words.tables import counted
from .cell_data import table

FACETS = ("family", "whose", "kind", "invariant")
QUESTION = "Which trees, pairs and contacts are right on hostile scenes?"


def verdicts(cell: Json) -> set[str]:
    return {finding["verdict"] for finding in cell["findings"].values()}


def finding_of(stress: list[Json]) -> Json:
    """Returns question and answer, as findings.py does."""
    def count(cells: list[Json], verdict: str) -> int:
        return sum(verdict in verdicts(cell) for cell in cells)

    ours = [cell for cell in stress if not cell.get("library")]
    broken, refused = (count(ours, verdict) or "none" for verdict in ("broken", "refused"))
    said = [f"Ours: {broken} of {counted(len(ours), 'cell')} broken, {refused} refused."]
    for library, cells in grouped((cell for cell in stress if cell.get("library")), lambda cell: cell["library"]).items():
        said.append(f"{library}: {count(cells, 'broken'):,} of {counted(len(cells), 'cell')} broken.")
    return {"experiment": "stress", "question": QUESTION, "answer": " ".join(said), "rows": []}


def shown(name: str, finding: Json | None) -> str | None:
    """Returns the verdict on an invariant, with what was missed and false of pairs and contacts, or how much was wrong."""
    if finding is None or finding["verdict"] != "broken":
        return finding and finding["verdict"]
    wrong, missed = finding["wrong"], finding["missed"]
    if name in ("pairs", "contacts"):
        return f"broken: {missed:,} missed, {wrong - missed:,} false"
    return f"broken: {wrong:,} wrong" if wrong else "broken"


def bad_table(stress: list[Json]) -> Json | None:
    """Returns one row for each finding that does not hold, ours first; None if all hold."""
    bad = [(cell, name, finding) for cell in sorted(stress, key=lambda cell: bool(cell.get("library")))
           for name, finding in cell["findings"].items() if finding["verdict"] != "holds"]
    rows = [[cell["family"], cell["scene"], cell["system"], cell.get("library") or "ours", name, shown(name, finding),
             finding.get("detail")] for cell, name, finding in bad]
    columns = [("family", "text"), ("scene", "text"), ("system", "text"), ("whose", "text"), ("invariant", "text"),
               ("verdict", "state"), ("detail", "text")]
    return table("Broken or refused", columns, FACETS, rows, libraries=[cell.get("library") for cell, _, _ in bad]) if bad else None


def invariants_of(stress: list[Json]) -> list[str]:
    return [name for name in words.INVARIANTS if any(name in cell["findings"] for cell in stress)]


def cells_table(stress: list[Json]) -> Json:
    there = invariants_of(stress)
    rows = [[cell["family"], cell["scene"], cell["system"], cell.get("library") or "ours", cell["kind"],
             *(shown(name, cell["findings"].get(name)) for name in there),
             "; ".join(f"{name}: {finding['detail']}" for name, finding in cell["findings"].items() if finding.get("detail"))
             or None] for cell in stress]
    columns = [*((label, "text") for label in ("family", "scene", "system", "whose", "kind")),
               *((name, "state") for name in there), ("detail", "text")]
    return table("Stress", columns, FACETS, rows, libraries=[cell.get("library") for cell in stress]) | {"folded": True}


def systems_table(stress: list[Json]) -> Json:
    """Returns one row for each system: its findings over all scenes, added up; first the systems of which one does not hold."""
    there = invariants_of(stress)
    bad = {cell["system"] for cell in stress if verdicts(cell) - {"holds"}}
    systems = grouped(sorted(stress, key=lambda cell: cell["system"] not in bad), lambda cell: cell["system"])
    rows = []
    for system, cells in systems.items():
        own = {name: [cell["findings"][name] for cell in cells if name in cell["findings"]] for name in there}
        rows.append([system, cells[-1].get("library") or "ours", len(cells),
                     *(shown_of(found) if found else None for found in own.values())])
    columns = [("system", "text"), ("whose", "text"), ("scenes", "count"), *((name, "state") for name in there)]
    return table("By system", columns, FACETS, rows, libraries=[cells[-1].get("library") for cells in systems.values()])


def shown_of(findings: list[Json]) -> str:
    """Returns the worst verdict of several findings, with the number of scenes that have it if it is not "holds"."""
    worst = words.joined(findings)["verdict"]
    count = sum(finding["verdict"] == worst for finding in findings)
    return worst if worst == "holds" else f"{worst}: {counted(count, 'scene')}"


def tables_of(stress: list[Json]) -> list[Json]:
    return [found for found in (bad_table(stress), systems_table(stress), cells_table(stress)) if found] if stress else []
