// SPDX-License-Identifier: MIT
//
// Pairs of triangles within a distance are those of CGAL's exact distances, over boxes that the host pads.
#include "collide/within/within.h"
#include "scenes/generate/pair_classes.h"
#include "tests/collide/many_objects.h"
#include "tests/needing.h"

namespace bvhbench {
namespace {

/// Returns the oracle's pairs.
PairList oracle(const Input& input, double distance, bool keep_adjacent, Among among = Among::all)
{
    std::vector<Aabb> boxes = leaf_boxes(input);
    pad_boxes(boxes, distance);
    const PairList candidates =
        touching_pairs(boxes, input.faces, keep_adjacent, input.objects, among);
    return pairs_within(input.points, input.faces, candidates.pairs(), keep_adjacent, distance);
}

/// What a query found, how often it was asked, and how many pairs were left to exact arithmetic.
struct Answer {
    PairList pairs;
    int queries = 0;
    std::uint64_t exactly = 0;
    double error = 0;  ///< the largest of a distance that was computed
};

/// Asks a collider over the builder of `standing`, or over none, with padded boxes.
Answer asked(const Standing& standing, std::string_view name, const WithinOptions& options,
             Among among = Among::all)
{
    Queue& queue = session().queue();
    const auto collider = made(name, {.among = among,
                                      .keep_adjacent = options.keep_adjacent,
                                      .form = options.form,
                                      .capacity = options.capacity});
    WithinPhase phase(session().programs(), options);
    phase.reserve(standing.input.device_points.size(), standing.input.triangle_count());
    collider->reserve(standing.tree, standing.input);
    Answer answer;
    do {
        const Input wide = phase.padded(standing.input, queue);
        const Tree* tree =
            standing.builder != nullptr ? &standing.builder->build(wide, queue) : nullptr;
        collider->query(tree, wide, queue);
        phase.query(standing.input, collider->device_pairs(queue), queue);
        queue.finish();
        ++answer.queries;
    } while (!collider->complete(queue) || !phase.complete(queue));
    answer.pairs = PairList(phase.pairs(queue));
    answer.exactly = phase.counts(queue).exactly;
    for (const double error : phase.distance_errors(standing.input, queue))
        answer.error = error;  // they are sorted
    EXPECT_EQ(answer.pairs.surplus(), 0u);
    EXPECT_EQ(answer.pairs.size(), phase.counts(queue).within);
    return answer;
}

/// Triangles with corners on a lattice, so that many are points or segments and many distances are equal; some share corners.
Mesh lattice_mesh(uint count, float unit, Point at, Dice& dice)
{
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const Point start = dice.lattice(14);
        for (int corner = 0; corner < 3; ++corner) {
            const Point by = dice.lattice(4);
            mesh.points.push_back({at.x + unit * (start.x + by.x), at.y + unit * (start.y + by.y),
                                   at.z + unit * (start.z + by.z)});
        }
        const uint shared = k == 0 ? 0 : dice.below(3) / 2 * (1 + dice.below(2)), first = 3 * k;
        mesh.faces.push_back(
            {first - (shared > 0 ? 3 : 0), first + 1 - (shared > 1 ? 3 : 0), first + 2});
    }
    return mesh;
}

/// Distances of points of a lattice, doubles around them, and ones that are tiny and huge.
std::vector<double> distances_of(double unit)
{
    std::vector<double> all = {0, 5e-324, 1e-30, 1e30, 1e300};
    for (const double square : {1.0, 2.0, 9.0, 14.0, 25.0}) {
        const double near = unit * std::sqrt(square);
        all.insert(all.end(), {near, std::nextafter(near, 0), std::nextafter(near, 2 * near)});
    }
    return all;
}

class WithinDistance : public Needing<testing::Test, cgal_absent> {};

class WithinDistanceTest
    : public WithinDistance,
      public testing::WithParamInterface<std::tuple<Named, Named, KernelForm>> {
protected:
    static std::string_view collider() { return std::get<1>(GetParam()).name; }
    static Standing standing(const Mesh& mesh, std::span<const FaceRange> objects = {})
    {
        const std::string_view builder = std::get<0>(GetParam()).name;
        return {mesh, builder == "none" ? nullptr : find_builder(builder).make, {}, objects};
    }
    static Answer found(const Standing& standing, WithinOptions options, Among among = Among::all)
    {
        options.form = std::get<2>(GetParam());
        return asked(standing, collider(), options, among);
    }
};

TEST_P(WithinDistanceTest, AreThoseOfTheOracle)
{
    Dice dice(1);
    std::size_t found_in_all = 0;
    for (const auto& [unit, at] : {std::pair(1.0f, Point{0, 0, 0}),
                                   {0.3f, {-1, 7, 4000}},
                                   {0x1p-70f, {0, 0, 0}},
                                   {0x1p90f, {0, 0, 0}}}) {
        const Standing standing = this->standing(lattice_mesh(90, unit, at, dice));
        for (const double distance : distances_of(unit))
            for (const bool keep : {false, true}) {
                SCOPED_TRACE(testing::Message() << unit << ", distance " << distance << keep);
                const PairList wanted = oracle(standing.input, distance, keep);
                EXPECT_EQ(found(standing, {.distance = distance, .keep_adjacent = keep}).pairs,
                          wanted);
                found_in_all += wanted.size();
            }
    }
    EXPECT_GT(found_in_all, 10000u);
}

TEST_P(WithinDistanceTest, AreThoseBetweenOrWithinObjects)
{
    Dice dice(2);
    ManyObjects many({});
    for (uint k = 0; k < 12; ++k)
        many.add(lattice_mesh(1 + dice.below(20), 1, {}, dice), static_cast<float>(k));
    const Standing standing = this->standing(many.mesh, many.objects);
    for (const Among among : {Among::all, Among::between_objects, Among::within_objects})
        for (const double distance : {0.0, 1.0, 3.0, 1000.0}) {
            SCOPED_TRACE(testing::Message() << static_cast<int>(among) << " at " << distance);
            const PairList wanted = oracle(standing.input, distance, true, among);
            EXPECT_GT(wanted.size(), 0u);
            EXPECT_EQ(found(standing, {.distance = distance, .keep_adjacent = true}, among).pairs,
                      wanted);
        }
}

TEST_P(WithinDistanceTest, AreCompleteWhereListsAreShort)
{
    Dice dice(3);
    const Standing standing = this->standing(lattice_mesh(60, 1, {}, dice));
    const PairList wanted = oracle(standing.input, 3, true);
    for (const bool without : {false, true}) {
        const Answer answer = found(
            standing,
            {.distance = 3, .keep_adjacent = true, .capacity = 1, .without_doubles = without});
        EXPECT_EQ(answer.pairs, wanted);
        EXPECT_GT(answer.queries, 1);
        EXPECT_EQ(answer.exactly > 0, !without) << "the host decided all, or what was unsure";
    }
    Mesh points;  // all 5 apart but for the last digits; one pair is not farther
    for (uint k = 0; k < 40; ++k) {
        const float x = 100 * static_cast<float>(k);
        points.points.insert(points.points.end(), {{x, 0, 0}, {x + 3, 4, k == 7 ? 0 : 0x1p-30f}});
        points.faces.insert(points.faces.end(),
                            {{2 * k, 2 * k, 2 * k}, {2 * k + 1, 2 * k + 1, 2 * k + 1}});
    }
    const Answer answer = found(this->standing(points), {.distance = 5, .capacity = 1});
    EXPECT_EQ(answer.pairs, PairList({{14, 15}}));
    EXPECT_EQ(answer.exactly, 40u);
}

INSTANTIATE_TEST_SUITE_P(
    Over, WithinDistanceTest,
    testing::Combine(testing::ValuesIn(first_by_day<Named>(
                         2, {{"oibvh-multi"}, {"apetrei-fused"}, {"oibvh-wide8"}})),
                     testing::ValuesIn(first_by_day<Named>(1, {{"group"}, {"leaf"}, {"block"}})),
                     both_forms),
    CaseName());
INSTANTIATE_TEST_SUITE_P(OverBinary, WithinDistanceTest,
                         testing::Combine(testing::Values(Named{"oibvh-multi"}),
                                          testing::Values(Named{"bvtt"}, Named{"front"}),
                                          both_forms),
                         CaseName());
INSTANTIATE_TEST_SUITE_P(WithoutTrees, WithinDistanceTest,
                         testing::Combine(testing::Values(Named{"none"}),
                                          testing::Values(Named{"grid"}, Named{"all-pairs"},
                                                          Named{"sort-sweep"}),
                                          both_forms),
                         CaseName());

/// Says of two triangles alone whether they are within a distance: the device, and the host without it.
bool two_within(const Mesh& mesh, double distance)
{
    const Standing standing(mesh, nullptr);
    const WithinOptions options = {.distance = distance, .form = KernelForm::chunks};
    const bool is_within = asked(standing, "all-pairs", options).pairs.size() == 1;
    EXPECT_EQ(are_within(mesh.points, mesh.faces, {0, 1}, options), is_within);
    return is_within;
}

TEST_F(WithinDistance, IsSeldomLeftToExactArithmetic)
{
    Dice dice(4);
    Mesh mesh = mesh_of_many_sizes(400);
    const Standing standing(mesh, "oibvh-multi");
    for (const double distance : {0.01, 0.3}) {
        const Answer answer = asked(standing, "leaf", {.distance = distance});
        EXPECT_EQ(answer.pairs, oracle(standing.input, distance, false));
        EXPECT_EQ(answer.exactly, 0u) << "of " << answer.pairs.size();
    }
}

/// Shapes have false pairs, and methods as computed have none here, nor distances that are far off.
TEST_F(WithinDistance, IsFoundByOtherMethods)
{
    const Mesh mesh = scene_mesh("torus:3000");
    const Standing standing(mesh, "oibvh-multi");
    WithinOptions options = {.distance = 0.02, .keep_adjacent = true};
    const PairList right = asked(standing, "leaf", options).pairs;
    for (const NarrowMethod& method : narrow_methods(NarrowOf::distance)) {
        options.method = method.name;
        const Answer answer = asked(standing, "leaf", options);
        EXPECT_TRUE(std::ranges::includes(answer.pairs.pairs(), right.pairs())) << method.name;
        EXPECT_LT(answer.error, method.real_bits == 64 ? 1e-13 : 1e-4) << method.name;
        EXPECT_EQ(answer.error > 0, !method.misses_none()) << method.name;
        EXPECT_EQ(answer.pairs.size() > right.size(), method.misses_none()) << method.name;
    }
}

TEST_F(WithinDistance, IsPaddedOutward)
{
    for (const double distance : {1.0, 3.0, 0.7, 1 + 0x1p-25, 1e-3, 1e-40, 123456789.0}) {
        const auto half = static_cast<float>(distance / 2);
        for (const float at :
             {0.0f, 1.0f, 0x1p24f, 3e7f, 1e20f, -half, std::nextafter(-half, 0.0f)})
            for (int axis = 0; axis < 3; ++axis) {
                std::array<float, 3> low = {at, at, at}, high = low;
                const auto k = static_cast<std::size_t>(axis);
                high[k] = static_cast<float>(at + distance);
                if (double{high[k]} - at > distance)
                    high[k] = std::nextafter(high[k], at);
                const Point p = {low[0], low[1], low[2]}, q = {high[0], high[1], high[2]};
                EXPECT_TRUE(two_within({{p, p, p, q, q, q}, {{0, 1, 2}, {3, 4, 5}}}, distance))
                    << at << " and " << distance << " farther";
            }
    }
}

}  // namespace
}  // namespace bvhbench
