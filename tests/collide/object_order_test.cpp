// SPDX-License-Identifier: MIT
//
// Queries of many objects. They are swept in an order, not tested each against each.
#include "collide/object_order.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

/// Small objects in a lattice, each overlapping its neighbours and many beginning at the same place, on a floor below all of them;
/// one lies far away, and two are the same.
ManyObjects crowd(std::size_t side)
{
    ManyObjects many({});
    Mesh floor = scene_mesh("grid:90");
    for (Point& point : floor.points)
        point = {(point.x - 0.1f) * 2 * static_cast<float>(side),
                 point.y * 2 * static_cast<float>(side), 0.1f};
    many.add(floor);
    const std::vector<Mesh> parts = {crowded_mesh(1), crowded_mesh(2), crowded_mesh(40)};
    for (std::size_t k = 0; k < side * side * side; ++k) {
        Mesh part = parts[k % 17 == 3 ? 2 : k % 2];
        for (Point& point : part.points) {
            point.y += 0.7f * static_cast<float>(k / side % side) + (k == 7 ? 1000.0f : 0.0f);
            point.z += 0.7f * static_cast<float>(k / side / side);
        }
        many.add(part, 0.7f * static_cast<float>(k % side));
    }
    many.add(parts[0]);
    many.add(parts[0]);
    return many;
}

class ObjectOrderTest : public testing::TestWithParam<ObjectsCase> {
protected:
    std::unique_ptr<Collider> collider(Among among, unsigned rules_off = 0) const
    {
        return made(std::get<0>(GetParam()).name,
                    {.among = among, .rules_off = rules_off, .form = std::get<2>(GetParam())});
    }
    /// Returns just enough objects to have an order.
    ManyObjects many() const
    {
        const std::size_t least = ObjectOrder::least_objects(std::get<2>(GetParam()));
        ManyObjects many = crowd(least > 512 ? 13 : 8);
        EXPECT_GE(many.objects.size(), least);
        return many;
    }
    Standing standing(const ManyObjects& many, const BuildOptions& options = {}) const
    {
        return many.standing(find_builder(std::get<1>(GetParam()).name).make, options);
    }
};

TEST_P(ObjectOrderTest, LosesNoPair)
{
    ManyObjects many = this->many();
    Standing standing = this->standing(many);
    for (const Among among : {Among::between_objects, Among::all}) {
        const auto swept = collider(among);
        expect_oracles_pairs(*swept, standing, true, among);
        const double tests =
            static_cast<double>(swept->counts(session().queue()).box_tests.value());
        const auto tested_all = collider(among, skip_apart);
        expect_oracles_pairs(*tested_all, standing, true, among);
        EXPECT_LT(tests, 0.8 * static_cast<double>(
                                   tested_all->counts(session().queue()).box_tests.value()));
    }
    // Later all objects begin at one place along the axis of the order.
    const auto swept = collider(Among::between_objects);
    expect_oracles_pairs(*swept, standing, true, Among::between_objects);
    for (const float scale : {0.0f, -1.0f}) {
        std::vector<Point> moved = many.mesh.points;
        for (std::size_t k = 0; k < moved.size(); ++k)
            moved[k] = {moved[k].z, moved[k].x * scale, moved[k].y * scale};
        standing.place(moved);
        standing.build();
        expect_pairs(*swept, standing, standing.expected(true, Among::between_objects));
    }
}

TEST_P(ObjectOrderTest, LosesNoPairInOtherFormats)
{
    const ManyObjects many = this->many();
    for (const char* format : {"f64", "u8"}) {
        if (!find_builder(std::get<1>(GetParam()).name).takes_formats)
            continue;
        SCOPED_TRACE(format);
        const Standing standing = this->standing(many, {.sorted_leaves = true, .boxes = format});
        const auto pairs = [&](unsigned rules_off) {
            const auto one = collider(Among::between_objects, rules_off);
            one->reserve(standing.tree, standing.input);
            find_pairs(*one, standing.tree, standing.input, session().queue());
            return PairList(one->pairs(session().queue()));
        };
        const PairList all = pairs(skip_apart);
        EXPECT_GT(all.size(), 0u);
        EXPECT_EQ(pairs(0), all);
    }
}

INSTANTIATE_TEST_SUITE_P(Trees, ObjectOrderTest, testing::ValuesIn(cases_of_objects()), CaseName());

}  // namespace
}  // namespace bvhbench
