// SPDX-License-Identifier: MIT
#include "collide/walks/collapse.h"

#include "collide/device_lists.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr std::size_t collapse_group = 128;

/// Of count_before.
constexpr uint counting_group = 256, words_per_item = 8;
constexpr uint counted_words = counting_group * words_per_item;
constexpr uint look_back_epoch_bits = 31;

/// Logarithms of how many leaves and how many children the wide nodes of an implicit tree have, with this many bits a child. On an H200,
/// other numbers of levels take up to 1.4 times as long.
uint run_bits(uint child_bits) { return BLOCK_LEVELS / child_bits * child_bits; }
uint fan_bits(uint child_bits) { return 2 * child_bits; }

/// Children of wide nodes a leaf that there is room for at first: small subtrees have some 20 leaves.
constexpr double first_children_each = 0.08;

}  // namespace

Collapse::Collapse(Programs& programs, const DeviceTree& tree, std::size_t room)
    : device_(programs.device())
    , is_implicit_(tree.is_implicit())
    , is_in_order_(tree.is_in_order())
    , is_numbered_by_range_(tree.is_numbered_by_range())
    , leaves_(tree.leaf_count())
    , objects_(static_cast<uint>(tree.objects.size()))
    , lists_(wide_class(leaves_))
    , words_(divided_up(leaves_, 32))
    , child_bytes_(tree.box_format().number == BOX_F64 ? 56 : sizeof(WideChild))
    , room_(room != 0 ? room : 64 + static_cast<std::size_t>(first_children_each * leaves_))
{
    const std::vector<Define> defines = {{"SORTED_LEAVES", tree.has_sorted_leaves() ? 1u : 0u},
                                         {"BOX_FORMAT", tree.box_format().number},
                                         {"NUMBERED_BY_RANGE", is_numbered_by_range_ ? 1u : 0u},
                                         {"GROUP_SIZE", counting_group},
                                         {"WORDS_PER_ITEM", words_per_item},
                                         {"STATE_EPOCH_BITS", look_back_epoch_bits},
                                         {"RUN_BITS", run_bits(tree.child_bits())},
                                         {"FAN_BITS", fan_bits(tree.child_bits())}};
    const auto kernel = [&](const char* name, const char* path = "collide/walks/collapse.cl") {
        return programs.kernel(tree.access_header(), path, name, defines);
    };
    if (is_implicit_) {
        list_children(tree);
        write_ = kernel("write_children", "collide/walks/collapse_implicit.cl");
        return;
    }
    if (!is_in_order_)
        for (const char* name : {"link", "mark_roots", "count", "line_up"})
            line_up_.push_back(kernel(name, "collide/walks/line_up.cl"));
    mark_ = kernel("mark");
    count_ = kernel("count_before");
    fill_ = kernel("fill");
}

void Collapse::list_children(const DeviceTree& tree)
{
    const uint run = 1u << run_bits(tree.child_bits()), fan = 1u << fan_bits(tree.child_bits());
    room_ = 0;
    for (const ForestObject& object : tree.objects) {
        begin_list_.push_back(static_cast<uint>(room_));
        cl_uint2 root = {{0, object.leaves | OF_LEAVES}};
        uint lists = 1;
        if (object.leaves > BLOCK_LEAVES) {
            for (uint count = divided_up(object.leaves, run);; count = divided_up(count, fan)) {
                root = {{static_cast<uint>(room_), count}};
                room_ += count;
                ++lists;
                if (count <= fan)
                    break;
            }
        }
        root_list_.push_back(root);
        lists_ = std::max(lists_, lists);
    }
}

