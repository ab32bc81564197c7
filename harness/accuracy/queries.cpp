// SPDX-License-Identifier: MIT
//
// The axes that build trees and query them for pairs: codes, input, place and boxes.
#include <cmath>

#include "builders/box_format.h"
#include "builders/device_tree.h"
#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "harness/accuracy/axis.h"
#include "harness/judge/metrics.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/pipeline.h"

namespace bvhbench {
namespace {

/// Counts the errors of the last pairs.
Differences count_pairs(const Pipeline& pipeline, const PairList& right, Cell& cell)
{
    const PairList found(pipeline.pairs());
    cell.check.pairs_hash = found.hash();
    return count_errors(found, right, cell);
}

/// Writes the surface area cost of the trees over an input, one for each object: the sum of their nodes' costs divided by the
/// sum of their roots' areas.
void add_forest_cost(Session& session, const Input& input, Cell& cell)
{
    Builder& builder = session.builder(cell.builder);
    builder.reserve_objects(object_sizes(input));
    const Tree* built = nullptr;
    session.build_once(builder, input, Start::from_triangles, &built);
    const auto& forest = dynamic_cast<const DeviceTree&>(*built);
    double cost = 0, area = 0;
    for (uint object = 0; object < forest.objects.size(); ++object) {
        const HostTree tree = forest.object_to_host_tree(object);
        const double root = surface_area(tree.nodes.front().box);
        if (const auto sums = area_sums(tree)) {
            cost += root * sums->cost();
            area += root;
        }
    }
    if (area > 0)
        cell.counters["sah_cost"] = cost / area;
    else
        cell.left_out["sah_cost"] = "no root has an area";
}

/// Calls measure(points, facts) with the scene rotated and moved by each of these multiples of its size, in doubles.
template <class Measure>
void at_places(const SceneFacts& scene, const Input& input, std::initializer_list<double> sizes,
               const Measure& measure)
{
    for (const double away : sizes) {
        SceneFacts facts = scene;
        facts.name +=
            " at " + (away > 0 ? "1e" + std::to_string(std::lround(std::log10(away))) : "0");
        measure(turned_and_moved(input.points, away), facts);
    }
}

}  // namespace

AxisMethod fastest_method(const Session& session, std::string name, std::string boxes,
                          std::string narrow, std::function<void(Measurement&)> prepare)
{
    return {.name = std::move(name),
            .builder = {{.order = "hilbert30", .sorted_leaves = true, .boxes = std::move(boxes)},
                        "oibvh-single"},
            .collider = {{.keep_adjacent = false},
                         session.device().is_cpu() ? "group" : "block",
                         std::move(narrow)},
            .prepare = std::move(prepare)};
}

void prepare_pipeline(Session& session, const Input& input, Measurement& one,
                      const JudgePipeline& judge)
{
    const auto pipeline =
        std::make_shared<Pipeline>(session, one.cell.builder, one.cell.collider, input);
    pipeline->begin_frame({});
    pipeline->prepare(input);
    one.cell.counters = pipeline->counters();
    one.once = [&input, pipeline] { return pipeline->once(input); };
    one.judge_again = [&one, pipeline, judge] { judge(*pipeline, one.cell); };
}

std::shared_ptr<RoundedInput> upload_rounded(Session& session, std::vector<Point> points,
                                             const Input& input)
{
    auto rounded = std::make_shared<RoundedInput>();
    rounded->points = std::move(points);
    rounded->input = upload(session.device(), session.queue(), rounded->points, input.faces);
    return rounded;
}

/// Measures what longer codes and other grids gain in the tree and in a query: curve orders on grids over each object and, if
/// there are several objects, over the scene. Compared with medians (one object only) and a radix tree.
void measure_codes(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    Session& session = run.session;
    const PairList right = touching_pairs(input.points, input.faces, true);
    std::vector<AxisMethod> methods;
    const auto add = [&](std::string name, const BuilderChoice& builder, const OrderEntry* codes) {
        const auto prepare = [&, codes](Measurement& one) {
            prepare_pipeline(session, input, one, [&](const Pipeline& pipeline, Cell& cell) {
                count_pairs(pipeline, right, cell);
                judge_errors(cell, pairs_oracle, true);
            });
            add_forest_cost(session, input, one.cell);
            if (codes == nullptr)
                return;
            const CodeCounts counts = code_counts(*codes, input.points, input.faces, input.objects,
                                                  one.cell.builder.grid);
            one.cell.counters["duplicates_count"] = static_cast<double>(counts.duplicates);
            one.cell.counters["longest_run_count"] = static_cast<double>(counts.longest_run);
        };
        methods.push_back({std::move(name), builder, {.name = "leaf"}, prepare});
    };
    for (const OrderEntry& order : order_catalog()) {
        if (order.medians != Medians::nowhere)
            continue;
        const std::string name(order.name);
        add(name, {{.order = name}, "oibvh-multi"}, &order);
        if (input.objects.size() > 1)
            add(name + "-scene", {{.order = name, .grid = GridOver::scene}, "oibvh-multi"}, &order);
    }
    if (input.objects.size() == 1)
        add("kd", {{.order = "kd"}, "oibvh-multi"}, nullptr);
    add("radix", {.name = "apetrei-fused"}, nullptr);
    measure_methods(run, "codes", scene, methods);
}

/// Counts the pairs that rounding vertices from double to float adds, against boxes in double. Rounding removes no pair:
/// rounding to nearest preserves the order of coordinates, so boxes that overlapped still do.
void measure_input(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    // Distance from the origin in sizes of the scene. A float has 24 bits, so at 1e7 sizes hardly any detail remains.
    at_places(scene, input, {0, 1e2, 1e3, 1e4, 1e5, 1e6}, [&](const auto& wide, const auto& facts) {
        const PairList right = overlapping_pairs_in_doubles(wide, input.faces);
        std::vector<AxisMethod> methods;
        const auto add = [&](const char* name, Doubles how) {
            const auto prepare = [&, how](Measurement& one) {
                const auto floats = upload_rounded(run.session, rounded(wide, how), input);
                // The judge keeps the input until all samples are taken.
                const auto judge = [&, floats](const Pipeline& pipeline, Cell& cell) {
                    const Differences wrong = count_pairs(pipeline, right, cell);
                    cell.counters["right_pairs_count"] = static_cast<double>(right.size());
                    judge_errors(cell, "boxes of doubles", wrong.missed > 0);
                };
                prepare_pipeline(run.session, floats->input, one, judge);
            };
            methods.push_back({name, {.name = "oibvh-multi"}, {.name = "leaf"}, prepare});
        };
        add("f32", Doubles::as_is);
        add("f32-recentred", Doubles::recentred);
        measure_methods(run, "input", facts, methods);
    });
}

/// Measures what exact contacts take by place: far from the origin rounding makes more pairs touch, and have no area, for which the
/// filters are in doubt. The same filters alone tell what exact arithmetic takes. The answer is that of the rounded vertices.
void measure_place(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    at_places(
        scene, input, {0, 1, 1e1, 1e2, 1e3, 1e4, 1e5}, [&](const auto& wide, const auto& facts) {
            const auto floats = upload_rounded(run.session, rounded(wide, Doubles::as_is), input);
            const PairList right = intersecting_pairs(
                floats->points, input.faces,
                touching_pairs(floats->points, input.faces, false).pairs(), false);
            std::vector<AxisMethod> methods;
            for (const char* narrow : {"exact", "filter-f64"}) {
                const auto judge = [&, narrow](const Pipeline& pipeline, Cell& cell) {
                    count_errors(PairList(pipeline.contacts()), right, cell);
                    judge_contacts(cell, "CGAL boxes, CGAL", narrow);
                };
                const auto prepare = [&, judge](Measurement& one) {
                    prepare_pipeline(run.session, floats->input, one, judge);
                };
                methods.push_back(fastest_method(run.session, narrow, "f32", narrow, prepare));
            }
            measure_methods(run, "place", facts, methods);
        });
}

/// Measures the false pairs that smaller boxes cost and the time they save. The trees' layout, query and exact narrow phase are
/// the same. Boxes are rounded outward: they may add pairs but must not remove any or change contacts.
void measure_boxes(const AxisRun& run, const SceneFacts& scene, const Input& input)
{
    const PairList right = touching_pairs(input.points, input.faces, false);
    const PairList contacts =
        has_exact_reference ? intersecting_pairs(input.points, input.faces, right.pairs(), false)
                            : PairList();
    const auto judge = [&](const Pipeline& pipeline, Cell& cell) {
        const Differences wrong = count_pairs(pipeline, right, cell);
        cell.counters["right_pairs_count"] = static_cast<double>(right.size());
        // False pairs are counted, and missed pairs are an error.
        judge_errors(cell, has_exact_reference ? "CGAL boxes, CGAL" : pairs_oracle,
                     wrong.missed > 0 || wrong == Differences{});
        const PairList found(pipeline.contacts());
        Check& check = cell.check;
        check.contacts_hash = found.hash();
        if (!has_exact_reference || found == contacts)
            return;
        check.verdict = Check::Verdict::differs;
        check.detail = "the oracle has " + std::to_string(contacts.size()) + " contacts, not " +
                       std::to_string(found.size());
    };
    std::vector<AxisMethod> methods;
    for (const BoxFormat& format : box_formats()) {
        const std::string name(format.name);
        const auto prepare = [&](Measurement& one) {
            prepare_pipeline(run.session, input, one, judge);
            one.cell.counters["node_bytes"] = static_cast<double>(format.box_bytes());
        };
        methods.push_back(fastest_method(run.session, name, name, "exact", prepare));
    }
    measure_methods(run, "boxes", scene, methods);
}

}  // namespace bvhbench
