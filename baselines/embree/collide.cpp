// SPDX-License-Identifier: MIT
//
// rtcCollide: Embree's own traversal of its own trees, the broad phase of whoever takes a library for it.
//
// A scene an object, of one user geometry each. Objects whose boxes overlap are held against each other, and an object
// against itself only if that is asked for: never slower than one scene of all objects, and between the 305 of a
// real frame a query is fourteen times as fast, for a scene against itself finds all pairs of neighbours first.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "baselines/colliders.h"
#include "baselines/embree/device.h"
#include "baselines/embree/thread_pairs.h"
#include "collide/oracles/host_collider.h"
#include "collide/oracles/sweep.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

/// Embree has its threads take floats below the normal ones for zeros, most of the time, and some of it stops the
/// program where an extent is one. Of floats that are zero or from `least` up, differences are zero or normal, too.
/// A box rounded outward to these may only meet too many others.
float rounded_down(float x)
{
    constexpr float least = 0x1p-100f;
    return std::abs(x) >= least ? x : x < 0 ? -least : 0;
}

Aabb rounded_outward(const Aabb& box)
{
    return {rounded_down(box.min_x),   rounded_down(box.min_y),   rounded_down(box.min_z),
            -rounded_down(-box.max_x), -rounded_down(-box.max_y), -rounded_down(-box.max_z)};
}

bool is_point(const Aabb& box)
{
    return box.min_x == box.max_x && box.min_y == box.max_y && box.min_z == box.max_z;
}

bool is_in_range(const Aabb& box)
{
    for (const float x : {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z})
        if (!(std::abs(x) < embree_largest_coordinate))
            return false;
    return true;
}

bool same(const Aabb& a, const Aabb& b)
{
    return a.min_x == b.min_x && a.min_y == b.min_y && a.min_z == b.min_z && a.max_x == b.max_x &&
           a.max_y == b.max_y && a.max_z == b.max_z;
}

class Embree final : public HostCollider {
public:
    Embree(const Device& device, const ColliderOptions& options)
        : HostCollider(
              device,
              {"embree", "Embree's rtcCollide, low quality, on all host threads [Wald2014]"},
              options)
        , device_(start_embree())
    {}

    void reserve(const Tree*, const Input& input) override
    {
        boxes_.resize(input.faces.size());
        objects_.clear();
        for (const FaceRange& faces : input.objects) {
            if (faces.count == 0)
                continue;  // rtcCollide calls a scene without triangles an invalid operation
            auto object = std::make_unique<Object>(Object{this, faces, {}, {}});
            object->geometry.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
            rtcSetGeometryUserPrimitiveCount(object->geometry.get(), faces.count);
            rtcSetGeometryUserData(object->geometry.get(), object.get());
            rtcSetGeometryBoundsFunction(object->geometry.get(), tell_box, nullptr);
            object->scene.reset(rtcNewScene(device_.get()));
            rtcSetSceneFlags(object->scene.get(), RTC_SCENE_FLAG_DYNAMIC);
            // Low on both: of either alone Embree makes what takes longer than it saves when points move each frame.
            rtcSetGeometryBuildQuality(object->geometry.get(), RTC_BUILD_QUALITY_LOW);
            rtcSetSceneBuildQuality(object->scene.get(), RTC_BUILD_QUALITY_LOW);
            rtcAttachGeometry(object->scene.get(), object->geometry.get());
            objects_.push_back(std::move(object));
        }
        object_boxes_.resize(objects_.size());
    }

    /// The boxes. What Embree takes it does not tell.
    Footprint reserved() const override
    {
        return {0, (boxes_.size() + object_boxes_.size()) * sizeof(Aabb)};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        std::optional<std::size_t> beyond;
        queue.on_host("hierarchy", [&] {
            beyond = take_boxes(input);
            if (!beyond)
                build();
        });
        if (beyond)
            throw Unavailable("Embree takes no coordinates beyond 1.8e18, and triangle " +
                              std::to_string(*beyond) + " has some");
        queue.on_host("broad", [&] { collide(input); });
        if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
            throw Unavailable("Embree found no pairs: its error " + std::to_string(error));
    }

private:
    struct Object {
        const Embree* of;
        FaceRange faces;
        EmbreeHandle<RTCGeometry> geometry;
        EmbreeHandle<RTCScene> scene;
    };

