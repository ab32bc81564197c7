"""How much launches alone may cost one run more than another. Between two runs the cost of a launch changes, and a run is too short
to show it: on processors threads of the operating system take launches, awake in one run and asleep in the next."""
from typing import Any

from cells import Sample, median
from comparing.drift import Pair

# By the kind of device: the largest cost of a launch over the smallest that runs on one machine met. On two cores of a shared host
# it was 0.5 to 6 microseconds, on an NVIDIA H200 4.7 to 7.2.
LARGEST_OVER_SMALLEST = {"cpu": 11.0}
OF_OTHERS = 1.5


def allowance_ns(runs: tuple[dict[str, Any], dict[str, Any]]) -> float:
    """Returns by how many nanoseconds a launch may differ between the two runs; 0 before format 1.5, which has no launch cost."""
    costs = [run.get("launch_cost_ns", 0) for run in runs]
    return (LARGEST_OVER_SMALLEST.get(runs[0]["device"].get("kind", ""), OF_OTHERS) - 1) * min(costs)


def share_of(pair: Pair, stage: str, allowance: float) -> float:
    """Returns the share of the smaller of both median times by which the launches of a stage, or of whole samples, may make them
    differ. A stage on the host counts as one launch."""
    shortest = min(median(series.times_ns(stage)) for series in pair)
    return allowance * max(launches_of(series.stages, stage) for series in pair) / shortest if shortest > 0 else 0.0


def launches_of(samples: list[Sample], stage: str) -> float:
    return median([sum(entry.get("launches", 1) for name, entry in sample.items() if stage in ("", name)) for sample in samples])
