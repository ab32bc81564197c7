"""Which counters of a cell are the same whenever it is measured, and which way they get worse."""
from cells import Cell

# A counter of a collider that comes out a little different from run to run, although nothing was changed, and why. Anything
# else that is no time is compared exactly.
UNSTEADY = {("box_tests_count", "group"): "it takes nodes in the order in which they turn up, which work-items race for"}
UNITS_OF_TIME = ("_ns", "_us", "_ms", "_s", "_per_s")
# What differs between devices, though it is exact on each: room for as many parts as there are compute units, and for queues
# that grow in steps of the device's.
SIZED_BY_DEVICE = {"scratch_bytes", "query_bytes", "near_bytes", "narrow_bytes", "memory_bytes"}
COSTS = {"sah_cost", "sah_inner", "sah_leaf", "sibling_overlap", "depth_max", "depth_mean", "epo", "epo_inner", "epo_leaf",
         "nodes_count", "missed_count", "false_count", "missed_pairs_count", "false_pairs_count", "relative_error",
         "box_tests_count"}


def is_time(counter: str) -> bool:
    """Whether its name ends with a unit of time, or it is a rate."""
    return counter.endswith(UNITS_OF_TIME)


def is_exact(counter: str, cell: Cell) -> bool:
    """Whether a cell like this one has the same value in every run."""
    return not is_time(counter) and (counter, cell.collider) not in UNSTEADY


def is_better_smaller(counter: str) -> bool:
    """Whether a smaller value is known to be better: costs, errors and bytes. What was found has no better value."""
    return counter.endswith("_bytes") or counter in COSTS
