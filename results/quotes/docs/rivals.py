from cells import Cell
from quotes import ONE_SET, Document, File, query_us, tree_us, us

SCENES = ("bend:torus:144046", "bend:torus:1087474", "bend:torus:2880000", "bend:happy_buddha_1087716", "unc_cloth_ball" + ONE_SET,
          "bend:hairball:400000", "bend:grid:1000000", "bend:soup:500000")
FIRST = "block over oibvh-single (hilbert30, sorted leaves)"
OUR_REFIT = "oibvh-single, hilbert30, sorted leaves, refit"
ROWS = {"`group` over `oibvh-multi`, `hilbert30`, sorted leaves": "group over oibvh-multi (hilbert30, sorted leaves)",
        "`group` over `apetrei-fused`": "group over apetrei-fused", "culbvh": "culbvh", "cuBQL, radix": "cubql-radix",
        "cuBQL, rebin radix": "cubql-rebin-radix", "Warp, LBVH": "warp-lbvh",
        "NexusBVH, H-PLOC, 32 bits": "nexus-hploc-32", "NexusBVH, H-PLOC, 64 bits": "nexus-hploc-64",
        "libuipc, stackless": "uipc-stackless", "libuipc, linear": "uipc-linear", "libuipc, info stackless": "uipc-info-stackless"}
REFITS = {"culbvh": "culbvh-refit", "cuBQL, radix": "cubql-radix-refit", "cuBQL, rebin radix": "cubql-rebin-radix-refit",
          "Warp, LBVH": "warp-lbvh-refit", "libuipc, linear": "uipc-linear-refit"}


def triangles_to_pairs(cell: Cell) -> float:
    return tree_us(cell) + query_us(cell)


def entry(cell: Cell, first: Cell | None = None) -> str:
    """Returns "0.079 + 0.085 = 0.164 (1.3)"."""
    told = "{:.3f} + {:.3f} = {:.3f}".format(*(1e-3 * part for part in (tree_us(cell), query_us(cell), triangles_to_pairs(cell))))
    return told + (f" ({triangles_to_pairs(cell) / triangles_to_pairs(first):.1f})" if first else "")


def quotes(doc: Document) -> None:
    rivals = File("h200/rivals")
    first = {scene: rivals.cell(scene, FIRST) for scene in SCENES}
    doc.under("## NVIDIA H200", until="**Refits**")
    doc.row("`block` over `oibvh-single`, `hilbert30`, sorted leaves", *(entry(first[scene]) for scene in SCENES))
    for label, asked in ROWS.items():
        doc.row(label, *(entry(rivals.cell(scene, asked), first[scene]) for scene in SCENES))
    best = [min(triangles_to_pairs(rivals.cell(scene, asked)) for asked in ROWS.values()
                if rivals.cell(scene, asked).outside) / triangles_to_pairs(first[scene])
            for scene in SCENES]
    doc.says("The fastest method from outside takes {} to {} times as long as ours", min(best), max(best))
    doc.says("it takes {} ms where `block` takes {}", query_us(rivals.cell(SCENES[2], "cubql-rebin-radix")) * 1e-3,
             query_us(first[SCENES[2]]) * 1e-3)
    walls = [cell.wall_ns * 1e-6 for cell in (rivals.cell(SCENES[0], asked) for asked in ROWS.values()) if cell.outside]
    doc.says("a frame of torus:144046 takes {} ms with ours and {} to {} with theirs", first[SCENES[0]].wall_ns * 1e-6,
             min(walls), max(walls))
    doc.says("culbvh's build of this torus, {} ms here", us(rivals.cell(SCENES[0], "culbvh"), "build") * 1e-3)
    doc.under("**Refits**", until="**Trees**")
    for label, asked in REFITS.items():
        doc.row(label, *(tree_us(rivals.cell(scene, asked)) * 1e-3 for scene in SCENES))

    doc.row("`oibvh-single`", *(us(rivals.cell(scene.removesuffix(ONE_SET), OUR_REFIT)) * 1e-3 for scene in SCENES))

    doc.under("**Trees**")
    trees = {cell.builder: cell.counters for cell in File("h200/rivals-trees").cells}
    for label, names in {"`oibvh-single`, `morton30`": ["oibvh-single"], "`apetrei-fused`": ["apetrei-fused"], "`hploc`": ["hploc"],
                         "culbvh": ["culbvh"], "NexusBVH: 32 bits, 64 bits": ["nexus-hploc-32", "nexus-hploc-64"],
                         "Warp": ["warp-lbvh"],
                         "cuBQL: radix, rebin radix, spatial median, SAH":
                         ["cubql-radix", "cubql-rebin-radix", "cubql-spatial-median", "cubql-sah"]}.items():
        doc.row(label, *(", ".join(f"{trees[name][counter]:.2f}" for name in names) for counter in ("sah_cost", "epo")))
    doc.under("## What failed")
    doc.says("lost up to 36,580 of {} pairs", first[SCENES[2]].counters["pairs_count"])
