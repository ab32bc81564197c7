from plots.evidence.quotes import Document, File, us

ORDERS = ("", ", morton63", ", hilbert30", ", kd")
STAGES = ("sort", "sort", "codes", "order")


def quotes(doc: Document) -> None:
    files = [File(f"turns/sorts-{name}") for name in ("before", "after")]

    def of(order: str, *stages: str) -> list[float]:
        return [us(file.cell("torus:2880000", f"oibvh-multi{order}"), *stages) / 1000 for file in files]

    rows = [(order, stage, of(order, stage)) for order, stage in zip(ORDERS, STAGES, strict=True)]
    rows.append(("", "triangles to tree", of("")))
    doc.table("two cores", "< order | < what | before, ms | now, ms | ratio", (
        [f"`{order[2:] or 'morton30'}`", f"`{what}`" if what in STAGES else what, before, now, f"{now / before:.2f}"] for order, what, (before, now) in rows))
