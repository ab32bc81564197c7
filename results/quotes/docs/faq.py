from quotes import Document, File


def quotes(doc: Document) -> None:
    counts = [File(f"{machine}/accuracy-codes").cell("n-body:100000", "codes, morton30").counters["box_tests_count"] for machine in ("pocl-2-cores", "h200")]
    doc.says("in accuracy-codes.json, {} on two cores and {} on an\nH200", *counts)
