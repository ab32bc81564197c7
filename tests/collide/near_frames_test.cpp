// SPDX-License-Identifier: MIT
//
// Frames reduced to triangles near another object have the oracle's pairs between objects.
#include "tests/collide/near_objects.h"

namespace bvhbench {
namespace {

/// Small frames of GPUs do without the rule `near` unless it is forced.
ColliderChoice between(const char* name, unsigned rules_off = 0)
{
    return {{.among = Among::between_objects, .keep_adjacent = false, .rules_off = rules_off},
            name,
            "exact",
            skip_near & ~rules_off};
}

bool has_stage(const std::vector<StageTime>& stages, std::string_view name)
{
    return std::ranges::count(stages, name, &StageTime::stage) > 0;
}

struct NearPipeline : testing::TestWithParam<BuilderChoice> {};

TEST_P(NearPipeline, FindsWhatIsFoundWithoutTheRule)
{
    for (const NamedObjects& one : all_objects())
        for (const char* name : {"leaf", "bvtt", "group"}) {
            SCOPED_TRACE(one.name + ' ' + name);
            const Input input = uploaded(one.many);
            Pipeline with(session(), GetParam(), between(name), input);
            Pipeline without(session(), GetParam(), between(name, skip_near), input);
            with.prepare(input);
            without.prepare(input);
            const PairList expected = expected_pairs(one.many, Among::between_objects, false);
            EXPECT_EQ(PairList(without.pairs()), expected);
            EXPECT_FALSE(without.counters().contains("entered_count"));
            const bool applies =
                entering(one.many) <= NearTriangles::most_of(one.many.mesh.faces.size());
            std::map<std::string, double> counters = with.counters();
            EXPECT_EQ(counters.contains("entered_count"), applies);
            EXPECT_EQ(counters["entered_count"],
                      applies ? static_cast<double>(entering(one.many)) : 0);
            for (int repeat = 0; repeat < 2; ++repeat) {
                EXPECT_EQ(has_stage(with.once(input), "near"), applies);
                EXPECT_EQ(PairList(with.pairs()), expected);
                EXPECT_EQ(PairList(with.contacts()), PairList(without.contacts()));
                EXPECT_EQ(with.counters()["pairs_count"], static_cast<double>(expected.size()));
                EXPECT_EQ(with.counters()["entered_count"], counters["entered_count"]);
            }
        }
}

TEST(NearTriangles, AreNotSoughtAmongMoreObjectsThanAreTestedEachAgainstEach)
{
    for (const std::size_t objects :
         {NearTriangles::most_objects, NearTriangles::most_objects + 1}) {
        ManyObjects many({});
        const Mesh triangle = crowded_mesh(1);
        for (std::size_t k = 0; k < objects; ++k)
            many.add(triangle, 3 * static_cast<float>(k));
        Pipeline pipeline(session(), {.name = "oibvh-multi"}, between("leaf"), uploaded(many));
        EXPECT_EQ(pipeline.counters().contains("near_bytes"),
                  objects <= NearTriangles::most_objects);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Builders, NearPipeline,
    testing::Values(BuilderChoice{.name = "oibvh-multi"},
                    BuilderChoice{{.order = "hilbert30", .sorted_leaves = true}, "oibvh-multi"},
                    BuilderChoice{.name = "oibvh-single"}, BuilderChoice{.name = "perfect"},
                    BuilderChoice{.name = "apetrei-fused"}),
    [](const auto& tested) {
        return test_name(tested.param.name) + (tested.param.sorted_leaves ? "_sorted" : "");
    });

/// Two objects that meet, part, overlap and meet again.
class Frames {
public:
    Frames()
        : many_(row(2, 0.9f))
        , points_(many_.mesh.points)
        , input_(uploaded(points_, many_.mesh.faces, many_.objects))
        , pipeline_(session(), {.name = "oibvh-multi"}, between("group"), input_)
    {}

    /// Moves the second object to `along` widths from the first. Returns the triangles that enter: all of them without the rule.
    double entered_at(float along, Motion motion)
    {
        const std::size_t half = points_.size() / 2;
        for (std::size_t k = 0; k < half; ++k)
            points_[half + k].x = points_[k].x + along * width(sphere(400));
        go_to(points_, pipeline_, input_, std::vector(2, motion));
        stages_ = pipeline_.once(input_);
        EXPECT_EQ(PairList(pipeline_.pairs()),
                  touching_pairs(points_, many_.mesh.faces, false, many_.objects,
                                 Among::between_objects));
        const std::map<std::string, double> counters = pipeline_.counters();
        return counters.contains("entered_count") ? counters.at("entered_count")
                                                  : static_cast<double>(many_.mesh.faces.size());
    }

    TreeUpdate update() const
    {
        return count("kept_objects_count") > 0       ? TreeUpdate::keep
               : count("refitted_objects_count") > 0 ? TreeUpdate::refit
                                                     : TreeUpdate::rebuild;
    }
    bool had(std::string_view stage) const { return has_stage(stages_, stage); }
    double count(const char* name) const { return pipeline_.counters().at(name); }

private:
    ManyObjects many_;
    std::vector<Point> points_;
    Input input_;
    Pipeline pipeline_;
    std::vector<StageTime> stages_;
};

TEST(NearFrames, TakeInWhatIsNearThen)
{
    Frames frames;
    const double some = frames.entered_at(0.9f, Motion::deforming);
    EXPECT_GT(some, 0);
    EXPECT_LT(some, 400);
    EXPECT_EQ(frames.entered_at(1.2f, Motion::deforming), 0);
    EXPECT_FALSE(frames.had("hierarchy"));
    EXPECT_FALSE(frames.had("broad"));
    EXPECT_EQ(frames.count("rebuilt_objects_count"), 0);
    EXPECT_EQ(frames.count("pairs_count"), 0);
    EXPECT_EQ(frames.count("contacts_count"), 0);
    EXPECT_EQ(frames.entered_at(0.1f, Motion::deforming), 800);
    EXPECT_FALSE(frames.had("near"));
    EXPECT_EQ(frames.entered_at(0.9f, Motion::deforming), some);
}

TEST(NearFrames, AreKeptWhenNothingMoves)
{
    Frames frames;
    const double some = frames.entered_at(0.9f, Motion::deforming);
    EXPECT_EQ(frames.entered_at(0.9f, Motion::unchanged), some);
    EXPECT_EQ(frames.update(), TreeUpdate::keep);
    EXPECT_FALSE(frames.had("near"));
    EXPECT_TRUE(frames.had("broad"));
    EXPECT_EQ(frames.entered_at(1.2f, Motion::deforming), 0);
    EXPECT_EQ(frames.entered_at(1.2f, Motion::unchanged), 0);
    EXPECT_TRUE(frames.had("near"));
}

/// A refit needs a tree of all triangles, which a frame of fewer triangles does not leave.
TEST(NearFrames, AreRefittedAsAWholeOnly)
{
    Frames frames;
    EXPECT_EQ(frames.entered_at(0.1f, Motion::deforming), 800);
    EXPECT_EQ(frames.entered_at(0.9f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::refit);
    EXPECT_LT(frames.entered_at(0.9f, Motion::deforming), 400);
    EXPECT_LT(frames.entered_at(0.95f, Motion::rigid), 400);
    EXPECT_EQ(frames.update(), TreeUpdate::rebuild);
    EXPECT_EQ(frames.entered_at(0.1f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::rebuild);
    EXPECT_EQ(frames.entered_at(0.15f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::refit);
}

TEST(NearRule, IsNotUsedForFewTrianglesOnAGpuUnlessForced)
{
    constexpr std::size_t few = 1000, many = 1u << 22;
    constexpr unsigned never_used = skip_deforming | skip_margin;
    EXPECT_EQ(skip_rules_off(0, 0, false, few), skip_near | never_used);
    EXPECT_EQ(skip_rules_off(0, skip_near, false, few), never_used);
    EXPECT_EQ(skip_rules_off(skip_rigid, 0, false, few), skip_near | never_used | skip_rigid);
    EXPECT_EQ(skip_rules_off(0, 0, false, many), never_used);
    EXPECT_EQ(skip_rules_off(0, 0, true, few), never_used);
    EXPECT_EQ(skip_rules_off(0, never_used, true, few), 0u);
}

TEST(NearFrames, ThatLaterChangeTheirMindAreAnError)
{
    const ManyObjects many = row(2, 0.9f);
    std::vector<Point> points = many.mesh.points;
    Input input = uploaded(many);
    Pipeline pipeline(session(), {.name = "oibvh-multi"}, between("leaf"), input);
    pipeline.prepare(input);
    points.back().x = -100;  // its object's box now contains the other object
    place(input, points);
    EXPECT_THROW(pipeline.once(input), Unavailable);
    session().queue().finish();
}

}  // namespace
}  // namespace bvhbench
