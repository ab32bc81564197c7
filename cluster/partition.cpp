// SPDX-License-Identifier: MIT
#include "cluster/partition.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <compare>

#include "geometry/cores.h"
#include "geometry/grid.h"
#include "geometry/hilbert.h"

namespace bvhbench {
namespace {

/// Keys are unique, because ids are.
struct Key {
    std::uint64_t high = 0;
    uint id = 0;
    auto operator<=>(const Key&) const = default;

    static constexpr uint bytes = 12;

    /// Returns byte k, the highest first.
    uint byte(uint k) const
    {
        return k < 8 ? static_cast<uint>(high >> (56 - 8 * k) & 0xff) : id >> (88 - 8 * k) & 0xff;
    }

    /// Returns the key with byte k set, which was 0.
    Key with(uint k, uint value) const
    {
        return k < 8 ? Key{high | std::uint64_t{value} << (56 - 8 * k), id}
                     : Key{high, id | value << (88 - 8 * k)};
    }
};

/// Triangles that are still to be cut into `parts` parts, from part `first` on.
struct Group {
    uint first, parts;
    std::uint64_t weight = 0;  ///< of all its triangles on all ranks
    uint left() const { return parts / 2; }
};

/// Returns the bits of a float so that unsigned integers compare as the floats do.
uint ordered_bits(float x)
{
    const uint bits = as_uint(x);
    return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

/// Returns whole * share / of, rounded down.
std::uint64_t part_of_whole(std::uint64_t whole, uint share, uint of)
{
    return whole / of * share + whole % of * share / of;
}

/// Cuts all triangles into parts, all groups of a depth at once.
class Partition {
public:
    Partition(const PlacedTriangles& placed, PartitionBy by, uint parts, Ranks& ranks)
        : placed_(placed)
        , by_(by)
        , parts_(parts)
        , ranks_(ranks)
        , keys_(placed.ids.size())
        , group_(placed.ids.size(), 0)
        , groups_{{0, parts}}
    {
        assert(placed.centres.size() == placed.ids.size() && parts > 0);
        assert(placed.weights.empty() || placed.weights.size() == placed.ids.size());
        std::array<std::uint64_t, 1> all{placed.ids.size()};
        ranks_.sum(all);
        triangles_ = all[0];
        if (by_ == PartitionBy::curve)
            key_by_curve();
    }

    std::vector<uint> parts()
    {
        while (std::ranges::any_of(groups_, [](const Group& group) { return group.parts > 1; })) {
            if (by_ == PartitionBy::rcb)
                key_by_longest_sides();
            weigh();
            split(selected());
        }
        std::vector<uint> parts;
        parts.reserve(group_.size());
        for (const uint group : group_)
            parts.push_back(groups_[group].first);
        return parts;
    }

private:
    uint weight(std::size_t k) const { return placed_.weights.empty() ? 1 : placed_.weights[k]; }

    /// Returns the boxes of the centres of each group, over all ranks.
    std::vector<Aabb> group_boxes() const
    {
        std::vector<Aabb> boxes(groups_.size(), empty_box());
        for (std::size_t k = 0; k < group_.size(); ++k) {
            const Point at = placed_.centres[k];
            boxes[group_[k]] = merged(boxes[group_[k]], {at.x, at.y, at.z, at.x, at.y, at.z});
        }
        std::vector<float> sides;
        for (const Aabb& box : boxes)
            sides.insert(sides.end(),
                         {box.min_x, box.min_y, box.min_z, -box.max_x, -box.max_y, -box.max_z});
        ranks_.least(sides);
        for (std::size_t g = 0; g < boxes.size(); ++g) {
            const float* of = &sides[6 * g];
            boxes[g] = {of[0], of[1], of[2], -of[3], -of[4], -of[5]};
        }
        return boxes;
    }

    void key_by_longest_sides()
    {
        std::vector<float Point::*> axes;
        for (const Aabb& box : group_boxes()) {
            // Halves, so that no side overflows; an empty box has sides below 0.
            const float x = 0.5f * box.max_x - 0.5f * box.min_x;
            const float y = 0.5f * box.max_y - 0.5f * box.min_y;
            const float z = 0.5f * box.max_z - 0.5f * box.min_z;
            axes.push_back(x >= y && x >= z ? &Point::x : y >= z ? &Point::y : &Point::z);
        }
        for (std::size_t k = 0; k < group_.size(); ++k)
            keys_[k] = {ordered_bits(placed_.centres[k].*axes[group_[k]]), placed_.ids[k]};
    }

    void key_by_curve()
    {
        const Bounds bounds = {empty_box(), group_boxes().front()};
        constexpr std::size_t block = 1 << 16;
        on_all_cores((keys_.size() + block - 1) / block, [&](std::size_t part) {
            for (std::size_t k = part * block; k < std::min(keys_.size(), (part + 1) * block);
                 ++k) {
                const Point at = placed_.centres[k];
                const Aabb box = {at.x, at.y, at.z, at.x, at.y, at.z};
                keys_[k] = {hilbert_63(cubic_cell(box, bounds, 0x1p21f)), placed_.ids[k]};
            }
        });
    }

    void weigh()
    {
        std::vector<std::uint64_t> weights(groups_.size());
        for (std::size_t k = 0; k < group_.size(); ++k)
            weights[group_[k]] += weight(k);
        ranks_.sum(weights);
        for (std::size_t g = 0; g < groups_.size(); ++g)
            groups_[g].weight = weights[g];
    }

    /// Returns the largest weight that the left half of a group may have.
    std::uint64_t wanted(const Group& group) const
    {
        if (by_ == PartitionBy::rcb)
            return part_of_whole(group.weight, group.left(), group.parts);
        return curve_cut(triangles_, group.first + group.left(), parts_) -
               curve_cut(triangles_, group.first, parts_);
    }

    /// Returns a key for each group: the least whose weight, with that of all keys before it, exceeds what is wanted of the left
    /// half. Keys before it are the left half.
    std::vector<Key> selected() const
    {
        constexpr uint digits = 256;
        std::vector<Key> found(groups_.size());
        std::vector<std::uint64_t> room;
        for (const Group& group : groups_)
            room.push_back(wanted(group));
        std::vector<uint>
            agree;  // triangles whose keys have all bytes found so far; before the first, all do
        const uint first_byte = by_ == PartitionBy::rcb ? 4 : 0;
        for (uint byte = first_byte; byte < Key::bytes; ++byte) {
            std::vector<std::uint64_t> sums(digits * groups_.size());
            const bool is_first = byte == first_byte;
            const std::size_t count = is_first ? keys_.size() : agree.size();
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t k = is_first ? i : agree[i];
                sums[digits * group_[k] + keys_[k].byte(byte)] += weight(k);
            }
            ranks_.sum(sums);
            for (std::size_t g = 0; g < groups_.size(); ++g) {
                uint digit = 0;
                while (digit + 1 < digits && sums[digits * g + digit] <= room[g])
                    room[g] -= sums[digits * g + digit++];
                found[g] = found[g].with(byte, digit);
            }
            std::size_t kept = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const std::size_t k = is_first ? i : agree[i];
                if (keys_[k].byte(byte) != found[group_[k]].byte(byte))
                    continue;
                if (is_first)
                    agree.push_back(static_cast<uint>(k));
                else
                    agree[kept++] = static_cast<uint>(k);
            }
            if (!is_first)
                agree.resize(kept);
        }
        return found;
    }

