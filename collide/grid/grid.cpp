// SPDX-License-Identifier: MIT
//
// Spatial hashing, rebuilt every frame: grid_table.cl makes the table and grid_walk.clh finds the pairs. Where other
// implementations sort (cell, triangle) entries by digits, this one counts entries per bucket, scans and fills: one pass instead
// of four, and no sort over an upper bound of entries, whose number only the device knows.
#include <algorithm>
#include <bit>
#include <cassert>

#include "builders/device_tree.h"
#include "builders/stages/bounds.h"
#include "builders/stages/scan.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/device_lists.h"
#include "collide/grid/hash_grid.h"
#include "collide/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint sum_group = 256;    // work-group size of the kernels that compute the mean side
constexpr uint sums_per_unit = 2;  // their work-groups per compute unit

// Side of a cell of the finest level, as a multiple of the mean longest side of boxes. Of 1, 1.5, 2 and 3, the value 2 gives the
// fewest box tests where objects differ in detail; on closed surfaces 1.5 gives a tenth to a fifth fewer, but more entries.
constexpr float cell_sides = 2.0f;

constexpr uint block_pairs = 512;        // pairs that a work-item of the chunk form buffers
constexpr std::size_t entries_each = 4;  // initial capacity: entries per triangle

class HashedGrid final : public DeviceCollider {
public:
    HashedGrid(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs,
                         {"grid", "Hierarchical hashed grid, after [Fan2011] and [Tang2018]"},
                         options, grid_group_size, Wants::no_tree)
        , bounds_(programs, options.form)
        , scan_(programs, options.form)
        , table_group_(std::min<std::size_t>(sum_group,
                                             device().cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()))
    {}

private:
    void compile(const Input& input) override;
    void plan(Arena& arena) override;
    void fill(const cl::CommandQueue& queue) override { bounds_.prepare(queue); }
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& queues) override
    {
        return had_room(entry_room_, queues[0], queues[0] / 8, sizeof(GridEntry), device(),
                        "entries of cells");
    }
    std::int64_t reads_at_least() const override  // at least one entry per triangle
    {
        return has_pairs_ ? std::int64_t{triangles_} * std::int64_t{sizeof(GridEntry)} : 0;
    }
    void enqueue_before(const Input& input, Queue& queue) override;
    void enqueue(const Input& input, Queue& queue) override;
    void enqueue_cells(Queue& queue);
    void enqueue_entries(Queue& queue);

    /// Right shift that turns a 32-bit hash into a bucket number.
    uint bucket_shift() const
    {
        return static_cast<uint>(std::countl_zero(static_cast<uint>(ends_.size()))) + 1;
    }

    /// Launches one work-item per triangle, in both kernel forms, since these kernels scatter.
    void launch_each(const cl::Kernel& kernel, std::size_t bytes, Queue& queue) const
    {
        launch(kernel, triangles_, table_group_, queue, static_cast<std::int64_t>(bytes));
    }

    BoundsStage bounds_;
    ScanStage scan_;
    std::size_t table_group_;
    cl::Kernel add_sides_, choose_cells_, count_cells_, enter_cells_, cell_pairs_, level_pairs_;
    bool has_pairs_ = false;  ///< a single object has no pairs between objects
    std::size_t entry_room_ = 0;
    Buffer<float> sides_;  ///< partial sums of half sides
    Buffer<HashGrid> grid_;
    Buffer<uint> ends_;          ///< ends of the buckets
    Buffer<GridEntry> entries_;  ///< entries, ordered by bucket
    Buffer<Pair> blocks_;
};

