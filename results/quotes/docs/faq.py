from plots.evidence.quotes import Document, File, us


def quotes(doc: Document) -> None:
    counts = [File(f"{machine}/accuracy-codes").cell("n-body:100000", "codes, morton30").counters["box_tests_count"]
              for machine in ("pocl-2-cores", "h200")]
    doc.says("in accuracy-codes.json are {} on two cores and {} on an H200", *counts)
    refit = File("h200/refit")
    shares = [us(cell) / us(refit.cell(cell.scene, cell.asked.removesuffix(", refit"))) for cell in refit.cells
              if cell.operation == "refit" and cell.builder.startswith("oibvh")]
    doc.says("a refit takes {} to {} of the time of a build of an Oi-BVH", min(shares), max(shares))
