// SPDX-License-Identifier: MIT
#include "collide/moving/impact_queries.h"

#include <algorithm>
#include <cassert>

#include "builders/stages/kernel_form.h"
#include "collide/device_lists.h"
#include "collide/narrow/narrow.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

// To add a method, add a line here and what it computes to queries.cl.
constexpr QueryMethod catalog[] = {
    {"ccd-f32-1e-2", "directions and volumes in floats: none missed, false ones within 1e-2", 1, 32,
     1e-2},
    {"ccd-f32-1e-4", "directions and volumes in floats: none missed, false ones within 1e-4", 1, 32,
     1e-4},
    {"ccd-f32-1e-6", "directions and volumes in floats: none missed, false ones within 1e-6", 1, 32,
     1e-6},
    {"ccd-f64-1e-2", "directions and volumes in doubles: none missed, false ones within 1e-2", 1,
     64, 1e-2},
    {"ccd-f64-1e-4", "directions and volumes in doubles: none missed, false ones within 1e-4", 1,
     64, 1e-4},
    {"ccd-f64-1e-6", "directions and volumes in doubles: none missed, false ones within 1e-6", 1,
     64, 1e-6},
    {"ccd-f64-1e-10", "directions and volumes in doubles: none missed, false ones within 1e-10", 1,
     64, 1e-10},
    {"additive-f64", "distance by distance, in doubles as computed", 2, 64, 0},
    {"roots-f64-1e-6", "roots of a cubic in doubles as computed, touching within 1e-6", 3, 64,
     1e-6},
    {"roots-f64-1e-10", "roots of a cubic in doubles as computed, touching within 1e-10", 3, 64,
     1e-10},
};

/// Steps after which a query is taken to touch.
constexpr uint most_steps(const QueryMethod& method) { return method.misses_none() ? 64 : 4096; }

constexpr uint group_size = 64;
constexpr std::size_t groups_a_unit = 32;  ///< most, on many cores

}  // namespace

std::span<const QueryMethod> query_methods() { return catalog; }

ImpactQueries::ImpactQueries(Programs& programs, const QueryMethod& method, double separation)
    : programs_(programs), tolerance_(method.tolerance), separation_(separation)
{
    check_separation(separation);
    if (separation > 0 && !method.can_separate())
        throw BadUsage(
            "the method " + std::string(method.name) +
            " finds when four vertices are in one plane, which a separation keeps apart");
    if (!has_doubles(programs.device()))
        throw Unavailable("queries of moving points are in doubles, which the device has not");
    kernel_ = programs.kernel("collide/moving/queries.cl", "time_impacts",
                              {{"MOST_STEPS", most_steps(method)},
                               {"REAL_BITS", method.real_bits},
                               {"ANSWER", method.answer},
                               {"SEPARATED", separation > 0 ? 1u : 0u}});
}

void ImpactQueries::load(std::span<const MovingQuery> queries, std::size_t copies,
                         const Queue& queue)
{
    count_ = queries.size();
    in_all_ = count_ * copies;
    of_edges_ = !queries.empty() && queries.front().of_edges;
    if (in_all_ > std::size_t{1} << 31)
        throw Unavailable("there are more than 2^31 queries");
    take_memory(arena_, programs_.device(), [&](Arena& arena) {
        from_ = arena.take<double>(12 * in_all_, Use::scratch);
        to_ = arena.take<double>(12 * in_all_, Use::scratch);
        times_ = arena.take<double>(in_all_, Use::scratch);
        cut_short_ = arena.take<uint>(1, Use::scratch);
    });
    // An array a coordinate: neighbouring lanes read neighbouring numbers.
    const auto upload = [&](Buffer<double>& to, const auto& at) {
        std::vector<double> all(12 * in_all_);
        for (std::size_t k = 0; k < in_all_; ++k) {
            assert(queries[k % count_].of_edges == of_edges_);
            for (std::size_t vertex = 0; vertex < 4; ++vertex) {
                const WidePoint p = at(queries[k % count_])[vertex];
                double* const x = &all[3 * vertex * in_all_ + k];
                x[0] = p.x, x[in_all_] = p.y, x[2 * in_all_] = p.z;
            }
        }
        to.upload(queue.cl(), all);
    };
    upload(from_, [](const MovingQuery& query) { return query.from; });
    upload(to_, [](const MovingQuery& query) { return query.to; });
}

void ImpactQueries::query(Queue& queue)
{
    assert(in_all_ > 0 && "load first");
    const Device& device = programs_.device();
    const bool in_groups = chosen_form(device, KernelForm::of_device) == KernelForm::groups;
    queue.begin("narrow");
    queue.clear(cut_short_.cl(), cut_short_.bytes());
    set_arguments(kernel_, from_, to_, of_edges_ ? 1u : 0u, static_cast<uint>(in_all_), tolerance_,
                  separation_, times_, cut_short_);
    const std::size_t groups =
        std::min<std::size_t>(divided_up(static_cast<uint>(in_all_), group_size),
                              groups_a_unit * device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
    queue.launch(kernel_, in_groups ? group_size * groups : chunk_count(device),
                 in_groups ? group_size : 1,
                 static_cast<std::int64_t>(from_.bytes() + to_.bytes() + times_.bytes()));
}

std::vector<double> ImpactQueries::times(const Queue& queue) const
{
    std::vector<double> all = times_.download(queue.cl());
    all.resize(count_);
    return all;
}

std::uint64_t ImpactQueries::cut_short(const Queue& queue) const
{
    return cut_short_.download(queue.cl()).front();
}

}  // namespace bvhbench
