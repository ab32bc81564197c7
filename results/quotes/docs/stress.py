from quotes import Document, File


def right_of(name: str) -> tuple[int, int]:
    """Returns the number of cells of ours, and of those that are right; the host is expected to refuse."""
    ours = [one for one in File(name).document["stress"] if not one.get("library")]
    right = [one for one in ours if one["kind"] == "host" or all(found["verdict"] == "holds" for found in one["findings"].values())]
    return len(ours), len(right)


def quotes(doc: Document) -> None:
    for name, text in (("pocl-2-cores/stress", "| {} cells of {} | none |"), ("h200/stress", "| {} cells of {} | 3 refused")):
        doc.says(text, *reversed(right_of(name)))
