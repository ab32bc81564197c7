// SPDX-License-Identifier: MIT
//
// What adapters of libraries for the processor share: the mesh, boxes of triangles, stages by the host's clock, pairs of threads.
#pragma once

#include "method.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace adapter {

/// A closed box.
struct Box {
    float low[3], high[3];
};

inline bool overlap(const Box& a, const Box& b)
{
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] &&
           b.low[1] <= a.high[1] && a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

inline unsigned thread_count() { return std::max(1u, std::thread::hardware_concurrency()); }

/// Calls `act(thread, k)` for every k below `count`, on all cores; each takes `part` numbers at a time.
template <class Act>
void in_parallel(uint32_t count, const Act& act, uint32_t part = 512)
{
    std::atomic<uint64_t> next{0};
    const auto work = [&](unsigned thread) {
        for (uint64_t begin; (begin = next.fetch_add(part)) < count;)
            for (uint64_t k = begin; k < std::min<uint64_t>(begin + part, count); ++k)
                act(thread, static_cast<uint32_t>(k));
    };
    std::vector<std::thread> others;
    for (unsigned thread = 1; thread < thread_count(); ++thread)
        others.emplace_back(work, thread);
    work(0);
    for (std::thread& other : others)
        other.join();
}

/// A method on the processor. An adapter says how to make, refit and query the tree.
class HostMethod : public Method {
public:
    void prepare(const bvhbench_mesh& mesh) override
    {
        if (mesh.triangles > most_triangles())
            throw std::runtime_error(std::to_string(mesh.triangles) +
                                     " triangles; this adapter takes " +
                                     std::to_string(most_triangles()) + " at most");
        faces_.assign(mesh.faces, mesh.faces + 3 * mesh.triangles);
        points_.resize(3 * mesh.vertices);
        boxes_.resize(mesh.triangles);
    }

    void load(const float* points) override
    {
        std::copy_n(points, points_.size(), points_.begin());
    }

    void build(bvhbench_stages& stages) override { make(stages, "build", &HostMethod::make_tree); }

    uint64_t bytes() override
    {
        return faces_.size() * 4 + points_.size() * 4 + boxes_.size() * sizeof(Box) +
               pairs_.capacity() * 4 + tree_bytes();
    }

protected:
    virtual uint64_t most_triangles() const { return INT32_MAX; }
    virtual void make_tree() = 0;  // from boxes()
    virtual void refit_tree() {}
    /// Calls add(thread, a, b) for every pair. A thread is a number below thread_count().
    virtual void find_pairs() {}
    virtual uint64_t tree_bytes() const = 0;

    // What refit, query and pairs of plugin.h are for a class that overrides the functions above.
    void timed_refit(bvhbench_stages& stages) { make(stages, "refit", &HostMethod::refit_tree); }

    void timed_query(bvhbench_stages& stages)
    {
        start();
        found_.resize(thread_count());
        for (std::vector<uint32_t>& found : found_)
            found.clear();
        find_pairs();
        pairs_.clear();
        for (const std::vector<uint32_t>& found : found_)
            pairs_.insert(pairs_.end(), found.begin(), found.end());
        add_stage(stages, "broad", 0, now(), false);
    }

    PairList list() const { return {pairs_.size() / 2, pairs_.data()}; }

    void add(unsigned thread, uint32_t a, uint32_t b)
    {
        found_[thread].push_back(a);
        found_[thread].push_back(b);
    }

    uint32_t triangles() const { return static_cast<uint32_t>(boxes_.size()); }
    const std::vector<float>& points() const { return points_; }
    const std::vector<uint32_t>& faces() const { return faces_; }
    const std::vector<Box>& boxes() const { return boxes_; }

private:
    void start() { start_ = std::chrono::steady_clock::now(); }

    /// Returns the nanoseconds since start().
    uint64_t now() const
    {
        const std::chrono::nanoseconds passed = std::chrono::steady_clock::now() - start_;
        return static_cast<uint64_t>(passed.count());
    }

    void make(bvhbench_stages& stages, const char* name, void (HostMethod::*tree)())
    {
        start();
        in_parallel(triangles(), [this](unsigned, uint32_t t) { boxes_[t] = box_of(t); });
        const uint64_t boxed = now();
        (this->*tree)();
        add_stage(stages, "bounds", 0, boxed, false);
        add_stage(stages, name, boxed, now(), false);
    }

    Box box_of(uint32_t triangle) const
    {
        const uint32_t* face = &faces_[3 * std::size_t{triangle}];
        Box box;
        for (int axis = 0; axis < 3; ++axis) {
            const float a = points_[3 * std::size_t{face[0]} + axis];
            const float b = points_[3 * std::size_t{face[1]} + axis];
            const float c = points_[3 * std::size_t{face[2]} + axis];
            box.low[axis] = std::min({a, b, c});
            box.high[axis] = std::max({a, b, c});
        }
        return box;
    }

    std::vector<uint32_t> faces_;
    std::vector<float> points_;
    std::vector<Box> boxes_;
    std::vector<std::vector<uint32_t>> found_;  // by each thread
    std::vector<uint32_t> pairs_;
    std::chrono::steady_clock::time_point start_;
};

/// Gives a HostMethod the query of plugin.h.
template <class Tree>
class HostCollider : public Tree {
public:
    void query(bvhbench_stages& stages) override { this->timed_query(stages); }
    PairList pairs() override { return this->list(); }
};

/// The same with a refit.
template <class Tree>
class RefittedHostCollider : public HostCollider<Tree> {
public:
    void refit(bvhbench_stages& stages) override { this->timed_refit(stages); }
};

}  // namespace adapter
