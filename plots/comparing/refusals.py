"""Rules of a comparison, and what two result files must have in common to be compared."""
import pathlib
from dataclasses import dataclass
from typing import Any

from ..files.output import WrongUsage
from ..read import results

Named = tuple[pathlib.Path, dict[str, Any]]  # a file's path, and its document or its run


@dataclass(frozen=True)
class Rules:
    threshold: float = 0.05  # smallest relative change of time that counts
    error: float = 0.05  # probability that any cell of two equal runs is called faster or slower
    allow_missing: bool = False
    allow_dirty: bool = False
    other_devices: bool = False  # compare only ratios between the cells of a scene
    allow_test_hooks: bool = False
    builders: tuple[str, str] | None = None  # compare cells of two builders; a difference of times or trees is no regression


def require_comparable(first: Named, second: Named, rules: Rules) -> None:
    """Raises WrongUsage, naming the files, if they cannot be compared under these rules."""
    for name, document in (first, second):
        require_file(name, document, rules)
    (name, one), (other_name, other) = first, second
    costs = [results.costs_text(results.costs_of(document["run"])) for document in (one, other)]
    if costs[0] != costs[1]:
        raise WrongUsage(f"{name} counts {costs[0]} and {other_name} {costs[1]}, so their sah_cost are not of one kind")
    clocks = [document["run"].get("clock", "device") for document in (one, other)]
    if clocks[0] != clocks[1]:
        raise WrongUsage(f"{name} was timed by the {clocks[0]}'s clock and {other_name} by the {clocks[1]}'s")
    if rules.other_devices and rules.builders:
        raise WrongUsage("--builders compares times of one device, and --other-devices ratios of two")
    if not rules.other_devices:
        require_same_machine((name, one["run"]), (other_name, other["run"]), "compares only ratios between the cells of a scene")


def require_same_machine(first: Named, second: Named, otherwise: str) -> None:
    """Raises WrongUsage if two runs were measured on different machines; `otherwise` is what --other-devices does."""
    (name, one), (other_name, other) = first, second
    if machine(one) != machine(other):
        raise WrongUsage(f"{name} was measured on {device_text(one)} and {other_name} on {device_text(other)}; --other-devices {otherwise}")


def require_file(name: pathlib.Path, document: dict[str, Any], rules: Rules) -> None:
    if not document["cells"]:
        raise WrongUsage(f"{name} has no cells to compare")
    if any(has_only_zeros(cell) for cell in document["cells"]):
        raise WrongUsage(f"{name} has launches that took no time: the device's clock was wrong (--clock host takes the host's)")
    require_run(name, document["run"], rules)


def has_only_zeros(cell: dict[str, Any]) -> bool:
    """True for a measured cell of launches of which none took any time, as older versions believed a clock that stood still."""
    stages = [stage for sample in cell.get("samples", []) for stage in sample["stages"]]
    return any(stage.get("launches") for stage in stages) and not any(stage.get("span_ns") or stage.get("wall_ns") for stage in stages)


def require_run(name: pathlib.Path, run: dict[str, Any], rules: Rules) -> None:
    program = run["program"]
    if results.is_dirty(program) and not rules.allow_dirty:
        raise WrongUsage(f"{name} was made by a program {results.changes_text(program)}, so nobody can say what was compared; "
                         "--allow-dirty compares it all the same")
    for hook, value in sorted(run.get("test_hooks", {}).items()):
        if not rules.allow_test_hooks:
            raise WrongUsage(f"{name} was made under {hook}={value}, which changes times for tests: it is no result")


def machine(run: dict[str, Any]) -> tuple[Any, ...]:
    device, host = run["device"], run["host"]
    return device["name"], device["platform"], device["compute_units"], host["cpu"], host["threads"]


def device_text(run: dict[str, Any]) -> str:
    name, _, units, cpu, threads = machine(run)
    return f"{name} ({units} units, host {cpu} of {threads} threads)"