void HashedGrid::compile(const Input& input)
{
    const auto table = [&](const char* name) {
        return programs().kernel(
            "collide/grid/grid_table.cl", name,
            {{"GROUP_SIZE", by_groups() ? sum_group : 1}, {"STRIDED", by_groups() ? 1u : 0u}});
    };
    add_sides_ = table("add_sides");
    choose_cells_ = table("choose_cells");
    count_cells_ = table("count_cells");
    enter_cells_ = table("enter_cells");
    const bool one_object = input.objects.size() == 1;  // all pairs are within it
    has_pairs_ = !one_object || within();
    const uint among = one_object ? 0 : static_cast<uint>(options_.among);
    const auto pairs = [&](const char* name) {
        return programs().kernel(
            by_groups() ? "collide/grid/grid_groups.cl" : "collide/grid/grid_chunks.cl", name,
            {{"AMONG", among},
             {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
             by_groups() ? Define{"GROUP_SIZE", group_size_} : Define{"SINK_BLOCK", block_pairs}});
    };
    cell_pairs_ = pairs("cell_pairs");
    level_pairs_ = pairs("level_pairs");
    queue_count_ = 1;
    entry_room_ = first_room(entries_each * std::size_t{triangles_}, sizeof(GridEntry));
}

void HashedGrid::plan(Arena& arena)
{
    const std::size_t units = device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    bounds_.plan(arena, triangles_, Use::scratch);
    sides_ =
        arena.take<float>(by_groups() ? sums_per_unit * units * sum_group : chunks_, Use::scratch);
    grid_ = arena.take<HashGrid>(1, Use::scratch);
    ends_ = arena.take<uint>(std::bit_ceil(std::max<std::size_t>(16, triangles_)), Use::scratch);
    scan_.plan(arena, ends_.size());
    entries_ = arena.take<GridEntry>(entry_room_, Use::scratch);
    if (!by_groups())
        blocks_ = arena.take<Pair>(block_pairs * chunks_, Use::scratch);
}

void HashedGrid::enqueue_before(const Input& input, Queue& queue)
{
    if (!has_pairs_)
        return;
    bounds_.enqueue(input, queue);
    enqueue_cells(queue);
    enqueue_entries(queue);
}

void HashedGrid::enqueue_cells(Queue& queue)
{
    const std::size_t group = by_groups() ? sum_group : 1;
    queue.begin("codes");
    set_arguments(add_sides_, bounds_.boxes(), sides_, triangles_);
    queue.launch(add_sides_, sides_.size(), group,
                 static_cast<std::int64_t>(bounds_.boxes().bytes() + sides_.bytes()));
    set_arguments(choose_cells_, sides_, bounds_.bounds(), grid_, static_cast<uint>(sides_.size()),
                  triangles_, cell_sides);
    queue.launch(choose_cells_, group, group, static_cast<std::int64_t>(sides_.bytes()));
    queue.clear(ends_.cl(), ends_.bytes());
    set_arguments(count_cells_, bounds_.boxes(), grid_, ends_, triangles_, bucket_shift());
    launch_each(count_cells_, bounds_.boxes().bytes() + ends_.bytes(), queue);
}

void HashedGrid::enqueue_entries(Queue& queue)
{
    queue.begin("sort");
    scan_.enqueue(ends_, queue);
    set_arguments(enter_cells_, bounds_.boxes(), grid_, ends_, entries_,
                  static_cast<uint>(entry_room_), triangles_, bucket_shift());
    launch_each(enter_cells_, bounds_.boxes().bytes() + ends_.bytes(), queue);
}

void HashedGrid::enqueue(const Input& input, Queue& queue)
{
    if (!has_pairs_)
        return;
    for (cl::Kernel* kernel : {&cell_pairs_, &level_pairs_}) {
        cl_uint next = set_arguments_from(*kernel, 0, bounds_.boxes(), grid_, ends_, entries_,
                                          static_cast<uint>(entry_room_), bucket_shift(),
                                          input.device_faces, input.device_owners, pairs_,
                                          static_cast<uint>(pairs_.size()), counters_);
        if (!by_groups())
            next = set_arguments_from(*kernel, next, blocks_);
        if (kernel == &level_pairs_)
            set_arguments_from(*kernel, next, triangles_);
        const std::size_t most = kernel == &cell_pairs_ ? entry_room_ : triangles_;
        launch(*kernel, by_groups() ? most : chunks_, by_groups() ? group_size_ : 1, queue);
    }
}

}  // namespace

std::unique_ptr<Collider> make_grid(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<HashedGrid>(programs, options);
}

}  // namespace bvhbench
