from plots.evidence.quotes import Document, File, sah, us

QUALITY = ("oibvh-multi, morton30-axis", "oibvh-multi", "oibvh-multi, hilbert30", "oibvh-multi, hilbert30+kd1024", "oibvh-multi, kd",
           "apetrei-fused")
TIMES = (*QUALITY[:2], "oibvh-multi, hilbert24", *QUALITY[2:4], "oibvh-multi, morton63", "oibvh-multi, hilbert63", *QUALITY[4:])
SCANS = ("bunny_69451", "armadillo_86482", "turbineblade_199034", "dragon_202520", "happy_buddha_1087716")


def called(asked: str) -> str:
    return "radix tree" if asked == QUALITY[-1] else f"`{asked.partition(', ')[2] or 'morton30'}`"


def quotes(doc: Document) -> None:
    quality, orders = File("h200/quality"), File("h200/orders")
    costs = {scene: [sah(quality, scene, asked) for asked in QUALITY] for scene in (*SCANS, "torus:200000", "hairball:200000")}
    doc.table("quality", f"< mesh | {' | '.join(map(called, QUALITY))} | `kd`/radix", (
        [scene, *those, f"{those[4] / those[5]:.2f}"] for scene, those in costs.items()))
    doc.says("it is within {} % of the radix tree on all five scans", 100 * max(costs[scene][4] / costs[scene][5] for scene in SCANS) - 100)
    doc.says("IPC's armadillo, {} and {} % worse", *(100 * sah(orders, scene, QUALITY[4]) / sah(orders, scene, QUALITY[5]) - 100
                                                     for scene in ("unc_cloth_ball", "ipc_armadillo_rollers")))
    builders = File("h200/builders")
    assert sah(builders, "unc_cloth_ball", "median-split") > 0.95 * sah(orders, "unc_cloth_ball", QUALITY[4]), "orders.md says that it is no better"
    wide, narrow = (us(orders.cell("torus:2880000", f"oibvh-multi, hilbert{bits}")) for bits in (63, 30))
    doc.says("gain nothing and take {} times as long", wide / narrow)
    doc.table("times", "< order | triangles to tree, µs | SAH", (
        [called(asked), us(cell), cell.counters["sah_cost"]] for asked in TIMES for cell in [orders.cell("torus:2880000", asked)]))
