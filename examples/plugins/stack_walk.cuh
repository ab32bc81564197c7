// SPDX-License-Identifier: MIT
//
// A walk over a library's binary tree, for adapters of libraries that do not find pairs of boxes themselves.
#pragma once

#include "cuda_method.cuh"
#include "tree_writer.h"

namespace adapter {

/// One triangle's box against the tree. `Tree` says what its nodes are: `root` and leaf(k) are the numbers of the root and of query
/// k's leaf; a leaf has triangle(n), another node children(n); overlap() compares two box(n).
template <class Tree>
struct StackWalk {
    Tree tree;
    uint32_t* depth_exceeded;

    template <class Add>
    __device__ void operator()(uint32_t k, const Add& add) const
    {
        constexpr int most = 128;
        uint32_t waiting[most];
        int count = 0;
        const uint32_t own = tree.triangle(tree.leaf(k));
        const auto box = tree.box(tree.leaf(k));
        uint32_t at = tree.root;
        for (;;) {
            const uint2 children = tree.children(at);
            uint32_t next[2];
            int found = 0;
            for (const uint32_t child : {children.x, children.y}) {
                if (!tree.overlap(box, tree.box(child)))
                    continue;
                if (!tree.is_leaf(child))
                    next[found++] = child;
                else if (own < tree.triangle(child))
                    add(own, tree.triangle(child));
            }
            if (found == 2) {
                if (count == most) {
                    *depth_exceeded = 1;
                    return;
                }
                waiting[count++] = next[1];
            }
            if (found > 0)
                at = next[0];
            else if (count > 0)
                at = waiting[--count];
            else
                return;
        }
    }
};

/// A CudaMethod that finds pairs by this walk.
class WalkedMethod : public CudaMethod {
protected:
    void reserve() override
    {
        depth_exceeded_.allocate(1);
        const uint32_t no = 0;
        depth_exceeded_.upload(&no);
    }

    template <class Tree>
    void walk(const Tree& tree)
    {
        find_pairs_by(StackWalk<Tree>{tree, depth_exceeded_.data()}, triangles());
    }

    uint64_t found() override
    {
        if (downloaded(depth_exceeded_.data(), 1)[0] != 0)
            throw std::runtime_error(
                "the tree is deeper than the 128 levels that the walk's stack has");
        return CudaMethod::found();
    }

private:
    DeviceArray<uint32_t> depth_exceeded_;
};

/// A node of 32 bytes, as builders of H-PLOC have it. In a leaf, left is UINT32_MAX and right the triangle.
struct alignas(16) BinaryNode {
    Box box;
    uint32_t left, right;
};
static_assert(sizeof(BinaryNode) == 32);

/// Node k < triangles is the leaf of triangle k, the last node is the root.
struct BinaryTree {
    const BinaryNode* nodes;
    uint32_t root;

    __device__ uint32_t leaf(uint32_t k) const { return k; }
    __device__ Box box(uint32_t n) const { return nodes[n].box; }
    __device__ bool is_leaf(uint32_t n) const { return nodes[n].left == UINT32_MAX; }
    __device__ uint32_t triangle(uint32_t n) const { return nodes[n].right; }
    __device__ uint2 children(uint32_t n) const { return {nodes[n].left, nodes[n].right}; }
    static __device__ bool overlap(const Box& a, const Box& b)
    {
        return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
               b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
    }
};

/// A WalkedMethod whose library makes such a tree.
class BinaryMethod : public WalkedMethod {
public:
    bvhbench_tree tree() override
    {
        const auto nodes = downloaded(binary_nodes(), root() + 1);
        return writer_.written(root(), [&](uint32_t number) {
            const BinaryNode& node = nodes[number];
            const auto &low = node.box.low, &high = node.box.high;
            Spelled<uint32_t> spelled{
                {low[0], low[1], low[2]}, {high[0], high[1], high[2]}, {}, {}};
            if (node.left == UINT32_MAX)
                spelled.triangles = {node.right};
            else
                spelled.children = {node.left, node.right};
            return spelled;
        });
    }

protected:
    void find_pairs() override { walk(BinaryTree{binary_nodes(), root()}); }
    uint32_t root() const { return 2 * triangles() - 2; }

    virtual const BinaryNode* binary_nodes() const = 0;

    template <class LibraryNode>
    static const BinaryNode* as_binary(const LibraryNode* nodes)
    {
        static_assert(sizeof(LibraryNode) == sizeof(BinaryNode),
                      "a box as in boxes(), then the two numbers");
        return reinterpret_cast<const BinaryNode*>(nodes);
    }

private:
    TreeWriter writer_;
};

}  // namespace adapter
