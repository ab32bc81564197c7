// SPDX-License-Identifier: MIT
//
// Several objects in a frame: a build makes a tree of each, and every collider finds the oracle's pairs between or within them.
#include "builders/host_tree.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

const std::vector<std::size_t> few_sizes = {1, 70, 3, 2, 129, 200, 1};

const DeviceTree& forest_of(const Standing& standing)
{
    return dynamic_cast<const DeviceTree&>(*standing.tree);
}

/// Returns an object's triangles alone.
Mesh alone(const ManyObjects& many, const FaceRange& object)
{
    const auto first = many.mesh.faces.begin() + object.first;
    return {many.mesh.points, {first, first + object.count}};
}

/// Returns an object's tree, over the triangles of alone().
HostTree tree_of(const Standing& standing, const ManyObjects& many, uint object)
{
    HostTree tree = forest_of(standing).object_to_host_tree(object);
    for (HostTree::Node& node : tree.nodes)
        if (node.primitive != HostTree::none)
            node.primitive -= static_cast<int>(many.objects[object].first);
    return tree;
}

class Objects : public testing::TestWithParam<std::tuple<BuilderEntry, Leaves>> {
protected:
    const BuilderEntry& builder() const { return std::get<0>(GetParam()); }
    BuildOptions options() const
    {
        return {.sorted_leaves = std::get<1>(GetParam()) == Leaves::sorted};
    }
};

TEST_P(Objects, HaveEachATreeOverTheirOwnTriangles)
{
    const ManyObjects many(few_sizes);
    const Standing standing = many.standing(builder().make, options());
    ASSERT_EQ(forest_of(standing).objects.size(), many.objects.size());
    std::size_t nodes = 0;
    for (uint k = 0; k < many.objects.size(); ++k) {
        const HostTree tree = tree_of(standing, many, k);
        const Mesh own = alone(many, many.objects[k]);
        nodes += tree.nodes.size();
        EXPECT_EQ(invariant_violation(tree, own.points, own.faces), "") << "object " << k;
    }
    EXPECT_LE(nodes, standing.tree->node_count());
}

/// With few objects, codes lose no bits to the object number, so each tree equals the tree of its object alone. Radix trees break
/// ties of codes by positions in the whole sequence, which differ.
TEST_P(Objects, HaveTheTreesThatTheyHaveAlone)
{
    const ManyObjects many({300, 64, 65, 1});
    const Standing standing = many.standing(builder().make, options());
    if (!forest_of(standing).is_implicit())
        return;
    for (uint k = 0; k < many.objects.size(); ++k) {
        const Standing one(alone(many, many.objects[k]), builder().make, options());
        EXPECT_EQ(tree_hash(tree_of(standing, many, k)), tree_hash(one.tree->to_host_tree())) << k;
    }
}

TEST_P(Objects, AreHeldAgainstEachOtherByEveryCollider)
{
    const ManyObjects many(few_sizes);
    const Standing standing = many.standing(builder().make, options());
    const auto& queried = builders_to_query();
    const auto place = std::ranges::find(queried, builder().name, &BuilderEntry::name);
    int turn = static_cast<int>(place - queried.begin());
    for (const char* name : {"leaf", "bvtt", "group"})
        for (const Among among : {Among::all, Among::between_objects, Among::within_objects}) {
            ++turn;
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
                for (const std::size_t capacity : {0u, 1u}) {
                    // By day each collider meets each tree once for each kind of pairs; the other settings take turns.
                    const bool is_taken =
                        place != queried.end()
                            ? takes_combination({turn, form == KernelForm::chunks}) &&
                                  takes_combination({turn / 2, options().sorted_leaves}) &&
                                  takes_combination({turn + turn / 2, capacity == 1})
                            : name == std::string_view("leaf") && among == Among::between_objects &&
                                  capacity == 0;
                    if (!is_taken)
                        continue;
                    SCOPED_TRACE(std::string(name) + ' ' + name_of(form) + ' ' +
                                 std::to_string(static_cast<int>(among)) + " capacity " +
                                 std::to_string(capacity));
                    const bool keep_adjacent = capacity == 0;
                    const auto collider = made(name, {.among = among,
                                                      .keep_adjacent = keep_adjacent,
                                                      .form = form,
                                                      .capacity = capacity});
                    expect_oracles_pairs(*collider, standing, keep_adjacent, among);
                }
        }
}

INSTANTIATE_TEST_SUITE_P(Catalog, Objects,
                         testing::Combine(testing::ValuesIn(device_builders()),
                                          testing::Values(Leaves::as_in_mesh, Leaves::sorted)),
                         CaseName());

/// Two objects move through each other: a query launches as many steps as the previous one needed, and all if those are too few.
TEST(ObjectsOfOneBuild, AreGivenNoStepsForEmptyQueues)
{
    for (const char* builder : {"oibvh-multi", "karras"})
        for (const KernelForm form : {KernelForm::groups, KernelForm::chunks}) {
            SCOPED_TRACE(builder);
            ManyObjects many({});
            const Mesh part = hard_inputs().front().make(100);
            many.add(part, 0);
            many.add(part, 1000);
            Standing standing = many.standing(find_builder(builder).make);
            const auto made_without = [&](unsigned rules_off) {
                auto collider =
                    made("bvtt",
                         {.among = Among::between_objects, .rules_off = rules_off, .form = form});
                collider->reserve(standing.tree, standing.input);
                return collider;
            };
            const auto with = made_without(0), without = made_without(skip_empty_queue);
            const auto launches_of = [&](Collider& collider) {
                const PairList expected = standing.expected(true, Among::between_objects);
                expect_pairs(collider, standing, expected);
                collider.query(standing.tree, standing.input, session().queue());
                const std::vector<StageTime> stages = session().queue().finish();
                EXPECT_TRUE(collider.complete(session().queue()));
                EXPECT_EQ(PairList(collider.pairs(session().queue())), expected);
                return stages.back().launches;
            };
            const int all = launches_of(*without);
            const int none = launches_of(*with);
            EXPECT_LT(none, all);
            for (const float along :
                 {0.25f, 1000.0f, 0.25f}) {  // into each other, apart, and again
                for (uint k = 0; k < part.points.size(); ++k)
                    many.mesh.points[part.points.size() + k].x = part.points[k].x + along;
                standing.place(many.mesh.points);
                standing.build();
                const int launched = launches_of(*with);
                EXPECT_EQ(launched == none, along > 1);
                EXPECT_LE(launched, all);
                EXPECT_EQ(launches_of(*without), all);
            }
        }
}

TEST(ObjectsOfOneBuild, AreRefusedWhereOneTreeIsBuilt)
{
    const ManyObjects many(few_sizes);
    EXPECT_THROW(many.standing(find_builder("median-split").make), Unavailable);
    EXPECT_THROW(many.standing(find_builder("oibvh-multi").make, {.order = "kd"}), BadUsage);
}

}  // namespace
}  // namespace bvhbench
