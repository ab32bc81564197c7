// SPDX-License-Identifier: MIT
#include "builders/stages/medians/cells.h"

#include <algorithm>

#include "builders/parameters.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// For passes that count in local memory: few large groups, so that few counts are added up in the end.
constexpr uint local_group_size = 1024;
constexpr uint local_groups_per_unit = 1;
constexpr uint local_leaves = 4;  // that a work-item looks at at a time

constexpr uint pass_leaves = 3;  // the same, of a pass that counts in global memory
constexpr uint chunk_levels =
    3;  // split one at a time in `chunks`, before each core takes subtrees

constexpr uint halve_group_size = 256;
constexpr uint halve_slabs = 4096;
constexpr uint local_slabs = 8192;  // 32 KiB per group
/// For many small nodes: small groups, many of which run at a time.
constexpr uint small_halve_group_size = 128;
constexpr uint small_halve_slabs = 1024;

std::int64_t bytes(std::size_t size) { return static_cast<std::int64_t>(size); }

/// Returns the number of a level's first node; nodes are numbered level by level.
constexpr std::size_t first_node(uint level) { return (std::size_t{1} << level) - 1; }

}  // namespace

CellMedians::CellMedians(Programs& programs, MedianShape shape)
    : shape_(shape)
    , units_(programs.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
    , number_(programs)
{
    shape_.form =
        chosen_form(programs.device(), shape.form, local_slabs * sizeof(uint), local_group_size);
    if (shape_.form == KernelForm::chunks) {
        number_leaves_ =
            programs.kernel("builders/stages/medians/cells_chunks.cl", "number_leaves");
        halve_ = programs.kernel("builders/stages/medians/cells_chunks.cl", "halve_nodes");
        return;
    }
    pass_group_size_ = programs.device().tuned(cells_pass_group_size);
    const auto local = [&](const char* name) {
        return programs.kernel("builders/stages/medians/cells_groups.cl", name,
                               {{"GROUP_SIZE", local_group_size},
                                {"LEAVES", local_leaves},
                                {"LOCAL_SLABS", local_slabs}});
    };
    const auto global = [&](const char* name) {
        return programs.kernel(
            "builders/stages/medians/cells_groups.cl", name,
            {{"GROUP_SIZE", pass_group_size_}, {"LEAVES", pass_leaves}, {"LOCAL_SLABS", 0}});
    };
    clear_ = global("clear_all");
    first_pass_ = local("first_pass");
    local_pass_ = local("pass");
    pass_ = global("pass");
    last_pass_ = global("last_pass");
    const auto halve = [&](uint group_size, uint slabs) {
        return programs.kernel("builders/stages/medians/cells_halve.cl", "halve_lists",
                               {{"GROUP_SIZE", group_size}, {"MOST_SLABS", slabs}});
    };
    halve_ = halve(halve_group_size, halve_slabs);
    halve_small_ = halve(small_halve_group_size, small_halve_slabs);
}

/// Returns the number of nodes of a level that have leaves.
uint CellMedians::nodes_on(uint level) const
{
    return divided_up(static_cast<uint>(size_), 1u << (root_height_ - level));
}

uint CellMedians::slabs_on(uint level) const
{
    return nodes_on(level) * slab_count(level, root_height_ - level);
}

void CellMedians::plan(Arena& arena, std::size_t size)
{
    size_ = size;
    root_height_ = size > 1 ? ceil_log2(static_cast<uint>(size)) : 0;
    levels_ = root_height_ - std::min(root_height_, shape_.block_height);
    cells_ = arena.take<Aabb>(first_node(levels_ + (shape_.form == KernelForm::chunks ? 1 : 0)),
                              Use::scratch);
    const std::size_t leaves = shape_.form == KernelForm::chunks && levels_ > 0 ? size : 0;
    even_ = arena.take<Leaf>(leaves, Use::scratch);
    odd_ = arena.take<Leaf>(leaves, Use::scratch);
    if (shape_.form == KernelForm::chunks || levels_ == 0)
        return;
    lists_ = arena.take<ulong>(size, Use::scratch);
    uint counts = 0;
    for (uint level = 0; level < levels_; ++level)
        counts = std::max(counts, slabs_on(level));
    centres_ = arena.take<float>(3 * size, Use::scratch);
    nodes_ = arena.take<uint>(size, Use::scratch);
    cuts_ = arena.take<CellCut>(first_node(levels_), Use::scratch);
    lefts_ = arena.take<uint>(first_node(levels_), Use::scratch);
    counts_ = arena.take<uint>(counts, Use::scratch);
    waiting_ = arena.take<uint>(first_node(levels_), Use::scratch);
    placed_ = arena.take<uint>(nodes_on(levels_), Use::scratch);
}

void CellMedians::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                          const Buffer<uint>& ids, Queue& queue)
{
    if (levels_ == 0)
        number_.enqueue(ids, queue);
    else if (shape_.form == KernelForm::chunks)
        in_chunks(boxes, bounds, ids, queue);
    else
        in_groups(boxes, bounds, ids, queue);
}

