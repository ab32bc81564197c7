// SPDX-License-Identifier: MIT
#include "scenes/motion.h"

#include <cmath>
#include <functional>

#include "helpers.h"
#include "scenes/generate/derived.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

using Move = std::function<Vector(Vector)>;

/// Rotates about (1, 2, 2) / 3 and translates.
Vector turned_and_shifted(Vector a, double turns, Vector shift)
{
    const Vector axis = {1 / 3.0, 2 / 3.0, 2 / 3.0};
    const Turn turn = turn_of(turns);
    return turn.cosine * a + turn.sine * cross(axis, a) +
           ((1 - turn.cosine) * dot(axis, a)) * axis + shift;
}

/// Returns the motion found when `first` gives `scene` its first frame and `second` its second. Both are rounded, as in a file.
Motion motion_of(std::string_view name, const Move& first, const Move& second)
{
    Scene scene = load_scene(name, {});
    std::vector<Point> now;
    for (Point& point : scene.frames[0]) {
        const Vector at = vector_of(point);
        point = rounded(first(at));
        now.push_back(rounded(second(at)));
    }
    scene.frames.push_back(now);
    return object_motions(finished(scene), 0, 1).at(0);
}

const Move still = [](Vector a) { return a; };
constexpr const char* shapes[] = {"torus:500", "grid:3000", "sphere:20000", "soup:200",
                                  "soup:1",    "grid:2",    "hairball:2000"};

TEST(Motion, OfWhatStaysIsUnchanged)
{
    for (const char* shape : shapes)
        EXPECT_EQ(motion_of(shape, still, still), Motion::unchanged) << shape;
}

TEST(Motion, OfWhatTurnsOrIsShiftedIsRigid)
{
    for (const char* shape : shapes)
        for (const Vector shift : {Vector{0, 0, 0}, {0.001, 0, 0}, {1000, -2000, 3}, {1e-6, 1, 0}})
            for (const double turns : {0.0, 1e-6, 0.01, 0.25, 0.5, 0.9}) {
                const Move second = [&](Vector a) { return turned_and_shifted(a, turns, shift); };
                const Move first = [&](Vector a) { return turned_and_shifted(a, 0.3, {}); };
                EXPECT_EQ(motion_of(shape, first, [&](Vector a) { return first(second(a)); }),
                          turns == 0 && length(shift) == 0 ? Motion::unchanged : Motion::rigid)
                    << shape << " " << turns << " " << shift.x;
            }
}

TEST(Motion, OfWhatBendsALittleIsNot)
{
    // A sheet that is bent out of its plane changes its lengths only by the square of this, which floats cannot show.
    for (const char* shape : {"grid:3000", "torus:500", "sphere:20000", "soup:200"}) {
        const Move bent = [](Vector a) { return a + Vector{0, 0, 4e-5 * a.x * a.x}; };
        EXPECT_EQ(motion_of(shape, still, bent), Motion::deforming) << shape;
        const Move bent_and_turned = [&](Vector a) {
            return turned_and_shifted(bent(a), 0.2, {1, 2, 3});
        };
        EXPECT_EQ(motion_of(shape, still, bent_and_turned), Motion::deforming) << shape;
    }
}

TEST(Motion, OfWhatGrowsOrIsMirroredIsNot)
{
    const Move grown = [](Vector a) { return 1.00001 * a; };
    const Move mirrored = [](Vector a) { return Vector{-a.x, a.y, a.z}; };
    for (const char* shape : {"hairball:2000", "soup:200"}) {
        EXPECT_EQ(motion_of(shape, still, grown), Motion::deforming) << shape;
        EXPECT_EQ(motion_of(shape, still, mirrored), Motion::deforming) << shape;
    }
    EXPECT_EQ(motion_of("grid:3000", still, mirrored),
              Motion::rigid);  // a flat sheet may be turned over
}

TEST(Motion, OfOneVertexAmongManyIsSeen)
{
    Scene scene = load_scene("sphere:20000", {});
    scene.frames.push_back(scene.frames[0]);
    scene.frames[1][777].x += 2e-6f;
    EXPECT_EQ(object_motions(scene, 0, 1).at(0), Motion::deforming);
    scene.frames[1][777] = scene.frames[0][777];
    scene.frames[1][777].y = std::nextafter(scene.frames[0][777].y, 9.0f);  // within rounding
    EXPECT_EQ(object_motions(scene, 0, 1).at(0), Motion::rigid);
}

TEST(Motion, IsToldForEachObject)
{
    Scene scene = load_scene("n-body:3050:1", {});
    scene.frames.push_back(scene.frames[0]);
    const auto vertex = [&](std::size_t object) {
        return scene.faces[scene.objects[object].first_face].a;
    };
    scene.frames[1][vertex(3)].y += 0.01f;
    const auto motions = object_motions(scene, 0, 1);
    for (std::size_t k = 0; k < motions.size(); ++k)
        EXPECT_EQ(motions[k], k == 3 ? Motion::deforming : Motion::unchanged);
}

// Checks the bound itself: over many roundings of points in all shapes, the error of the fit never exceeds it.
TEST(RigidFit, LeavesNoMoreThanItsAllowance)
{
    Random random(5);
    for (int trial = 0; trial < 3000; ++trial) {
        const Vector scale = {1, trial % 3 == 0 ? 1.0 : 1e-3, trial % 2 == 0 ? 1.0 : 0.0};
        std::vector<Vector> from, to;
        for (int k = 0; k < 1 + trial % 7; ++k) {
            const Vector at = vector_of(random.in_ball());
            from.push_back({scale.x * at.x, scale.y * at.y, scale.z * at.z});
            const Vector off = (1e-6 / length(at)) * vector_of(random.in_ball());
            const double size = length(off);
            to.push_back(turned_and_shifted(from.back(), 0.37, {5, 6, 7}) +
                         (size > 1e-6 ? 1e-6 / size : 1.0) * off);
        }
        const RigidFit fit = fit_rigid(from, to);
        const std::vector<double> allowances = fit_allowances(from);
        for (std::size_t k = 0; k < from.size(); ++k)
            EXPECT_LE(length(to[k] - fit(from[k])), 1.001e-6 * allowances[k]) << trial;
    }
}

// Cases in which the allowance must exceed the 2 of a point and the mean: most points move the mean, some at both ends rotate
// the fit, and one of these moves against all others.
TEST(RigidFit, NeedsItsAllowanceForTheTurn)
{
    std::vector<Vector> from, to;
    const auto add = [&](double x, double up) {
        from.push_back({x, 0, 0});
        to.push_back({x, up, 0});
    };
    for (int k = 0; k < 3000; ++k)
        add(0, 1e-6);
    for (int k = 0; k < 60; ++k) {
        add(1, 1e-6);
        add(-1, -1e-6);
    }
    add(1, -1e-6);
    const double off = length(to.back() - fit_rigid(from, to)(from.back()));
    EXPECT_GT(off, 2.8e-6);
    EXPECT_LE(off, 1.001e-6 * fit_allowances(from).back());
}

/// Returns one triangle whose first corner is at `corner[k]` in frame k.
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
        EXPECT_TRUE(same_points(after.frames[5 * k], before.frames[k]));
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
        EXPECT_EQ(scene.frames[k][1].x, 1.0f);  // points at rest do not move
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