    /// Replaces each group of several parts by its two halves.
    void split(const std::vector<Key>& cuts)
    {
        std::vector<Group> halves;
        std::vector<uint> first_half;
        for (const Group& group : groups_) {
            first_half.push_back(static_cast<uint>(halves.size()));
            if (group.parts > 1)
                halves.push_back({group.first, group.left()});
            halves.push_back(group.parts > 1
                                 ? Group{group.first + group.left(), group.parts - group.left()}
                                 : group);
        }
        for (std::size_t k = 0; k < group_.size(); ++k) {
            const uint g = group_[k];
            const bool is_right = groups_[g].parts > 1 && keys_[k] >= cuts[g];
            group_[k] = first_half[g] + (is_right ? 1 : 0);
        }
        groups_ = std::move(halves);
    }

    PlacedTriangles placed_;
    PartitionBy by_;
    uint parts_;
    Ranks& ranks_;
    std::uint64_t triangles_ = 0;  ///< on all ranks
    std::vector<Key> keys_;
    std::vector<uint> group_;  ///< of each triangle: an index into groups_
    std::vector<Group> groups_;
};

}  // namespace

std::vector<uint> partitioned(const PlacedTriangles& placed, PartitionBy by, uint parts,
                              Ranks& ranks)
{
    return Partition(placed, by, parts, ranks).parts();
}

std::uint64_t curve_block(std::uint64_t triangles, uint parts)
{
    return std::bit_floor(std::max<std::uint64_t>(1, triangles / 32 / parts));
}

std::uint64_t curve_cut(std::uint64_t triangles, uint part, uint parts)
{
    if (part == parts)
        return triangles;
    const std::uint64_t block = curve_block(triangles, parts);
    return part_of_whole(triangles / block, part, parts) * block;
}

}  // namespace bvhbench
