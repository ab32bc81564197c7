// SPDX-License-Identifier: MIT
//
// Front tracking over frames that move a little, jump, part and return: every frame has the oracle's pairs, each once.
#include <cmath>
#include <map>

#include "harness/measure/pipeline.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

/// Three objects that overlap, one of them a single triangle.
struct Moving : ManyObjects {
    Moving() : ManyObjects({})
    {
        for (const Mesh& part : {scene_mesh("sphere:300"), crowded_mesh(90), crowded_mesh(1)})
            add(part);
    }

    /// Returns the points, each displaced by at most `by` along its own path, and each object shifted by `apart` from the
    /// previous one.
    std::vector<Point> moved(float by, int frame, float apart = 0) const
    {
        std::vector<Point> points = mesh.points;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const auto phase = static_cast<float>(k * (static_cast<std::size_t>(frame) + 1));
            points[k].x += by * std::sin(phase) + apart * static_cast<float>(point_owners[k]);
            points[k].y += by * std::sin(1.3f * phase);
            points[k].z += by * std::cos(0.7f * phase);
        }
        return points;
    }
};

/// A front and its tree, carried from frame to frame.
class Tracked {
public:
    Tracked(const Moving& moving, bool as_one, MakeBuilder make, const ColliderOptions& options,
            const BuildOptions& build = {})
        : options_(options)
        , standing_(moving.mesh, make, build,
                    as_one ? std::span<const FaceRange>{} : moving.objects)
        , front_(made("front", options))
    {
        front_->reserve(standing_.tree, standing_.input);
    }

    /// Moves to these points and compares the pairs found with the oracle's.
    void expect_pairs_at(const std::vector<Point>& points)
    {
        standing_.place(points);
        update_ = front_->next_frame();
        refits += update_ == TreeUpdate::refit ? 1 : 0;
        while (!query()) {
        }
        expect_pairs();
        prunes += counted().at("prunes_count");
    }

    /// Repeats the query of the same frame from the same front.
    void expect_the_same_again()
    {
        const std::map<std::string, double> before = counted();
        ASSERT_TRUE(query());
        expect_pairs();
        EXPECT_EQ(counted(), before);
    }

    std::map<std::string, double> counted() const
    {
        const QueryCounts counts = front_->counts(session().queue());
        std::map<std::string, double> all = {{"pairs", static_cast<double>(counts.pairs)},
                                             {"tests", static_cast<double>(*counts.box_tests)},
                                             {"peak", static_cast<double>(*counts.bvtt_peak)}};
        for (const auto& [name, value] : counts.more)
            all[std::string(name)] = static_cast<double>(value);
        return all;
    }

    int refits = 0;
    double prunes = 0;

private:
    bool query()
    {
        Queue& queue = session().queue();
        const Input& input = standing_.input;
        const Tree& tree = update_ == TreeUpdate::refit ? standing_.builder->refit(input, queue)
                                                        : standing_.builder->build(input, queue);
        front_->query(&tree, input, queue);
        queue.finish();
        return front_->complete(queue);
    }

    void expect_pairs() const
    {
        const PairList found(front_->pairs(session().queue()));
        EXPECT_EQ(found.surplus(), 0u);
        EXPECT_EQ(found, standing_.expected(options_.keep_adjacent, options_.among));
    }

    ColliderOptions options_;
    Standing standing_;
    std::unique_ptr<Collider> front_;
    TreeUpdate update_ = TreeUpdate::rebuild;
};

class FrontOver : public testing::TestWithParam<std::tuple<BuilderEntry, KernelForm>> {
protected:
    MakeBuilder make() const { return std::get<0>(GetParam()).make; }
    KernelForm form() const { return std::get<1>(GetParam()); }
};

/// Runs small motions, a jump and back, a jump that stays until the tree is rebuilt, small motions, and a return to the start.
void run_all(Tracked& tracked, const Moving& moving)
{
    int frame = 0;
    for (const float by :
         {0.0f, 0.01f, 0.02f, 1.5f, 0.02f, 0.01f, 1.5f, 1.5f, 1.49f, 1.49f, 0.02f, 0.0f}) {
        SCOPED_TRACE("frame " + std::to_string(frame));
        tracked.expect_pairs_at(moving.moved(by, by > 1 ? 40 : ++frame));
    }
    EXPECT_GT(tracked.refits, 5);
    EXPECT_GT(tracked.prunes, 0);
}

TEST_P(FrontOver, FindsTheOraclesPairsInEveryFrameOfOneObject)
{
    const Moving moving;
    for (const bool keep_adjacent : {true, false})
        for (const std::size_t capacity : {0u, 1u})
            for (const bool sorted_leaves : {true, false}) {
                SCOPED_TRACE(std::to_string(keep_adjacent) + std::to_string(capacity) +
                             std::to_string(sorted_leaves));
                Tracked tracked(
                    moving, true, make(),
                    {.keep_adjacent = keep_adjacent, .form = form(), .capacity = capacity},
                    {.sorted_leaves = sorted_leaves});
                run_all(tracked, moving);
                EXPECT_GE(tracked.counted().at("restarts_count"), 1);
            }
}

