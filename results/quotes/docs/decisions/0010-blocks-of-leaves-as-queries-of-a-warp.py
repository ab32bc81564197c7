from plots.evidence.quotes import ONE_SET, Document, File, query_us


def quotes(doc: Document) -> None:
    pairs = File("h200/pairs")
    asked = ("group over apetrei-fused", "group over oibvh-multi", "block over oibvh-single")
    doc.says("take {} µs with `group` over\n`apetrei-fused` and {} over `oibvh-multi`, and {} with `block`",
             *(query_us(pairs.cell("torus:2880000" + ONE_SET, one)) for one in asked))
