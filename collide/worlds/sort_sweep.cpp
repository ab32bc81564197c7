// SPDX-License-Identifier: MIT
//
// Sort and sweep over many objects at once. Boxes are sorted by object, and within it by where they begin along its axis; a sweep from each
// box on meets those that begin before it ends.
//
// The axis is that along which the object's centres are farthest apart, as the frame has it: the stage `bounds` knows it at no cost. A code
// has as few bits as tell boxes apart, so that the sort makes fewer passes: 16 cells a box of the largest object, rounded up to whole
// passes. Boxes that begin in one cell are tested against each other.
#include <algorithm>
#include <optional>

#include "builders/stages/bounds.h"
#include "builders/stages/codes.h"
#include "builders/stages/sort/sort.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/parameters.h"
#include "collide/worlds/object_starts.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint row_padding = 8;          // boxes that the chunk form may read behind the last
constexpr uint sweep_block_pairs = 512;  // pairs that a work-item of the chunk form buffers
constexpr std::size_t each_group = 256;  // work-group size of the kernels before and after the sort
constexpr uint pass_bits = 8;            // of a pass of the sort
constexpr uint bits_of_cells = 4;        // more than what numbers the boxes of the largest object
constexpr uint most_position_bits = 24;  // that a float tells apart

/// Returns the bits of a box's place along the axis.
uint position_bits(const std::vector<FaceRange>& objects)
{
    uint most = 1;
    for (const FaceRange& object : objects)
        most = std::max(most, object.count);
    const uint object_bits = ceil_log2(static_cast<uint>(objects.size()));
    const uint least = ceil_log2(most), wanted = least + bits_of_cells;
    uint bits = divided_up(object_bits + wanted, pass_bits) * pass_bits;
    if (bits > 32 && object_bits + least <= 32)
        bits = 32;  // one word
    return std::clamp(bits - object_bits, 1u, most_position_bits);
}

/// Returns how many work-items share the sweep from a box on, in objects of `each` boxes. On an H200 8,192 objects of 60 take 189 µs with 2
/// and 325 with 32; 64 of 5,290 take 1,403 and 381.
uint lanes_for(std::size_t each) { return each < 512 ? 2 : 32; }

class SortSweep final : public DeviceCollider {
public:
    SortSweep(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs, {"sort-sweep", "Sort and sweep, after [Liu2010]"}, options,
                         sort_sweep_group_size, Wants::no_tree)
        , bounds_(programs, options.form)
        , each_group_(std::min<std::size_t>(each_group,
                                            device().cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>()))
    {}

private:
    void compile(const Input& input) override;
    void plan(Arena& arena) override;
    void fill(const cl::CommandQueue& queue) override;
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>&) override { return true; }
    std::int64_t reads_at_least() const override  // each box and its codes once
    {
        return has_pairs_ ? static_cast<std::int64_t>(sides_.bytes() + 2 * ends_.bytes()) : 0;
    }
    void enqueue_before(const Input& input, Queue& queue) override;
    void enqueue(const Input& input, Queue& queue) override;
    uint row_length() const { return triangles_ + row_padding; }

    uint lanes_ = 1;
    BoundsStage bounds_;
    std::size_t each_group_;
    std::optional<RadixSort> sort_;
    cl::Kernel codes_kernel_, place_kernel_, sweep_kernel_;
    bool has_pairs_ = false;  ///< a single object has no pairs between objects
    std::vector<uint> sizes_, starts_;
    uint words_ = 1;  ///< of a code
    Buffer<float> sides_;
    Buffer<uint> ends_, device_starts_;
    Buffer<Pair> blocks_;
};

