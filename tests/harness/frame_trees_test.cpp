// SPDX-License-Identifier: MIT
//
// Tests the options `update` and `trees`: what is done to the trees of each frame, and that the pairs are the oracle's.
#include "tests/harness/frame_runs.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

ColliderChoice with_trees(TreeOver trees, ColliderChoice choice)
{
    choice.trees = trees;
    return choice;
}

/// Expects that making the pipeline is refused, in a sentence with these words.
void expect_refusal(const Scene& scene, const BuilderChoice& builder,
                    const ColliderChoice& collider, const std::string& words)
{
    const Input input = upload_frame(session(), scene, 0);
    const std::string why =
        refusal_of<BadUsage>([&] { Pipeline(session(), builder, collider, input); });
    EXPECT_NE(why.find(words), std::string::npos) << collider.name << builder.name << why;
}

TEST(Update, RebuildsEveryTreeInEveryFrame)
{
    const Scene scene = load_scene("cloth-ball:2000:4", {});  // the ball moves rigidly
    for (const char* builder : {"oibvh-multi", "apetrei-fused"})
        for (const char* name : {"group", "front", "front-leaf"}) {
            const std::vector<Counters> frames = run_frames(
                scene, {.name = builder}, {.name = name, .update = FrameUpdate::rebuild});
            for (const Counters& counters : frames) {
                expect_updates(counters, 2, 0, 0);
                if (counters.contains("front_count")) {
                    EXPECT_EQ(counters.at("restarts_count"), 0);
                    EXPECT_EQ(counters.at("prunes_count"), 0);  // a front from the roots has none
                    EXPECT_GT(counters.at("front_count"), 0);
                }
            }
        }
}

TEST(Update, TracksAFrontIfLeftAlone)
{
    const Scene scene = load_scene("cloth-ball:2000:4", {});
    for (const char* name : {"front", "front-leaf"}) {
        const std::vector<Counters> frames =
            run_frames(scene, {.name = "apetrei-fused"}, {.name = name});
        expect_updates(frames.at(0), 2, 0, 0);
        expect_updates(frames.at(1), 0, 2, 0);
    }
}

TEST(Update, RefitsEveryTreeAfterTheFirstFrame)
{
    Scene scene = load_scene("cloth-ball:2000:4", {});
    scene.frames[2] = scene.frames[1];  // the rule `unchanged` would keep both trees
    for (const char* builder : {"oibvh-multi", "apetrei-fused"})
        for (const char* name : {"group", "leaf", "bvtt"}) {
            const std::vector<Counters> frames =
                run_frames(scene, {.name = builder}, {.name = name, .update = FrameUpdate::refit});
            expect_updates(frames.at(0), 2, 0, 0);
            for (std::size_t frame = 1; frame < frames.size(); ++frame)
                expect_updates(frames[frame], 0, 2, 0);
        }
}

TEST(Update, LeavesOutTheRuleNearWhereItRefits)
{
    Scene scene = load_scene("n-body:6100:3", {});
    scene.frames.pop_back();  // in which too many triangles are near others
    for (const FrameUpdate update : {FrameUpdate::rebuild, FrameUpdate::refit}) {
        const std::vector<Counters> frames =
            run_frames(scene, {.name = "oibvh-multi"},
                       {{.among = Among::between_objects}, "leaf", "none", 0, update});
        EXPECT_EQ(frames.at(1).contains("entered_count"), update == FrameUpdate::rebuild);
    }
}

TEST(Update, IsRefusedWhereItCannotBe)
{
    const Scene scene = load_scene("cloth-ball:2000:2", {});
    const BuilderChoice multi{.name = "oibvh-multi"};
    for (const char* name : {"front", "front-leaf"})
        expect_refusal(scene, multi, {.name = name, .update = FrameUpdate::refit},
                       "refits its tree by itself");
    for (const char* name : {"grid", "brute"}) {
        for (const FrameUpdate update : {FrameUpdate::rebuild, FrameUpdate::refit})
            expect_refusal(scene, multi, {.name = name, .update = update}, "queries none");
        expect_refusal(scene, multi, {.name = name, .trees = TreeOver::scene}, "queries none");
    }
}

