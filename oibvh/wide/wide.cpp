// SPDX-License-Identifier: MIT
#include "oibvh/oibvh.h"
#include "oibvh/wide/builder.h"

namespace bvhbench {

std::unique_ptr<Builder> make_oibvh_wide4(Programs& programs, const BuildOptions& options)
{
    return make_wide_builder(programs,
                             {"oibvh-wide4", "Oi-BVH, 4 children a node [Chitalu2020, App. C]",
                              BuilderCard::Runs::on_device},
                             {2, "oibvh/wide/wide4.clh", "oibvh/wide/wide4_access.clh"}, options);
}

std::unique_ptr<Builder> make_oibvh_wide8(Programs& programs, const BuildOptions& options)
{
    return make_wide_builder(programs,
                             {"oibvh-wide8", "Oi-BVH, 8 children a node [Chitalu2020, App. C]",
                              BuilderCard::Runs::on_device},
                             {3, "oibvh/wide/wide8.clh", "oibvh/wide/wide8_access.clh"}, options);
}

}  // namespace bvhbench
