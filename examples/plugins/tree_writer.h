// SPDX-License-Identifier: MIT
//
// Spells out a library's tree as the arrays of bvhbench/plugin.h.
#pragma once

#include <bvhbench/plugin.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace adapter {

/// A node of a library's tree: its box and its children, or in a leaf its triangles. `Ref` is how the library names a node.
template <class Ref>
struct Spelled {
    float low[3], high[3];
    std::vector<Ref> children;
    std::vector<uint32_t> triangles;
};

/// Keeps the arrays of the last tree that was written.
class TreeWriter {
public:
    /// Returns the tree below `root`, breadth first. `spell(ref)` describes a node of the library. A leaf of more than 8
    /// triangles, which plugin.h does not allow, becomes a node with leaves of 8 below it, of the same box.
    template <class Ref, class Spell>
    bvhbench_tree written(const Ref& root, Spell spell)
    {
        nodes_.clear();
        entries_.clear();
        std::vector<Spelled<Ref>> waiting{spell(root)};
        for (std::size_t k = 0; k < waiting.size(); ++k) {
            Spelled<Ref> at = std::move(waiting[k]);
            const bool is_leaf = at.children.empty() && at.triangles.size() <= 8;
            begin_node(at.low, at.high, is_leaf);
            if (is_leaf)
                entries_.insert(entries_.end(), at.triangles.begin(), at.triangles.end());
            const auto add = [&](Spelled<Ref> child) {
                entries_.push_back(static_cast<uint32_t>(waiting.size()));
                waiting.push_back(std::move(child));
            };
            for (const Ref& child : at.children)
                add(spell(child));
            if (at.triangles.size() > 8)
                for (std::vector<uint32_t>& part : parts(at.triangles)) {
                    Spelled<Ref> child = at;
                    child.triangles = std::move(part);
                    add(std::move(child));
                }
            end_node();
        }
        return {nodes_.size(), nodes_.data(), entries_.size(), entries_.data()};
    }

private:
    /// Returns at most 8 lists of about the same length.
    static std::vector<std::vector<uint32_t>> parts(const std::vector<uint32_t>& all)
    {
        std::vector<std::vector<uint32_t>> made(std::min<std::size_t>(8, (all.size() + 7) / 8));
        for (std::size_t k = 0; k < all.size(); ++k)
            made[k * made.size() / all.size()].push_back(all[k]);
        return made;
    }

    void begin_node(const float* low, const float* high, bool is_leaf)
    {
        bvhbench_node node{};
        std::copy_n(low, 3, node.low);
        std::copy_n(high, 3, node.high);
        node.first = static_cast<uint32_t>(entries_.size());
        node.is_leaf = is_leaf;
        nodes_.push_back(node);
    }

    void end_node()
    {
        nodes_.back().count = static_cast<uint32_t>(entries_.size()) - nodes_.back().first;
    }

    std::vector<bvhbench_node> nodes_;
    std::vector<uint32_t> entries_;
};

}  // namespace adapter
