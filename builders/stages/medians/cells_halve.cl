// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DMOST_SLABS=4096u
//
// Between two passes of cells_groups.cl: splits lists exactly, a group per node. MOST_SLABS is the number of slabs of the
// node's children together, or of the root.
#include "builders/stages/group_scan.clh"
#include "builders/stages/medians/cells.clh"
#include "geometry/bits.h"

#define DIGITS 256u
#define FEW GROUP_SIZE  // entries that are ranked by comparing each with all others

// Turns of the loop in halve_lists.
#define PARTS_TURN 0u  // counts a long list's entries by parts of their slab
#define FEW_TURN 1u    // ranks the entries of a short list, or those of one part
#define DIGITS_TURN \
    2u  // first of 8 turns: counts the entries by a digit of key and id, if one part is long
#define CHILDREN_TURN 10u  // splits the list; the children's counts determine their cuts

/// The entries of a list that go left: those whose digits in `mask` are at most those of `last`.
typedef struct {
    ulong mask, last;
    uint wanted;    ///< Entries that go left among the undecided ones.
    uint is_found;  ///< 1 if no entry is undecided.
} Selection;

static inline bool goes_left(local const Selection* const selection, const ulong entry)
{
    return (entry & selection->mask) <= selection->last;
}

/// Returns which of DIGITS equal parts of its slab an entry is in; monotonic in the entry.
static inline uint part_of_slab(const CellCut cut, const ulong entry)
{
    const float at = from_ordered_bits((uint)(entry >> 32u));
    const float parts = (at - cut.low) * cut.slabs_per_unit * (float)DIGITS;
    return (uint)fmin(fmax(parts - (float)(cut.slab * DIGITS), 0.0f), (float)(DIGITS - 1u));
}

/// Returns the lowest bit of the digit that is counted in a turn.
static inline uint shift_of(const uint turn) { return 56u - 8u * (turn - DIGITS_TURN); }

/// Counts the undecided entries by their part or digit.
static inline void count_digits(local const Selection* const selection, global const ulong* list,
                                const uint size, const CellCut cut, const uint turn,
                                volatile local uint* digits)
{
    for (uint k = (uint)get_local_id(0); k < size; k += GROUP_SIZE) {
        const ulong entry = list[k];
        if (turn == PARTS_TURN)
            atomic_inc(&digits[part_of_slab(cut, entry)]);
        else if ((entry & selection->mask) == selection->last)
            atomic_inc(&digits[(uint)(entry >> shift_of(turn)) & (DIGITS - 1u)]);
    }
}

/// Records the next digit, given how many undecided entries have a smaller digit and how many have the same.
static inline void add_digit(local Selection* const selection, const uint turn, const uint digit,
                             const uint less, const uint equal)
{
    selection->wanted -= less;
    selection->is_found = selection->wanted == equal ? 1u : 0u;
    selection->mask |= (ulong)(DIGITS - 1u) << shift_of(turn);
    selection->last |= (ulong)digit << shift_of(turn);
}

/// Selects among few entries: the last to go left is the one with `wanted` - 1 smaller entries.
static inline void select_of_few(local Selection* const selection, local const ulong* const few,
                                 const uint size, const uint wanted)
{
    for (uint k = (uint)get_local_id(0); k < size; k += GROUP_SIZE) {
        const ulong entry = few[k];
        uint less = 0u;
        for (uint other = 0u; other < size; ++other)
            less += few[other] < entry ? 1u : 0u;
        if (less + 1u == wanted) {
            selection->mask = ~0ul;
            selection->last = entry;
            selection->is_found = 1u;
        }
    }
}

