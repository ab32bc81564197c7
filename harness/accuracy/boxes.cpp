// SPDX-License-Identifier: MIT
//
// The axis boxes: what fewer bytes a box cost in false pairs and save in time, of trees in one layout, built, queried and
// followed by the exact narrow phase alike. Rounded outward, boxes may add pairs and must take none away.
#include "builders/box_format.h"
#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "harness/accuracy/axes.h"
#include "harness/accuracy/scene_input.h"
#include "harness/base/failure.h"

namespace bvhbench {
namespace {

/// The same for all methods, but for what a layout cannot do: the collider that is fastest on the kind of device.
void choose_pipeline(std::string_view method, bool is_cpu, Cell& cell)
{
    cell.builder = {.name = "oibvh-single",
                    .order = "hilbert30",
                    .sorted_leaves = true,
                    .boxes = std::string(method)};
    cell.collider = {.name = is_cpu ? "group" : "block", .keep_adjacent = false, .narrow = "exact"};
}

struct Right {
    PairList pairs, contacts;
};

Right right_answers(const Input& input)
{
    Right right;
    right.pairs = touching_pairs(input.points, input.faces, false);
    if (has_exact_reference)
        right.contacts = intersecting_pairs(input.points, input.faces, right.pairs, false);
    return right;
}

/// Pairs may be more than the right ones; contacts are decided exactly and may not.
void judge(const Pipeline& pipeline, const Right& right, Cell& cell)
{
    judge_pairs(pipeline, right.pairs, has_exact_reference ? "brute, CGAL" : "brute", cell);
    Check& check = cell.check;
    if (cell.counters["missed_count"] == 0 && check.verdict == Check::Verdict::differs) {
        check.verdict = Check::Verdict::counted;
        check.detail.clear();
    }
    const PairList contacts = pipeline.contacts();
    check.contacts_hash = contacts.hash();
    if (!has_exact_reference || contacts == right.contacts)
        return;
    check.verdict = Check::Verdict::differs;
    check.detail = "the oracle has " + std::to_string(right.contacts.size()) + " contacts, not " +
                   std::to_string(contacts.size());
}

}  // namespace

void measure_boxes(const AxisRun& run)
{
    for_each_scene(
        run, "boxes", {"torus:100000", "hairball:100000"},
        [&](const SceneFacts& scene, const Input& input) {
            const Right right = right_answers(input);
            std::vector<Subject> cells;
            std::vector<std::unique_ptr<Pipeline>> pipelines;
            for (const BoxFormat& format : box_formats()) {
                const std::string_view method = format.name;
                if (!run.task.wants(scene.name, method))
                    continue;
                Subject& one = cells.emplace_back();
                one.cell = accuracy_cell("boxes", std::string(method), scene);
                choose_pipeline(method, run.session.device().is_cpu(), one.cell);
                const std::string failure = reason_of_failure([&] {
                    auto& pipeline =
                        pipelines.emplace_back(settled_pipeline(run.session, one.cell, input));
                    one.cell.counters["node_bytes"] = static_cast<double>(format.box_bytes());
                    one.once = [&input, frame = pipeline.get()] { return frame->once(input); };
                });
                if (!failure.empty()) {
                    pipelines.resize(cells.size());
                    fail(run.session, one, failure);
                }
            }
            take_samples_of(run, cells);
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (cells[k].once) {
                    cells[k].cell.counters["right_pairs_count"] =
                        static_cast<double>(right.pairs.size());
                    judge(*pipelines[k], right, cells[k].cell);
                }
                run.add(std::move(cells[k].cell));
            }
        });
}

}  // namespace bvhbench
