from plots.evidence.quotes import Document, File, us


def quotes(doc: Document) -> None:
    doc.says("of torus:2880000 takes {} µs from ids", us(File("h200/peers").cell("torus:2880000", "oibvh-single"), "hierarchy"))