class OneTreeOverTheScene : public testing::TestWithParam<const char*> {};

TEST_P(OneTreeOverTheScene, FindsThePairsOfItsObjects)
{
    const Scene scene = load_scene("n-body:1200:3", {});
    ASSERT_GT(scene.objects.size(), 2u);
    const bool needs_implicit = std::string_view(GetParam()) == "block";
    for (const char* builder : {"oibvh-multi", "apetrei-fused"})
        for (const Among among : {Among::all, Among::between_objects})
            for (const bool keep_adjacent : {true, false}) {
                if (needs_implicit && std::string_view(builder) != "oibvh-multi")
                    continue;
                for (const Counters& counters : run_frames(
                         scene, {.name = builder},
                         with_trees(
                             TreeOver::scene,
                             {{.among = among, .keep_adjacent = keep_adjacent}, GetParam()})))
                    EXPECT_EQ(counters.at("rebuilt_objects_count") +
                                  counters.at("refitted_objects_count"),
                              1);
            }
}

INSTANTIATE_TEST_SUITE_P(Colliders, OneTreeOverTheScene,
                         testing::Values("leaf", "bvtt", "group", "block", "front", "front-leaf"),
                         CaseName());

TEST(OneTree, GivesTheNarrowPhaseTheTrueFaces)
{
    const Scene scene = load_scene("two-spheres:2000:6", {});
    const auto contacts_of = [&](TreeOver trees) {
        Input input = upload_frame(session(), scene, 5);
        Pipeline pipeline(
            session(), {.name = "oibvh-multi"},
            with_trees(
                trees,
                {{.among = Among::between_objects, .keep_adjacent = false}, "group", "exact"}),
            input);
        go_to(scene.frames[5], pipeline, input);
        return PairList(pipeline.contacts());
    };
    const PairList expected = contacts_of(TreeOver::object);
    EXPECT_GT(expected.size(), 0u);
    EXPECT_EQ(contacts_of(TreeOver::scene), expected);
}

TEST(OneTree, IsKeptIfNothingMoves)
{
    Scene scene = load_scene("n-body:1200:3", {});
    scene.frames[1] = scene.frames[0];
    const std::vector<Counters> frames =
        run_frames(scene, {.name = "oibvh-multi"},
                   with_trees(TreeOver::scene, {{.among = Among::between_objects}, "group"}));
    expect_updates(frames.at(0), 1, 0, 0);
    expect_updates(frames.at(1), 0, 0, 1);
    expect_updates(frames.at(2), 1, 0, 0);  // objects move rigidly, but not together
}

TEST(OneTree, IsRefusedWhereItCannotBe)
{
    const BuilderChoice multi{.name = "oibvh-multi"};
    const ColliderChoice between = with_trees(
        TreeOver::scene, {{.among = Among::between_objects, .keep_adjacent = false}, "leaf"});
    Scene scene = load_scene("cloth-ball:2000:2", {});
    ColliderChoice within = between;
    within.among = Among::within_objects;
    expect_refusal(scene, multi, within, "pairs within objects");
    expect_refusal(load_scene("torus:200", {}), multi, between, "the scene is one object");
    scene.faces[scene.objects.back().first_face].a = scene.faces.front().a;
    expect_refusal(scene, multi, between, "share vertices");
    ColliderChoice keeps = between;
    keeps.keep_adjacent = true;
    run_frames(scene, multi, keeps);
}

/// A sheet whose wave grows by `step` of its side in each frame, but shuffles its corners in the last.
Scene waving_sheet(float step)
{
    Scene scene = load_scene("grid:800", {});
    const std::vector<Point> flat = scene.frames.front();
    for (int frame = 1; frame < 5; ++frame) {
        std::vector<Point> points = flat;
        for (Point& p : points)
            p.z = step * static_cast<float>(frame) * std::sin(9 * p.x);
        scene.frames.push_back(points);
    }
    std::vector<Point>& last = scene.frames.emplace_back(flat);
    std::shuffle(last.begin(), last.end(), std::mt19937(1));
    scene.frames.push_back(last);
    for (Point& p : scene.frames.back())
        p.x *= 1.01f;
    return scene;
}

