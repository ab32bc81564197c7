// SPDX-License-Identifier: MIT
//
// Broad phases of ipc-toolkit, as a plug-in of bvhbench: between two frames or at one moment, on all cores of the host.
#include <ipc/broad_phase/hash_grid.hpp>
#include <ipc/broad_phase/lbvh.hpp>

#include "step_method.h"

namespace {

template <class BroadPhase>
class OfIpc final : public adapter::StepMethod {
public:
    void query(bvhbench_stages& stages) override
    {
        adapter::timed(stages, "build", [&] {
            const Eigen::MatrixXi none;
            phase_.build(start_, end_, has_edges() ? corners_ : none,
                         has_edges() ? none : corners_);
        });
        adapter::timed(stages, "broad", [&] {
            of_vertices_.clear(), of_edges_.clear(), of_faces_.clear();
            if (has_edges())
                phase_.detect_edge_edge_candidates(of_edges_);
            else if (has_vertices())
                phase_.detect_face_vertex_candidates(of_vertices_);
            else
                phase_.detect_face_face_candidates(of_faces_);
        });
    }

    adapter::PairList pairs() override
    {
        pairs_.clear();
        for (const auto& one : of_vertices_)
            add(one.vertex_id, one.face_id);
        for (const auto& one : of_edges_)
            add(one.edge0_id, one.edge1_id);
        for (const auto& one : of_faces_)
            add(one.face0_id, one.face1_id);
        return StepMethod::pairs();
    }

private:
    BroadPhase phase_;
    std::vector<ipc::FaceVertexCandidate> of_vertices_;
    std::vector<ipc::EdgeEdgeCandidate> of_edges_;
    std::vector<ipc::FaceFaceCandidate> of_faces_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {
        adapter::step_method<OfIpc<ipc::LBVH>>("ipc-lbvh", "LBVH of ipc-toolkit, on all cores"),
        adapter::step_method<OfIpc<ipc::HashGrid>>("ipc-hash-grid",
                                                   "hash grid of ipc-toolkit, on all cores")};
    return adapter::plugin(host_abi, "ipc-toolkit", LIBRARY_VERSION, "MIT", "host", methods);
}
