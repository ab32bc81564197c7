"""What the program says of a sweep's cells: what each is in full, or why there is none."""
from collections.abc import Callable

from sweeping.planned import NO_BUILDER, OPTIONS, Json, Planned, Sweep

Settle = Callable[[list[Json]], list[Json]]  # the program's answers to experiments


def settled(planned: list[Planned], sweep: Sweep, settle: Settle) -> list[Planned]:
    """With what the program says of each."""
    for one, answer in zip(planned, settle([sweep.experiment([one]) for one in planned])):
        one.why_not = answer.get("error", "")
        one.raw = unsettled(one, sweep) if one.why_not else answer["cells"][0]
        if not one.why_not:
            say_all_options(one)
    return planned


def say_all_options(one: Planned) -> None:
    """However a cell was described, it is the same experiment, also for a program whose usual options are others."""
    if one.builder is not None:
        one.builder = {"name": one.raw["builder"]["name"], **one.raw["builder"]["options"]}
    if one.collider is not None:
        options, said = dict(one.raw["collider"]["options"]), one.query
        one.query = {key: options.pop(key) for key, (whose, _) in OPTIONS.items() if whose == "query" and key in options}
        if one.query.pop("no_skip"):  # a list of rules there, which experiments name one by one, or all
            one.query["no_skip"] = said["no_skip"]
        one.collider = {"name": one.raw["collider"]["name"], **options}


def unsettled(one: Planned, sweep: Sweep) -> Json:
    """What can be said of a cell that there is not."""
    def choice(described: Json) -> Json:
        options = {key: int(value) if str(value).isdecimal() else value for key, value in described.items() if key != "name"}
        return {"name": described["name"], "options": options}

    scene = {"name": one.scene["scene"]}
    if int(one.scene.get("between", 0)) > 0:
        scene["between"] = int(one.scene["between"])
    if one.scene.get("objects", "auto") != "auto":
        scene["objects_by"] = one.scene["objects"]
    raw = {"experiment": sweep.name, "scene": scene, "builder": choice(one.builder or {"name": NO_BUILDER}),
           "operation": "build" if one.collider is None else "collide", "status": "skipped"}
    if one.collider is not None:
        of_scene = {"adjacent": "drop"} if one.scene.get("swept") else {}
        of_scene |= {"pairs_of": one.scene["pairs_of"]} if "pairs_of" in one.scene else {}
        raw["collider"] = choice(one.collider | one.query | of_scene)
    return raw
