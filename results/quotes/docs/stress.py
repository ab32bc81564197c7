from plots.evidence.quotes import Document, File


def right_of(name: str) -> tuple[int, int]:
    """Returns the number of cells of ours, and of those that are right; the host is expected to refuse."""
    ours = [one for one in File(name).document["stress"] if not one.get("library")]
    right = [one for one in ours if one["kind"] == "host" or all(found["verdict"] == "holds" for found in one["findings"].values())]
    return len(ours), len(right)


def errors(finding: dict[str, int]) -> str:
    """Returns what was missed and what is false: "-16 +353"."""
    counts = {"-": finding["missed"], "+": finding["wrong"] - finding["missed"]}
    return " ".join(f"{sign}{count:,}" for sign, count in counts.items() if count)


def quotes(doc: Document) -> None:
    doc.says("| {} cells of {} | none |", *reversed(right_of("pocl-2-cores/stress")))
    found = {(one["family"], one["scene"], one["system"]): one["findings"] for one in File("pocl-2-cores/stress").document["stress"]}
    systems = "rtcCollide", *(f"FCL {tree} {number}" for number in ("double", "float") for tree in ("AABB", "OBBRSS"))
    doc.table("libraries", f"< scene | {' | '.join(systems)}", (
        [f"{family}: {scene}", *(errors(found[family, scene, system]["pairs" if system == "rtcCollide" else "contacts"])
                                 for system in systems)]
        for family, scene in (("hard", "denormal"), ("scale", "1e17"), ("scale", "1e30"), ("degenerate", "lattice"),
                              ("degenerate", "one point"), ("sizes", "3"))))
    doc.says("| {} cells of {} | 3 refused", *reversed(right_of("h200/stress")))
