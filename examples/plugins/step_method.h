// SPDX-License-Identifier: MIT
//
// What adapters of broad phases between two frames share: vertices, edges and faces in matrices of Eigen, as these libraries take them.
#pragma once

#include <Eigen/Core>

#include "host_method.h"

namespace adapter {

/// A method whose pairs are of vertices and faces, of edges, or, of one moment, of faces, without those that share a vertex. It rounds boxes outward.
class StepMethod : public Method {
public:
    void prepare(const bvhbench_mesh& mesh) override
    {
        if (mesh.drops_adjacent == 0)
            throw std::runtime_error(
                "it leaves out pairs that share a vertex: it takes --adjacent drop");
        vertices_ = static_cast<Eigen::Index>(mesh.vertices);
        first_ = static_cast<uint32_t>(mesh.first);
        has_edges_ = first_ == 0 && mesh.triangles > 0 && mesh.faces[1] == mesh.faces[2];
        const auto rest = static_cast<Eigen::Index>(mesh.triangles - mesh.first);
        corners_.resize(rest, has_edges_ ? 2 : 3);
        for (Eigen::Index k = 0; k < corners_.size(); ++k) {
            const Eigen::Index row = k / corners_.cols(), column = k % corners_.cols();
            corners_(row, column) = static_cast<int>(mesh.faces[3 * (first_ + row) + column]);
        }
    }

    void load(const float* points) override { load_step(points, points); }

    void load_step(const float* start, const float* end) override
    {
        using Rows = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
        start_ = Eigen::Map<const Rows>(start, vertices_, 3).cast<double>();
        end_ = Eigen::Map<const Rows>(end, vertices_, 3).cast<double>();
    }

    PairList pairs() override { return {pairs_.size() / 2, pairs_.data()}; }

    uint64_t bytes() override
    {
        return sizeof(double) * static_cast<uint64_t>(start_.size() + end_.size()) +
               sizeof(uint32_t) * (pairs_.capacity() + static_cast<uint64_t>(corners_.size()));
    }

protected:
    bool has_vertices() const { return first_ > 0; }
    bool has_edges() const { return has_edges_; }

    /// Adds a pair by the library's numbers: of a vertex, if there are any, and a face, or of two edges or faces.
    void add(int64_t a, int64_t b)
    {
        pairs_.push_back(static_cast<uint32_t>(a));
        pairs_.push_back(first_ + static_cast<uint32_t>(b));
    }

    Eigen::MatrixXd start_, end_;
    Eigen::MatrixXi corners_;  ///< of the edges, or of the faces
    std::vector<uint32_t> pairs_;

private:
    Eigen::Index vertices_ = 0;
    uint32_t first_ = 0;  ///< number of triangles that are vertices, before the others
    bool has_edges_ = false;
};

/// Returns the table of functions of class M.
template <class M>
bvhbench_method step_method(const char* name, const char* summary)
{
    bvhbench_method made = method<M>(name, summary);
    made.widens_boxes = 1;
    return made;
}

/// Calls `work` and adds the stage that it is.
template <class Work>
void timed(bvhbench_stages& stages, const char* name, const Work& work)
{
    const uint64_t before = stages.count == 0 ? 0 : stages.stage[stages.count - 1].end_ns;
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::nanoseconds passed = std::chrono::steady_clock::now() - start;
    add_stage(stages, name, before, before + static_cast<uint64_t>(passed.count()), false);
}

}  // namespace adapter
