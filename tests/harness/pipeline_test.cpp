// SPDX-License-Identifier: MIT
//
// Tests which work a frame's pipeline leaves out, and that it still finds the same pairs.
#include "harness/measure/device_verdict.h"
#include "tests/harness/frame_runs.h"

namespace bvhbench {
namespace {

/// Expects what is done to the objects in the second of three frames; in the first, both are built.
void expect_second_frame(const Scene& scene, const char* builder, unsigned rules_off,
                         double rebuilt, double refitted, double kept)
{
    SCOPED_TRACE(std::string(builder) + " without " + skip_rules_text(rules_off));
    const std::vector<Counters> frames =
        run_frames(scene, {{.order = "hilbert30"}, builder}, {{.rules_off = rules_off}, "group"});
    expect_updates(frames.at(0), 2, 0, 0);
    expect_updates(frames.at(1), rebuilt, refitted, kept);
}

TEST(Pipeline, RebuildsOfAMixedSceneOnlyWhatDeforms)
{
    const Scene scene = load_scene("cloth-ball:4000:3", {});
    for (const char* builder : {"oibvh-multi", "oibvh-single", "perfect"}) {
        expect_second_frame(scene, builder, 0, 1, 1, 0);
        expect_second_frame(scene, builder, skip_rigid, 2, 0, 0);
    }
    expect_second_frame(scene, "karras", 0, 2, 0, 0);
}

TEST(Pipeline, LeavesAloneWhatHasNotMoved)
{
    Scene scene = load_scene("cloth-ball:4000:3", {});
    const SceneObject& ball = scene.objects.back();
    for (uint face = ball.first_face; face < ball.first_face + ball.face_count; ++face)
        for (const uint corner : {scene.faces[face].a, scene.faces[face].b, scene.faces[face].c})
            scene.frames[1][corner] = scene.frames[0][corner];
    expect_second_frame(scene, "oibvh-multi", 0, 1, 0, 1);
    expect_second_frame(scene, "oibvh-multi", skip_unchanged, 1, 1, 0);
    expect_second_frame(scene, "oibvh-multi", skip_unchanged | skip_rigid, 2, 0, 0);
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
