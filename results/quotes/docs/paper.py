from quotes import Document, File, sah, us


def quotes(doc: Document) -> None:
    fig8, table4, builders = File("h200/fig8-printed"), File("h200/table4"), File("h200/builders")

    def both(exponent: int) -> list[float]:
        return [us(fig8.cell(f"refine:torus:1024:{1 << exponent}", name)) for name in ("oibvh-single-printed", "oibvh-multi")]

    doc.says("the faster up to 2^13 triangles ({} and {} µs), equal at 2^14 ({}) and the slower from 2^15 on ({} and {};", *both(13), both(14)[0], *both(15))
    doc.says("the Happy Buddha's costs are {} and {};", *(sah(table4, "happy_buddha_1087716", f"{name}, morton30-axis")
                                                         for name in ("apetrei-fused", "oibvh-multi")))
    doc.says("the bunny's 144,046 triangles take {} µs where single work-items take {} (",
             *(us(builders.cell("bunny", name), "hierarchy") for name in ("oibvh-single", "oibvh-single-printed")))
