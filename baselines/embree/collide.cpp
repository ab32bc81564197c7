// SPDX-License-Identifier: MIT
//
// rtcCollide: Embree's traversal of its own trees, the broad phase of programs that use a library for it.
//
// Each object is a scene with one user geometry. Objects whose boxes overlap are tested against each other, and an object
// against itself only on request. This is never slower than one scene of all objects. Between the 305 objects of a real frame
// a query is fourteen times as fast, because a scene tested against itself first yields all pairs of neighbouring triangles.
//
// Embree takes boxes, builds and collides in parallel itself; the loops here do so for many objects. They use Embree's own
// threads, those of TBB.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <limits>

#include "baselines/baselines.h"
#include "baselines/embree/device.h"
#include "baselines/object_pairs.h"
#include "baselines/plain_libraries.h"
#include "baselines/thread_pairs.h"
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

/// The quality of the geometry decides how its tree is made: low from Morton codes, the others by surface areas, refit by surface
/// areas at first and then by new boxes over the same tree. That of the scene is low, because with any other Embree makes one
/// tree of all geometries, by surface areas, and never refits it.
std::unique_ptr<Object> object_of(const EmbreeHandle<RTCDevice>& device, FaceRange faces,
                                  const std::vector<Aabb>& boxes, RTCSceneFlags flags,
                                  RTCBuildQuality quality)
{
    auto object = std::make_unique<Object>(Object{faces, &boxes});
    object->geometry.reset(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_USER));
    rtcSetGeometryUserPrimitiveCount(object->geometry.get(), faces.count);
    rtcSetGeometryUserData(object->geometry.get(), object.get());
    rtcSetGeometryBoundsFunction(object->geometry.get(), tell_box, nullptr);
    object->scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(object->scene.get(), flags);
    rtcSetGeometryBuildQuality(object->geometry.get(), quality);
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
    Embree(const Device& device, std::string_view name, std::string_view method,
           const ColliderOptions& options, RTCBuildQuality quality)
        : HostCollider(device, {name, method}, options), quality_(quality), device_(start_embree())
    {
        memory_.watch(device_);
    }

    void reserve(const Tree*, const Input& input) override
    {
        boxes_.resize(input.faces.size());
        objects_.clear();
        memory_.begin();
        for (const FaceRange& faces : input.objects)
            if (faces.count > 0)  // rtcCollide refuses a scene without triangles
                objects_.push_back(
                    object_of(device_, faces, boxes_, RTC_SCENE_FLAG_DYNAMIC, quality_));
        object_boxes_.resize(objects_.size());
        if (!is_refit())
            return;
        take_boxes(input);
        for (const auto& object : objects_)
            build(*object);
        require_success(device_, "built no tree");
    }

    /// Counts what Embree held at most since `reserve`, our boxes, and the pairs.
    Footprint reserved() const override
    {
        return {memory_.peak_bytes(), (boxes_.size() + object_boxes_.size()) * sizeof(Aabb) +
                                          found_.size() * sizeof(Pair)};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        ObjectTasks tasks;
        queue.on_host(is_refit() ? "refit" : "hierarchy", [&] {
            take_boxes(input);
            tasks = object_tasks(object_boxes_, options_);
            tbb::parallel_for(std::size_t{0}, tasks.with_trees.size(),
                              [&](std::size_t k) { build(*objects_[tasks.with_trees[k]]); });
        });
        queue.on_host("broad", [&] { collide(input, tasks.meetings); });
        require_success(device_, "found no pairs");
        more_ = {{is_refit() ? "refitted_objects_count" : "rebuilt_objects_count",
                  tasks.with_trees.size()}};
    }

private:
    bool is_refit() const { return quality_ == RTC_BUILD_QUALITY_REFIT; }

    /// Computes the boxes of this frame. Throws Unavailable for a triangle out of Embree's range of coordinates.
    void take_boxes(const Input& input)
    {
        is_rounded_ = false;
        tbb::parallel_for(std::size_t{0}, objects_.size(), [&](std::size_t k) {
            const auto [first, count] = objects_[k]->faces;
            Aabb around = tbb::parallel_reduce(
                tbb::blocked_range<std::size_t>(first, first + count, boxes_a_task), empty_box(),
                [&](const auto& range, const Aabb& before) {
                    return merged(before, take_boxes(input, range.begin(), range.end()));
                },
                [](const Aabb& a, const Aabb& b) { return merged(a, b); });
            if (around.min_x == around.max_x && around.min_y == around.max_y &&
                around.min_z == around.max_z)
                give_extent(first, count, around);
            object_boxes_[k] = around;
        });
        // Not inside of the loops: TBB has crashed in cancelling them, among what Embree had left there.
        if (!std::ranges::all_of(object_boxes_, is_in_range))
            for (std::size_t i = 0; i < input.faces.size(); ++i)
                require_in_range(leaf_box(input, input.faces[i]), i);
    }

    /// Computes the boxes of a run of triangles and returns the box around them.
    Aabb take_boxes(const Input& input, std::size_t begin, std::size_t end)
    {
        Aabb around = empty_box();
        bool is_rounded = false;
        for (std::size_t i = begin; i < end; ++i) {
            const Aabb box = leaf_box(input, input.faces[i]);
            boxes_[i] = rounded_outward(box);
            is_rounded = is_rounded || sides_of(box) != sides_of(boxes_[i]);
            around = merged(around, boxes_[i]);
        }
        if (is_rounded)
            is_rounded_ = true;
        return around;
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

    void collide(const Input& input, const std::vector<Pair>& meetings)
    {
        by_thread_.clear();
        const auto wanted = [&](Pair pair) {
            return overlap(boxes_[pair.a], boxes_[pair.b]) &&
                   (options_.keep_adjacent ||
                    !share_a_vertex(input.faces[pair.a], input.faces[pair.b]));
        };
        tbb::parallel_for(std::size_t{0}, meetings.size(), [&](std::size_t k) {
            meet(*objects_[meetings[k].a], *objects_[meetings[k].b], by_thread_, wanted);
        });
        found_.clear();
        by_thread_.append_to(found_);
        if (is_rounded_)
            std::erase_if(found_, [&](Pair pair) {
                return !overlap(leaf_box(input, input.faces[pair.a]),
                                leaf_box(input, input.faces[pair.b]));
            });
    }

    static constexpr std::size_t boxes_a_task = 1024;

    RTCBuildQuality quality_;
    EmbreeMemory memory_;
    EmbreeHandle<RTCDevice> device_;
    std::vector<std::unique_ptr<Object>> objects_;
    std::vector<Aabb> boxes_;  ///< as given to Embree; equal to the triangles' unless `is_rounded_`
    std::vector<Aabb> object_boxes_;
    std::atomic<bool> is_rounded_ = false;
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
        made.push_back(object_of(device, range, boxes, RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_LOW));
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
    return std::make_unique<Embree>(
        programs.device(), "embree",
        "Embree's rtcCollide, trees of low quality built each time, on all host threads [Wald2014]",
        options, RTC_BUILD_QUALITY_LOW);
}

std::unique_ptr<Collider> make_embree_refit_collider(Programs& programs,
                                                     const ColliderOptions& options)
{
    return std::make_unique<Embree>(
        programs.device(), "embree-refit",
        "Embree's rtcCollide, trees refit to moved points, on all host threads [Wald2014]", options,
        RTC_BUILD_QUALITY_REFIT);
}

std::vector<PlainLibrary> plain_embree() { return {{"rtcCollide", "Embree", false, find_plainly}}; }

}  // namespace bvhbench
