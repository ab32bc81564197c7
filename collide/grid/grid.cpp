// SPDX-License-Identifier: MIT
//
// Spatial hashing, each frame anew: the table of collide/grid/grid_table.cl, then collide/grid/grid_walk.clh along it. Where
// others sort (cell, triangle) entries by digits, buckets are counted, scanned and filled: one pass in place of four,
// and no sort of as many entries as there might be, since only the device knows how many there are.
#include <algorithm>
#include <bit>
#include <cassert>

#include "builders/device_tree.h"
#include "builders/stages/bounds.h"
#include "builders/stages/scan.h"
#include "collide/colliders.h"
#include "collide/grid/hash_grid.h"
#include "collide/pair_collider.h"
#include "collide/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint sum_group = 256;    // of the kernels that find the mean side
constexpr uint sums_per_unit = 2;  // groups of those, a compute unit

// How long a cell of the finest level is, in mean longest sides of boxes. Of 1, 1.5, 2 and 3, two has the fewest box
// tests where objects differ in detail; on closed surfaces 1.5 has a tenth to a fifth fewer, and more entries.
constexpr float cell_sides = 2.0f;

constexpr std::size_t entries_each = 4;  // a triangle, that there is room for at first

/// As collide/grid/grid_entry.clh reads it. 32 bytes.
struct Entry {
    Aabb box;
    uint number, triangle;
};

class HashedGrid final : public PairCollider {
public:
    HashedGrid(Programs& programs, const ColliderOptions& options)
        : PairCollider(programs,
                       {"grid", "Hierarchical hashed grid, after [Fan2011] and [Tang2018]"},
                       options, grid_group_size)
        , bounds_(programs, options.form)
        , scan_(programs, options.form)
        , table_group_(std::min<std::size_t>(sum_group,
                                             device().cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()))
    {}

    bool needs_tree() const override { return false; }
    std::string refusal(const Tree&) const override { return {}; }
    void reserve(const Tree*, const Input& input) override;
    void query(const Tree*, const Input& input, Queue& queue) override;

private:
    void compile(const Input& input);
    void plan_rest(Arena& arena) override;
    void write_down(const cl::CommandQueue& queue) override { bounds_.prepare(queue); }
    uint wide_counters() const override { return 1; }
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& queue_sizes) override;
    bool has_pairs(const Input& input) const;
    /// That a work-item of the form for few cores collects before it passes them on.
    uint block_pairs() const { return device().tuned(grid_block_pairs); }
    void enqueue_cells(Queue& queue);
    void enqueue_entries(Queue& queue);
    void enqueue_pairs(const Input& input, Queue& queue);
    uint bucket_shift() const;
    void launch_each(cl::Kernel& kernel, std::size_t bytes, Queue& queue);

    BoundsStage bounds_;
    ScanStage scan_;
    std::size_t table_group_;
    cl::Kernel add_sides_, choose_cells_, count_cells_, enter_cells_, cell_pairs_, level_pairs_;
    uint triangles_ = 0;
    std::size_t entry_room_ = 0;
    Buffer<float> sides_;  ///< partial sums
    Buffer<HashGrid> grid_;
    Buffer<uint> ends_;      ///< of the buckets
    Buffer<Entry> entries_;  ///< bucket after bucket
    Buffer<Pair> blocks_;
};

/// With one object there are no others, and all pairs are within it.
bool HashedGrid::has_pairs(const Input& input) const
{
    return triangles_ > 1 && (options_.among != Among::between_objects || input.objects.size() > 1);
}

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
    const uint among = input.objects.size() == 1                  ? 0
                       : options_.among == Among::between_objects ? 1
                       : options_.among == Among::within_objects  ? 2
                                                                  : 0;
    const auto pairs = [&](const char* name) {
        return programs().kernel(
            by_groups() ? "collide/grid/grid_groups.cl" : "collide/grid/grid_chunks.cl", name,
            {{"AMONG", among},
             {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
             by_groups() ? Define{"GROUP_SIZE", group_size_}
                         : Define{"SINK_BLOCK", block_pairs()}});
    };
    cell_pairs_ = pairs("cell_pairs");
    level_pairs_ = pairs("level_pairs");
}