void SortSweep::compile(const Input& input)
{
    const bool one_object = input.objects.size() == 1;
    has_pairs_ = !one_object || within();
    const uint among = one_object ? 0 : static_cast<uint>(options_.among);
    const std::vector<FaceRange> objects = tested_objects(input, among);
    starts_ = object_starts(objects);
    sizes_.clear();
    for (const FaceRange& object : objects)
        sizes_.push_back(object.count);
    lanes_ = lanes_for(triangles_ / objects.size());
    const uint position = position_bits(objects);
    const uint code_bits = position + ceil_log2(static_cast<uint>(objects.size()));
    words_ = code_words(code_bits);
    sort_.emplace(programs(), code_bits, sort_shape(device(), options_.form));
    const auto of_codes = [&](const char* name) {
        return programs().kernel("collide/worlds/sweep_codes.cl", name,
                                 {{"POSITION_BITS", position},
                                  {"CODE_WORDS", words_},
                                  {"SEVERAL_OBJECTS", objects.size() > 1 ? 1u : 0u}});
    };
    codes_kernel_ = of_codes("begin_codes");
    place_kernel_ = of_codes("place_boxes");
    std::vector<Define> defines = {{"AMONG", among},
                                   {"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u},
                                   {"CODE_WORDS", words_}};
    if (by_groups())
        defines.insert(defines.end(), {{"GROUP_SIZE", group_size_}, {"SWEEP_LANES", lanes_}});
    else
        defines.push_back({"SINK_BLOCK", sweep_block_pairs});
    sweep_kernel_ = programs().kernel(
        by_groups() ? "collide/worlds/sweep_groups.cl" : "collide/worlds/sweep_chunks.cl",
        "sweep_pairs", defines);
}

void SortSweep::plan(Arena& arena)
{
    bounds_.plan(arena, sizes_, Use::scratch);
    sort_->plan(arena, triangles_);
    sides_ = arena.take<float>(6 * std::size_t{row_length()}, Use::scratch);
    ends_ = arena.take<uint>(std::size_t{words_} * triangles_, Use::scratch);
    device_starts_ = arena.take<uint>(starts_.size(), Use::scratch);
    blocks_ = arena.take<Pair>(by_groups() ? 0 : sweep_block_pairs * chunks_, Use::scratch);
}

void SortSweep::fill(const cl::CommandQueue& queue)
{
    bounds_.prepare(queue);
    sort_->prepare(queue);
    device_starts_.upload(queue, starts_);
}

void SortSweep::enqueue_before(const Input& input, Queue& queue)
{
    if (!has_pairs_)
        return;
    const std::size_t box_bytes = bounds_.boxes().bytes();
    bounds_.enqueue(input, queue);
    queue.begin("codes");
    set_arguments(codes_kernel_, bounds_.boxes(), bounds_.bounds(), input.device_owners,
                  sort_->unsorted_codes(), triangles_);
    launch(codes_kernel_, triangles_, each_group_, queue,
           static_cast<std::int64_t>(box_bytes + ends_.bytes()));
    sort_->enqueue(queue);
    set_arguments(place_kernel_, bounds_.boxes(), bounds_.bounds(), input.device_owners,
                  sort_->ids(), sides_, ends_, triangles_, row_length());
    launch(place_kernel_, triangles_, each_group_, queue,
           static_cast<std::int64_t>(2 * box_bytes + ends_.bytes() + sort_->ids().bytes()));
}

void SortSweep::enqueue(const Input& input, Queue& queue)
{
    if (!has_pairs_)
        return;
    const cl_uint next =
        set_arguments_from(sweep_kernel_, 0, sort_->codes(), ends_, sort_->ids(), sides_,
                           row_length(), triangles_, device_starts_, input.device_owners,
                           input.device_faces, pairs_, static_cast<uint>(pairs_.size()), counters_);
    if (by_groups()) {
        launch(sweep_kernel_, std::size_t{triangles_} * lanes_, group_size_, queue);
        return;
    }
    set_arguments_from(sweep_kernel_, next, blocks_);
    launch(sweep_kernel_, chunks_, 1, queue);
}

}  // namespace

std::unique_ptr<Collider> make_sort_sweep(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<SortSweep>(programs, options);
}

}  // namespace bvhbench
