// SPDX-License-Identifier: MIT
#include "collide/narrow/narrow.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <string>

#include "collide/narrow/exact_adjacent.h"
#include "collide/narrow/narrow_counters.h"
#include "collide/narrow/sharing.h"
#include "collide/parameters.h"
#include "geometry/bits.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

bool has_doubles(const Device& device)
{
    return device.cl.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() != 0;
}

std::uint64_t count_in(const std::vector<uint>& words, uint at)
{
    return words[at] | std::uint64_t{words[at + 1]} << 32;
}

/// Room for `wanted` and some more; throws Unavailable for what 32 bits cannot count.
std::size_t grown_to(std::uint64_t wanted)
{
    constexpr std::uint64_t most = std::numeric_limits<uint>::max();
    if (wanted > most)
        throw Unavailable(std::to_string(wanted) + " contacts or more: a query holds at most " +
                          std::to_string(most));
    return static_cast<std::size_t>(std::min(most, wanted + wanted / 8));
}

Corners corners_of(std::span<const Point> points, Face face)
{
    return {{points[face.a], points[face.b], points[face.c]}};
}

bool meet(const Input& input, Pair pair, bool keep_adjacent)
{
    Shared shared = {0, input.faces[pair.a], input.faces[pair.b]};
    if (keep_adjacent)
        shared = sharing(shared.a, shared.b);
    return corners_meet(corners_of(input.points, shared.a), corners_of(input.points, shared.b),
                        shared.count);
}

}  // namespace

NarrowPhase::NarrowPhase(Programs& programs, const NarrowOptions& options)
    : programs_(programs)
    , options_(options)
    , form_(chosen_form(programs.device(), options.form))
    , has_doubles_(has_doubles(programs.device()) && !options.without_doubles)
    , is_exact_(find_narrow_method(options.method).is_exact)
    , chunks_(chunk_count(programs.device()))
{
    const Device& device = programs.device();
    if (by_groups())
        group_size_ = device.tuned(narrow_group_size);
    else
        block_pairs_ = device.tuned(narrow_block_pairs);
    check_narrow(options.method, options.keep_adjacent);
    const NarrowMethod& method = find_narrow_method(options.method);
    options_.method = method.name;  // words that stay
    if (method.real_bits == 64 && !has_doubles_)
        throw Unavailable(std::string(method.name) + " needs doubles, which the device has not");
    filter_ = compiled_filter(method);
    if (is_exact_ && has_doubles_)
        exact_ = programs.kernel("collide/narrow/narrow_exact.cl", "decide_exactly",
                                 {{"KEEP_ADJACENT", options.keep_adjacent ? 1u : 0u}});
}