TEST_P(FrontOver, FindsTheOraclesPairsInEveryFrameOfSeveralObjects)
{
    const Moving moving;
    for (const Among among : {Among::all, Among::between_objects, Among::within_objects})
        for (const std::size_t capacity : {0u, 1u}) {
            SCOPED_TRACE(std::to_string(static_cast<int>(among)) + ' ' + std::to_string(capacity));
            Tracked tracked(moving, false, make(),
                            {.among = among, .form = form(), .capacity = capacity});
            run_all(tracked, moving);
        }
}

TEST_P(FrontOver, NoticesObjectsThatComeBack)
{
    const Moving moving;
    Tracked tracked(moving, false, make(), {.among = Among::between_objects, .form = form()});
    const auto move_to = [&](float x) {
        SCOPED_TRACE(x);
        tracked.expect_pairs_at(moving.moved(0, 0, x));
    };
    for (const float x : {0.0f, 0.2f, 0.9f, 50.0f})
        move_to(x);
    for (int frame = 0; frame < 16; ++frame)
        move_to(50);
    EXPECT_EQ(tracked.counted().at("front_count"), 3);  // pairs of roots
    for (const float x : {50.1f, 0.9f, 0.2f, 0.0f})
        move_to(x);
}

TEST_P(FrontOver, NeitherSproutsNorPrunesWhereNothingMoves)
{
    const Moving moving;
    Tracked tracked(moving, true, make(), {.form = form()});
    tracked.expect_pairs_at(moving.moved(0.01f, 1));
    const auto first = tracked.counted();
    tracked.expect_the_same_again();
    for (int repeat = 0; repeat < 2; ++repeat) {
        tracked.expect_pairs_at(moving.moved(0.01f, 1));
        const auto still = tracked.counted();
        EXPECT_EQ(still.at("front_count"), first.at("front_count"));
        EXPECT_EQ(still.at("sprouts_count"), 0);
        EXPECT_EQ(still.at("prunes_count"), 0);
        tracked.expect_the_same_again();
    }
    EXPECT_EQ(tracked.refits, 2);
}

TEST_P(FrontOver, MayBeRepeatedWhileItMoves)
{
    const Moving moving;
    Tracked tracked(moving, false, make(), {.form = form()});
    for (int frame = 0; frame < 6; ++frame) {
        tracked.expect_pairs_at(moving.moved(0.03f, frame));
        for (int repeat = 0; repeat < 3; ++repeat)
            tracked.expect_the_same_again();
    }
    EXPECT_GE(tracked.refits, 3);
}

TEST_P(FrontOver, ClimbsBackWhenItHasGrown)
{
    // Over the same tree, the highest front depends on the points alone, not on the frames before.
    const Moving moving;
    for (const bool as_one : {true, false}) {
        Tracked tracked(moving, as_one, make(), {.form = form()});
        tracked.expect_pairs_at(moving.moved(0, 0));
        const double first = tracked.counted().at("front_count");
        tracked.expect_pairs_at(moving.moved(1.5f, 40));
        EXPECT_GT(tracked.counted().at("front_count"), 2 * first);
        tracked.expect_pairs_at(moving.moved(0, 0));
        EXPECT_EQ(tracked.counted().at("front_count"), first);
        EXPECT_GT(tracked.counted().at("prunes_count"), first);
        EXPECT_EQ(tracked.refits, 2);
        tracked.expect_the_same_again();
    }
}

INSTANTIATE_TEST_SUITE_P(Catalog, FrontOver,
                         testing::Combine(testing::ValuesIn(device_builders()), both_forms),
                         CaseName());

TEST(FrontPipeline, KeepsItsTreeWhileOthersBuildTheirs)
{
    const Moving moving;
    std::vector<Point> points = moving.mesh.points;
    Input input = upload(session().device(), session().queue(), points, moving.mesh.faces);
    const BuilderChoice builder{.name = "oibvh-multi"};
    ColliderChoice front, leaf;
    front.name = "front";
    leaf.name = "leaf";
    Pipeline tracking(session(), builder, front, input), walking(session(), builder, leaf, input);
    for (int frame = 0; frame < 6; ++frame) {
        points = moving.moved(0.02f, frame);
        input.device_points.upload(session().queue().cl(), points);
        for (Pipeline* one : {&tracking, &walking}) {
            one->begin_frame({});
            one->settle(input);
        }
        for (int repeat = 0; repeat < 3; ++repeat)
            for (Pipeline* one : {&walking, &tracking}) {
                const std::vector<StageTime> stages = one->once(input);
                const bool refits =
                    std::any_of(stages.begin(), stages.end(),
                                [](const StageTime& stage) { return stage.stage == "refit"; });
                EXPECT_EQ(refits, one == &tracking && frame > 0);
                EXPECT_EQ(PairList(one->pairs()), touching_pairs(points, moving.mesh.faces, true));
            }
    }
}

TEST(Front, RefusesToJump)
{
    for (const ColliderOptions& options :
         {ColliderOptions{.jump = 2}, ColliderOptions{.start_level = 1}})
        EXPECT_THROW(made("front", options), BadUsage);
}

}  // namespace
}  // namespace bvhbench
