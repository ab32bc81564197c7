"""Prints the results of stress: verdicts by scene, invariants by system, and our cells that are wrong or refused."""
from collections import Counter

from ..files.json_files import Json
from ..read import results
from ..read.cells import grouped
from ..words.tables import Table, whole

INVARIANTS = ("ends", "leaves", "boxes", "layout", "pairs", "contacts", "agree", "moved", "room", "same")
WORSE = {"holds": 0, "refused": 1, "broken": 2}


def text(run: results.Run) -> str:
    cells = run.stress
    if not cells:
        return ""
    ours = [cell for cell in cells if not cell.get("library")]
    said, wrong, refused = "", 0, 0
    for cell in ours:
        if any(finding["verdict"] == "broken" for finding in cell["findings"].values()):
            said += told("WRONG", cell, "broken")
            wrong += 1
        elif cell["kind"] != "host" and verdict_of(cell) == "refused":  # the host is expected to refuse
            said += told("refused", cell, "refused")
            refused += 1
    end = f"{wrong} wrong" if wrong else "none wrong" if refused else "all right"
    return "\n".join([scenes(cells), systems(cells, run.facts.get("libraries", {})),
                      f"{said}{len(ours)} cells of ours, {end}{f', {refused} refused' if refused else ''}\n"])


def told(word: str, cell: Json, verdict: str) -> str:
    return "".join(f"{word} {cell['family']}: {cell['scene']}, {cell['system']}, {invariant}: {finding.get('detail', '')}\n"
                   for invariant, finding in cell["findings"].items() if finding["verdict"] == verdict)


def text_of(invariant: str, finding: Json) -> str:
    """Returns "right", "refused", "failed", "-12 +3" (missed and false pairs), "12 wrong" or "wrong"."""
    if finding["verdict"] != "broken":
        return "right" if finding["verdict"] == "holds" else "refused"
    if invariant == "ends":
        return "failed"
    wrong, missed = finding["wrong"], finding["missed"]
    if invariant in ("pairs", "contacts"):
        return f"-{missed:,} +{wrong - missed:,}"
    return f"{wrong:,} wrong" if wrong else "wrong"


def verdict_of(cell: Json) -> str:
    """Returns the verdict of one system on a scene."""
    worst = max(cell["findings"].items(), key=lambda found: WORSE[found[1]["verdict"]], default=None)
    return text_of(*worst) if worst else ""


def tally(cells: list[Json]) -> str:
    """Returns "21 right", "20 right, 1 wrong"."""
    counts = Counter(word if (word := verdict_of(cell)) in ("right", "refused") else "wrong" for cell in cells)
    return ", ".join(f"{counts[word]} {word}" for word in ("right", "refused", "wrong") if counts[word])


def scenes(cells: list[Json]) -> str:
    libraries = list(dict.fromkeys(cell["system"] for cell in cells if cell["kind"] == "library"))
    table = Table("<scene", "triangles", "<ours", "<wrapped libraries", *(f"<{library}" for library in libraries))
    for row, those in grouped(cells, lambda cell: f"{cell['family']}: {cell['scene']}").items():
        by_library = {cell["system"]: verdict_of(cell) for cell in those if cell["kind"] == "library"}
        others = grouped((cell for cell in those if cell["kind"] != "library"), lambda cell: bool(cell.get("library")))
        table.row(row, whole(max(cell.get("triangles", 0) for cell in those) or None),
                  *(tally(others.get(is_wrapped, [])) for is_wrapped in (False, True)),
                  *(by_library.get(library, "") for library in libraries))
    return table.text()


def systems(cells: list[Json], versions: dict[str, str]) -> str:
    table = Table("<system", "scenes", *(f"<{name}" for name in INVARIANTS), "<")
    for system, those in grouped(cells, lambda cell: cell["system"]).items():
        found = {name: [cell["findings"][name] for cell in those if name in cell["findings"]] for name in INVARIANTS}
        library = those[-1].get("library", "")
        table.row(system, str(len(those)), *(text_of(name, joined(own)) if own else "" for name, own in found.items()),
                  f"{library} {versions[library]}" if library in versions else library)
    return table.text()


def joined(findings: list[Json]) -> Json:
    """Adds up the findings' numbers and keeps the worst verdict."""
    worst = max(findings, key=lambda one: WORSE[one["verdict"]])
    return {"verdict": worst["verdict"], **{key: sum(one[key] for one in findings) for key in ("wrong", "missed")}}
