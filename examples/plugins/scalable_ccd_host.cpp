// SPDX-License-Identifier: MIT
//
// The sort and sweep of Scalable-CCD for the processor, as a plug-in of bvhbench: between two frames or at one moment.
#include <scalable_ccd/broad_phase/sort_and_sweep.hpp>

#include "step_method.h"

namespace {

class SortAndSweep final : public adapter::StepMethod {
public:
    void query(bvhbench_stages& stages) override
    {
        std::vector<scalable_ccd::AABB> vertices, others;
        adapter::timed(stages, "bounds", [&] {
            scalable_ccd::build_vertex_boxes(start_, end_, vertices);
            (has_edges() ? scalable_ccd::build_edge_boxes : scalable_ccd::build_face_boxes)(
                vertices, corners_, others);
        });
        adapter::timed(stages, "broad", [&] {
            if (has_vertices())
                scalable_ccd::sort_and_sweep(std::move(vertices), std::move(others), axis_, found_);
            else
                scalable_ccd::sort_and_sweep(std::move(others), axis_, found_);
        });
    }

    adapter::PairList pairs() override
    {
        pairs_.clear();
        for (const auto& [a, b] : found_)
            add(a, b);
        return StepMethod::pairs();
    }

private:
    int axis_ = 0;  ///< the library's choice for the next query
    std::vector<std::pair<int, int>> found_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::step_method<SortAndSweep>(
        "scalable-ccd-host", "sort and sweep of Scalable-CCD, on all cores")};
    return adapter::plugin(host_abi, "Scalable-CCD", LIBRARY_VERSION, "Apache-2.0", "host",
                           methods);
}
