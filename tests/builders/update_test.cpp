// SPDX-License-Identifier: MIT
//
// Updates of several objects' trees with a different kind of update for each: every tree equals, bit for bit, the tree of a
// full rebuild, or the tree that the host makes from the previous one.
#include <optional>

#include "builders/host_tree.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using enum TreeUpdate;
using Updates = std::vector<TreeUpdate>;

struct Case {
    std::string name;
    BuildOptions options;
    bool waits = false;  ///< whether groups of a launch wait for other groups (implicit.waits)
};

std::vector<Case> all_cases()
{
    std::vector<Case> cases;
    for (int place = 0; const char* order : {"morton30", "hilbert30", "morton63"}) {
        ++place;
        for (const bool sorted : {false, true})
            for (const unsigned group : {0u, 16u})
                if (takes_combination({place, sorted, group == 0}))
                    cases.push_back(
                        {std::string(order) + (sorted ? "_sorted" : "_mesh") +
                             (group == 0 ? "" : "_groups"),
                         {.order = order, .group_size = group, .sorted_leaves = sorted}});
    }
    for (const bool sorted : {false, true})
        cases.push_back({std::string("waiting_groups") + (sorted ? "_sorted" : "_mesh"),
                         {.group_size = 16, .sorted_leaves = sorted},
                         true});
    return cases;
}

using Tested = std::tuple<std::string, Case>;

class Updating : public testing::TestWithParam<Tested> {
protected:
    Session& bench() const { return std::get<1>(GetParam()).waits ? waiting_session() : session(); }

    void start(const std::vector<std::size_t>& sizes)
    {
        many_.emplace(sizes);
        points_ = many_->mesh.points;
        input_ =
            upload(bench().device(), bench().queue(), points_, many_->mesh.faces, many_->objects);
        builder_ = made();
        bench().build_once(*builder_, input_, Start::from_triangles, &tree_);
        expected_ = trees(*tree_);
    }

    std::unique_ptr<Builder> made() const
    {
        auto builder = find_builder(std::get<0>(GetParam()))
                           .make(bench().programs(), std::get<1>(GetParam()).options);
        builder->reserve_objects(object_sizes(input_));
        return builder;
    }

    std::vector<HostTree> trees(const Tree& tree) const
    {
        const auto& forest = dynamic_cast<const DeviceTree&>(tree);
        std::vector<HostTree> trees;
        for (uint k = 0; k < forest.objects.size(); ++k)
            trees.push_back(forest.object_to_host_tree(k));
        return trees;
    }

    /// Moves objects as their updates require: not at all, by a translation, or each corner separately.
    void move(const Updates& updates)
    {
        std::uniform_real_distribution<float> by(0.0f, 0.2f);
        for (std::size_t k = 0; k < updates.size(); ++k) {
            const Point shift = {by(random_), by(random_), by(random_)};
            const FaceRange& range = many_->objects[k];
            if (updates[k] == keep)
                continue;
            for (uint face = range.first; face < range.first + range.count; ++face)
                for (const uint corner : {many_->mesh.faces[face].a, many_->mesh.faces[face].b,
                                          many_->mesh.faces[face].c}) {
                    Point& point = points_[corner];
                    const bool deforms = updates[k] == rebuild;
                    point.x += deforms ? by(random_) : shift.x;
                    point.y += deforms ? by(random_) : shift.y;
                }
        }
        input_.points = points_;
        input_.device_points.upload(bench().queue().cl(), points_);
    }

    void expect_trees(const Updates& updates)
    {
        const auto whole = made();
        const Tree* rebuilt_tree = nullptr;
        bench().build_once(*whole, input_, Start::from_triangles, &rebuilt_tree);
        const std::vector<HostTree> rebuilt = trees(*rebuilt_tree);
        const std::vector<HostTree> found = trees(*tree_);
        for (std::size_t k = 0; k < updates.size(); ++k) {
            if (updates[k] != keep)
                expected_[k] = updates[k] == rebuild
                                   ? rebuilt[k]
                                   : refitted(expected_[k], points_, many_->mesh.faces);
            EXPECT_EQ(tree_hash(found[k]), tree_hash(expected_[k])) << "object " << k;
        }
    }

    /// Updates for a frame, and again for the same frame, in which no object has moved.
    void expect_update(const Updates& updates)
    {
        move(updates);
        const Updates planned = builder_->plan_update(updates, bench().queue());
        EXPECT_EQ(planned, updates);
        for (int sample = 0; sample < 2; ++sample) {
            tree_ = &builder_->update(input_, bench().queue());
            bench().queue().finish();
            expect_trees(sample == 0 ? updates : Updates(updates.size(), keep));
        }
    }

