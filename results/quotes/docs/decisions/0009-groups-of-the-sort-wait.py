from plots.evidence.quotes import Document, File, us

ORDERS = ("", ", morton63", ", hilbert30", ", kd")
STAGES = ("sort", "sort", "codes", "order")


def two_cores(doc: Document) -> None:
    files = [File(f"turns/sorts-{name}") for name in ("before", "after")]

    def of(order: str, *stages: str) -> list[float]:
        return [us(file.cell("torus:2880000", f"oibvh-multi{order}"), *stages) / 1000 for file in files]

    rows = [(order, stage, of(order, stage)) for order, stage in zip(ORDERS, STAGES, strict=True)]
    rows.append(("", "triangles to tree", of("")))
    doc.table("two cores", "< order | < what | before, ms | now, ms | ratio", (
        [f"`{order[2:] or 'morton30'}`", f"`{what}`" if what in STAGES else what, before, now, f"{now / before:.2f}"] for order, what, (before, now) in rows))


def wide_codes(doc: Document) -> None:
    files = [File(f"turns/wide-codes-{name}") for name in ("before", "after")]
    doc.table("wide codes", "< scene | `morton48`: before | now | `morton63`: before | now", (
        [scene, *(us(file.cell(scene, f"oibvh-single, {order}"), "sort") for order in ("morton48", "morton63") for file in files)]
        for scene in ("torus:2880000", "soup:2880000", "outlier:torus:2880000:0:400")))


def short_codes(doc: Document) -> None:
    cells = [cell for cell in File("turns/short-codes").cells if "hilbert" in cell.label]

    def ratio(scene: str, frame: int, *stages: str) -> float:
        long, short = (us(cell, *stages) for cell in cells if (cell.scene, cell.frame) == (scene, frame))
        return short / long

    meshes = "torus:144046", "torus:400000"
    doc.says("take {} of the time along `hilbert30` for torus:144046 and {} for", *(ratio(mesh, 0, "order", "hierarchy") for mesh in meshes))
    doc.says("exact contacts take {} and {}, the two of `unc_cloth_ball` {} and {}, those of `unc_nbody` {} and {} (",
             *(ratio(mesh, 0) for mesh in meshes), *(ratio(scene, frame) for scene in ("unc_cloth_ball", "unc_nbody") for frame in (0, 1)))


def quotes(doc: Document) -> None:
    two_cores(doc)
    wide_codes(doc)
    short_codes(doc)