void CellMedians::in_groups(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                            const Buffer<uint>& ids, Queue& queue)
{
    const auto count = static_cast<uint>(size_);
    const std::size_t many =
        std::size_t{divided_up(count, pass_group_size_ * pass_leaves)} * pass_group_size_;
    const std::size_t few =
        std::size_t{std::min(units_ * local_groups_per_unit,
                             divided_up(count, local_group_size * local_leaves))} *
        local_group_size;

    set_arguments(clear_, counts_, static_cast<uint>(counts_.size()), waiting_,
                  static_cast<uint>(waiting_.size()), placed_, static_cast<uint>(placed_.size()));
    queue.launch(clear_, std::min(many, std::size_t{units_} * pass_group_size_), pass_group_size_,
                 bytes(counts_.bytes() + waiting_.bytes() + placed_.bytes()));
    set_arguments(first_pass_, boxes, bounds, centres_, cells_, cuts_, counts_, count,
                  root_height_);
    queue.launch(first_pass_, few, local_group_size, bytes(boxes.bytes() + centres_.bytes()));
    enqueue_halve(ids, 0, queue);
    for (uint level = 1; level < levels_; ++level) {
        const bool is_local = slabs_on(level) <= local_slabs;
        cl::Kernel& pass = is_local ? local_pass_ : pass_;
        set_arguments(pass, centres_, nodes_, cuts_, counts_, waiting_, lists_, count, root_height_,
                      level);
        queue.launch(pass, is_local ? few : many, is_local ? local_group_size : pass_group_size_,
                     bytes(16 * size_));
        enqueue_halve(ids, level, queue);
    }
    set_arguments(last_pass_, centres_, nodes_, cuts_, placed_, waiting_, lists_, ids, count,
                  root_height_, levels_);
    queue.launch(last_pass_, many, pass_group_size_, bytes(12 * size_));
    enqueue_halve(ids, levels_, queue);
}

void CellMedians::enqueue_halve(const Buffer<uint>& ids, uint level, Queue& queue)
{
    const std::size_t groups = level > 0 ? nodes_on(level - 1) : 1;
    const bool is_small =
        level >= levels_ || 2 * slab_count(level, root_height_ - level) <= small_halve_slabs;
    const uint group_size = is_small ? small_halve_group_size : halve_group_size;
    cl::Kernel& halve = is_small ? halve_small_ : halve_;
    set_arguments(halve, centres_, nodes_, cuts_, cells_, lefts_, counts_, waiting_, lists_,
                  placed_, ids, static_cast<uint>(size_), root_height_, shape_.block_height, level);
    queue.launch(halve, groups * group_size, group_size,
                 level < levels_ ? bytes(slabs_on(level) * sizeof(uint)) : 0);
}

/// Splits the first levels in one launch each, because they have few nodes; then one launch with a subtree per work-item.
void CellMedians::in_chunks(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                            const Buffer<uint>& ids, Queue& queue)
{
    constexpr uint group_size = 256;
    const auto count = static_cast<uint>(size_);
    set_arguments(number_leaves_, boxes, even_, count);
    queue.launch(number_leaves_, std::size_t{divided_up(count, group_size)} * group_size,
                 group_size, bytes(boxes.bytes() + even_.bytes()));
    for (uint level = 0; level < levels_; ++level) {
        const bool is_last = level + 1 == levels_ || level >= chunk_levels;
        const uint bottom = is_last ? shape_.block_height + 1 : root_height_ - level;
        set_arguments(halve_, bounds, level % 2 == 0 ? even_ : odd_, level % 2 == 0 ? odd_ : even_,
                      cells_, ids, count, root_height_, level, bottom, is_last ? 1u : 0u);
        queue.launch(halve_, nodes_on(level), 1, bytes(2 * even_.bytes() + ids.bytes()));
        if (is_last)
            break;
    }
}

}  // namespace bvhbench
