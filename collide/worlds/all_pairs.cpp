// SPDX-License-Identifier: MIT
//
// Each box against each of its object, tile by tile: what simulators of robot learning do for many small worlds.
#include <algorithm>

#include "builders/stages/bounds.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/parameters.h"
#include "collide/worlds/object_starts.h"
#include "collide/worlds/tile.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint lanes = 8;               // boxes of a tile of the chunk form
constexpr uint tile_block_pairs = 512;  // pairs that a work-item of the chunk form buffers
constexpr std::uint64_t few_steps = 8;  // steps of a tile, if there are not too many tiles then
constexpr std::uint64_t many_tiles = 1u << 18;

class AllPairs final : public DeviceCollider {
public:
    AllPairs(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs, {"all-pairs", "Each box against each, tile by tile"}, options,
                         all_pairs_group_size, Wants::no_tree)
        , rows_(device().tuned(all_pairs_rows))
        , bounds_(programs, options.form)
    {}

private:
    void compile(const Input& input) override;
    void plan(Arena& arena) override;
    void fill(const cl::CommandQueue& queue) override;
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>&) override { return true; }
    std::int64_t reads_at_least() const override  // each box once
    {
        return has_pairs_ ? std::int64_t{triangles_} * std::int64_t{sizeof(Aabb)} : 0;
    }
    void enqueue_before(const Input& input, Queue& queue) override
    {
        if (has_pairs_)
            bounds_.enqueue(input, queue);
    }
    void enqueue(const Input& input, Queue& queue) override;

    uint tile_size() const { return by_groups() ? rows_ * group_size_ : lanes; }
    void cut(FaceRange object);

    uint rows_;
    BoundsStage bounds_;
    cl::Kernel kernel_;
    bool has_pairs_ = false;  ///< a single object has no pairs between objects
    std::uint64_t most_steps_ = few_steps;
    std::vector<Tile> tiles_;
    std::vector<uint> starts_;
    Buffer<Tile> device_tiles_;
    Buffer<uint> device_starts_;
    Buffer<Pair> blocks_;
};

/// Adds the tiles of an object; in the group form, small objects that follow each other share a tile.
void AllPairs::cut(FaceRange object)
{
    const uint size = tile_size(), object_end = object.first + object.count;
    if (by_groups() && !tiles_.empty() && tiles_.back().end == tiles_.back().object_end &&
        object_end - tiles_.back().object_first <= size) {
        tiles_.back().end = tiles_.back().object_end = object_end;
        return;
    }
    const uint ring = divided_up(object.count, size);
    for (uint k = 0; k < ring; ++k) {
        Tile tile = {object.first + k * size,
                     object.first + std::min(object.count, (k + 1) * size),
                     object.first,
                     object_end,
                     0,
                     0};
        const std::uint64_t steps = by_groups() ? 1 + met_behind(ring, k) : 1;
        for (std::uint64_t step = 0; step < steps; step += most_steps_) {
            tile.first_step = static_cast<uint>(step);
            tile.end_step = static_cast<uint>(std::min(steps, step + most_steps_));
            tiles_.push_back(tile);
        }
    }
}

void AllPairs::compile(const Input& input)
{
    const bool one_object = input.objects.size() == 1;
    has_pairs_ = !one_object || within();
    const uint among = one_object ? 0 : static_cast<uint>(options_.among);
    kernel_ = programs().kernel(
        by_groups() ? "collide/worlds/all_pairs_groups.cl" : "collide/worlds/all_pairs_chunks.cl",
        "all_pairs",
        by_groups() ? std::vector<Define>{{"AMONG", among},
                                          {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                          {"GROUP_SIZE", group_size_},
                                          {"ROWS", rows_}}
                    : std::vector<Define>{{"AMONG", among},
                                          {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                          {"SINK_BLOCK", tile_block_pairs}});
    const std::vector<FaceRange> objects = tested_objects(input, among);
    starts_ = object_starts(objects);
    std::uint64_t steps = 0;
    for (const FaceRange& object : objects) {
        const std::uint64_t ring = divided_up(object.count, tile_size());
        steps += ring * (ring / 2 + 1);
    }
    most_steps_ = std::max(few_steps, steps / many_tiles);
    tiles_.clear();
    for (const FaceRange& object : objects)
        cut(object);
}

void AllPairs::plan(Arena& arena)
{
    bounds_.plan(arena, triangles_, Use::scratch);
    device_tiles_ = arena.take<Tile>(tiles_.size(), Use::scratch);
    device_starts_ = arena.take<uint>(starts_.size(), Use::scratch);
    blocks_ = arena.take<Pair>(by_groups() ? 0 : tile_block_pairs * chunks_, Use::scratch);
}

void AllPairs::fill(const cl::CommandQueue& queue)
{
    bounds_.prepare(queue);
    device_tiles_.upload(queue, tiles_);
    device_starts_.upload(queue, starts_);
}

void AllPairs::enqueue(const Input& input, Queue& queue)
{
    if (!has_pairs_)
        return;
    const cl_uint next = set_arguments_from(kernel_, 0, bounds_.boxes(), device_tiles_,
                                            device_starts_, input.device_owners, input.device_faces,
                                            pairs_, static_cast<uint>(pairs_.size()), counters_);
    if (by_groups()) {
        launch(kernel_, tiles_.size() * group_size_, group_size_, queue);
        return;
    }
    set_arguments_from(kernel_, next, blocks_, static_cast<uint>(tiles_.size()));
    launch(kernel_, chunks_, 1, queue);
}

}  // namespace

std::unique_ptr<Collider> make_all_pairs(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<AllPairs>(programs, options);
}

}  // namespace bvhbench
