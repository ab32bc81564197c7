// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "builders/implicit/layout.h"

namespace bvhbench {

std::unique_ptr<Builder> make_perfect(Programs& programs, const BuildOptions& options)
{
    constexpr ImplicitLayout layout = {
        .stored_on = [](uint, uint level) { return 1u << level; },
        .first_slot = [](uint, uint level) { return (1u << level) - 1; },
        .build_groups = "baselines/perfect/build_groups.cl",
        .build_items = "baselines/perfect/build_items.cl",
        .access = "baselines/perfect/access.clh",
    };
    return make_implicit_builder(programs,
                                 {"perfect", "Perfect implicit tree, padded [Chitalu2020, Table 1]",
                                  BuilderCard::Runs::on_device},
                                 layout, Meeting::between_launches, options);
}

}  // namespace bvhbench
