// SPDX-License-Identifier: MIT
//
// Benchmarks of code on the host that needs no device. Their names begin with "host/".
#pragma once

#include "benchmarks/iterations.h"

namespace bvhbench {

/// Registers `work`, which processes `items` items and returns a number. The benchmark has an error unless that is `expected`.
template <class Work>
void register_host(const std::string& name, Outcome& outcome, std::int64_t items,
                   std::uint64_t expected, Work work)
{
    benchmark::RegisterBenchmark(("host/" + name).c_str(), [=, &outcome](benchmark::State& state) {
        const std::uint64_t found = work();
        if (found != expected) {
            outcome.differs = true;
            return fail(state, "the result is wrong: " + std::to_string(found) + ", not " +
                                   std::to_string(expected));
        }
        for (auto _ : state)
            benchmark::DoNotOptimize(work());
        state.SetItemsProcessed(state.iterations() * items);
        state.SetLabel("agrees");
        outcome.has_measured = true;
    });
}

void register_host_codes(Outcome& outcome);     ///< the layout's formulas; Morton and Hilbert codes
void register_host_contacts(Outcome& outcome);  ///< predicates of the narrow phase
void register_host_readers(Outcome& outcome);   ///< readers of mesh files

}  // namespace bvhbench