void HashedGrid::reserve(const Tree*, const Input& input)
{
    triangles_ = input.triangle_count();
    compile(input);
    entry_room_ = options_.capacity != 0
                      ? options_.capacity
                      : device().room_for(std::uint64_t{entries_each} * triangles_, sizeof(Entry));
    take_memory_for(triangles_);
}

void HashedGrid::plan_rest(Arena& arena)
{
    const std::size_t units = device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    bounds_.plan(arena, triangles_, Use::scratch);
    sides_ =
        arena.take<float>(by_groups() ? sums_per_unit * units * sum_group : chunks_, Use::scratch);
    grid_ = arena.take<HashGrid>(1, Use::scratch);
    ends_ = arena.take<uint>(std::bit_ceil(std::max<std::size_t>(
                                 16, std::size_t{device().tuned(grid_buckets_each)} * triangles_)),
                             Use::scratch);
    scan_.plan(arena, ends_.size());
    entries_ = arena.take<Entry>(entry_room_, Use::scratch);
    if (!by_groups())
        blocks_ = arena.take<Pair>(block_pairs() * chunks_, Use::scratch);
}

bool HashedGrid::make_room(std::uint64_t, const std::vector<std::uint64_t>& queue_sizes)
{
    if (queue_sizes[0] <= entry_room_)
        return true;
    entry_room_ =
        device().room_for(queue_sizes[0] + queue_sizes[0] / 8, sizeof(Entry), queue_sizes[0]);
    return false;
}

/// What leaves of a hashed word the number of a bucket.
uint HashedGrid::bucket_shift() const
{
    return static_cast<uint>(std::countl_zero(static_cast<uint>(ends_.size()))) + 1;
}

/// A work-item a triangle, in either form: what these kernels do is scatter.
void HashedGrid::launch_each(cl::Kernel& kernel, std::size_t bytes, Queue& queue)
{
    queue.launch(kernel, divided_up(triangles_, static_cast<uint>(table_group_)) * table_group_,
                 table_group_, static_cast<std::int64_t>(bytes));
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

void HashedGrid::enqueue_pairs(const Input& input, Queue& queue)
{
    const auto bind = [&](cl::Kernel& kernel) {
        cl_uint next = set_arguments_from(kernel, 0, bounds_.boxes(), grid_, ends_, entries_,
                                          static_cast<uint>(entry_room_), bucket_shift(),
                                          input.device_faces, input.device_owners, pairs_,
                                          static_cast<uint>(pairs_.size()), counters_);
        if (!by_groups())
            next = set_arguments_from(kernel, next, blocks_);
        return next;
    };
    const auto launch = [&](const cl::Kernel& kernel, std::size_t most) {
        if (by_groups())
            queue.launch(
                kernel, divided_up(static_cast<uint>(most), group_size_) * std::size_t{group_size_},
                group_size_, 0);
        else
            queue.launch(kernel, chunks_, 1, 0);
    };
    bind(cell_pairs_);
    launch(cell_pairs_, entry_room_);
    set_arguments_from(level_pairs_, bind(level_pairs_), triangles_);
    launch(level_pairs_, triangles_);
}

void HashedGrid::query(const Tree*, const Input& input, Queue& queue)
{
    assert(input.triangle_count() == triangles_);
    if (has_pairs(input)) {
        bounds_.enqueue(input, queue);
        enqueue_cells(queue);
        enqueue_entries(queue);
    }
    queue.begin("broad");
    queue.clear(counters_.cl(), counters_.bytes());
    if (!has_pairs(input))
        return;
    queue.declare(std::int64_t{triangles_} *
                  std::int64_t{sizeof(Entry)});  // one a triangle, or more
    enqueue_pairs(input, queue);
}

}  // namespace

std::unique_ptr<Collider> make_grid(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<HashedGrid>(programs, options);
}

}  // namespace bvhbench
