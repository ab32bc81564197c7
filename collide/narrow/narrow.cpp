// SPDX-License-Identifier: MIT
#include "collide/narrow/narrow.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

#include "collide/device_lists.h"
#include "collide/host_triangles.h"
#include "collide/narrow/exact_adjacent.h"
#include "collide/narrow/narrow_words.h"
#include "collide/narrow/sharing.h"
#include "collide/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// Steps of a method for swept boxes; a pair that needs more is taken to touch.
constexpr uint most_steps = 64;

constexpr uint pairs_in_block = 512;  ///< that a work-item collects of a kind, on few cores

/// Most work-groups per compute unit, of methods for swept boxes.
constexpr std::size_t swept_groups_per_unit = 32;

/// Most work-groups per compute unit, of the filter and of the exact test: about as many as run at a time. Others only cost their
/// start: on an H200 22,558 candidates took both kernels together 16 µs with 32 groups each, and 11 with 4 and 2; 980,183 took the
/// filter 38.4 µs with 4 and 34.1 with 6. With 8 groups in the place of 2, exact tests of most kinds of pairs took up to 1.7 times as
/// long, and those of the slowest kind, pairs a hair's breadth apart, 0.78 times (not kept).
constexpr std::size_t filter_groups_per_unit = 6, exact_groups_per_unit = 2;

/// After as many queries whose filter left nothing open, the launch that would decide it is left out.
constexpr uint queries_to_skip_rest = 3;

/// True if a float that is a denormal is not taken for 0, which would be another coordinate.
bool keeps_denormals(const Device& device)
{
    return (device.cl.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_DENORM) != 0;
}

}  // namespace

bool has_doubles(const Device& device)
{
    return device.cl.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
}

Corners corners_of(std::span<const Point> points, Face face)
{
    return {{points[face.a], points[face.b], points[face.c]}};
}

bool triangles_meet(std::span<const Point> points, std::span<const Face> faces, Pair pair,
                    bool keep_adjacent)
{
    Shared shared = {0, faces[pair.a], faces[pair.b]};
    if (keep_adjacent)
        shared = sharing(shared.a, shared.b);
    return corners_meet(corners_of(points, shared.a), corners_of(points, shared.b), shared.count);
}

void append_found(std::span<const Pair> more, std::uint64_t found, const DevicePairs& list,
                  const Queue& queue)
{
    const std::uint64_t room = list.pairs.size();
    const std::size_t written = std::min<std::uint64_t>(more.size(), room - std::min(found, room));
    if (written > 0)
        queue.cl().enqueueWriteBuffer(list.pairs.cl(), CL_TRUE, found * sizeof(Pair),
                                      written * sizeof(Pair), more.data());
    const std::uint64_t total = found + more.size();
    const uint words[] = {static_cast<uint>(total), static_cast<uint>(total >> 32)};
    queue.cl().enqueueWriteBuffer(list.counters.cl(), CL_TRUE, CONTACTS_COUNT * sizeof(uint),
                                  sizeof words, words);
}

NarrowPhase::NarrowPhase(Programs& programs, const NarrowOptions& options)
    : programs_(programs)
    , options_(options)
    , form_(chosen_form(programs.device(), options.form))
    , has_doubles_(has_doubles(programs.device()) && keeps_denormals(programs.device()) &&
                   !options.without_doubles)
    , is_filter_(find_narrow_method(options.method).is_filter())
    , is_exact_(find_narrow_method(options.method).is_exact)
    , chunks_(chunk_count(programs.device()))
{
    const Device& device = programs.device();
    if (by_groups())
        group_size_ = device.tuned(narrow_group_size);
    else
        block_pairs_ = pairs_in_block;
    check_narrow(options.method, options.keep_adjacent);
    check_narrow_of(options.method, is_swept() ? NarrowOf::step : NarrowOf::moment);
    check_separation(options.separation);
    if (options.separation > 0)
        check_separation(options.method, is_swept());
    const NarrowMethod& method = find_narrow_method(options.method);
    options_.method = method.name;  // refers to static storage
    if (method.real_bits == 64 && !has_doubles_)
        throw Unavailable(
            std::string(method.name) +
            " needs doubles, and floats that are denormals, and the device lacks one of them");
    if (is_swept()) {
        tolerance_ = method.tolerance * *options.swept_size;
        filter_ = compiled_impacts(method);
        return;
    }
    filter_ = compiled_filter(method);
    if (is_filter_ && !is_exact_)
        rest_ = programs.kernel("collide/narrow/narrow_undecided.cl", "keep_undecided");
    else if (is_exact_ && has_doubles_)
        rest_ = programs.kernel("collide/narrow/narrow_exact.cl", "decide_exactly",
                                {{"KEEP_ADJACENT", options.keep_adjacent ? 1u : 0u}});
}