void Collapse::plan(Arena& arena)
{
    children_ = arena.take<std::byte>(room_ * child_bytes_, Use::scratch);
    child_ends_ = arena.take<uint>(room_, Use::scratch);
    roots_ = arena.take<cl_uint2>(objects_, Use::scratch);
    child_count_ = arena.take<uint>(1, Use::scratch);
    if (is_implicit_) {
        begins_ = arena.take<uint>(objects_, Use::scratch);
        places_ = arena.take<uint>(1, Use::scratch);
        return;
    }
    const std::size_t words = std::size_t{lists_} * words_ + 1, inner = leaves_ - 1;
    const std::size_t lined_up = is_in_order_ ? 1 : leaves_;
    ends_ = arena.take<uint>(is_numbered_by_range_ ? inner : 2 * inner, Use::scratch);
    positions_ = arena.take<uint>(lined_up, Use::scratch);
    places_ = arena.take<uint>(lined_up, Use::scratch);
    parents_ = arena.take<uint>(is_in_order_ ? 0 : inner + leaves_, Use::scratch);
    met_ = arena.take<uint>(is_in_order_ ? 0 : inner, Use::scratch);
    leaf_counts_ = arena.take<uint>(is_in_order_ ? 0 : 2 * inner, Use::scratch);
    marks_ = arena.take<uint>(words, Use::scratch);
    counts_ = arena.take<cl_uint2>(words, Use::scratch);
    states_ = arena.take<std::uint64_t>(divided_up(static_cast<uint>(words), counted_words),
                                        Use::scratch);
    tiles_taken_ = arena.take<uint>(1, Use::scratch);
}

void Collapse::prepare(const cl::CommandQueue& queue)
{
    if (is_implicit_) {
        begins_.upload(queue, begin_list_);
        roots_.upload(queue, root_list_);
        child_count_.upload(queue, std::vector<uint>{room()});
        return;
    }
    states_.upload(queue, std::vector<std::uint64_t>(states_.size()));
    tiles_taken_.upload(queue, std::vector<uint>(1));
    marks_.upload(queue, std::vector<uint>(marks_.size()));
    met_.upload(queue, std::vector<uint>(met_.size()));
    epoch_ = 0;
}

void Collapse::enqueue(const DeviceTree& tree, Queue& queue)
{
    queue.begin("collapse");
    const std::size_t items = is_implicit_ ? room_ : leaves_;
    const auto launch = [&](cl::Kernel& kernel, std::size_t bytes, const auto&... more) {
        set_arguments_from(kernel, tree.bind(kernel, 0), more...);
        queue.launch(kernel, (items + collapse_group - 1) / collapse_group * collapse_group,
                     collapse_group, static_cast<std::int64_t>(bytes));
    };
    if (is_implicit_) {
        if (room_ > 0)
            launch(write_, 2 * children_.bytes(), objects_, begins_, room(), children_,
                   child_ends_);
        return;
    }
    if (!is_in_order_) {
        launch(line_up_[0], parents_.bytes() + ends_.bytes(), parents_, ends_);
        launch(line_up_[1], 0, objects_, parents_);
        launch(line_up_[2], parents_.bytes() + leaf_counts_.bytes(), parents_, met_, leaf_counts_);
        launch(line_up_[3], parents_.bytes() + leaf_counts_.bytes() + ends_.bytes(), parents_,
               leaf_counts_, positions_, places_, ends_);
    }
    launch(mark_, ends_.bytes(), positions_, ends_, marks_, words_);
    const auto words = static_cast<uint>(marks_.size());
    const std::size_t groups = device_.lets_groups_wait() ? states_.size() : 1;
    queue.launch(set_arguments(count_, marks_, counts_, words, states_, ++epoch_, tiles_taken_),
                 groups * counting_group, counting_group,
                 static_cast<std::int64_t>(2 * counts_.bytes()));
    launch(fill_, ends_.bytes(), objects_, positions_, ends_, counts_, words_, lists_, children_,
           child_ends_, room(), roots_, child_count_, tiles_taken_);
}

bool Collapse::had_room_for(std::uint64_t children)
{
    return had_room(room_, children, children / 8, child_bytes_, device_, "children of wide nodes");
}

}  // namespace bvhbench
