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
#include "collide/host_triangles.h"
#include "collide/narrow/narrow.h"
#include "collide/narrow/narrow_words.h"
#include "collide/parameters.h"
#include "collide/within/closest.h"
#include "collide/within/distance_filter.h"
#include "collide/within/exact_distance.h"
#include "geometry/bits.h"
#include "geometry/cores.h"

namespace bvhbench {
namespace {

constexpr uint within_group_size = 256;
/// Most work-groups of a compute unit, on many cores; each pass has a quarter of the one before, which leaves few pairs over.
constexpr std::size_t groups_a_unit = 16;
constexpr std::size_t taken_at_once = 1024;  ///< the same of a thread of the host

/// Returns the nearest float that is not above a positive double, or not below it, and no denormal, which a device may take for 0.
float float_below(double value)
{
    const auto near =
        static_cast<float>(std::min(value, double{std::numeric_limits<float>::max()}));
    const float below = double{near} <= value ? near : std::nextafter(near, 0.0f);
    return below < std::numeric_limits<float>::min() ? 0 : below;
}

float float_above(double value)
{
    const auto near = static_cast<float>(value);
    const float above = double{near} >= value ? near : std::nextafter(near, INFINITY);
    return value == 0 ? 0 : std::max(above, std::numeric_limits<float>::min());
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
    if (const uint likely = likely_within(at_a, at_b, low, high, true); likely != VERDICT_UNSURE)
        return likely == VERDICT_MEET;
    return triangles_meet(points, faces, pair, false) ||
           parted_within(at_a, at_b, options.distance);
}

WithinPhase::WithinPhase(Programs& programs, const WithinOptions& options)
    : programs_(programs)
    , options_(options)
    , form_(chosen_form(programs.device(), options.form))
    , padding_(programs, options.form, false)
{
    set_distance(options.distance);
    check_narrow_of(options.method, NarrowOf::distance);
    const bool can_double = has_doubles(programs.device()) && !options.without_doubles;
    const NarrowMethod& method =
        find_narrow_method(options.method == "none" ? "exact" : options.method);
    is_exact_ = method.is_exact;
    if (!is_exact_) {
        if (!can_double)
            throw Unavailable(std::string(method.name) +
                              " needs doubles, which the device has not");
        computes_distances_ = method.within_test == WITHIN_COMPUTED;
        add_pass(method.within_test, method.real_bits, PAIRS_COUNT, NARROW_EXACT_COUNT);
    } else if (can_double && in_groups()) {
        add_pass(WITHIN_CORNERS, 32, PAIRS_COUNT, NARROW_FLOAT_COUNT);
        add_pass(WITHIN_WAYS, 32, NARROW_FLOAT_COUNT, NARROW_DOUBLE_COUNT);
        add_pass(WITHIN_WAYS, 64, NARROW_DOUBLE_COUNT, NARROW_EXACT_COUNT);
    } else if (can_double) {
        add_pass(WITHIN_WAYS, 64, PAIRS_COUNT, NARROW_EXACT_COUNT);
    }
}

void WithinPhase::add_pass(unsigned test, unsigned real_bits, uint from, uint left_at)
{
    passes_.push_back(
        {.kernel = programs_.kernel("collide/within/within.cl", "decide_within",
                                    {{"GROUP_SIZE", in_groups() ? within_group_size : 1},
                                     {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                     {"TEST", test},
                                     {"REAL_BITS", real_bits},
                                     {"FROM", from},
                                     {"LEFT", left_at}}),
         .real_bits = real_bits,
         .left_at = left_at});
}

void WithinPhase::set_distance(double distance)
{
    if (!(distance >= 0 && std::isfinite(distance)))
        throw BadUsage("a distance is a finite number that is not negative");
    options_.distance = distance;
    std::tie(low_, high_) = square_of(distance);
}

void WithinPhase::reserve(std::size_t points, std::size_t triangles)
{
    take_memory(arena_, programs_.device(),
                [&](Arena& arena) { counters_ = arena.take<uint>(NARROW_COUNTERS, Use::scratch); });
    padding_.reserve(points);
    const std::size_t guess = std::max<std::size_t>(1024, triangles);
    room_ = options_.capacity != 0 ? options_.capacity : guess;
    for (Pass& pass : passes_)
        pass.room = is_exact_ ? room_ : 1;
    take_lists();
}

void WithinPhase::take_lists()
{
    take_memory(lists_, programs_.device(), [&](Arena& arena) {
        pairs_ = arena.take<Pair>(room_, Use::scratch);
        distances_ = arena.take<double>(computes_distances_ ? room_ : 1, Use::scratch);
        for (Pass& pass : passes_)
            pass.left = arena.take<Pair>(pass.room, Use::scratch);
    });
}

Footprint WithinPhase::reserved() const
{
    Footprint all = padding_.reserved();
    for (const auto* arena : {&arena_, &lists_})
        all.scratch_bytes += *arena ? (*arena)->used().total() : 0;
    return all;
}

void WithinPhase::query(const Input& input, const DevicePairs& candidates, Queue& queue)
{
    const Device& device = programs_.device();
    queue.begin("narrow");
    queue.clear(counters_.cl(), counters_.bytes());
    DevicePairs from = candidates;
    std::size_t items =
        groups_a_unit * within_group_size * device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    for (Pass& pass : passes_) {
        const auto begin = [&](auto low, auto high) {
            set_arguments(pass.kernel, input.device_points, input.device_faces, from.pairs,
                          from.counters, static_cast<uint>(from.pairs.size()), low, high, pairs_,
                          static_cast<uint>(pairs_.size()), distances_, pass.left,
                          static_cast<uint>(pass.left.size()), counters_);
        };
        if (pass.real_bits == 64)
            begin(low_, high_);
        else
            begin(float_below(low_), float_above(high_));
        queue.launch(pass.kernel, in_groups() ? items : chunk_count(device),
                     in_groups() ? within_group_size : 1, 0);
        items = std::max(items / 4, std::size_t{within_group_size});
        from = {pass.left, counters_};
    }
    if (is_exact_)
        queue.on_host("exact", [&] { decide_on_host(input, candidates, queue); });
}

/// Appends what is within the distance of the unsure pairs; without doubles, of all candidates.
void WithinPhase::decide_on_host(const Input& input, const DevicePairs& candidates,
                                 const Queue& queue)
{
    const WithinCounts decided = counts(queue);
    const bool all_here = passes_.empty();
    const DevicePairs from = all_here ? candidates : DevicePairs{passes_.back().left, {}};
    const std::uint64_t there =
        all_here ? wide_counts(candidates.counters, queue)[PAIRS_COUNT / 2] : decided.exactly;
    if (there == 0 || there > from.pairs.size())  // a list that was too short comes again
        return;
    const std::vector<Pair> left =
        first_entries(from.pairs, there, queue, "the candidates left to the host");
    const HostTriangles here(input, queue);
    std::vector<char> is_within(left.size());  // no bits: threads write them
    on_all_cores((left.size() + taken_at_once - 1) / taken_at_once, [&](std::size_t part) {
        const std::size_t end = std::min(left.size(), (part + 1) * taken_at_once);
        for (std::size_t k = part * taken_at_once; k < end; ++k)
            is_within[k] = are_within(here.points, here.faces, left[k], options_) ? 1 : 0;
    });
    std::vector<Pair> more;
    for (std::size_t k = 0; k < left.size(); ++k)
        if (is_within[k] != 0)
            more.push_back(left[k]);
    append_found(more, decided.within, {pairs_, counters_}, queue);
}

bool WithinPhase::complete(const Queue& queue)
{
    const std::vector<std::uint64_t> counts = wide_counts(counters_, queue);
    const auto fits = [&](std::size_t& room, uint at, const char* what) {
        const std::uint64_t there = counts[at / 2];
        return had_room(room, there, there / 8, sizeof(Pair), programs_.device(), what);
    };
    bool all_fit = fits(room_, CONTACTS_COUNT, "pairs within the distance");
    for (Pass& pass : passes_)
        all_fit = fits(pass.room, pass.left_at, "unsure pairs") && all_fit;
    if (!all_fit)
        take_lists();
    return all_fit;
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

std::vector<double> WithinPhase::distance_errors(const Input& input, const Queue& queue) const
{
    if (!computes_distances_ || options_.distance == 0)
        return {};
    assert(!input.points.empty());
    const std::vector<Pair> found = pairs(queue);
    const std::vector<double> computed = distances_.download(queue.cl());
    std::vector<double> errors(found.size());
    on_all_cores((found.size() + taken_at_once - 1) / taken_at_once, [&](std::size_t part) {
        const std::size_t end = std::min(found.size(), (part + 1) * taken_at_once);
        for (std::size_t k = part * taken_at_once; k < end; ++k) {
            const Corners a = corners_of(input.points, input.faces[found[k].a]);
            const Corners b = corners_of(input.points, input.faces[found[k].b]);
            errors[k] = std::abs(computed[k] - closest_points(a, b).distance) / options_.distance;
        }
    });
    std::ranges::sort(errors);
    return errors;
}

}  // namespace bvhbench