cl::Kernel NarrowPhase::compiled_filter(const NarrowMethod& method)
{
    std::vector<Define> defines = {by_groups() ? Define{"GROUP_SIZE", group_size_}
                                               : Define{"SINK_BLOCK", block_pairs_}};
    if (method.is_exact)
        defines.insert(defines.end(), {{"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                       {"WITH_DOUBLES", has_doubles_ ? 1u : 0u}});
    else
        defines.insert(defines.end(),
                       {{"ROUNDED_TEST", method.rounded_test}, {"REAL_BITS", method.real_bits}});
    const char* const verdict =
        method.is_exact ? "collide/narrow/verdict.clh" : "collide/narrow/rounded_verdict.clh";
    const char* const chunks =
        method.is_exact ? "collide/narrow/narrow_chunks.cl" : "collide/narrow/rounded_chunks.cl";
    return programs_.kernel(verdict, by_groups() ? "collide/narrow/narrow_groups.cl" : chunks,
                            "filter_pairs", defines);
}

void NarrowPhase::reserve(std::size_t triangles)
{
    const std::size_t guess = std::max<std::size_t>(1024, triangles);
    room_.contacts = options_.capacity != 0 ? options_.capacity : guess;
    room_.unsure = !is_exact_ ? 1 : options_.capacity != 0 ? options_.capacity : guess;
    take_memory();
}

void NarrowPhase::take_all(Arena& arena)
{
    counters_ = arena.take<uint>(NARROW_COUNTERS, Use::scratch);
    unsure_ = arena.take<Pair>(room_.unsure, Use::scratch);
    blocks_ = arena.take<Pair>(by_groups() ? 1 : 2 * block_pairs_ * chunks_, Use::scratch);
    contacts_ = arena.take<Pair>(room_.contacts, Use::scratch);
}

void NarrowPhase::take_memory()
{
    Arena measuring = Arena::measuring(programs_.device());
    take_all(measuring);
    arena_.reset();  // the old memory goes before the new comes
    arena_ = Arena::reserved(programs_.device(), measuring.used());
    take_all(*arena_);
}

/// No more than make every compute unit's lanes full. The kernels' turns see to the rest.
std::size_t NarrowPhase::group_count(std::size_t candidates) const
{
    const Device& device = programs_.device();
    const std::size_t most = device.tuned(narrow_groups_per_unit) *
                             std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
    return std::clamp<std::size_t>(divided_up(static_cast<uint>(candidates), group_size_), 1, most);
}

void NarrowPhase::query(const Input& input, const Buffer<Pair>& candidates,
                        const Buffer<uint>& candidate_counters, Queue& queue)
{
    assert(arena_ && "reserve first");
    const std::size_t items = by_groups() ? group_count(candidates.size()) * group_size_ : chunks_;
    const auto contact_room = static_cast<uint>(contacts_.size());
    const auto unsure_room = static_cast<uint>(unsure_.size());

    queue.begin("narrow");
    queue.clear(counters_.cl(), counters_.bytes());
    set_arguments(filter_, input.device_points, input.device_faces, candidates, candidate_counters,
                  static_cast<uint>(candidates.size()), contacts_, contact_room, unsure_,
                  unsure_room, counters_);
    if (!by_groups())
        filter_.setArg(10, blocks_.cl());
    queue.launch(filter_, items, by_groups() ? group_size_ : 1, 0);
    if (!is_exact_)
        return;
    if (!has_doubles_) {
        decide_on_host(input, queue);
        return;
    }
    set_arguments(exact_, input.device_points, input.device_faces, unsure_, unsure_room, contacts_,
                  contact_room, counters_);
    queue.launch(exact_, items, by_groups() ? group_size_ : 1, 0);
}

void NarrowPhase::decide_on_host(const Input& input, Queue& queue)
{
    std::vector<uint> words = counters_.download(queue.cl());
    const std::uint64_t found = count_in(words, CONTACTS_COUNT);
    std::vector<Pair> unsure(
        std::min<std::uint64_t>(count_in(words, NARROW_EXACT_COUNT), unsure_.size()));
    if (!unsure.empty())
        queue.cl().enqueueReadBuffer(unsure_.cl(), CL_TRUE, 0, unsure.size() * sizeof(Pair),
                                     unsure.data());
    std::erase_if(unsure, [&](Pair pair) { return !meet(input, pair, options_.keep_adjacent); });

    const std::size_t room = contacts_.size() - std::min<std::uint64_t>(found, contacts_.size());
    const std::size_t written = std::min(room, unsure.size());
    if (written > 0)
        queue.cl().enqueueWriteBuffer(contacts_.cl(), CL_TRUE, found * sizeof(Pair),
                                      written * sizeof(Pair), unsure.data());
    const std::uint64_t total = found + unsure.size();
    words[CONTACTS_COUNT] = static_cast<uint>(total);
    words[CONTACTS_COUNT + 1] = static_cast<uint>(total >> 32);
    queue.cl().enqueueWriteBuffer(counters_.cl(), CL_TRUE, 0, counters_.bytes(), words.data());
}

bool NarrowPhase::complete(const Queue& queue)
{
    const std::vector<uint> words = counters_.download(queue.cl());
    const std::uint64_t contacts = count_in(words, CONTACTS_COUNT);
    const std::uint64_t unsure = count_in(words, NARROW_EXACT_COUNT);
    if (contacts <= room_.contacts && unsure <= room_.unsure)
        return true;
    if (contacts > room_.contacts)
        room_.contacts = grown_to(contacts);
    if (unsure > room_.unsure)
        room_.unsure = grown_to(unsure);
    take_memory();
    return false;
}

NarrowCounts NarrowPhase::counts(const Queue& queue) const
{
    const std::vector<uint> words = counters_.download(queue.cl());
    return {count_in(words, CONTACTS_COUNT), count_in(words, NARROW_FLOAT_COUNT),
            count_in(words, NARROW_DOUBLE_COUNT), count_in(words, NARROW_EXACT_COUNT)};
}

std::vector<Pair> NarrowPhase::contacts(const Queue& queue) const
{
    const auto count = static_cast<std::size_t>(counts(queue).contacts);
    require_host_memory("the contacts found, " + std::to_string(count) + " of them,",
                        count * sizeof(Pair));
    std::vector<Pair> found(count);
    assert(found.size() <= contacts_.size());
    if (!found.empty())
        queue.cl().enqueueReadBuffer(contacts_.cl(), CL_TRUE, 0, found.size() * sizeof(Pair),
                                     found.data());
    return found;
}

int find_contacts(NarrowPhase& narrow, const Input& input, const Buffer<Pair>& candidates,
                  const Buffer<uint>& candidate_counters, Queue& queue)
{
    int queries = 0;
    do {
        narrow.query(input, candidates, candidate_counters, queue);
        ++queries;
    } while (!narrow.complete(queue));
    return queries;
}

}  // namespace bvhbench
