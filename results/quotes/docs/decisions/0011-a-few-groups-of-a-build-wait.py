from quotes import ONE_SET, Document, File, us


def quotes(doc: Document) -> None:
    doc.says("of torus:2880000 takes {} µs from ids", us(File("h200/peers").cell("torus:2880000", "oibvh-single"), "hierarchy"))
    doc.says("and {} from sorted leaves", us(File("h200/pairs").cell("torus:2880000" + ONE_SET, "block over oibvh-single (kd, sorted leaves)"),
                                             "hierarchy"))
