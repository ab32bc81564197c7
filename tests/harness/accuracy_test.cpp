// SPDX-License-Identifier: MIT
//
// Tests that errors are counted correctly, that references are exact, and that each axis finds errors known to be there.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "collide/narrow/narrow_methods.h"
#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/judge/metrics.h"
#include "harness/judge/pair_counts.h"
#include "scenes/generate/pair_classes.h"
#include "scenes/generate/random.h"

namespace bvhbench {
namespace {

/// Returns a root with two leaves: surface areas 54, 6 and 24.
HostTree small_tree()
{
    HostTree tree;
    tree.nodes.resize(3);
    tree.nodes[0].box = {0, 0, 0, 3, 3, 3};
    tree.nodes[0].child = {1, 2};
    tree.nodes[1] = {.box = {0, 0, 0, 1, 1, 1}, .child = {}, .primitive = 0};
    tree.nodes[2] = {.box = {1, 1, 1, 3, 3, 3}, .child = {}, .primitive = 1};
    return tree;
}

TEST(Accuracy, SumsAreThoseOfTheFormula)
{
    const long double right = cost_in_long_double(small_tree());
    EXPECT_NEAR(static_cast<double>(right), 1.2 + 30.0 / 54, 1e-15);
    for (const SumMethod& method : sum_methods()) {
        const bool in_floats = method.name.starts_with("f32");
        EXPECT_NEAR(static_cast<double>(method.cost(small_tree())), 1.2 + 30.0 / 54,
                    in_floats ? 2e-7 : 1e-15)
            << method.name;
    }
}

TEST(Accuracy, SumsOfManyLeavesShowWhatEachWayLoses)
{
    HostTree tree = small_tree();
    Random random(3);
    for (int k = 2; k < 300'000; ++k) {
        const float low = random.unit();
        tree.nodes.push_back(
            {.box = {low, low, low, low + random.unit(), low + 1, low + random.unit()},
             .child = {},
             .primitive = k});
    }
    const long double right = cost_in_long_double(tree);
    std::map<std::string_view, double> errors;
    for (const SumMethod& method : sum_methods())
        errors[method.name] = static_cast<double>(std::abs((method.cost(tree) - right) / right));
    EXPECT_GT(errors["f32"], 10 * errors["f32-pairwise"]);
    EXPECT_LT(errors["f32-compensated"], 2e-7);
    EXPECT_GT(errors["f64"], 1e-16);
    EXPECT_LT(errors["f64-pairwise"], 1e-15);
    EXPECT_LT(errors["f64-compensated"], 4e-16);
    EXPECT_EQ(sum_methods().back().cost(tree), area_sums(tree)->cost());
}

TEST(Accuracy, CodesAreCountedAsEqualAsTheyAre)
{
    // Three equal boxes, two equal ones close by, and one so far off that 30 bits cannot separate the first five.
    std::vector<Point> points;
    std::vector<Face> faces;
    for (const float x : {0.0f, 0.0f, 1e-4f, 0.0f, 1e-4f, 1.0f}) {
        const auto first = static_cast<uint>(points.size());
        points.insert(points.end(), {{x, 0, 0}, {x, 0, 0}, {x, 0, 0}});
        faces.push_back({first, first + 1, first + 2});
    }
    const FaceRange all[] = {{0, 6}}, three[] = {{0, 3}, {3, 2}, {5, 1}};
    const CodeCounts few = code_counts(find_order("morton30"), points, faces, all);
    EXPECT_EQ(few.duplicates, 4u);
    EXPECT_EQ(few.longest_run, 5u);
    for (const char* order : {"morton48", "morton63"}) {
        const CodeCounts many = code_counts(find_order(order), points, faces, all);
        EXPECT_EQ(many.duplicates, 3u);
        EXPECT_EQ(many.longest_run, 3u);
    }
    // With three objects, the boxes of one object that are close together get different codes only on its own grid.
    const auto split = [&](GridOver grid) {
        return code_counts(find_order("morton30"), points, faces, three, grid);
    };
    EXPECT_EQ(split(GridOver::object).duplicates, 1u);
    EXPECT_EQ(split(GridOver::object).longest_run, 2u);
    EXPECT_EQ(split(GridOver::scene).duplicates, 3u);
    EXPECT_EQ(split(GridOver::scene).longest_run, 3u);
}

TEST(Accuracy, BoxesOfDoublesOverlapAsThoseOfTheFloatsTheyAre)
{
    const Mesh mesh = apart_pairs(find_pair_class("lattice_8"), 300, 1);
    std::vector<WidePoint> wide;
    for (const Point p : mesh.points)
        wide.push_back({p.x, p.y, p.z});
    const PairList in_doubles = overlapping_pairs_in_doubles(wide, mesh.faces);
    EXPECT_GT(in_doubles.size(), 1000u);
    EXPECT_EQ(in_doubles, touching_pairs(mesh.points, mesh.faces, true));
}

TEST(Accuracy, RoundingAddsPairsFarOffAndTakesNoneAway)
{
    const Mesh mesh = apart_pairs(find_pair_class("needles"), 400, 1);
    std::size_t added_last = 0;
    for (const double sizes : {0.0, 1e5, 1e7}) {
        const std::vector<WidePoint> wide = turned_and_moved(mesh.points, sizes);
        const PairList right = overlapping_pairs_in_doubles(wide, mesh.faces);
        const auto wrong = [&](Doubles how) {
            return differences(touching_pairs(rounded(wide, how), mesh.faces, true), right);
        };
        EXPECT_EQ(wrong(Doubles::as_is).missed, 0u);
        EXPECT_EQ(wrong(Doubles::recentred).missed, 0u);
        EXPECT_LE(wrong(Doubles::recentred).false_ones, right.size() / 1000);
        added_last = wrong(Doubles::as_is).false_ones;
    }
    EXPECT_GT(added_last, 100u);
}

TEST(Accuracy, AGridRoundsEachCoordinateToTheNearestOfItsPositions)
{
    // The longest side is from 1 to 8: with three bits its positions are the whole numbers.
    const std::vector<Point> points = {
        {1, 10, -3}, {8, 10.4f, -3}, {2.4f, 11.6f, -3}, {2.6f, 10.5f, -3}, {1.25f, 12, -3}};
    const std::vector<Point> right = {
        {1, 10, -3}, {8, 10, -3}, {2, 12, -3}, {3, 11, -3}, {1, 12, -3}};
    const auto equal = [](const std::vector<Point>& a, const std::vector<Point>& b) {
        return std::ranges::equal(
            a, b, [](Point p, Point q) { return p.x == q.x && p.y == q.y && p.z == q.z; });
    };
    EXPECT_TRUE(equal(on_a_grid(points, 3), right));
    EXPECT_TRUE(equal(on_a_grid(points, 30), points));  // finer than floats
    const std::vector<Point> same(3, {5, 6, 7});
    EXPECT_TRUE(equal(on_a_grid(same, 1), same));
}

/// Returns the cells of an axis, by "input/method".
std::map<std::string, Cell> measured(std::string_view axis, const AxisTask& task)
{
    static Session& session = *new Session(CommonOptions{});  // never destroyed: no driver at exit
    std::map<std::string, Cell> cells;
    Progress progress(1);
    int order = 0;
    find_axis(axis).measure({session, task, order, progress, [&](Cell&& cell) {
                                 const std::string key =
                                     cell.scene.name + '/' + cell.accuracy.method;
                                 cells.emplace(key, std::move(cell));
                             }});
    return cells;
}

TEST(Accuracy, OfNarrowPhasesFindsTheErrorsThatAreThere)
{
    if (!has_exact_reference)
        GTEST_SKIP() << "built without CGAL: nothing is compared";
    const AxisTask task{
        .scenes = {}, .pairs = 46'000, .pairs_at_once = 700, .samples = 2, .filter = {}};
    const auto cells = measured("narrow", task);
    EXPECT_EQ(cells.size(), pair_classes().size() * narrow_methods(NarrowOf::moment).size());
    double total = 0;
    for (const auto& [name, cell] : cells) {
        SCOPED_TRACE(name);
        ASSERT_EQ(cell.status, Cell::Status::measured) << cell.reason;
        ASSERT_EQ(cell.samples.size(), 2u);
        const double pairs = cell.counters.at("pairs_count"),
                     meeting = cell.counters.at("meeting_count");
        const Meeting promised = find_pair_class(cell.scene.name).meeting;
        EXPECT_TRUE(promised == Meeting::some || meeting == (promised == Meeting::all ? pairs : 0));
        EXPECT_EQ(cell.counters.at("narrow_float_count") + cell.counters.at("narrow_double_count") +
                      cell.counters.at("narrow_exact_count"),
                  pairs);
        for (const Sample& sample : cell.samples) {
            ASSERT_EQ(sample.stages.size(), 1u);
            EXPECT_GT(sample.stages[0].span_ns, 0);
            // Each sample includes all pieces.
            EXPECT_EQ(sample.stages[0].moved_bytes % 8, 0);
            EXPECT_GT(sample.stages[0].moved_bytes, 104 * static_cast<std::int64_t>(pairs) - 1);
        }
        if (find_narrow_method(cell.accuracy.method).is_exact) {
            EXPECT_EQ(cell.counters.at("missed_count") + cell.counters.at("false_count"), 0);
            EXPECT_EQ(cell.check.verdict, Check::Verdict::agrees);
            total += pairs;
        } else {
            EXPECT_EQ(cell.check.verdict, Check::Verdict::counted);
        }
    }
    EXPECT_EQ(total, 46'000);
    EXPECT_GT(cells.at("same_place/guigue-f32").counters.at("missed_count"), 100);
    EXPECT_GT(cells.at("near_touching/guigue-f32").counters.at("false_count"), 3);
    EXPECT_GT(cells.at("needles/moller-f32").counters.at("false_count"), 100);
}

TEST(Accuracy, OfScenesMeasuresWhatIsAsked)
{
    const AxisTask task{
        .scenes = {"soup:700"}, .samples = 2, .filter = cell_filter("f64|63|recentred")};
    const auto sums = measured("sums", task);
    EXPECT_EQ(sums.size(), 3u);
    EXPECT_EQ(sums.at("soup:700/f64-compensated").check.verdict, Check::Verdict::agrees);
    const auto codes = measured("codes", task);
    EXPECT_EQ(codes.size(), 4u);
    for (const auto& [name, cell] : codes) {
        EXPECT_EQ(cell.check.verdict, Check::Verdict::agrees) << name;
        EXPECT_EQ(cell.counters.at("longest_run_count"), 1) << name;
        EXPECT_GT(cell.counters.at("box_tests_count"), 700) << name;
        EXPECT_EQ(cell.samples.size(), 2u) << name;
    }
    const auto input = measured("input", task);
    EXPECT_EQ(input.size(), 6u);
    for (const auto& [name, cell] : input)
        EXPECT_EQ(cell.counters.at("missed_count"), 0) << name;
    const auto place = measured("place", {.scenes = {"two-spheres:3000"}, .samples = 1});
    EXPECT_EQ(place.size(), 14u);
    for (const auto& [name, cell] : place) {
        EXPECT_EQ(cell.counters.at("missed_count"), 0) << name;
        EXPECT_EQ(cell.check.verdict == Check::Verdict::agrees, name.ends_with("/exact")) << name;
    }
    EXPECT_GT(place.at("two-spheres:3000 at 1e5/exact").counters.at("narrow_exact_count"),
              10 + place.at("two-spheres:3000 at 0/exact").counters.at("narrow_exact_count"));
    EXPECT_THROW(find_axis("depth"), BadUsage);
}

}  // namespace
}  // namespace bvhbench
