from plots.evidence.quotes import Document, File, us


def quotes(doc: Document) -> None:
    refit = File("h200/refit")
    shares = [us(cell) / us(refit.cell(cell.scene, cell.asked.removesuffix(", refit"))) for cell in refit.cells
              if cell.operation == "refit" and cell.builder.startswith("oibvh")]
    doc.says("a refit takes {} to {} of the time of a build of an Oi-BVH", min(shares), max(shares))
