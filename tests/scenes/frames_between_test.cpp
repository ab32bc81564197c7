// SPDX-License-Identifier: MIT
#include "scenes/frames_between.h"

#include <cmath>
#include <cstring>

#include "helpers.h"
#include "scenes/finish.h"

namespace bvhbench {
namespace {

/// One triangle whose first corner goes where the frames say.
Scene path(std::initializer_list<Point> corner)
{
    Scene scene;
    scene.name = "path";
    scene.faces = {{0, 1, 2}};
    for (const Point point : corner)
        scene.frames.push_back({point, {1, 0, 0}, {0, 1, 0}});
    return finished(scene);
}

TEST(FramesBetween, KeepWhatWasThereBitForBit)
{
    const Scene before = load_scene("cloth-ball:500:3", {});
    const Scene after = with_frames_between(before, 4);
    ASSERT_EQ(after.frames.size(), 11u);
    for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(std::memcmp(after.frames[5 * k].data(), before.frames[k].data(),
                              before.frames[k].size() * sizeof(Point)),
                  0);
    EXPECT_NE(after.content_hash, before.content_hash);
    EXPECT_EQ(after.name, before.name);
    EXPECT_EQ(with_frames_between(before, 0).content_hash, before.content_hash);
}

TEST(FramesBetween, AreOnTheStraightWayRoundedOnce)
{
    const Point a = {0.1f, -3e7f, 1e-40f}, b = {16777216.0f, 7.0f, 3e38f};
    const Scene scene = with_frames_between(path({a, b}), 9);
    ASSERT_EQ(scene.frames.size(), 11u);
    for (int k = 1; k < 10; ++k) {
        const double t = k / 10.0;
        const Point is = scene.frames[k][0];
        EXPECT_EQ(is.x, static_cast<float>((1 - t) * a.x + t * b.x));
        EXPECT_EQ(is.y, static_cast<float>((1 - t) * a.y + t * b.y));
        EXPECT_EQ(is.z, static_cast<float>((1 - t) * a.z + t * b.z));
        EXPECT_EQ(scene.frames[k][1].x, 1.0f);  // what stays stays
    }
}

TEST(FramesBetween, HaveNoNegativeZeroAndStayFinite)
{
    const Scene tiny = with_frames_between(path({{-1e-45f, 0, 0}, {0, 0, 0}}), 7);
    for (const auto& frame : tiny.frames)
        EXPECT_FALSE(frame[0].x == 0 && std::signbit(frame[0].x));
    const float most = 3.4028235e38f;
    const Scene huge = with_frames_between(path({{-most, most, 0}, {most, most, 0}}), 3);
    EXPECT_EQ(huge.frames[2][0].x, 0.0f);
    EXPECT_EQ(huge.frames[2][0].y, most);
}

TEST(FramesBetween, AreLabelledByTheFrameBefore)
{
    Scene scene = path({{0, 0, 0}, {1, 0, 0}});
    scene.frame_labels = {"7", "9"};
    const std::vector<std::string> expected = {"7", "7+1/3", "7+2/3", "9"};
    EXPECT_EQ(with_frames_between(scene, 2).frame_labels, expected);
}

TEST(FramesBetween, NeedTwoFramesAndMemory)
{
    EXPECT_THROW(with_frames_between(path({{0, 0, 0}}), 1), BadUsage);
    EXPECT_EQ(with_frames_between(path({{0, 0, 0}}), 0).frames.size(), 1u);
    EXPECT_THROW(with_frames_between(load_scene("n-body:1000000:2", {}), 0xffffffffu), Unavailable);
}

}  // namespace
}  // namespace bvhbench