    /// Two objects, or one twice.
    struct Meeting {
        Embree* of;
        const Object* a;
        const Object* b;
    };

    static void tell_box(const RTCBoundsFunctionArguments* asked)
    {
        const auto& object = *static_cast<const Object*>(asked->geometryUserPtr);
        const Aabb& box = object.of->boxes_[object.faces.first + asked->primID];
        *asked->bounds_o = {box.min_x, box.min_y, box.min_z, 0, box.max_x, box.max_y, box.max_z, 0};
    }

    /// Called by all of Embree's threads, for a few pairs at a time whose leaves' boxes overlap.
    static void add(void* meeting, RTCCollision* collisions, unsigned count)
    {
        const auto& [self, a, b] = *static_cast<const Meeting*>(meeting);
        std::vector<Pair>& list = self->by_thread_.mine();
        for (const RTCCollision* one = collisions; one != collisions + count; ++one) {
            const Pair pair = {a->faces.first + one->primID0, b->faces.first + one->primID1};
            // Of an object with itself both (a, b) and (b, a) are told, and triangles with themselves.
            if (pair.a < pair.b && overlap(self->boxes_[pair.a], self->boxes_[pair.b]) &&
                (self->options_.keep_adjacent ||
                 !share_a_vertex(self->faces_[pair.a], self->faces_[pair.b])))
                list.push_back(pair);
        }
    }

    /// The boxes of this frame; the first triangle that reaches beyond what Embree takes, if one does.
    std::optional<std::size_t> take_boxes(const Input& input)
    {
        faces_ = input.faces;
        is_rounded_ = false;
        for (std::size_t k = 0; k < objects_.size(); ++k) {
            const auto [first, count] = objects_[k]->faces;
            Aabb around = empty_box();
            for (std::size_t i = first; i < first + count; ++i) {
                const Aabb box = leaf_box(input, faces_[i]);
                if (!is_in_range(box))
                    return i;
                boxes_[i] = rounded_outward(box);
                is_rounded_ = is_rounded_ || !same(box, boxes_[i]);
                around = merged(around, boxes_[i]);
            }
            if (is_point(around))
                give_extent(first, count, around);
            object_boxes_[k] = around;
        }
        return {};
    }

    /// To triangles that are all one point: over two to four of them Embree asserts that there is an extent.
    void give_extent(uint first, uint count, Aabb& around)
    {
        constexpr float above = std::numeric_limits<float>::max();
        around.max_x = -rounded_down(-std::nextafter(around.max_x, above));
        std::fill_n(boxes_.begin() + first, count, around);
        is_rounded_ = true;
    }

    void build()
    {
        for (const auto& object : objects_) {
            rtcCommitGeometry(object->geometry.get());
            rtcCommitScene(object->scene.get());
        }
    }

    void collide(const Input& input)
    {
        by_thread_.clear();
        if (options_.among != Among::within_objects) {
            const PairList near = overlapping_pairs(object_boxes_);
            for (const Pair pair : near.pairs())
                meet(*objects_[pair.a], *objects_[pair.b]);
        }
        if (options_.among != Among::between_objects)
            for (const auto& object : objects_)
                meet(*object, *object);
        found_.clear();
        by_thread_.append_to(found_);
        if (is_rounded_)
            std::erase_if(found_, [&](Pair pair) {
                return !overlap(leaf_box(input, faces_[pair.a]), leaf_box(input, faces_[pair.b]));
            });
    }

    void meet(const Object& a, const Object& b)
    {
        Meeting meeting = {this, &a, &b};
        rtcCollide(a.scene.get(), b.scene.get(), add, &meeting);
    }

    EmbreeHandle<RTCDevice> device_;
    std::vector<std::unique_ptr<Object>> objects_;
    std::span<const Face> faces_;
    std::vector<Aabb> boxes_;  ///< as Embree gets them, each the triangle's unless `is_rounded_`
    std::vector<Aabb> object_boxes_;
    bool is_rounded_ = false;
    ThreadPairs by_thread_;
};

}  // namespace

std::unique_ptr<Collider> make_embree_collider(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Embree>(programs.device(), options);
}

}  // namespace bvhbench
