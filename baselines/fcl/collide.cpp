// SPDX-License-Identifier: MIT
//
// FCL's collision of meshes, the narrow phase of many robot planners: a model an object, its tree, and a test of two
// triangles at the leaves. In double: FCL in float misses pairs.
//
// fcl::collide would copy both models for each pair of objects. What it calls then is called here instead.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/collision_request.h>
#include <fcl/narrowphase/collision_result.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <limits>
#include <utility>

#include "baselines/colliders.h"
#include "collide/sweep.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr uint unused = std::numeric_limits<uint>::max();

/// An object as FCL has it: the points that its triangles name, numbered anew.
template <class Volume>
struct Object {
    std::span<const Face> faces;
    uint first = 0;
    std::vector<uint> used;  ///< the frame's number of each of its points
    std::vector<fcl::Vector3d> moved;
    fcl::BVHModel<Volume> model;
};

/// FCL's descent of two trees. Adjacent triangles are not tested: FCL finds that they touch, and nothing else.
template <class Descent>
class Meeting final : public Descent {
public:
    std::span<const Face> faces1;
    std::span<const Face> faces2;

    void leafTesting(int b1, int b2) const override
    {
        if (!share_a_vertex(faces1[triangle(*this->model1, b1)], faces2[triangle(*this->model2, b2)]))
            Descent::leafTesting(b1, b2);
    }

private:
    template <class Model>
    static std::size_t triangle(const Model& model, int node)
    {
        return static_cast<std::size_t>(model.getBV(node).primitiveId());
    }
};

template <class Volume, class Descent>
class Fcl final : public Collider {
public:
    Fcl(const ColliderCard& card, const ColliderOptions& options) : card_(card), options_(options)
    {
        if (options.keep_adjacent)
            throw BadUsage(std::string(card.name) +
                           " cannot tell whether triangles that share a vertex meet beyond it");
    }

    ColliderCard card() const override { return card_; }
    bool needs_tree() const override { return false; }
    bool finds_contacts() const override { return true; }
    std::string refusal(const Tree&) const override { return {}; }

    void reserve(const Tree*, const Input& input) override
    {
        objects_.clear();
        std::vector<uint> renumbered(input.points.size(), unused);
        for (const FaceRange& range : input.objects)
            objects_.push_back(object_of(input, range, renumbered));
    }

    /// FCL's trees. Its copies of the mesh are not counted, and ours neither.
    Footprint reserved() const override
    {
        std::size_t nodes = 0;
        for (const auto& object : objects_)
            nodes += 2 * object->faces.size() - 1;
        return {nodes * (sizeof(fcl::BVNode<Volume>) + sizeof(unsigned)), 0};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host("hierarchy", [&] {
            boxes_.clear();
            for (const auto& object : objects_)
                boxes_.push_back(move(*object, input.points));
        });
        queue.on_host("broad", [&] {
            found_.clear();
            if (options_.among != Among::within_objects)
                for (const Pair pair : overlapping_pairs(boxes_).pairs())
                    meet(*objects_[pair.a], *objects_[pair.b]);
            if (options_.among != Among::between_objects)
                for (const auto& object : objects_)
                    meet(*object, *object);
        });
    }

    bool complete(const Queue&) override { return true; }
    QueryCounts counts(const Queue&) const override { return {found_.size(), {}, {}, {}}; }
    std::vector<Pair> pairs(const Queue&) const override { return found_; }

private:
    static std::unique_ptr<Object<Volume>> object_of(const Input& input, const FaceRange& range,
                                                     std::vector<uint>& renumbered)
    {
        auto object = std::make_unique<Object<Volume>>();
        object->faces = input.faces.subspan(range.first, range.count);
        object->first = range.first;
        const auto number = [&](uint vertex) {
            if (renumbered[vertex] == unused) {
                renumbered[vertex] = static_cast<uint>(object->used.size());
                object->used.push_back(vertex);
            }
            return renumbered[vertex];
        };
        std::vector<fcl::Triangle> triangles;
        for (const Face& face : object->faces)
            triangles.emplace_back(number(face.a), number(face.b), number(face.c));
        for (const uint vertex : object->used) {
            const Point& p = input.points[vertex];
            object->moved.emplace_back(p.x, p.y, p.z);
            renumbered[vertex] = unused;
        }
        object->model.beginModel(static_cast<int>(triangles.size()),
                                 static_cast<int>(object->moved.size()));
        object->model.addSubModel(object->moved, triangles);
        if (const int error = object->model.endModel(); error != fcl::BVH_OK)
            throw Unavailable("FCL built no tree: its error " + std::to_string(error));
        return object;
    }

    static Aabb move(Object<Volume>& object, std::span<const Point> points)
    {
        Aabb around = empty_box();
        for (std::size_t k = 0; k < object.used.size(); ++k) {
            const Point& p = points[object.used[k]];
            object.moved[k] = {p.x, p.y, p.z};
            around = merged(around, triangle_box(p, p, p));
        }
        object.model.beginReplaceModel();
        object.model.replaceSubModel(object.moved);
        object.model.endReplaceModel(getenv("REFIT") != nullptr, true);
        return around;
    }

    void meet(Object<Volume>& a, Object<Volume>& b)
    {
        fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), false);
        fcl::CollisionResultd result;
        fcl::Transform3d nowhere = fcl::Transform3d::Identity();
        Meeting<Descent> meeting;
        meeting.faces1 = a.faces;
        meeting.faces2 = b.faces;
        if constexpr (std::is_same_v<Volume, fcl::AABBd>)
            fcl::detail::initialize(meeting, a.model, nowhere, b.model, nowhere, request, result);
        else
            fcl::detail::initialize(static_cast<Descent&>(meeting), std::as_const(a.model), nowhere,
                                    std::as_const(b.model), nowhere, request, result);
        if (&a == &b)
            fcl::detail::selfCollide<double>(&meeting);
        else
            fcl::detail::collide<double>(&meeting);
        for (std::size_t k = 0; k < result.numContacts(); ++k) {
            const fcl::Contactd& contact = result.getContact(k);
            const uint one = a.first + static_cast<uint>(contact.b1);
            const uint other = b.first + static_cast<uint>(contact.b2);
            found_.push_back({std::min(one, other), std::max(one, other)});
        }
    }

    ColliderCard card_;
    ColliderOptions options_;
    std::vector<std::unique_ptr<Object<Volume>>> objects_;
    std::vector<Aabb> boxes_;  ///< of the objects
    std::vector<Pair> found_;
};

}  // namespace

std::unique_ptr<Collider> make_fcl_aabb_collider(Programs&, const ColliderOptions& options)
{
    using Descent = fcl::detail::MeshCollisionTraversalNode<fcl::AABBd>;
    return std::make_unique<Fcl<fcl::AABBd, Descent>>(
        ColliderCard{"fcl-aabb",
                     "FCL, axis-aligned boxes in double, on one core of the host [Pan2012]"},
        options);
}

std::unique_ptr<Collider> make_fcl_obbrss_collider(Programs&, const ColliderOptions& options)
{
    using Descent = fcl::detail::MeshCollisionTraversalNodeOBBRSSd;
    return std::make_unique<Fcl<fcl::OBBRSSd, Descent>>(
        ColliderCard{
            "fcl-obbrss",
            "FCL, oriented boxes and swept spheres in double, on one core of the host [Pan2012]"},
        options);
}

}  // namespace bvhbench
