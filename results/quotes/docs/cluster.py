from quotes import Document, File, frame_ms


def quotes(doc: Document) -> None:
    strong, weak, small = (File(f"h200/cluster-{name}").document["runs"] for name in ("strong", "weak", "strong-small"))
    one, two = (frame_ms(run["result"]) for run in strong)
    doc.says("| torus:67108864 | {} ms | {} ms | {} times as fast |", one, two, one / two)
    half, whole = (frame_ms(run["result"]) for run in weak)
    doc.says("| torus:33554432, torus:67108864 | {} ms | {} ms | as much on each: efficiency {} % |", half, whole, 100 * half / whole)
    doc.says("The measured {} is below", one / two)
    doc.says("torus:2880000 takes {} ms on one H200 and {} on two", *(frame_ms(run["result"]) for run in small))

    billion, largest = File("h200/cluster-billion").document, File("h200/cluster-largest").document
    rank = billion["ranks"][0]
    doc.says("along `hilbert48`: {} ms a frame, {} pairs", frame_ms(billion), billion["pairs_count"])
    doc.says("predicted as\n{} GB and measured as {}; the host took {} GB for it, {} bytes a triangle", rank["predicted_device_bytes"]
             * 1e-9,
             rank["device_peak_bytes"] * 1e-9, rank["host_peak_bytes"] * 1e-9, rank["host_peak_bytes"] / rank["triangles"])
    doc.says("moving the triangles took\n{} s, once", billion["partition_ns"] * 1e-9)
    doc.says("| 500,000,000 | `block`, `hilbert48` | H200 | {} | {} |", rank["device_peak_bytes"] / rank["triangles"],
             rank["predicted_device_bytes"] / rank["device_peak_bytes"])
    only = largest["ranks"][0]
    doc.says("the largest scene that was run on one: {} ms a frame, {} ns a triangle, {} pairs", frame_ms(largest),
             largest["frame_ns"] / largest["scene"]["triangles"], largest["pairs_count"])
    doc.says("It took {} GB of the device's memory and {} of the\nhost's. The file predicts {} GB", only["device_peak_bytes"] * 1e-9,
             only["host_peak_bytes"] * 1e-9, only["predicted_device_bytes"] * 1e-9)

    for scene, size, boxes in (("filled", "", "50,000"), ("filled", "-large", "9,300,000"), ("hollow", "", "50,000"),
                               ("hollow", "-large", "9,300,000")):
        alone, both = (File(f"h200/cluster-{scene}{size}-{ranks}").document for ranks in (1, 2))
        doc.says(f"| {scene}-cube | {boxes} | {{}} ms | {{}} ms | {{}} |", frame_ms(alone), frame_ms(both), both["pairs_count"])

    def halo(name: str, partition: str) -> float:
        return next(100 * run["result"]["halo_share"] for run in File(f"pocl-2-cores/{name}").document["runs"] if run["ranks"] == 8
                    and run["partition"] == partition and run["result"]["boxes_count"] == 64)

    doc.says("With `rcb` {} % of the triangles go to another of 8 ranks, with `curve` {} %", halo("cluster-halo", "rcb"),
             halo("cluster-halo", "curve"))
    doc.says("Of soup:1000000 {} % go to another of 8 ranks with\n`rcb`, {} % with `curve`", halo("cluster-halo-soup", "rcb"),
             halo("cluster-halo-soup", "curve"))
