// SPDX-License-Identifier: MIT
//
// FCL's collision of meshes, the narrow phase of many robot planners: each object is a model with a tree, and leaves are tested
// triangle against triangle. In double precision, because FCL in float misses pairs. With axis-aligned boxes, because with
// oriented boxes a frame takes three to four times as long, both to build and to traverse.
//
// The code calls the functions inside fcl::collide directly, because fcl::collide copies both models for each pair of objects.
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <algorithm>
#include <limits>

#include "baselines/baselines.h"
#include "baselines/fcl/model.h"
#include "baselines/object_pairs.h"
#include "collide/oracles/host_collider.h"

namespace bvhbench {
namespace {

constexpr uint unused = std::numeric_limits<uint>::max();

/// An object's FCL model, which contains only the points that its triangles use, renumbered.
struct Object {
    FaceRange range;
    std::span<const Face> faces;
    std::vector<uint> used;  ///< index in the frame of each of the model's points
    std::vector<fcl::Vector3d> moved;
    std::unique_ptr<fcl::BVHModel<fcl::AABBd>> model;
};

/// FCL's traversal of two trees, without tests of triangles that share a vertex: FCL only reports that these touch.
class Meeting final : public fcl::detail::MeshCollisionTraversalNode<fcl::AABBd> {
public:
    Meeting(std::span<const Face> faces1, std::span<const Face> faces2)
        : faces1_(faces1), faces2_(faces2)
    {}

    void leafTesting(int leaf1, int leaf2) const override
    {
        const auto triangle = [](const auto& of, int leaf) {
            return static_cast<std::size_t>(of.getBV(leaf).primitiveId());
        };
        if (!share_a_vertex(faces1_[triangle(*model1, leaf1)], faces2_[triangle(*model2, leaf2)]))
            MeshCollisionTraversalNode::leafTesting(leaf1, leaf2);
    }

private:
    std::span<const Face> faces1_;
    std::span<const Face> faces2_;
};

/// What is kept of a tree when its points have moved.
enum class Keep { nothing, topology };

class Fcl final : public HostCollider {
public:
    Fcl(const Device& device, std::string_view name, std::string_view method,
        const ColliderOptions& options, Keep keep)
        : HostCollider(device, {name, method}, options), keep_(keep)
    {
        if (options.keep_adjacent)
            throw BadUsage(std::string(name) +
                           " cannot keep adjacent triangles: it does not tell those that only touch"
                           " where they share a vertex from those that meet elsewhere too");
    }

    bool finds_contacts() const override { return true; }

    void reserve(const Tree*, const Input& input) override
    {
        objects_.clear();
        std::vector<uint> renumbered(input.points.size(), unused);
        for (const FaceRange& range : input.objects)
            if (range.count > 0)
                objects_.push_back(object_of(input, range, renumbered));
    }

    /// Counts FCL's trees. FCL's copies of the mesh and ours are not counted.
    Footprint reserved() const override
    {
        std::size_t nodes = 0;
        for (const auto& object : objects_)
            nodes += 2 * object->faces.size() - 1;
        return {nodes * (sizeof(fcl::BVNode<fcl::AABBd>) + sizeof(unsigned)), 0};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host(keep_ == Keep::topology ? "refit" : "hierarchy", [&] {
            boxes_.clear();
            for (const auto& object : objects_)
                boxes_.push_back(move(*object, input.points));
        });
        queue.on_host("broad", [&] { collide(); });
    }

private:
    static std::unique_ptr<Object> object_of(const Input& input, const FaceRange& range,
                                             std::vector<uint>& renumbered)
    {
        auto object = std::make_unique<Object>();
        object->range = range;
        object->faces = input.faces.subspan(range.first, range.count);
        std::vector<Point> points;
        const auto number = [&](uint vertex) {
            if (renumbered[vertex] == unused) {
                renumbered[vertex] = static_cast<uint>(points.size());
                points.push_back(input.points[vertex]);
                object->used.push_back(vertex);
            }
            return renumbered[vertex];
        };
        std::vector<Face> faces;
        for (const Face& face : object->faces)
            faces.push_back({number(face.a), number(face.b), number(face.c)});
        for (const uint vertex : object->used)
            renumbered[vertex] = unused;  // for the next object
        object->model = model_of<fcl::AABBd>(points, faces);
        require_tree(object->model->endModel());
        object->moved.resize(points.size());
        return object;
    }

    /// Moves the model to the current points, and rebuilds or refits its tree. Returns the object's box.
    Aabb move(Object& object, std::span<const Point> points) const
    {
        Aabb around = empty_box();
        for (std::size_t k = 0; k < object.used.size(); ++k) {
            const Point& p = points[object.used[k]];
            object.moved[k] = fcl_point<double>(p);
            around = merged(around, triangle_box(p, p, p));
        }
        // Replaces instead of updating, since the boxes of an updated model also enclose the former points.
        object.model->beginReplaceModel();
        object.model->replaceSubModel(object.moved);
        const bool bottom_up = true;
        require_tree(object.model->endReplaceModel(keep_ == Keep::topology, bottom_up));
        return around;
    }

    void collide()
    {
        found_.clear();
        for_near_objects(objects_, boxes_, options_.among,
                         [&](Object& a, Object& b) { meet(a, b); });
    }

    void meet(Object& a, Object& b)
    {
        // Requests all pairs, without contact data.
        const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), false);
        fcl::CollisionResultd result;
        fcl::Transform3d in_place = fcl::Transform3d::Identity();
        Meeting meeting(a.faces, b.faces);
        fcl::detail::initialize(meeting, *a.model, in_place, *b.model, in_place, request, result);
        if (&a == &b)
            fcl::detail::selfCollide<double>(&meeting);
        else
            fcl::detail::collide<double>(&meeting);
        for (std::size_t k = 0; k < result.numContacts(); ++k) {
            const fcl::Contactd& contact = result.getContact(k);
            const uint one = a.range.first + static_cast<uint>(contact.b1);
            const uint other = b.range.first + static_cast<uint>(contact.b2);
            found_.push_back({std::min(one, other), std::max(one, other)});
        }
    }

    Keep keep_;
    std::vector<std::unique_ptr<Object>> objects_;
    std::vector<Aabb> boxes_;  ///< one per object
};

}  // namespace

std::unique_ptr<Collider> make_fcl_collider(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Fcl>(
        programs.device(), "fcl",
        "FCL in double, trees built each time, on one core of the host [Pan2012]", options,
        Keep::nothing);
}

std::unique_ptr<Collider> make_fcl_refit_collider(Programs& programs,
                                                  const ColliderOptions& options)
{
    return std::make_unique<Fcl>(
        programs.device(), "fcl-refit",
        "FCL in double, trees refit to moved points, on one core of the host [Pan2012]", options,
        Keep::topology);
}

}  // namespace bvhbench
