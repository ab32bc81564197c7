"""Which counters of a cell are reproducible, and in which direction they get worse."""
from .cells import Cell

# Counters of colliders that vary a little from run to run without any change: by 2e-5 and 0.2 % in the results. All other counters
# that are not times are compared exactly.
MOST_VARIATION = 0.01
UNSTEADY = {
    ("box_tests_count", "group"): "it takes nodes in the order in which they turn up, which work-items race for",
    **{(counter, collider): "its queues grow by what was found until they were full, which work-items race for"
       for counter in ("memory_bytes", "query_bytes") for collider in ("bvtt", "front")}}
FOUND = ("pairs_count", "contacts_count")  # all that a library guarantees
LIBRARIES = ("embree", "fcl")  # which builders and colliders wrap; beginnings of their names
UNSTEADY_UNITS = ("_ns", "_us", "_ms", "_s", "_per_s", "_joules", "_watts")  # and of energy
# Counters that are exact on each device but differ between devices: sizes depend on the number of compute units, and queues grow
# in steps of the device's, and bvtt starts where the device is tuned to.
SIZED_BY_DEVICE = {"scratch_bytes", "query_bytes", "near_bytes", "narrow_bytes", "memory_bytes", "device_peak_bytes",
                   "used_start_level", "used_jump", "earliest_impact"}
COSTS = {"sah_cost", "sah_inner", "sah_leaf", "sibling_overlap", "depth_max", "depth_mean", "epo", "epo_inner", "epo_leaf",
         "nodes_count", "missed_count", "false_count", "missed_pairs_count", "false_pairs_count", "relative_error", "missed_depth_most", "false_gap_most",
         "box_tests_count"}


def is_time(counter: str) -> bool:
    """True if the name ends with a unit of time or energy, or is a rate."""
    return counter.endswith(UNSTEADY_UNITS)


def is_exact(counter: str, cell: Cell) -> bool:
    """True if a cell like this one has the same value in every run."""
    return not is_time(counter) and (counter, cell.collider) not in UNSTEADY


def differs(counter: str, first: float, second: float, cell: Cell) -> bool:
    """True if two values of a counter that is no time tell of a change."""
    if is_time(counter) or first == second:
        return False
    return is_exact(counter, cell) or abs(second - first) > MOST_VARIATION * abs(first)


def is_promised(counter: str, cell: Cell) -> bool:
    """False for counters of libraries that may change from run to run or with their version, such as Embree's memory."""
    return counter in FOUND or not any(name.partition("-")[0] in LIBRARIES for name in (cell.builder, cell.collider or ""))


def is_better_smaller(counter: str) -> bool:
    """True if a smaller value is known to be better: costs, errors and bytes. Counts of results are neither better nor worse."""
    return counter.endswith("_bytes") or counter in COSTS
