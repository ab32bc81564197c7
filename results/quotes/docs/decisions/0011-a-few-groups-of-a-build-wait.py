from plots.evidence.quotes import Document, File, us


def quotes(doc: Document) -> None:
    doc.says("of torus:2880000 takes {} µs from ids", us(File("h200/peers").cell("torus:2880000", "oibvh-single"), "hierarchy"))
    now, before = (us(File(f"turns/large-hierarchy-{name}").cells[0], "hierarchy") for name in ("after", "before"))
    doc.says("torus:67108864 takes {} µs, before {}, medians", now, before)
