// SPDX-License-Identifier: MIT
#include "oibvh/oibvh.h"

#include "builders/implicit/layout.h"
#include "oibvh/layout.h"

namespace bvhbench {
namespace {

constexpr ImplicitLayout oi_layout = {
    .stored_on = [](uint leaves, uint level) { return oi_real_on(oi_shape(leaves), level); },
    .first_slot = [](uint leaves, uint level) { return oi_first_slot(oi_shape(leaves), level); },
    .build_groups = "oibvh/build_groups.cl",
    .build_items = "oibvh/build_items.cl",
    .access = "oibvh/access.clh",
};

}  // namespace

std::unique_ptr<Builder> make_oibvh_multi(Programs& programs, const BuildOptions& options)
{
    return make_implicit_builder(
        programs,
        {"oibvh-multi", "Oi-BVH, multi-kernel [Chitalu2020]", BuilderCard::Runs::on_device},
        oi_layout, Meeting::between_launches, options);
}

std::unique_ptr<Builder> make_oibvh_multi_printed(Programs& programs, const BuildOptions& options)
{
    return make_implicit_builder(
        programs,
        {"oibvh-multi-printed", "Oi-BVH, multi-kernel, as printed [Chitalu2020]",
         BuilderCard::Runs::on_device},
        oi_layout, Meeting::by_local_atomics, options);
}

std::unique_ptr<Builder> make_oibvh_single(Programs& programs, const BuildOptions& options)
{
    return make_implicit_builder(
        programs,
        {"oibvh-single", "Oi-BVH, single-kernel [Chitalu2020]", BuilderCard::Runs::on_device},
        oi_layout, Meeting::by_handoff, options);
}

std::unique_ptr<Builder> make_oibvh_single_printed(Programs& programs, const BuildOptions& options)
{
    return make_implicit_builder(
        programs,
        {"oibvh-single-printed", "Oi-BVH, single-kernel, as printed [Chitalu2020]",
         BuilderCard::Runs::on_device},
        oi_layout, Meeting::by_climbing, options);
}

std::unique_ptr<Builder> make_oibvh_host(Programs& programs, const BuildOptions& options)
{
    return make_host_implicit_builder(
        programs,
        {"oibvh-host", "Oi-BVH, threads of the host [Chitalu2020]", BuilderCard::Runs::on_host},
        oi_layout, options);
}

}  // namespace bvhbench
