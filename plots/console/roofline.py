"""How far stages are from the least time that the device allows: their bytes at the copy rate and their launches."""
import results
from console import spread
from tables import Table, duration, size

OF_QUERIES = ("ropes", "broad", "narrow")  # a frame's tree is built as in the cells that build


def text(run: results.Run) -> str:
    if not any(cell.experiment == "roofline" for cell in run.all_cells):
        return ""
    table = Table("<scene", "<of", "<stage", "launches", "bytes", "a triangle", "floor", "reached", "ratio")
    for cell in run.all_cells if run.copy_rate else ():
        if not cell.has_times:
            continue
        for entry in cell.all_samples[0]["stages"]:
            launches, moved = entry.get("launches", 0), entry.get("moved_bytes", 0)
            is_query = cell.operation != "collide" or cell.builder == "none" or entry["stage"] in OF_QUERIES
            if not (launches and moved and is_query):
                continue
            floor = 1e9 * moved / run.copy_rate + launches * run.facts.get("launch_cost_ns", 0)
            reached = spread.median(cell.times_ns(entry["stage"]))
            table.row([cell.scene_facts["name"], cell.pipeline, entry["stage"], str(launches), size(moved),
                       f"{moved / max(1, cell.triangles):.1f}", duration(floor), duration(reached), f"{reached / floor:.2f}"])
    return "floor: bytes at the copy rate, and launches at the launch cost\n" + table.text()
