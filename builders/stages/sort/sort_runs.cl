// SPDX-License-Identifier: MIT
// check: -DDIGIT_BITS=8u -DMOST_PASSES=8u -DCODE_WORDS=2u -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DSTATE_EPOCH_BITS=31u
//
// Between the passes of sweep_words.cl by the high parts of codes and those by all of a code: sorts each run of equal high parts by the
// low parts.
#include "builders/stages/sort/sweep_tile.clh"
#include "geometry/dialect.h"

#define MOST_IN_A_RUN 32u

/// Sets counters[RUNS_ARE_LONG] if a run would have more than MOST_IN_A_RUN pairs, were the digits of passes `first_pass` to
/// `passes` - 1 independent and as frequent as the most frequent ones. Launched as one group.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void expect_runs(
    volatile global uint* counters, const uint count, const uint first_pass, const uint passes)
{
    local uint most[MOST_PASSES];
    const uint item = (uint)get_local_id(0);
    for (uint pass = item; pass < passes; pass += GROUP_SIZE)
        most[pass] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = HISTOGRAM(first_pass) + item; k < HISTOGRAM(passes); k += GROUP_SIZE)
        atomic_max(&most[k / DIGITS], counters[k]);
    barrier(CLK_LOCAL_MEM_FENCE);
    float in_a_run = (float)count;
    for (uint pass = first_pass; pass < passes; ++pass)
        in_a_run *= (float)most[pass] / (float)count;
    if (item == 0u && in_a_run > (float)MOST_IN_A_RUN)
        counters[RUNS_ARE_LONG] = 1u;
}

/// Writes the ids of `count` words, sorted by the high parts above `id_bits` bits. Of a pair in a run, a work-item counts the pairs
/// that come before it. Sets counters[RUNS_ARE_LONG], and leaves ids out, if a run has more than MOST_IN_A_RUN pairs.
kernel void sort_runs(global const ulong* restrict words, global const ulong* restrict codes,
                      global uint* restrict ids, volatile global uint* counters, const uint count,
                      const uint id_bits)
{
    const uint own = (uint)get_global_id(0);
    if (own >= count || has_long_runs(counters))
        return;
    const ulong high = words[own] >> id_bits, id_mask = (1ul << id_bits) - 1ul;
    uint first = own, end = own + 1u;
    while (first > 0u && own - first < MOST_IN_A_RUN && words[first - 1u] >> id_bits == high)
        --first;
    while (end < count && end - first <= MOST_IN_A_RUN && words[end] >> id_bits == high)
        ++end;
    if (end - first > MOST_IN_A_RUN) {
        atomic_or(&counters[RUNS_ARE_LONG], 1u);
        return;
    }
    const uint id = (uint)(words[own] & id_mask);
    uint place = first;
    if (end - first > 1u) {
        const ulong code = codes[id];
        for (uint k = first; k < end; ++k) {
            const ulong other = codes[words[k] & id_mask];
            place += other < code || (other == code && k < own) ? 1u : 0u;
        }
    }
    ids[place] = id;
}
