// SPDX-License-Identifier: MIT
//
// Tests which work a frame's pipeline leaves out, and that it still finds the same pairs.
#include "harness/measure/pipeline.h"

#include "collide/skips.h"
#include "harness/measure/device_verdict.h"
#include "harness/measure/frames.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

/// Runs a pipeline over the frames of a scene and compares its pairs with the sweep's.
class PipelineFrames {
public:
    PipelineFrames(const Scene& scene, const char* builder, unsigned rules_off) : scene_(scene)
    {
        input_ = upload_frame(session(), scene, 0);
        const ColliderChoice collider{{.rules_off = rules_off}, "group"};
        pipeline_ = std::make_unique<Pipeline>(
            session(), BuilderChoice{{.order = "hilbert30"}, builder}, collider, input_);
    }

    std::map<std::string, double> go_to(std::size_t frame, std::span<const Motion> motions)
    {
        bvhbench::go_to(scene_.frames[frame], *pipeline_, input_, motions);
        const std::map<std::string, double> counters = pipeline_->counters();
        for (int sample = 0; sample < 2; ++sample) {
            pipeline_->once(input_);
            EXPECT_EQ(PairList(pipeline_->pairs()),
                      touching_pairs(input_.points, input_.faces, true));
            EXPECT_EQ(pipeline_->counters(), counters);  // each sample does the same work
        }
        return counters;
    }

private:
    const Scene& scene_;
    Input input_;
    std::unique_ptr<Pipeline> pipeline_;
};

using Counts = std::array<double, 4>;

/// Returns the number of objects rebuilt, refitted and kept, and of sorts.
Counts counts_of(const std::map<std::string, double>& counters)
{
    return {counters.at("rebuilt_objects_count"), counters.at("refitted_objects_count"),
            counters.at("kept_objects_count"), counters.at("sorts_count")};
}

void expect_counts(const Scene& scene, const char* builder, unsigned rules_off,
                   const Counts& expected)
{
    SCOPED_TRACE(std::string(builder) + " without " + skip_rules_text(rules_off));
    PipelineFrames frames(scene, builder, rules_off);
    EXPECT_EQ(counts_of(frames.go_to(0, {})), (Counts{2, 0, 0, 1}));
    EXPECT_EQ(counts_of(frames.go_to(1, object_motions(scene, 0, 1))), expected);
}

TEST(Pipeline, RebuildsOfAMixedSceneOnlyWhatDeforms)
{
    const Scene scene = load_scene("cloth-ball:4000:3", {});
    for (const char* builder : {"oibvh-multi", "oibvh-single", "perfect"}) {
        expect_counts(scene, builder, 0, {1, 1, 0, 1});
        expect_counts(scene, builder, skip_rigid, {2, 0, 0, 1});
    }
    expect_counts(scene, "karras", 0, {2, 0, 0, 1});
}

TEST(Pipeline, LeavesAloneWhatHasNotMoved)
{
    Scene scene = load_scene("cloth-ball:4000:3", {});
    const SceneObject& ball = scene.objects.back();
    for (uint face = ball.first_face; face < ball.first_face + ball.face_count; ++face)
        for (const uint corner : {scene.faces[face].a, scene.faces[face].b, scene.faces[face].c})
            scene.frames[1][corner] = scene.frames[0][corner];
    expect_counts(scene, "oibvh-multi", 0, {1, 0, 1, 1});
    expect_counts(scene, "oibvh-multi", skip_unchanged, {1, 1, 0, 1});
    expect_counts(scene, "oibvh-multi", skip_unchanged | skip_rigid, {2, 0, 0, 1});
}

TEST(Transfers, AreOfPipelinesThatReadOrWriteTheDevice)
{
    const Scene scene = load_scene("soup:300", {});
    const Input input = upload_frame(session(), scene, 0);
    const auto transfers_of = [&](const ColliderChoice& collider) {
        Pipeline pipeline(session(), {.name = "oibvh-multi"}, collider, input);
        pipeline.begin_frame({});
        pipeline.prepare(input);
        const std::vector<Pair> found = pipeline.pairs();
        const std::map<std::string, double> transfers = pipeline.transfers(input);
        EXPECT_EQ(pipeline.pairs(), found);
        return transfers;
    };
    for (const ColliderChoice& collider :
         {ColliderChoice{.name = "group"},
          ColliderChoice{{.keep_adjacent = false}, "brute", "exact"}}) {
        const std::map<std::string, double> transfers = transfers_of(collider);
        EXPECT_GT(transfers.at("upload_ns"), 0) << collider.name;
        EXPECT_GT(transfers.at("read_back_ns"), 0) << collider.name;
    }
    EXPECT_TRUE(transfers_of({.name = "brute"}).empty());
}

/// Prepares the first frame of a scene, gives the points of the second to the device, the host or neither, and returns the
/// verdict of devices on the pairs of the first.
Check verdict_on(const char* scene_name, const ColliderChoice& collider, bool device_moves,
                 bool host_moves)
{
    const Scene scene = load_scene(scene_name, {});
    Input input = upload_frame(session(), scene, 0);
    Pipeline pipeline(session(), {.name = "karras"}, collider, input);
    pipeline.begin_frame({});
    pipeline.prepare(input);
    if (device_moves)
        input.device_points.upload(session().queue().cl(), scene.frames[1]);
    if (host_moves)
        input.points = scene.frames[1];
    return verdict_of_devices(session(), pipeline, collider, input);
}

TEST(VerdictOfDevices, AgreesWithRightPairs)
{
    for (const char* name : {"leaf", "grid"})
        for (const Among among : {Among::all, Among::between_objects}) {
            const ColliderChoice collider{{.among = among, .keep_adjacent = among != Among::all},
                                          name};
            const Check check = verdict_on("n-body:12200:2", collider, false, false);
            EXPECT_EQ(check.verdict, Check::Verdict::agrees) << name << ": " << check.detail;
            EXPECT_NE(check.detail.find(" pairs of the hash "), std::string::npos);
        }
}

TEST(VerdictOfDevices, NeedsBothTheOtherAlgorithmAndBruteForceToAgree)
{
    const ColliderChoice collider{{.keep_adjacent = false}, "leaf"};
    for (const bool device_moves : {false, true}) {
        const Check check = verdict_on("n-body:12200:2", collider, device_moves, !device_moves);
        EXPECT_EQ(check.verdict, Check::Verdict::differs);
        EXPECT_EQ(check.detail.find("grid found ") != std::string::npos, device_moves);
        EXPECT_EQ(check.detail.find("brute force found ") != std::string::npos, !device_moves);
    }
}

}  // namespace
}  // namespace bvhbench