/// Splits the lists of the nodes on the level above `level`, counts their leaves in the slabs of the children, and stores the
/// children's cuts and the cells of the children's children. `level` 0: the root has no list, and only its cut is found. On the
/// level of the blocks, leaves get their places instead.
///
/// One loop over turns. In most of them, prefix sums over bins tell which bin holds the wanted entry. (PoCL 3.1 cannot inline
/// sum_before twice, and loses loop variables across barriers except for the counter, so the state is kept in local memory.)
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void halve_lists(
    global const float* restrict centres, global uint* restrict nodes,
    global CellCut* restrict cuts, global Aabb* restrict cells, global uint* restrict lefts,
    global uint* restrict counts, global const uint* restrict waiting,
    global const ulong* restrict lists, volatile global uint* placed, global uint* restrict ids,
    const uint count, const uint root_height, const uint block_height, const uint level)
{
    local uint bins[MOST_SLABS];  // of the children's slabs, one child after the other
    local uint digits[DIGITS];
    local ulong few[FEW];
    local uint few_size;
    local uint scratch[SCAN_SCRATCH];
    local uint
        found[6];  // of a digit or of each child: the bin, the entries before it, the entries in it
    local Selection selection;
    const uint item = (uint)get_local_id(0);
    const uint node = (uint)get_group_id(0);
    const uint height = root_height - level;  // of the children
    const uint slabs = slab_count(level, height);
    const bool at_blocks = height == block_height;
    const uint children = level > 0u ? 2u : 1u;
    const uint first_child = children * node;

    const uint above = level > 0u ? first_node(level - 1u) + node : 0u;
    const uint size = level > 0u ? waiting[above] : 0u;
    const uint list_start = level > 0u ? node << (height + 1u) : 0u;
    global const ulong* const list = lists + list_start;
    // Loads whatever may be needed before it is known whether it is, so that the loads do not wait for each other.
    const CellCut cut = cuts[above];
    const ulong own_entry = list_start + item < count ? list[item] : 0ul;
    const uint real_children = min(children, divided_up(count, 1u << height) - first_child);
    const CellCut left_cut = cuts[at_blocks ? 0u : first_node(level) + first_child];
    const CellCut right_cut =
        cuts[at_blocks || real_children < 2u ? 0u : first_node(level) + first_child + 1u];
    if (item == 0u) {
        selection.mask = 0ul;
        selection.last = 0ul;
        selection.wanted = level > 0u ? lefts[above] : 0u;
        selection.is_found = size == 0u ? 1u : 0u;
        few_size = 0u;
        found[1] = 0u;
        found[2] = size;
    }
    const uint all_slabs = at_blocks ? 0u : slabs * children;
    // Reads all counters before clearing any, so that the loads overlap.
    const uint real_slabs = min(all_slabs, slabs * real_children);
    for (uint k = item; k < all_slabs; k += GROUP_SIZE)
        bins[k] = k < real_slabs ? counts[first_child * slabs + k] : 0u;
    for (uint k = item; k < real_slabs; k += GROUP_SIZE)
        counts[first_child * slabs + k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);

    for (uint turn = size > FEW ? PARTS_TURN : FEW_TURN; turn <= CHILDREN_TURN; ++turn) {
        if (turn < CHILDREN_TURN && selection.is_found != 0u)
            continue;
        if (turn == FEW_TURN) {
            if (found[2] > FEW)
                continue;
            for (uint k = item; k < size; k += GROUP_SIZE) {
                const ulong entry = k < GROUP_SIZE ? own_entry : list[k];
                if (size <= FEW || part_of_slab(cut, entry) == found[0])
                    few[atomic_inc(&few_size)] = entry;
            }
            barrier(CLK_LOCAL_MEM_FENCE);
            select_of_few(&selection, few, few_size, selection.wanted - found[1]);
            barrier(CLK_LOCAL_MEM_FENCE);
            continue;
        }
        const bool selects = turn < CHILDREN_TURN;
        local uint* const counted = selects ? digits : bins;
        const uint all_bins = selects ? DIGITS : all_slabs;
        const uint child_bins = selects ? DIGITS : slabs;
        if (selects) {
            for (uint k = item; k < DIGITS; k += GROUP_SIZE)
                digits[k] = 0u;
            barrier(CLK_LOCAL_MEM_FENCE);
            count_digits(&selection, list, size, cut, turn, digits);
        } else {
            for (uint k = item; k < size; k += GROUP_SIZE) {
                const ulong entry = k < GROUP_SIZE ? own_entry : list[k];
                const uint id = (uint)entry;
                const uint side = goes_left(&selection, entry) ? 0u : 1u;
                if (at_blocks) {
                    place_leaf(placed, ids, first_child + side, block_height, id);
                } else {
                    nodes[id] = first_child + side;
                    const uint axis = side == 0u ? left_cut.axis : right_cut.axis;
                    const float at = centres[(ulong)axis * count + id];
                    atomic_inc(&bins[side * slabs +
                                     slab_of(side == 0u ? left_cut : right_cut, at, slabs)]);
                }
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);

        const uint own_bins = divided_up(all_bins, GROUP_SIZE);
        const uint begin = min(all_bins, item * own_bins);
        const uint end = min(all_bins, begin + own_bins);
        uint sum = 0u;
        for (uint bin = begin; bin < end; ++bin)
            sum += counted[bin];
        uint all;
        uint before = sum_before(sum, scratch, &all);
        const uint child = begin / child_bins;  // child that all of this item's bins belong to
        const uint first = (first_child + child) << height;
        const uint leaves = selects || first >= count ? 0u : min(1u << height, count - first);
        const uint target = selects ? selection.wanted : left_count(leaves, height);
        before -= child > 0u ? 1u << height : 0u;  // leaves of the other child
        if (before < target && target <= before + sum)
            for (uint bin = begin; bin < end; ++bin) {
                if (before < target && target <= before + counted[bin]) {
                    found[3u * child] = bin - child * child_bins;
                    found[3u * child + 1u] = before;
                    found[3u * child + 2u] = counted[bin];
                }
                before += counted[bin];
            }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (selects && turn >= DIGITS_TURN && item == 0u)
            add_digit(&selection, turn, found[0], found[1], found[2]);
        if (!selects && begin == child * child_bins && begin < end && leaves > 0u)
            cut_node(cuts, cells, lefts, level, first_child + child, slabs,
                     slab_count(level + 1u, height - 1u),
                     target<leaves, found[3u * child], target - found[3u * child + 1u], height - 1u>
                         block_height);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}