    std::int64_t moved_ = 0;
    std::mt19937 random_{3};
    std::optional<ManyObjects> many_;
    std::vector<Point> points_;
    Input input_;
    std::unique_ptr<Builder> builder_;
    const Tree* tree_ = nullptr;
    std::vector<HostTree> expected_;
};

TEST_P(Updating, LeavesEachTreeAsIfItsObjectWereAlone)
{
    start({1, 2, 3, 480, 70, 1, 200});
    const Updates frames[] = {
        {keep, refit, rebuild, rebuild, refit, keep, rebuild},
        {rebuild, rebuild, refit, keep, rebuild, rebuild, keep},
        {refit, refit, keep, refit, keep, rebuild, refit},
        {keep, keep, keep, refit, refit, refit, keep},
        {keep, keep, keep, rebuild, keep, keep, keep},
        {refit, refit, refit, rebuild, refit, refit, refit},
        {rebuild, rebuild, rebuild, refit, rebuild, rebuild, rebuild},
        {keep, keep, keep, keep, keep, keep, refit},
    };
    for (const Updates& updates : frames) {
        SCOPED_TRACE("frame " + std::to_string(&updates - frames));
        expect_update(updates);
    }
}

TEST_P(Updating, TakesAllObjectsOrOne)
{
    start({3, 480});
    for (const TreeUpdate first : {rebuild, refit, keep})
        for (const TreeUpdate second : {rebuild, refit, keep})
            if (first != keep || second != keep) {
                SCOPED_TRACE(std::to_string(static_cast<int>(first)) + ' ' +
                             std::to_string(static_cast<int>(second)));
                expect_update({first, second});
            }
}

/// Refitted and kept objects have no codes and are not sorted; for kept objects no boxes are computed either.
TEST_P(Updating, HasOnlyTheStagesThatSomeObjectNeeds)
{
    start({3, 4800, 70});
    const bool gathers =  // nodes that contain leaves have none; groups line leaves up themselves
        dynamic_cast<const DeviceTree&>(*tree_).has_sorted_leaves() && bench().device().is_cpu() &&
        std::get<1>(GetParam()).options.group_size == 0;
    const auto stages_of = [&](const Updates& updates) {
        builder_->plan_update(updates, bench().queue());
        builder_->update(input_, bench().queue());
        std::vector<std::string> stages;
        moved_ = 0;
        for (const StageTime& stage : bench().queue().finish()) {
            stages.push_back(stage.stage);
            moved_ += stage.moved_bytes;
        }
        return stages;
    };
    std::vector<std::string> built = {"bounds", "codes", "sort", "hierarchy"};
    std::vector<std::string> refits = {"bounds", "refit"};
    if (gathers) {
        built.insert(built.begin() + 3, "gather");
        refits.insert(refits.begin() + 1, "gather");
    }
    EXPECT_EQ(stages_of({rebuild, refit, keep}), built);
    const std::int64_t few = moved_;
    EXPECT_EQ(stages_of({rebuild, rebuild, refit}), built);
    EXPECT_GT(2 * moved_, 3 * few);  // boxes are computed for all moving objects, in both cases
    EXPECT_EQ(stages_of({keep, keep, refit}), refits);
}

INSTANTIATE_TEST_SUITE_P(Implicit, Updating,
                         testing::Combine(testing::Values("oibvh-multi", "oibvh-single", "perfect",
                                                          "oibvh-wide8"),
                                          testing::ValuesIn(all_cases())),
                         CaseName());

TEST(Updates, OfBuildersThatTreatAllObjectsAlikeRebuildOrRefitAll)
{
    const ManyObjects many({30, 70, 3});
    const Input input = uploaded(many.mesh.points, many.mesh.faces, many.objects);
    const auto radix = find_builder("karras").make(session().programs(), {});
    radix->reserve_objects(object_sizes(input));
    session().build_once(*radix, input, Start::from_triangles);
    const auto planned = [&](const Updates& wanted) {
        return radix->plan_update(wanted, session().queue());
    };
    EXPECT_EQ(planned({keep, refit, rebuild}), Updates(3, rebuild));
    EXPECT_EQ(planned({keep, refit, keep}), Updates(3, refit));
    EXPECT_EQ(planned({keep, keep, keep}), Updates(3, keep));

    const auto host = find_builder("sah-binned").make(session().programs(), {});
    const Updates one = {refit};
    EXPECT_EQ(host->plan_update(one, session().queue()), Updates(1, rebuild));
}

}  // namespace
}  // namespace bvhbench
