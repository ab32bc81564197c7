// SPDX-License-Identifier: MIT
//
// Swept boxes contain every frame in between; every builder makes the same ones, and every collider finds the oracle's pairs.

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/swept_reference.h"
#include "harness/judge/pair_counts.h"
#include "harness/measure/collide.h"
#include "scenes/generate/derived.h"
#include "scenes/ground_truth.h"
#include "tests/collide/collider_testing.h"
#include "tests/folder.h"

namespace bvhbench {
namespace {

Scene moving_scene(std::vector<Face> faces, std::vector<Point> from, std::vector<Point> to)
{
    Scene scene;
    scene.name = "moving";
    scene.source = "generated";
    scene.faces = std::move(faces);
    scene.frames = {std::move(from), std::move(to)};
    return finished(std::move(scene));
}

/// Returns a strip of triangles along a random path, in which neighbours share vertices and each vertex moves on its own.
Scene random_motion(uint triangles, float way)
{
    std::mt19937 random(7);
    const auto uniform = [&] { return std::uniform_real_distribution<float>(-1, 1)(random); };
    const uint vertices = triangles;
    std::vector<Point> from, to;
    Point p = {0, 0, 0};
    for (uint k = 0; k < vertices; ++k) {
        p = {p.x + 0.1f * uniform(), p.y + 0.1f * uniform(), p.z + 0.1f * uniform()};
        from.push_back(p);
        to.push_back({p.x + way * uniform(), p.y + way * uniform(), p.z + way * uniform()});
    }
    std::vector<Face> faces;
    for (uint k = 0; k < triangles; ++k)
        faces.push_back({k, (k + 1) % vertices, (k + 2) % vertices});
    return moving_scene(std::move(faces), std::move(from), std::move(to));
}

/// Returns a square sheet of two triangles at rest, and a triangle that falls through it: v4 to v6, first above, then below.
Scene falling_triangle()
{
    const std::vector<Point> sheet = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    std::vector<Point> from = sheet, to = sheet;
    for (const auto& [x, y] :
         {std::pair(0.25f, 0.25f), std::pair(0.75f, 0.25f), std::pair(0.25f, 0.75f)}) {
        from.push_back({x, y, 1});
        to.push_back({x, y, -1});
    }
    return moving_scene({{0, 1, 2}, {0, 2, 3}, {4, 5, 6}}, std::move(from), std::move(to));
}

Input swept_input(const Scene& scene, const SweptParts& parts)
{
    Input input = uploaded(scene.frames[0], parts.faces, parts.objects);
    upload_end(input, session().device(), session().queue(), scene.frames[1]);
    return input;
}

/// Returns the pairs of boxes or, with a narrow phase, the contacts.
PairList pairs_by(const BuilderChoice& builder, const ColliderChoice& collider, const Input& input)
{
    Pipeline pipeline(session(), builder, collider, input);
    pipeline.begin_frame({});
    pipeline.prepare(input);
    return PairList(pipeline.has_contacts() ? pipeline.contacts() : pipeline.pairs());
}

PairList right_pairs(const Input& input, Among among)
{
    return touching_pairs(leaf_boxes(input), input.faces, false, input.objects, among);
}

/// Returns all pairs whose features come as near as a separation, of any boxes.
PairList right_contacts(const Input& input, Among among, double separation)
{
    const std::vector<Aabb> same(input.faces.size());
    const PairList all = touching_pairs(same, input.faces, false, input.objects, among);
    return pairs_of(touching_on_the_way(input.points, input.end_points, input.faces, all.pairs(),
                                        nullptr, separation));
}

TEST(SweptParts, AreVerticesAndFacesAndEachEdgeOnceByItsLargerVertex)
{
    const Scene scene = falling_triangle();
    const SweptParts vf = vertices_and_faces(scene), edges = unique_edges(scene);
    EXPECT_EQ(vf.objects, (std::vector<FaceRange>{{0, 7}, {7, 3}}));
    EXPECT_EQ(vf.faces[5].a, 5u);
    EXPECT_EQ(vf.faces[5].c, 5u);
    EXPECT_EQ(vf.faces[9].b, 5u);
    const std::pair<uint, uint> expected[] = {{0, 1}, {0, 2}, {1, 2}, {0, 3},
                                              {2, 3}, {4, 5}, {4, 6}, {5, 6}};
    ASSERT_EQ(edges.faces.size(), std::size(expected));
    for (uint k = 0; k < edges.faces.size(); ++k) {
        const auto [a, b] = expected[k];
        EXPECT_EQ(edges.faces[k].a, a);
        EXPECT_EQ(edges.faces[k].b, b);
        EXPECT_EQ(edges.faces[k].c, b);
        EXPECT_EQ(place_of_edge(edges, b, a), k);
    }
    EXPECT_EQ(place_of_edge(edges, 1, 3), std::nullopt);
    EXPECT_EQ(place_of_edge(edges, 5, 5), std::nullopt);
}

// Counted by hand: each vertex of the falling triangle passes through the boxes of both triangles of the sheet, and each corner
// of the sheet that belongs to only one of its triangles touches the other one's box. Three edges cross the sheet's diagonal.
TEST(SweptBoxes, OfATriangleFallingThroughASheetMeetAsCountedByHand)
{
    const Scene scene = falling_triangle();
    const SweptParts vf = vertices_and_faces(scene), edges = unique_edges(scene);
    const ColliderChoice between = {{.among = Among::between_objects, .keep_adjacent = false},
                                    "leaf"};
    EXPECT_EQ(pairs_by({.name = "oibvh-multi"}, between, swept_input(scene, vf)),
              PairList({{1, 8}, {3, 7}, {4, 7}, {4, 8}, {5, 7}, {5, 8}, {6, 7}, {6, 8}}));
    const ColliderChoice within = {{.among = Among::within_objects, .keep_adjacent = false},
                                   "leaf"};
    EXPECT_EQ(pairs_by({.name = "oibvh-multi"}, within, swept_input(scene, edges)),
              PairList({{1, 5}, {1, 6}, {1, 7}}));
    // In a single frame, hardly anything meets.
    const Input first = uploaded(scene.frames[0], vf.faces, vf.objects);
    EXPECT_EQ(pairs_by({.name = "oibvh-multi"}, between, first), PairList({{1, 8}, {3, 7}}));
}

TEST(SweptBoxes, HoldEveryFrameInBetween)
{
    for (const float way : {0.0f, 1e-7f, 0.1f, 3.0f, 1e6f, 1e30f}) {
        const Scene scene = random_motion(200, way);
        const Scene all = with_frames_between(scene, 50);
        ASSERT_EQ(all.frames.size(), 52u);
        for (const Face face : scene.faces) {
            const Aabb swept =
                swept_box(face_box(scene.frames[0], face), face_box(scene.frames[1], face));
            Aabb around = empty_box();
            for (const auto& points : all.frames)
                around = merged(around, face_box(points, face));
            EXPECT_EQ(std::memcmp(&swept, &around, sizeof swept), 0) << way;
        }
    }
}

/// One builder of implicit trees and one of radix trees: another test shows that all builders make the same boxes.
class SweptPairs : public testing::TestWithParam<const char*> {};

TEST_P(SweptPairs, AreThoseOfTheSweepByEveryColliderAndWithASeparationMissNone)
{
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL: there is no reference";
    const Scene scene = random_motion(300, 0.2f);
    const SweptParts parts[] = {vertices_and_faces(scene), unique_edges(scene)};
    const Among among[] = {Among::between_objects, Among::within_objects};
    for (const int k : {0, 1}) {
        const Input input = swept_input(scene, parts[k]);
        const PairList right = right_pairs(input, among[k]);
        const Input still = uploaded(scene.frames[0], parts[k].faces, parts[k].objects);
        ASSERT_GT(right.size(), 2 * right_pairs(still, among[k]).size());
        std::map<double, PairList> near;
        for (const double separation : {1e-6, 0.02, 0.5})
            near[separation] = right_contacts(input, among[k], separation);
        for (int turn = 0; const ColliderEntry& collider : box_colliders(false)) {
            ++turn;
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks}) {
                if (!takes_combination({k, turn, form == KernelForm::chunks}))
                    continue;
                SCOPED_TRACE(std::string(collider.name) + ' ' + name_of(form));
                ColliderChoice choice = {{.among = among[k], .keep_adjacent = false},
                                         std::string(collider.name)};
                choice.form = form;
                const BuilderChoice builder = {.name = collider.needs_tree ? GetParam() : "none"};
                EXPECT_EQ(pairs_by(builder, choice, input), right);
                if (make_collider(choice, session().programs())->is_on_host())
                    continue;  // which is refused
                choice.narrow = "ccd-f64-1e-6";
                for (const auto& [separation, contacts] : near) {
                    choice.distance = separation;
                    const PairList found = pairs_by(builder, choice, input);
                    EXPECT_EQ(differences(found, contacts).missed, 0u) << separation;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Builders, SweptPairs, testing::Values("oibvh-single", "karras"),
                         CaseName());

TEST(SweptBoxes, OfAllBuildersAreThoseOfTheReferenceOrAreRefused)
{
    const Scene scene = random_motion(150, 0.5f);
    const SweptParts edges = unique_edges(scene);
    const Input input = swept_input(scene, edges);
    for (const BuilderEntry& entry : builder_catalog()) {
        if (entry.make == nullptr)
            continue;
        SCOPED_TRACE(entry.name);
        const auto builder = make_builder({.name = std::string(entry.name)}, session().programs());
        builder->reserve(edges.faces.size());
        const Tree* tree = nullptr;
        if (entry.name.starts_with("fcl")) {
            EXPECT_THROW(session().build_once(*builder, input, Start::from_triangles, &tree),
                         BadUsage);
            session().renew_queue();
            continue;
        }
        session().build_once(*builder, input, Start::from_triangles, &tree);
        for (const HostTree::Node& node : tree->to_host_tree().nodes)
            if (node.primitive != HostTree::none) {
                const Aabb right =
                    leaf_box(input, edges.faces[static_cast<std::size_t>(node.primitive)]);
                EXPECT_EQ(std::memcmp(&node.box, &right, sizeof right), 0);
            }
    }
}

/// Returns the cells of all steps of a scene.
std::vector<Cell> cells_of(CollideTask task)
{
    std::vector<Cell> cells;
    int order = 0;
    task.swept = true;
    task.frames = {0, 0};
    task.samples = 1;
    task.warm_up = 0;
    collide_frames(session(), task, order, [&](std::vector<Cell>&& some, const Found&) {
        cells.insert(cells.end(), std::make_move_iterator(some.begin()),
                     std::make_move_iterator(some.end()));
    });
    return cells;
}

// Consecutive steps share buffers, which they exchange, and a front continues over them.
TEST(SweptSteps, OfASequenceAreEachHeldToTheSweep)
{
    CollideTask task;
    task.scene = "cloth-ball:600:12";
    task.pipelines = {
        {{{.order = "hilbert30"}, "oibvh-single"}, {.name = "group"}},
        {{.name = "oibvh-multi"}, {.name = "front"}},
        {{{.order = "kd"}, "oibvh-multi"}, {{.among = Among::within_objects}, "leaf"}}};
    const std::vector<Cell> cells = cells_of(task);
    ASSERT_EQ(cells.size(), 11u * 5u);
    std::vector<std::optional<std::uint64_t>> hashes;
    for (const Cell& cell : cells) {
        EXPECT_EQ(cell.check.verdict, Check::Verdict::agrees) << cell.check.detail << cell.reason;
        EXPECT_EQ(cell.features.to_frame, cell.scene.frame + 1);
        EXPECT_EQ(cell.counters.at("missed_count"), 0);
        hashes.push_back(cell.check.pairs_hash);
    }
    EXPECT_NE(hashes.front(), hashes[hashes.size() - 5]);
}

// A swept box rounded outward has false pairs and misses none.
TEST(SweptSteps, OverRoundedBoxesMissNothing)
{
    CollideTask task;
    task.scene = "cloth-ball:600:3";
    task.pipelines = {
        {{{.order = "hilbert30", .sorted_leaves = true, .boxes = "u8"}, "oibvh-single"},
         {.name = "group"}}};
    const std::vector<Cell> cells = cells_of(task);
    ASSERT_EQ(cells.size(), 2u * 2u);
    for (const Cell& cell : cells) {
        EXPECT_EQ(cell.check.verdict, Check::Verdict::counted) << cell.check.detail << cell.reason;
        EXPECT_EQ(cell.counters.at("missed_count"), 0);
        EXPECT_GT(cell.counters.at("false_count"), 0);
    }
}

TEST(SweptSteps, OfDataFindTheWholeGroundTruthAsManyPairsAsItsAuthorCountedAndAllThatTouches)
{
    if (data_folder().empty())
        GTEST_SKIP() << "no data folder";
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL: there is no reference";
    const BuilderChoice builder = {{.order = "hilbert30", .sorted_leaves = true}, "oibvh-single"};
    CollideTask task;
    task.scene = "ipc_armadillo_rollers";
    task.pipelines = {{builder, {.name = "group"}},
                      {builder, {{.among = Among::between_objects}, "group", "ccd-1e-4"}}};
    std::vector<Cell> cells = cells_of(task);
    ASSERT_EQ(cells.size(), 3u);
    auto& counters = cells[1].counters;
    EXPECT_EQ(cells[1].check.verdict, Check::Verdict::counted) << cells[1].check.detail;
    EXPECT_EQ(counters.at("missed_count"), 0);
    EXPECT_EQ(counters.at("ground_truth_pairs"), 4650);
    EXPECT_EQ(counters.at("ground_truth_missed"), 0);
    // The reference finds what the data's author found.
    EXPECT_EQ(counters.at("contacts_count") - counters.at("false_count"), 4650);
    EXPECT_LT(counters.at("false_count"), 4650);
    cells.erase(cells.begin() + 1);
    const double pairs[] = {2032004, 5068352}, listed[] = {4652, 19313};
    for (const std::size_t k : {0, 1}) {
        EXPECT_EQ(cells[k].check.verdict, Check::Verdict::agrees) << cells[k].check.detail;
        EXPECT_EQ(cells[k].check.against, std::string(pairs_oracle) + ", ground truth, meta.json");
        EXPECT_EQ(cells[k].counters.at("pairs_count"), pairs[k]);
        EXPECT_EQ(cells[k].counters.at("reference_pairs_count"), pairs[k]);
        EXPECT_EQ(cells[k].counters.at("ground_truth_pairs"), listed[k]);
        EXPECT_EQ(cells[k].counters.at("ground_truth_missed"), 0);
    }
}

}  // namespace
}  // namespace bvhbench
