// SPDX-License-Identifier: MIT
//
// Many small worlds of boxes, each an object (make_worlds in generators.h). A body is a box that bounds what it stands for: a box on
// the floor is turned about the vertical, and a link of a robot is a rod from joint to joint.
#include <algorithm>

#include "scenes/generate/generators.h"
#include "scenes/generate/random.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

// Lengths in metres.
constexpr uint most_links = 28, links_a_limb = 7;
constexpr double link_length = 0.12, link_radius = 0.03;
constexpr double pile_distance = 0.2,
                 pile_shift = 0.04;                    // between piles, and of a pile to each side
constexpr double least_half = 0.04, most_half = 0.09;  // sides of a box in a pile
constexpr double sinks = 0.001;                        // depth of what rests in what it rests on
constexpr double slide = 0.15;                         // way of a pile that moves, in all frames
constexpr double margin = 0.3, floor_depth = 0.1,
                 gap = 0.5;     // of floors: beyond the piles, below, between
constexpr double swing = 0.06;  // of a joint to each side, in turns

struct Box {
    Vector low, high;
};

Box around(Vector centre, Vector half) { return {centre - half, centre + half}; }

/// Numbers of a world of `bodies` bodies.
struct Plan {
    uint links, side;  ///< links of the robot; piles along a side of their square
    double half;       ///< half the side of the floor

    explicit Plan(uint bodies)
        : links(std::min(most_links, (bodies - 1) / 3))
        , side(static_cast<uint>(std::ceil(std::sqrt((bodies - 1 - links) / 2.0))))
        , half(std::max(1.0, 0.5 * side * pile_distance + margin))
    {}
};

/// The bodies of one world, around the origin, at `time` from 0 to 1.
class World {
public:
    World(uint number, uint bodies, double time) : random_(number + 1), plan_(bodies), time_(time)
    {
        boxes_.push_back({{-plan_.half, -floor_depth, -plan_.half}, {plan_.half, 0, plan_.half}});
        for (uint first = 0; first < plan_.links; first += links_a_limb)
            add_limb(first, std::min(plan_.links, first + links_a_limb));
        for (uint pile = 0; boxes_.size() < bodies; ++pile)
            add_pile(pile, bodies);
    }
    const std::vector<Box>& boxes() const { return boxes_; }

private:
    /// Adds the links `first` to `end` - 1: a chain from the robot's foot, in a vertical plane.
    void add_limb(uint first, uint end)
    {
        const Turn plane = turn_of(static_cast<double>(first) / plan_.links + random_.unit());
        double pitch = 0.25;
        Vector joint = {0, link_radius - sinks, 0};
        for (uint link = first; link < end; ++link) {
            const double phase = random_.unit();
            pitch += swing * (random_.symmetric() + turn_of(time_ + phase).sine);
            const Turn rise = turn_of(pitch);
            Vector next = joint + link_length * Vector{rise.cosine * plane.cosine, rise.sine,
                                                       rise.cosine * plane.sine};
            next.y = std::max(next.y, link_radius - sinks);
            const Vector thick = {link_radius, link_radius, link_radius};
            const Vector low = {std::min(joint.x, next.x), std::min(joint.y, next.y),
                                std::min(joint.z, next.z)};
            const Vector high = {std::max(joint.x, next.x), std::max(joint.y, next.y),
                                 std::max(joint.z, next.z)};
            boxes_.push_back({low - thick, high + thick});
            joint = next;
        }
    }

    /// Adds one to three boxes on top of each other. The place of pile k is the k-th of a square, row by row, and where all are
    /// taken, a random one.
    void add_pile(uint pile, uint bodies)
    {
        const uint places = plan_.side * plan_.side;
        const auto anywhere = static_cast<uint>(random_.unit() * static_cast<float>(places));
        const uint place = pile < places ? pile : std::min(anywhere, places - 1);
        const auto along = [&](uint k) {
            return (k + 0.5 - 0.5 * plan_.side) * pile_distance + pile_shift * random_.symmetric();
        };
        Vector at = {along(place % plan_.side), 0, along(place / plan_.side)};
        const bool moves = random_.unit() < 0.1f;
        const Turn way = turn_of(random_.unit());
        if (moves)
            at = at + (slide * time_) * Vector{way.cosine, 0, way.sine};
        const uint count = 1 + static_cast<uint>(3 * random_.unit());
        for (uint k = 0; k < count && boxes_.size() < bodies; ++k) {
            const auto side = [&] {
                return least_half + (most_half - least_half) * random_.unit();
            };
            const Vector half = {side(), side(), side()};
            const Turn yaw = turn_of(random_.unit());
            const double c = std::fabs(yaw.cosine), s = std::fabs(yaw.sine);
            at.y += half.y - sinks;
            boxes_.push_back(
                around(at, {c * half.x + s * half.z, half.y, s * half.x + c * half.z}));
            at.y += half.y;
        }
    }

    Random random_;
    Plan plan_;
    double time_;
    std::vector<Box> boxes_;
};

}  // namespace

Scene make_worlds(uint worlds, uint bodies, uint frames)
{
    Scene scene;
    scene.source = "generated";
    for (uint world = 0; world < worlds; ++world)
        scene.objects.push_back({"world " + std::to_string(world), world * bodies, bodies});
    for (uint body = 0; body < worlds * bodies; ++body)
        scene.faces.push_back({2 * body, 2 * body + 1, 2 * body + 1});
    const auto columns = static_cast<uint>(std::ceil(std::sqrt(worlds)));
    const double apart = 2 * Plan(bodies).half + gap;
    for (uint frame = 1; frame <= frames; ++frame) {
        std::vector<Point>& points = scene.frames.emplace_back();
        points.reserve(2 * scene.faces.size());
        for (uint world = 0; world < worlds; ++world) {
            const Vector at = {(world % columns) * apart, 0, (world / columns) * apart};
            const World bodies_of(world, bodies, static_cast<double>(frame) / frames);
            for (const Box& box : bodies_of.boxes())
                points.insert(points.end(), {rounded(at + box.low), rounded(at + box.high)});
        }
    }
    return scene;
}

}  // namespace bvhbench
