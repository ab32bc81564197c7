from quotes import Document, File, sah, us

QUALITY = {"bunny, 69,451": "bunny_69451", "armadillo, 86,482": "armadillo_86482", "turbine blade, 199,034": "turbineblade_199034",
           "dragon, 202,520": "dragon_202520", "Happy Buddha, 1,087,716": "happy_buddha_1087716", "torus:200000": "torus:200000",
           "hairball:200000": "hairball:200000"}
TIMES = ("oibvh-multi", "oibvh-multi, morton30-axis", "oibvh-multi, hilbert30", "oibvh-multi, morton63", "oibvh-multi, hilbert63",
         "oibvh-multi, hilbert30+kd1024", "oibvh-multi, kd", "apetrei-fused")


def quotes(doc: Document) -> None:
    quality, orders, fig13 = File("h200/quality"), File("h200/orders"), File("h200/fig13")
    ratios = {}
    for label, scene in QUALITY.items():
        costs = [sah(quality, scene, asked) for asked in ("oibvh-multi, morton30-axis", "oibvh-multi", "oibvh-multi, hilbert30",
                                                          "oibvh-multi, hilbert30+kd1024", "oibvh-multi, kd", "apetrei-fused")]
        ratios[label] = costs[4] / costs[5]
        doc.row(label, *costs, ratios[label])
    doc.says("with `kd` it is within {} % of the radix tree on all five scans", 100 * max(list(ratios.values())[:5]) - 100)

    torus = [orders.cell("torus:2880000", asked) for asked in TIMES]
    times, costs = [us(cell) for cell in torus], [cell.counters["sah_cost"] for cell in torus]
    doc.row("triangles to tree", *times)
    doc.row("SAH", *costs)
    doc.says("costs {} % more time than `morton30` and lowers SAH by {} %", 100 * times[2] / times[0] - 100, 100 - 100 * costs[2]
             / costs[0])
    doc.says("in {} times the time of `morton30` and {} times that of the best radix builder", times[6] / times[0], times[6] / times[7])

    far = {asked: {mesh: [sah(fig13, cell.scene, asked) / sah(fig13, cell.scene, "apetrei-fused, morton30-axis") for cell in fig13.cells
                          if mesh in cell.scene and cell.builder == "apetrei-fused"] for mesh in ("torus", "dragon")}
           for asked in ("oibvh-multi, kd", "oibvh-multi, morton30-axis")}
    kd, printed = far.values()
    doc.says("On the torus `kd` costs {} to {} times as much as the radix tree, the paper's order {} to {} times",
             min(kd["torus"]), max(kd["torus"]), min(printed["torus"]), max(printed["torus"]))
    doc.says("rises to {}, the paper's order to {}", max(kd["dragon"]), max(printed["dragon"]))