cl::Kernel NarrowPhase::compiled_filter(const NarrowMethod& method)
{
    std::vector<Define> defines = {by_groups() ? Define{"GROUP_SIZE", group_size_}
                                               : Define{"SINK_BLOCK", block_pairs_}};
    const bool with_doubles = has_doubles_ && method.real_bits != 32;
    if (is_filter_)
        defines.insert(defines.end(), {{"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                       {"WITH_DOUBLES", with_doubles ? 1u : 0u}});
    else
        defines.insert(defines.end(),
                       {{"ROUNDED_TEST", method.rounded_test}, {"REAL_BITS", method.real_bits}});
    const char* const verdict =
        is_filter_ ? "collide/narrow/verdict.clh" : "collide/narrow/rounded.clh";
    const char* const chunks =
        is_filter_ ? "collide/narrow/narrow_chunks.cl" : "collide/narrow/rounded_chunks.cl";
    return programs_.kernel(verdict, by_groups() ? "collide/narrow/narrow_groups.cl" : chunks,
                            "filter_pairs", defines);
}

cl::Kernel NarrowPhase::compiled_impacts(const NarrowMethod& method)
{
    std::vector<Define> defines = {{"MOST_STEPS", most_steps},
                                   {"REAL_BITS", method.real_bits},
                                   {"SEPARATED", options_.separation > 0 ? 1u : 0u}};
    if (method.real_bits == 32) {
        if (options_.is_wide)
            throw BadUsage("the vertices are in doubles, and the narrow phase " +
                           std::string(method.name) +
                           " rounds them to floats, which can miss what touches: take one that is "
                           "called ccd-f64-*");
        return programs_.kernel("collide/impacts/impacts.cl", "find_impacts", defines);
    }
    defines.push_back({"WIDE_POINTS", options_.is_wide ? 1u : 0u});
    return programs_.kernel("collide/wide_impacts/wide_impacts.cl", "find_impacts", defines);
}

void NarrowPhase::reserve(std::size_t triangles)
{
    const std::size_t guess = std::max<std::size_t>(1024, triangles);
    contact_room_ = options_.capacity != 0 ? options_.capacity : guess;
    unsure_room_ = is_filter_ ? contact_room_ : 1;
    take_all();
}

void NarrowPhase::take_all()
{
    take_memory(arena_, programs_.device(), [&](Arena& arena) {
        counters_ = arena.take<uint>(NARROW_COUNTERS, Use::scratch);
        next_counters_ = arena.take<uint>(NARROW_COUNTERS, Use::scratch);
        unsure_ = arena.take<Pair>(unsure_room_, Use::scratch);
        blocks_ = arena.take<Pair>(by_groups() ? 1 : 2 * block_pairs_ * chunks_, Use::scratch);
        contacts_ = arena.take<Pair>(contact_room_, Use::scratch);
        times_ = arena.take<float>(is_swept() ? contact_room_ : 1, Use::scratch);
    });
    const Device& device = programs_.device();
    next_counters_.upload(cl::CommandQueue(device.context, device.cl),
                          std::vector<uint>(NARROW_COUNTERS));
}

/// Returns the number of work-items for a list of pairs. In the group form they loop over the list.
std::size_t NarrowPhase::items_for(std::size_t pairs, std::size_t groups_per_unit) const
{
    if (!by_groups())
        return chunks_;
    const Device& device = programs_.device();
    const std::size_t most = groups_per_unit * device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    return group_size_ *
           std::clamp<std::size_t>(divided_up(static_cast<uint>(pairs), group_size_), 1, most);
}

void NarrowPhase::query(const Input& input, const Buffer<Pair>& candidates,
                        const Buffer<uint>& candidate_counters, Queue& queue)
{
    assert(arena_ && "reserve first");
    counts_.clear();
    if (is_swept()) {
        find_impacts(input, candidates, candidate_counters, queue);
        return;
    }
    const auto contact_room = static_cast<uint>(contacts_.size());
    const auto unsure_room = static_cast<uint>(unsure_.size());

    queue.begin("narrow");
    std::swap(counters_, next_counters_);
    set_arguments(filter_, input.device_points, input.device_faces, candidates, candidate_counters,
                  static_cast<uint>(candidates.size()), contacts_, contact_room, unsure_,
                  unsure_room, counters_, next_counters_);
    if (!by_groups())
        filter_.setArg(11, blocks_.cl());
    queue.launch(filter_, items_for(candidates.size(), filter_groups_per_unit),
                 by_groups() ? group_size_ : 1, 0);
    if (!is_filter_)
        return;
    if (is_exact_ && !has_doubles_) {
        decide_on_host(input, queue);
        return;
    }
    launched_rest_ = decided_in_row_ < queries_to_skip_rest;
    if (!launched_rest_)
        return;
    if (is_exact_)
        set_arguments(rest_, input.device_points, input.device_faces, unsure_, unsure_room,
                      contacts_, contact_room, counters_);
    else
        set_arguments(rest_, unsure_, unsure_room, contacts_, contact_room, counters_);
    queue.launch(rest_, items_for(unsure_.size(), exact_groups_per_unit),
                 by_groups() ? group_size_ : 1, 0);
}

void NarrowPhase::find_impacts(const Input& input, const Buffer<Pair>& candidates,
                               const Buffer<uint>& candidate_counters, Queue& queue)
{
    queue.begin("narrow");
    queue.clear(counters_.cl(), counters_.bytes());
    const auto set_for = [&](const auto& points, const auto& end_points, auto separation) {
        set_arguments(filter_, points, end_points, input.device_faces, candidates,
                      candidate_counters, static_cast<uint>(candidates.size()), contacts_, times_,
                      static_cast<uint>(contacts_.size()), tolerance_, separation, counters_);
    };
    const double separation = options_.separation;
    if (options_.is_wide)
        set_for(input.wide.device_points, input.wide.device_end_points, separation);
    else if (find_narrow_method(options_.method).real_bits == 64)
        set_for(input.device_points, input.device_end_points, separation);
    else  // rounded as the kernel allows for, and no denormal, which a device may take for 0
        set_for(input.device_points, input.device_end_points,
                static_cast<float>(std::clamp<double>(separation, std::numeric_limits<float>::min(),
                                                      std::numeric_limits<float>::max())));
    queue.launch(filter_, items_for(candidates.size(), swept_groups_per_unit),
                 by_groups() ? group_size_ : 1, 0);
}

void NarrowPhase::decide_on_host(const Input& input, Queue& queue)
{
    const std::vector<std::uint64_t> counts = wide_counts(counters_, queue);
    std::vector<Pair> unsure = first_entries(
        unsure_, std::min<std::uint64_t>(counts[NARROW_EXACT_COUNT / 2], unsure_.size()), queue,
        "the candidates left to the host");
    const HostTriangles here(input, queue);
    std::erase_if(unsure, [&](Pair pair) {
        return !triangles_meet(here.points, here.faces, pair, options_.keep_adjacent);
    });

    append_found(unsure, counts[CONTACTS_COUNT / 2], device_contacts(), queue);
}

bool NarrowPhase::complete(const Queue& queue)
{
    std::vector<std::uint64_t> counts = wide_counts(counters_, queue);
    const std::uint64_t contacts = counts[CONTACTS_COUNT / 2],
                        unsure = counts[NARROW_EXACT_COUNT / 2];
    const Device& device = programs_.device();
    const bool contacts_fit =
        had_room(contact_room_, contacts, contacts / 8, sizeof(Pair), device, "contacts");
    const bool unsure_fit =
        had_room(unsure_room_, unsure, unsure / 8, sizeof(Pair), device, "unsure candidates");
    if (!contacts_fit || !unsure_fit)
        take_all();
    const bool is_complete = contacts_fit && unsure_fit && (unsure == 0 || launched_rest_);
    decided_in_row_ = unsure == 0 ? decided_in_row_ + 1 : 0;
    if (is_complete)
        counts_ = std::move(counts);
    return is_complete;
}

NarrowCounts NarrowPhase::counts(const Queue& queue) const
{
    const std::vector<std::uint64_t> counts =
        counts_.empty() ? wide_counts(counters_, queue) : counts_;
    return {counts[CONTACTS_COUNT / 2], counts[NARROW_FLOAT_COUNT / 2],
            counts[NARROW_DOUBLE_COUNT / 2], counts[NARROW_EXACT_COUNT / 2]};
}

std::vector<Pair> NarrowPhase::contacts(const Queue& queue) const
{
    return first_entries(contacts_, counts(queue).contacts, queue, "the contacts found");
}

std::vector<float> NarrowPhase::impact_times(const Queue& queue) const
{
    assert(is_swept());
    return first_entries(times_, counts(queue).contacts, queue, "the times of impact");
}

void find_contacts(NarrowPhase& narrow, const Input& input, const Buffer<Pair>& candidates,
                   const Buffer<uint>& candidate_counters, Queue& queue)
{
    do
        narrow.query(input, candidates, candidate_counters, queue);
    while (!narrow.complete(queue));
}

std::int64_t corner_bytes(std::span<const Pair> pairs, const Input& input)
{
    std::vector<bool> faces(input.faces.size()), points(input.points.size());
    for (const Pair pair : pairs)
        for (const uint triangle : {pair.a, pair.b}) {
            if (faces[triangle])
                continue;
            faces[triangle] = true;
            const Face face = input.faces[triangle];
            points[face.a] = points[face.b] = points[face.c] = true;
        }
    const std::int64_t frames = input.is_swept() ? 2 : 1;
    const std::int64_t point = input.is_wide() ? sizeof(WidePoint) : sizeof(Point);
    return std::count(faces.begin(), faces.end(), true) * std::int64_t{sizeof(Face)} +
           std::count(points.begin(), points.end(), true) * frames * point;
}

}  // namespace bvhbench
