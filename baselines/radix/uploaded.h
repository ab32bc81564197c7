// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "builders/device_tree.h"
#include "builders/input.h"
#include "device/arena.h"

namespace bvhbench {

class RadixTree;

/// A tree of a builder that runs on the host, copied to the device, where colliders query it as they do a radix tree: leaves in
/// depth-first order, with boxes in that order, and inner nodes numbered as in node.h.
class UploadedTree {
public:
    explicit UploadedTree(const Device& device);
    ~UploadedTree();

    /// Copies the tree of one object. Waits. Takes memory if the number of leaves is not that of the last call. Throws Unavailable
    /// for what is no binary tree over the input's triangles, and for one that is deeper than kernels expect.
    const DeviceTree& copy(const Tree& tree, const Input& input, const Queue& queue);

    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

private:
    void write(const HostTree& from, const Input& input, const cl::CommandQueue& queue);

    const Device& device_;
    std::optional<Arena> arena_;
    std::unique_ptr<RadixTree> tree_;
};

}  // namespace bvhbench
