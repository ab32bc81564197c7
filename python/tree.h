// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <mutex>

#include "python/query.h"

namespace bvhbench::python {

/// A tree over arrays. On a device that shares the host's memory the arrays are not copied, and are held as long as the tree reads them.
/// Threads may call one tree: calls take turns.
class BoundTree {
public:
    BoundTree(std::shared_ptr<OpenDevice> on, oibvh::Options options);

    /// `sizes` are those of the objects, as oibvh::Tree::build takes them. Waits if kernels read the arrays, as `refit` and `update`.
    void build(Floats points, Numbers faces, const Numbers& sizes);
    void refit(Floats points);

    /// Rebuilds the trees of the objects that are not 0 in `moved`, and keeps the others.
    void update(Floats points, const Numbers& moved);

    Numbers ask(const Query& query);
    Numbers pairs_with(BoundTree& other);

    const oibvh::Tree& tree() const { return tree_; }

private:
    void take(Floats points, Numbers* faces, const std::function<void(const oibvh::Input&)>& work);
    oibvh::Input input(const Floats& points, const Numbers& faces);

    std::shared_ptr<OpenDevice> on_;
    std::mutex mutex_;
    // What the tree reads comes before it, so that it is destroyed later.
    Floats points_;
    Numbers faces_;
    cl::Buffer points_buffer_, faces_buffer_;  ///< over the arrays, if they are not copied
    oibvh::Tree tree_;
};

}  // namespace bvhbench::python
