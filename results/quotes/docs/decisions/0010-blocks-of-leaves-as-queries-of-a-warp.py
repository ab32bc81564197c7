from plots.evidence.quotes import ONE_SET, Document, File, ends, query_us, us

SCENES = ("torus:144046", "torus:2880000", "hairball:400000", "cloth-ball:92230", "n-body:146000")


def collapsed(doc: Document) -> None:
    """The table of radix trees that block walks, and what is said of it."""
    file = File("h200/collapse")

    def of(scene: str, collider: str, tree: str, *stages: str, order: str = "hilbert30, ") -> float:
        return us(file.cell(scene, f"{collider} over {tree} ({order}sorted leaves)"), *stages)

    implicit, radix = "oibvh-multi", "apetrei-fused"
    doc.table("collapse", "< scene | implicit, `block`: `broad` | frame | radix, `group`: `ropes` | `broad` | frame "
              "| radix, `block`: `collapse` | `broad` | frame", (
                  [scene, *(f"{value:.3g}" if value < 1000 else f"{value:.0f}" for value in (
                      of(scene, "block", implicit, "broad"), of(scene, "block", implicit),
                      of(scene, "group", radix, "ropes"), of(scene, "group", radix, "broad"), of(scene, "group", radix),
                      of(scene, "block", radix, "collapse"), of(scene, "block", radix, "broad"), of(scene, "block", radix)))]
                  for scene in SCENES))

    def ratios(collider: str, *stages: str, order: str = "hilbert30, ") -> tuple[float, float]:
        found = [of(scene, collider, radix, *stages, order=order) / of(scene, "block", implicit, *stages, order=order) for scene in SCENES]
        return min(found), max(found)

    doc.says("queried in {} to {} times the time of an implicit one (over `morton30` {} to {}), where `group` takes {} to {}",
             *ratios("block", "broad"), *ratios("block", "broad", order=""), *ratios("group", "broad"))
    collapse = [of(scene, "block", radix, "collapse") for scene in SCENES]
    doc.says("Its frame still takes {} to {} times as long: its build takes longer, and the collapse {} to {} µs",
             *ratios("block"), min(collapse), max(collapse))
    doc.says("On n-body, whose objects are small, the collapse costs more than it saves: {} µs a frame against {} with `group`",
             of(SCENES[-1], "block", radix), of(SCENES[-1], "group", radix))
    wide = "oibvh-wide4", "oibvh-wide8"
    doc.says("The stage takes {} to {} and {} to {} µs",
             *(end for tree in wide for end in ends(of(scene, "block", tree, "collapse") for scene in SCENES)))

    def of_wide(collider: str, than: str = "") -> list[float]:
        return [end for tree in wide for end in ends(of(scene, "block", tree, "broad") / of(scene, collider, than or tree, "broad")
                                                     for scene in SCENES)]

    doc.says("Queries take {} to {} and {} to\n{} times as long as those of the binary implicit tree, and {} to {} and {} to {} of those",
             *of_wide("block", implicit), *of_wide("group"))
    torus, hploc = SCENES[1], "hploc"
    doc.says("makes the collapse\n{} µs, and the query takes {} µs, where `group` takes {}. A frame takes {} µs, with `group` {}",
             of(torus, "block", hploc, "collapse"), of(torus, "block", hploc, "broad"), of(torus, "group", hploc, "broad"),
             of(torus, "block", hploc), of(torus, "group", hploc))


def quotes(doc: Document) -> None:
    collapsed(doc)
    pairs = File("h200/pairs")
    asked = ("group over apetrei-fused", "group over oibvh-multi", "block over oibvh-single")
    doc.says("take {} µs with `group` over\n`apetrei-fused` and {} over `oibvh-multi`, and {} with `block`",
             *(query_us(pairs.cell("torus:2880000" + ONE_SET, one)) for one in asked))
