"""A scene in three dimensions: what `bvhbench report --scene` wrote of it, packed for a page."""
import array
import pathlib
from typing import Any

import results
from report_cells import scene_name, state_of, who


def packed(kind: str, values: list) -> bytes:
    """Little-endian numbers of 32 bits: 'f' or 'I'."""
    numbers = array.array(kind, values)
    assert numbers.itemsize == 4
    return numbers.tobytes()


def load(path: pathlib.Path) -> tuple[dict[str, Any], dict[str, bytes]]:
    """What is said of a scene, and its arrays by name. Raises results.Refused for a file that is none."""
    view = results.parsed(path)
    try:
        results.check(path, view["cell"], "cell")
        results.check(path, view["run"], "run")
        return facts_of(view), arrays_of(view)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        raise results.Refused(f"{path}: no scene of a report: {error}") from error


def arrays_of(view: dict[str, Any]) -> dict[str, bytes]:
    return {"points": packed("f", view["points"]), "faces": packed("I", view["faces"]),
            "pairs": packed("I", view["pairs"]), "contacts": packed("I", view["contacts"]),
            "boxes": packed("f", [side for level in view["levels"] for side in level["boxes"]])}


def facts_of(view: dict[str, Any]) -> dict[str, Any]:
    cell, run = view["cell"], view["run"]
    levels = [{"count": len(level["boxes"]) // 6, "leaves": level["leaves"]} for level in view["levels"]]
    return {"scene": scene_name(cell["scene"]), "frame": cell["scene"].get("frame", 0), "who": who(cell),
            "triangles": len(view["faces"]) // 3, "state": state_of(cell), "against": cell["check"].get("against", ""),
            "why": cell["check"].get("detail", ""), "hashes": {key: value for key, value in cell["check"].items()
                                                               if key.endswith("_hash")},
            "device": run["device"]["name"], "driver": run["device"]["driver"], "commit": run["program"]["commit"],
            "dirty": run["program"]["dirty"], "pairs": len(view["pairs"]) // 2, "contacts": len(view["contacts"]) // 2,
            "levels": levels}
