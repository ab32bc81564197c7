// SPDX-License-Identifier: MIT
#include "collide/within/within.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "collide/counters.h"
#include "collide/device_lists.h"
#include "collide/narrow/narrow.h"
#include "collide/narrow/narrow_words.h"
#include "collide/parameters.h"
#include "collide/within/distance_filter.h"
#include "collide/within/exact_distance.h"
#include "geometry/bits.h"
#include "geometry/cores.h"

namespace bvhbench {
namespace {

constexpr uint within_group_size = 64;
constexpr std::size_t items_a_unit = 4096;   ///< most work-items of a compute unit, on many cores
constexpr uint run_of_chunk = 64;            ///< candidates that a work-item takes at once, on few
constexpr std::size_t taken_at_once = 1024;  ///< the same of a thread of the host

/// Returns a float that is at least half of the distance, and no denormal, which a device may take for 0.
float reach_of(double distance)
{
    constexpr float most = std::numeric_limits<float>::max();  // spans any two floats
    const double half = distance / 2;
    if (distance == 0 || half >= most)
        return distance == 0 ? 0 : most;
    const auto near = static_cast<float>(half);
    return std::max(std::nextafter(near, most), std::numeric_limits<float>::min());
}

/// Numbers around the square of the distance, which are equal unless that underflows: the filter's bounds cover its rounding.
std::pair<double, double> square_of(double distance)
{
    const double square = distance * distance;
    const bool underflows = distance > 0 && square < 0x1p-900;
    return {underflows ? 0 : square, underflows ? 0x1p-900 : square};
}

}  // namespace

bool are_within(std::span<const Point> points, std::span<const Face> faces, Pair pair,
                const WithinOptions& options)
{
    const Face a = faces[pair.a], b = faces[pair.b];
    if (share_a_vertex(a, b))
        return options.keep_adjacent;
    const Corners at_a = corners_of(points, a), at_b = corners_of(points, b);
    const auto [low, high] = square_of(options.distance);
    if (const uint likely = likely_within(at_a, at_b, low, high); likely != VERDICT_UNSURE)
        return likely == VERDICT_MEET;
    return triangles_meet(points, faces, pair, false) ||
           parted_within(at_a, at_b, options.distance);
}

WithinPhase::WithinPhase(Programs& programs, const WithinOptions& options)
    : programs_(programs)
    , options_(options)
    , form_(chosen_form(programs.device(), options.form))
    , has_doubles_(has_doubles(programs.device()) && !options.without_doubles)
{
    set_distance(options.distance);
    pad_ = programs.kernel("collide/within/pad.cl", "pad_points");
    if (has_doubles_)
        decide_ = programs.kernel("collide/within/within.cl", "decide_within",
                                  {{"RUN", form_ == KernelForm::chunks ? run_of_chunk : 1},
                                   {"KEEP_ADJACENT", options.keep_adjacent ? 1u : 0u}});
}

void WithinPhase::set_distance(double distance)
{
    if (!(distance >= 0 && std::isfinite(distance)))
        throw BadUsage("a distance is a finite number that is not negative");
    options_.distance = distance;
    reach_ = reach_of(distance);
    std::tie(low_, high_) = square_of(distance);
}

void WithinPhase::reserve(const Input& input)
{
    take_memory(arena_, programs_.device(), [&](Arena& arena) {
        low_ends_ = arena.take<Point>(input.device_points.size(), Use::scratch);
        high_ends_ = arena.take<Point>(input.device_points.size(), Use::scratch);
        counters_ = arena.take<uint>(NARROW_COUNTERS, Use::scratch);
    });
    const std::size_t guess = std::max<std::size_t>(1024, input.triangle_count());
    room_ = unsure_room_ = options_.capacity != 0 ? options_.capacity : guess;
    take_lists();
}

void WithinPhase::take_lists()
{
    take_memory(lists_, programs_.device(), [&](Arena& arena) {
        pairs_ = arena.take<Pair>(room_, Use::scratch);
        unsure_ = arena.take<Pair>(has_doubles_ ? unsure_room_ : 1, Use::scratch);
    });
}

Footprint WithinPhase::reserved() const
{
    Footprint all = arena_ ? arena_->used() : Footprint{};
    if (lists_)
        all.scratch_bytes += lists_->used().total();
    return all;
}

Input WithinPhase::padded(const Input& input, Queue& queue)
{
    assert(arena_ && "reserve first");
    const std::size_t count = low_ends_.size();
    queue.begin("pad");
    set_arguments(pad_, input.device_points, reach_, low_ends_, high_ends_,
                  static_cast<uint>(count));
    const bool in_groups = form_ == KernelForm::groups;
    queue.launch(pad_,
                 in_groups ? divided_up(static_cast<uint>(count), within_group_size) *
                                 std::size_t{within_group_size}
                           : chunk_count(programs_.device()),
                 in_groups ? within_group_size : 1,
                 static_cast<std::int64_t>(3 * low_ends_.bytes()));
    return input.between(low_ends_, high_ends_);
}

void WithinPhase::query(const Input& input, const DevicePairs& candidates, Queue& queue)
{
    const Device& device = programs_.device();
    queue.begin("narrow");
    queue.clear(counters_.cl(), counters_.bytes());
    if (has_doubles_) {
        set_arguments(decide_, input.device_points, input.device_faces, candidates.pairs,
                      candidates.counters, static_cast<uint>(candidates.pairs.size()), low_, high_,
                      pairs_, static_cast<uint>(pairs_.size()), unsure_,
                      static_cast<uint>(unsure_.size()), counters_);
        const bool in_groups = form_ == KernelForm::groups;
        queue.launch(decide_,
                     in_groups ? items_a_unit * device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()
                               : chunk_count(device),
                     in_groups ? within_group_size : 1, 0);
    }
    queue.on_host("exact", [&] { decide_on_host(input, candidates, queue); });
}

/// Appends what is within the distance of the unsure pairs; without doubles, of all candidates.
void WithinPhase::decide_on_host(const Input& input, const DevicePairs& candidates,
                                 const Queue& queue)
{
    const WithinCounts decided = counts(queue);
    const DevicePairs from = has_doubles_ ? DevicePairs{unsure_, {}} : candidates;
    const std::uint64_t there =
        has_doubles_ ? decided.exactly : wide_counts(candidates.counters, queue)[PAIRS_COUNT / 2];
    if (there == 0 || there > from.pairs.size())  // a list that was too short comes again
        return;
    const std::vector<Pair> left =
        first_entries(from.pairs, there, queue, "the candidates left to the host");
    std::vector<Point> device_points;
    std::vector<Face> device_faces;
    if (input.points.empty()) {
        device_points = input.device_points.download(queue.cl());
        device_faces = input.device_faces.download(queue.cl());
    }
    const std::span<const Point> points = input.points.empty() ? device_points : input.points;
    const std::span<const Face> faces = input.points.empty() ? device_faces : input.faces;
    std::vector<char> is_within(left.size());  // no bits: threads write them
    on_all_cores((left.size() + taken_at_once - 1) / taken_at_once, [&](std::size_t part) {
        const std::size_t end = std::min(left.size(), (part + 1) * taken_at_once);
        for (std::size_t k = part * taken_at_once; k < end; ++k)
            is_within[k] = are_within(points, faces, left[k], options_) ? 1 : 0;
    });
    std::vector<Pair> more;
    for (std::size_t k = 0; k < left.size(); ++k)
        if (is_within[k] != 0)
            more.push_back(left[k]);
    const std::uint64_t total = decided.within + more.size();
    if (!more.empty() && total <= pairs_.size())
        queue.cl().enqueueWriteBuffer(pairs_.cl(), CL_TRUE, decided.within * sizeof(Pair),
                                      more.size() * sizeof(Pair), more.data());
    const uint words[] = {static_cast<uint>(total), static_cast<uint>(total >> 32)};
    queue.cl().enqueueWriteBuffer(counters_.cl(), CL_TRUE, CONTACTS_COUNT * sizeof(uint),
                                  sizeof words, words);
}

bool WithinPhase::complete(const Queue& queue)
{
    const WithinCounts found = counts(queue);
    const Device& device = programs_.device();
    const bool pairs_fit = had_room(room_, found.within, found.within / 8, sizeof(Pair), device,
                                    "pairs within the distance");
    const bool unsure_fit = had_room(unsure_room_, found.exactly, found.exactly / 8, sizeof(Pair),
                                     device, "unsure pairs");
    if (!pairs_fit || !unsure_fit)
        take_lists();
    return pairs_fit && unsure_fit;
}

WithinCounts WithinPhase::counts(const Queue& queue) const
{
    const std::vector<std::uint64_t> counts = wide_counts(counters_, queue);
    return {counts[CONTACTS_COUNT / 2], counts[NARROW_EXACT_COUNT / 2]};
}

std::vector<Pair> WithinPhase::pairs(const Queue& queue) const
{
    return first_entries(pairs_, counts(queue).within, queue, "the pairs within the distance");
}

}  // namespace bvhbench
