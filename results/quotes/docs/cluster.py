from collections.abc import Callable

from clusters import measured, stage_times
from quotes import Document, File, frame_ms
from ranks import model_s


def quotes(doc: Document) -> None:
    def times(name: str) -> list[float]:
        return [frame_ms(run["result"]) for run in File(f"h200/cluster-{name}").document["runs"]]

    for name, scene in (("strong", "torus:67108864"), ("strong-buddha", "the scanned Happy Buddha, refined to 17,000,000"),
                        ("strong-hairball", "hairball:8000000"), ("strong-small", "torus:2880000")):
        doc.says(f"| {scene} | {{}} ms | {{}} ms | {{}} ms | {{}} times as fast |", *times(name), times(name)[0] / times(name)[2])
    weak = times("weak")
    doc.says("| torus with 33,554,432 on each | {} ms | {} ms | {} ms | {} % efficient |", *weak, 100 * weak[0] / weak[2])

    def most(name: str, stage: str, clock: str = "device_ns", pick: Callable[[list[float]], float] = max) -> float:
        """Returns the most time that a rank of four needs for a stage, or for all of them, in milliseconds."""
        stages = stage_times(File(f"h200/cluster-{name}").document["runs"][2]["result"], clock)
        return pick(stages[stage] if stage else [sum(ranks) for ranks in zip(*stages.values())]) * 1e-6

    doc.says("torus:67108864: the busiest device works for {} of the {} ms", most("strong", ""), times("strong")[2])
    doc.says("The exchange, of {} ms at most, is hidden behind the test of the own triangles, {} ms", most("strong", "exchange", "host_ns"),
             most("strong", "self"))
    doc.says("the busiest device works for {} of {} ms. The own triangles take {} ms, the exchange {} on", most("strong-buddha", ""),
             times("strong-buddha")[2], most("strong-buddha", "self"), most("strong-buddha", "exchange", "host_ns"))
    hairball = File("h200/cluster-strong-hairball").document["runs"][2]["result"]
    doc.says("The hairball: the busiest device works for {} of {} ms. {} % of the triangles leave. Testing them takes {} ms on the device "
             "that receives most and {} on the one that receives least; the own triangles take {}", most("strong-hairball", ""),
             times("strong-hairball")[2], 100 * hairball["halo_share"], most("strong-hairball", "halo"),
             most("strong-hairball", "halo", pick=min), most("strong-hairball", "self"))
    doc.says("and 8,000,000 have {}", hairball["pairs_count"])

    billion, = (run["result"] for run in File("h200/cluster-billion").document["runs"])
    largest = File("h200/cluster-largest").document
    rank = billion["ranks"][0]
    doc.says("on four H200, `block` over `oibvh-multi` along `hilbert48`: {} ms a frame, {} pairs", frame_ms(billion), billion["pairs_count"])
    doc.says("predicted as\n{} GB and measured as {}; the host took {} GB for it, {} bytes a triangle", rank["predicted_device_bytes"]
             * 1e-9,
             rank["device_peak_bytes"] * 1e-9, rank["host_peak_bytes"] * 1e-9, rank["host_peak_bytes"] / rank["triangles"])
    doc.says("moving the triangles took\n{} s, once", billion["partition_ns"] * 1e-9)
    whole, = (run["result"] for run in File("h200/cluster-most").document["runs"])
    doc.says("on four H200: {} ms a frame, {} pairs", frame_ms(whole), whole["pairs_count"])
    doc.says("It took {} GB of each device's memory and {} GB of the host's for each rank",
             *(max(rank[key] for rank in whole["ranks"]) * 1e-9 for key in ("device_peak_bytes", "host_peak_bytes")))
    doc.says("| 250,000,000 | `block`, `hilbert48` | H200 | {} | {} |", rank["device_peak_bytes"] / rank["triangles"],
             rank["predicted_device_bytes"] / rank["device_peak_bytes"])
    only = largest["ranks"][0]
    doc.says("the largest scene that was run on one: {} ms a frame, {} ns a triangle, {} pairs", frame_ms(largest),
             largest["frame_ns"] / largest["scene"]["triangles"], largest["pairs_count"])
    doc.says("It took {} GB of the device's memory, predicted as\n{}, and {} of the host's",
             *(only[key] * 1e-9 for key in ("device_peak_bytes", "predicted_device_bytes", "host_peak_bytes")))

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

    strong = measured(File("h200/cluster-strong").document)
    model = [strong[0]["frame_ns"] * 1e-9 / model_s(strong[0], strong[-1], ranks, False) for ranks in (4, 8)]
    doc.says("It gives {} times on 4 ranks for torus:67108864, where {} was measured, and {} on 8", model[0],
             times("strong")[0] / times("strong")[2], model[1])
    doc.says("{} ms on the rank that sends to two others, the test of those that came, {} ms", most("strong", "select"),
             most("strong", "halo"))
