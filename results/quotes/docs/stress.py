from quotes import Document, File


def quotes(doc: Document) -> None:
    """Cells of ours, and those of them that are right; the host is expected to refuse."""
    for name, text in (("pocl-2-cores/stress", "| {} cells of {} |"), ("h200/stress", "| {} cells of {}; without `repeats`")):
        ours = [one for one in File(name).document["stress"] if not one.get("library")]
        right = [one for one in ours if one["kind"] == "host" or all(found["verdict"] == "holds" for found in one["findings"].values())]
        doc.says(text, len(right), len(ours))
