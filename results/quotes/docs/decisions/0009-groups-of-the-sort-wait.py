from quotes import Document, File, us


def quotes(doc: Document) -> None:
    orders = File("h200/orders")
    doc.says("({} in\n[orders.json]", us(orders.cell("torus:2880000", "oibvh-multi"), "sort"))
    doc.says("torus:2880000 from triangles to tree took {} µs", us(orders.cell("torus:2880000", "oibvh-multi")))
