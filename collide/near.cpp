// SPDX-License-Identifier: MIT
#include "collide/near.h"

#include <algorithm>
#include <cassert>

#include "collide/counters.h"
#include "collide/device_lists.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "collide/near.cl";
constexpr uint usual_group_size = 64;

/// Work-groups per compute unit that map pairs back, at most.
constexpr std::size_t map_groups_a_unit = 64;

}  // namespace

NearTriangles::NearTriangles(Programs& programs, const NearOptions& options)
    : programs_(programs)
    , options_(options)
    , form_(chosen_form(programs.device(), options.form))
    , chunks_(chunk_count(programs.device()))
    , bounds_(programs, form_)
    , scan_places_(programs, form_)
    , scan_ranks_(programs, form_)
{
    const auto kernel = [&](const char* name) {
        return programs.kernel(path, name,
                               {{"GROUP_SIZE", form_ == KernelForm::groups ? usual_group_size : 1u},
                                {"LISTED", options_.listed}});
    };
    list_ = kernel("list_touching");
    flag_ = kernel("flag_near");
    count_ = kernel("count_near");
    compact_ = kernel("compact_near");
    map_ = kernel("map_pairs");
}

void NearTriangles::plan(Arena& arena, const Input& input)
{
    const std::size_t triangles = input.triangle_count(), objects = input.objects.size();
    const std::size_t most = std::max<std::size_t>(1, most_of(triangles));
    bounds_.plan(arena, object_sizes(input), Use::scratch);
    lists_ = arena.take<uint>(objects * options_.listed, Use::scratch);
    list_sizes_ = arena.take<uint>(objects, Use::scratch);
    places_ = arena.take<uint>(triangles + 1, Use::scratch);
    scan_places_.plan(arena, places_.size());
    first_faces_ = arena.take<uint>(objects + 1, Use::scratch);
    counts_ = arena.take<uint>(objects, Use::scratch);
    ranks_ = arena.take<uint>(objects, Use::scratch);
    scan_ranks_.plan(arena, objects);
    test_count_ = arena.take<uint>(2, Use::scratch);
    faces_ = arena.take<Face>(most, Use::scratch);
    owners_ = arena.take<uint>(most, Use::scratch);
    ids_ = arena.take<uint>(most, Use::scratch);
}

void NearTriangles::reserve(const Input& input)
{
    assert(input.objects.size() > 1);
    take_memory(arena_, programs_.device(), [&](Arena& arena) { plan(arena, input); });
    std::vector<uint> first_faces;
    for (const FaceRange& object : input.objects)
        first_faces.push_back(object.first);
    first_faces.push_back(input.triangle_count());
    const cl::CommandQueue queue(programs_.device().context, programs_.device().cl);
    bounds_.prepare(queue);
    first_faces_.upload(queue, first_faces);
}

void NearTriangles::launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes,
                           Queue& queue)
{
    if (form_ == KernelForm::groups)
        queue.launch(kernel, (items + usual_group_size - 1) / usual_group_size * usual_group_size,
                     usual_group_size, moved_bytes);
    else
        queue.launch(kernel, chunks_, 1, moved_bytes);
}

std::vector<uint> NearTriangles::find(const Input& input, Queue& queue)
{
    assert(arena_ && input.triangle_count() + 1 == places_.size());
    const uint triangles = input.triangle_count();
    const auto objects = static_cast<uint>(input.objects.size());
    const auto bytes = [](const auto&... buffers) {
        return static_cast<std::int64_t>((buffers.bytes() + ...));
    };
    bounds_.enqueue(input, queue, "near");
    queue.clear(test_count_.cl(), test_count_.bytes());
    set_arguments(list_, bounds_.bounds(), objects, lists_, list_sizes_, test_count_);
    launch(list_, objects, bytes(bounds_.bounds(), list_sizes_), queue);
    set_arguments(flag_, bounds_.boxes(), input.device_owners, bounds_.bounds(), objects, lists_,
                  list_sizes_, places_, triangles, test_count_);
    launch(flag_, places_.size(), bytes(bounds_.boxes(), input.device_owners, places_), queue);
    scan_places_.enqueue(places_, queue);
    set_arguments(count_, places_, first_faces_, objects, counts_, ranks_);
    launch(count_, objects, bytes(first_faces_, counts_, ranks_), queue);
    scan_ranks_.enqueue(ranks_, queue);
    set_arguments(compact_, places_, input.device_faces, input.device_owners, ranks_, faces_,
                  owners_, ids_, triangles, static_cast<uint>(most_of(triangles)));
    launch(compact_, triangles, bytes(places_), queue);
    std::vector<uint> counts(objects);
    queue.read(counts_.cl(), counts_.bytes(), counts.data());
    return counts;
}

Input NearTriangles::frame(const Input& whole, const std::vector<uint>& counts,
                           std::vector<Face>& faces, const Queue& queue) const
{
    std::vector<FaceRange> objects;
    uint total = 0;
    for (const uint count : counts)
        if (count > 0) {
            objects.push_back({total, count});
            total += count;
        }
    assert(total <= most_of(whole.triangle_count()) && !whole.is_swept());
    faces.resize(total);
    if (total > 0)
        queue.cl().enqueueReadBuffer(faces_.cl(), CL_TRUE, 0, total * sizeof(Face), faces.data());
    return {whole.points,        faces,
            whole.device_points, {faces_.cl(), total},
            std::move(objects),  {owners_.cl(), total}};
}

void NearTriangles::map_back(const DevicePairs& found, Queue& queue)
{
    const std::size_t units = programs_.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    static_assert(PAIRS_COUNT == 0, "the kernel reads the first count");
    set_arguments(map_, found.pairs, found.counters, static_cast<uint>(found.pairs.size()), ids_);
    launch(map_, std::min(found.pairs.size(), units * map_groups_a_unit * usual_group_size), 0,
           queue);
}

std::uint64_t NearTriangles::box_tests(const Queue& queue) const
{
    return wide_counts(test_count_, queue).front();
}

}  // namespace bvhbench
