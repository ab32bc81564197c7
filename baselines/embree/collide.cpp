// SPDX-License-Identifier: MIT
//
// rtcCollide: Embree's traversal of its own trees, the broad phase of programs that use a library for it.
//
// Each object is a scene with one user geometry. Objects whose boxes overlap are tested against each other, and an object
// against itself only on request. This is never slower than one scene of all objects. Between the 305 objects of a real frame
// a query is fourteen times as fast, because a scene tested against itself first yields all pairs of neighbouring triangles.
#include <algorithm>
#include <limits>

#include "baselines/baselines.h"
#include "baselines/embree/device.h"
#include "baselines/embree/thread_pairs.h"
#include "baselines/object_pairs.h"
#include "baselines/plain_libraries.h"
#include "collide/oracles/host_collider.h"

namespace bvhbench {
namespace {

/// An object's Embree geometry and scene. Must not move in memory, since the geometry's callback refers to it.
struct Object {
    FaceRange faces;
    const std::vector<Aabb>* boxes;  ///< of all triangles of the frame
    EmbreeHandle<RTCGeometry> geometry = {};
    EmbreeHandle<RTCScene> scene = {};
};

void tell_box(const RTCBoundsFunctionArguments* asked)
{
    const auto& object = *static_cast<const Object*>(asked->geometryUserPtr);
    const Aabb& box = (*object.boxes)[object.faces.first + asked->primID];
    *asked->bounds_o = {box.min_x, box.min_y, box.min_z, 0, box.max_x, box.max_y, box.max_z, 0};
}

std::unique_ptr<Object> object_of(const EmbreeHandle<RTCDevice>& device, FaceRange faces,
                                  const std::vector<Aabb>& boxes, RTCSceneFlags flags)
{
    auto object = std::make_unique<Object>(Object{faces, &boxes});
    object->geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(object->geometry.get(), faces.count);
    rtcSetGeometryUserData(object->geometry.get(), object.get());
    rtcSetGeometryBoundsFunction(object->geometry.get(), tell_box, nullptr);
    object->scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(object->scene.get(), flags);
    // Low quality on both: with either one higher, Embree's build costs more than queries save if points move every frame.
    rtcSetGeometryBuildQuality(object->geometry.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneBuildQuality(object->scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcAttachGeometry(object->scene.get(), object->geometry.get());
    return object;
}

void build(const Object& object)
{
    rtcCommitGeometry(object.geometry.get());
    rtcCommitScene(object.scene.get());
}

/// Adds to `found` the pairs between `a` and `b`, or within the object if &a == &b, for which `wanted` is true.
template <class Wanted>
void meet(const Object& a, const Object& b, ThreadPairs& found, const Wanted& wanted)
{
    struct Meeting {
        const Object &a, &b;
        ThreadPairs& found;
        const Wanted& wanted;
    } meeting{a, b, found, wanted};
    /// Called from all of Embree's threads with a few pairs at a time whose leaf boxes overlap.
    const auto add = [](void* data, RTCCollision* collisions, unsigned count) {
        const auto& of = *static_cast<const Meeting*>(data);
        std::vector<Pair>& list = of.found.mine();
        for (const RTCCollision* one = collisions; one != collisions + count; ++one) {
            const Pair pair = {of.a.faces.first + one->primID0, of.b.faces.first + one->primID1};
            // For an object with itself, Embree reports both (a, b) and (b, a), and each triangle with itself.
            if ((&of.a != &of.b || pair.a < pair.b) && of.wanted(pair))
                list.push_back(pair);
        }
    };
    rtcCollide(a.scene.get(), b.scene.get(), add, &meeting);
}

/// Returns x rounded down to zero or a magnitude of at least `least`. Embree's threads mostly treat subnormal floats as zeros,
/// and some of its code aborts on a subnormal extent. Differences of rounded values are zero or normal. Boxes rounded outward
/// contain the original boxes, so no pair is missed, but some found may not overlap.
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
        for (const FaceRange& faces : input.objects)
            if (faces.count > 0)  // rtcCollide refuses a scene without triangles
                objects_.push_back(object_of(device_, faces, boxes_, RTC_SCENE_FLAG_DYNAMIC));
        object_boxes_.resize(objects_.size());
    }

    /// Counts the boxes. Embree does not report the memory it allocates.
    Footprint reserved() const override
    {
        return {0, (boxes_.size() + object_boxes_.size()) * sizeof(Aabb)};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host("hierarchy", [&] {
            take_boxes(input);
            for (const auto& object : objects_)
                build(*object);
        });
        queue.on_host("broad", [&] { collide(input); });
        require_success(device_, "found no pairs");
    }

private:
    /// Computes the boxes of this frame. Throws Unavailable for the first triangle out of Embree's range of coordinates.
    void take_boxes(const Input& input)
    {
        is_rounded_ = false;
        for (std::size_t k = 0; k < objects_.size(); ++k) {
            const auto [first, count] = objects_[k]->faces;
            Aabb around = empty_box();
            for (std::size_t i = first; i < first + count; ++i) {
                const Aabb box = leaf_box(input, input.faces[i]);
                require_in_range(box, i);
                boxes_[i] = rounded_outward(box);
                is_rounded_ = is_rounded_ || sides_of(box) != sides_of(boxes_[i]);
                around = merged(around, boxes_[i]);
            }
            if (around.min_x == around.max_x && around.min_y == around.max_y &&
                around.min_z == around.max_z)
                give_extent(first, count, around);
            object_boxes_[k] = around;
        }
    }

    /// Enlarges the box of an object whose triangles all lie in one point, and gives it to all of them: for two to four such
    /// triangles Embree asserts a nonzero extent.
    void give_extent(uint first, uint count, Aabb& around)
    {
        constexpr float above = std::numeric_limits<float>::max();
        around.max_x = -rounded_down(-std::nextafter(around.max_x, above));
        std::fill_n(boxes_.begin() + first, count, around);
        is_rounded_ = true;
    }

    void collide(const Input& input)
    {
        by_thread_.clear();
        const auto wanted = [&](Pair pair) {
            return overlap(boxes_[pair.a], boxes_[pair.b]) &&
                   (options_.keep_adjacent ||
                    !share_a_vertex(input.faces[pair.a], input.faces[pair.b]));
        };
        for_near_objects(objects_, object_boxes_, options_.among,
                         [&](const Object& a, const Object& b) { meet(a, b, by_thread_, wanted); });
        found_.clear();
        by_thread_.append_to(found_);
        if (is_rounded_)
            std::erase_if(found_, [&](Pair pair) {
                return !overlap(leaf_box(input, input.faces[pair.a]),
                                leaf_box(input, input.faces[pair.b]));
            });
    }

    EmbreeHandle<RTCDevice> device_;
    std::vector<std::unique_ptr<Object>> objects_;
    std::vector<Aabb> boxes_;  ///< as given to Embree; equal to the triangles' unless `is_rounded_`
    std::vector<Aabb> object_boxes_;
    bool is_rounded_ = false;
    ThreadPairs by_thread_;
};

/// Calls rtcCollide as in Embree's tutorial: boxes are not rounded and all reported pairs are returned.
std::vector<Pair> find_plainly(std::span<const Point> points, std::span<const Face> faces,
                               std::span<const FaceRange> objects)
{
    const EmbreeHandle<RTCDevice> device = start_embree();
    const std::vector<Aabb> boxes = face_boxes(points, faces);
    std::vector<std::unique_ptr<Object>> made;
    for (const FaceRange& range : objects) {
        made.push_back(object_of(device, range, boxes, RTC_SCENE_FLAG_NONE));
        build(*made.back());
    }
    ThreadPairs by_thread;
    meet(*made.front(), *made.back(), by_thread, [](Pair) { return true; });
    require_success(device, "found no pairs");
    std::vector<Pair> found;
    by_thread.append_to(found);
    return found;
}

}  // namespace

std::unique_ptr<Collider> make_embree_collider(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Embree>(programs.device(), options);
}

std::vector<PlainLibrary> plain_embree() { return {{"rtcCollide", "Embree", false, find_plainly}}; }

}  // namespace bvhbench