TEST(Deforming, IsRefittedWhileQueriesTestHardlyMoreBoxes)
{
    const Scene scene = waving_sheet(0.01f);
    ColliderChoice forced{{}, "leaf", "none", skip_deforming};
    const BuilderChoice multi{.name = "oibvh-multi"};
    const std::vector<Counters> with = run_frames(scene, multi, forced);
    expect_updates(with[0], 1, 0, 0);
    for (const std::size_t frame : {1, 2, 3, 4, 5})
        expect_updates(with[frame], 0, 1, 0);
    expect_updates(with[6], 1, 0, 0);  // the frame before tested far more
    EXPECT_GT(with[5].at("box_tests_count"), 1.15 * with[0].at("box_tests_count"));
    for (const Counters& frame : run_frames(scene, multi, {{}, "leaf"}))
        expect_updates(frame, 1, 0, 0);
    forced.update = FrameUpdate::rebuild;
    for (const Counters& frame : run_frames(scene, multi, forced))
        expect_updates(frame, 1, 0, 0);
}

TEST(Margin, IsNotUsedWhereTreesAreToBeRebuiltOrRefittedInEachFrame)
{
    const Scene still = waving_sheet(0);
    for (const FrameUpdate update :
         {FrameUpdate::automatic, FrameUpdate::rebuild, FrameUpdate::refit}) {
        const std::vector<Counters> frames =
            run_frames(still, {.name = "oibvh-multi"}, {{}, "leaf", "none", skip_margin, update});
        EXPECT_EQ(frames[2].contains("listed_count"), update == FrameUpdate::automatic);
    }
}

/// Returns what `auto` chooses for `objects` objects of `triangles` triangles each.
TreeOver chosen_trees(uint objects, uint triangles, ColliderChoice choice,
                      bool share_a_vertex = false, bool on_cpu = true)
{
    Scene scene = load_scene("soup:" + std::to_string(objects * triangles), {});
    scene.objects.clear();
    for (uint k = 0; k < objects; ++k)
        scene.objects.push_back({.first_face = k * triangles, .face_count = triangles});
    if (share_a_vertex)
        scene.faces.back().a = scene.faces.front().a;
    return trees_over(with_trees(TreeOver::automatic, std::move(choice)),
                      upload_frame(session(), scene, 0), on_cpu);
}

TEST(OneTree, IsChosenForManySmallObjects)
{
    const ColliderChoice between{{.among = Among::between_objects}, "group"};
    ColliderChoice drops = between, within = between;
    drops.keep_adjacent = false;
    within.among = Among::within_objects;
    EXPECT_EQ(chosen_trees(512, 2, between), TreeOver::scene);
    EXPECT_EQ(chosen_trees(512, 16, {{}, "leaf"}), TreeOver::scene);
    EXPECT_EQ(chosen_trees(512, 2, drops), TreeOver::scene);
    EXPECT_EQ(chosen_trees(511, 2, between), TreeOver::object) << "few";
    EXPECT_EQ(chosen_trees(512, 17, between), TreeOver::object) << "large";
    EXPECT_EQ(chosen_trees(512, 128, between, false, false), TreeOver::scene);
    EXPECT_EQ(chosen_trees(512, 129, between, false, false), TreeOver::object) << "large";
    EXPECT_EQ(chosen_trees(512, 2, within), TreeOver::object);
    EXPECT_EQ(chosen_trees(512, 2, drops, true), TreeOver::object) << "cannot drop that pair";
    EXPECT_EQ(chosen_trees(512, 2, {{}, "grid"}), TreeOver::object) << "needs no tree";
}

}  // namespace
}  // namespace bvhbench
