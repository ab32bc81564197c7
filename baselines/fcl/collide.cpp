// SPDX-License-Identifier: MIT
//
// FCL's collision of meshes, the narrow phase of many robot planners: each object is a model with a tree, and leaves are tested
// triangle against triangle.
//
// Volumes are axis-aligned boxes of floats, which hold the points exactly: of FCL's volumes they take the least time, both to
// build and to traverse. Triangles are tested by FCL in doubles, because it misses pairs in floats.
//
// FCL itself runs on one core. Models are independent of each other and a traversal only reads them, so models are built, and parts
// of traversals run, on all cores. The functions inside fcl::collide are called, because fcl::collide copies both models for each
// pair of objects.
#include <fcl/math/bv/utility.h>
#include <fcl/narrowphase/detail/traversal/collision/bvh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision/intersect.h>
#include <fcl/narrowphase/detail/traversal/traversal_recurse.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <limits>

#include "baselines/baselines.h"
#include "baselines/fcl/model.h"
#include "baselines/object_pairs.h"
#include "baselines/thread_pairs.h"
#include "collide/oracles/host_collider.h"

namespace bvhbench {
namespace {

using Volume = fcl::AABB<float>;

constexpr uint unused = std::numeric_limits<uint>::max();

/// An object's FCL model, which contains only the points that its triangles use, renumbered.
struct Object {
    FaceRange range;
    std::span<const Face> faces;
    std::vector<uint> used;  ///< index in the frame of each of the model's points
    std::unique_ptr<fcl::BVHModel<Volume>> model;
};

/// A part of FCL's traversal of two trees: a node of each or, of one tree, a node with itself.
struct Part {
    const Object *a, *b;
    int node_a, node_b;

    bool is_with_itself() const { return a == b && node_a == node_b; }
};

/// FCL's traversal, without tests of triangles that share a vertex: FCL only reports that these touch.
class Traversal final : public fcl::detail::BVHCollisionTraversalNode<Volume> {
public:
    /// Pairs are added to `found`.
    Traversal(const Part& part, std::vector<Pair>& found) : part_(part), found_(found)
    {
        model1 = part.a->model.get();
        model2 = part.b->model.get();
    }

    void run()
    {
        if (part_.is_with_itself())
            fcl::detail::selfCollisionRecurse<float>(this, part_.node_a, nullptr);
        else
            fcl::detail::collisionRecurse<float>(this, part_.node_a, part_.node_b, nullptr);
    }

    /// Adds the parts that FCL's recursion makes of this one in its next step. Returns false if it ends here.
    bool split(std::vector<Part>& parts) const
    {
        const auto [a, b, i, j] = part_;
        const bool is_at_leaves = isFirstNodeLeaf(i) && isSecondNodeLeaf(j);
        if (part_.is_with_itself()) {
            if (is_at_leaves)
                return false;
            const int left = getFirstLeftChild(i), right = getFirstRightChild(i);
            parts.insert(parts.end(),
                         {{a, a, left, left}, {a, a, right, right}, {a, a, left, right}});
            return true;
        }
        if (BVTesting(i, j))  // true if the boxes are apart
            return false;
        if (is_at_leaves)
            parts.push_back(part_);
        else if (firstOverSecond(i, j))
            parts.insert(parts.end(),
                         {{a, b, getFirstLeftChild(i), j}, {a, b, getFirstRightChild(i), j}});
        else
            parts.insert(parts.end(),
                         {{a, b, i, getSecondLeftChild(j)}, {a, b, i, getSecondRightChild(j)}});
        return !is_at_leaves;
    }

    bool canStop() const override { return false; }

    void leafTesting(int leaf1, int leaf2) const override
    {
        const int one = model1->getBV(leaf1).primitiveId();
        const int other = model2->getBV(leaf2).primitiveId();
        if (share_a_vertex(part_.a->faces[static_cast<std::size_t>(one)],
                           part_.b->faces[static_cast<std::size_t>(other)]))
            return;
        const std::array<fcl::Vector3d, 3> p = corners(*model1, one), q = corners(*model2, other);
        if (!fcl::detail::Intersect<double>::intersect_Triangle(p[0], p[1], p[2], q[0], q[1], q[2]))
            return;
        const uint a = part_.a->range.first + static_cast<uint>(one);
        const uint b = part_.b->range.first + static_cast<uint>(other);
        found_.push_back({std::min(a, b), std::max(a, b)});
    }

private:
    static std::array<fcl::Vector3d, 3> corners(const fcl::BVHModel<Volume>& model, int triangle)
    {
        const fcl::Triangle& of = model.tri_indices[triangle];
        const auto point = [&](std::size_t vertex) -> fcl::Vector3d {
            return model.vertices[vertex].cast<double>();
        };
        return {point(of[0]), point(of[1]), point(of[2])};
    }

    Part part_;
    std::vector<Pair>& found_;
};

/// Splits parts, a step of the recursion at a time, until there are enough for all cores.
std::vector<Part> split_for_all_cores(std::vector<Part> parts)
{
    constexpr std::size_t parts_a_core = 64;
    const std::size_t enough =
        parts_a_core * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    std::vector<Pair> none;
    for (bool goes_on = true; goes_on && parts.size() < enough;) {
        goes_on = false;
        std::vector<Part> next;
        for (const Part& part : parts)
            goes_on = Traversal(part, none).split(next) || goes_on;
        parts = std::move(next);
    }
    return parts;
}

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
        boxes_.resize(objects_.size());
    }

    /// Counts FCL's trees, and the pairs. FCL's copies of the mesh are not counted.
    Footprint reserved() const override
    {
        std::size_t nodes = 0;
        for (const auto& object : objects_)
            nodes += 2 * object->faces.size() - 1;
        return {nodes * (sizeof(fcl::BVNode<Volume>) + sizeof(unsigned)),
                found_.size() * sizeof(Pair)};
    }

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        const bool refits = keep_ == Keep::topology;
        ObjectTasks tasks;
        queue.on_host(refits ? "refit" : "hierarchy", [&] {
            tbb::parallel_for(std::size_t{0}, objects_.size(), [&](std::size_t k) {
                boxes_[k] = box_of(*objects_[k], input.points);
            });
            tasks = object_tasks(boxes_, options_);
            tbb::parallel_for(std::size_t{0}, tasks.with_trees.size(), [&](std::size_t k) {
                move(*objects_[tasks.with_trees[k]], input.points);
            });
        });
        queue.on_host("broad", [&] { collide(tasks.meetings); });
        more_ = {
            {refits ? "refitted_objects_count" : "rebuilt_objects_count", tasks.with_trees.size()}};
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
        object->model = model_of<Volume>(points, faces);
        require_tree(object->model->endModel());
        return object;
    }

    static Aabb box_of(const Object& object, std::span<const Point> points)
    {
        Aabb around = empty_box();
        for (const uint vertex : object.used)
            around = merged(around, triangle_box(points[vertex], points[vertex], points[vertex]));
        return around;
    }

    /// Moves the model to the current points, and rebuilds or refits its tree.
    void move(Object& object, std::span<const Point> points) const
    {
        // Replaces instead of updating, since the boxes of an updated model also enclose the former points.
        object.model->beginReplaceModel();
        for (const uint vertex : object.used)
            object.model->replaceVertex(fcl_point<float>(points[vertex]));
        const bool bottom_up = true;
        require_tree(object.model->endReplaceModel(keep_ == Keep::topology, bottom_up));
    }

    void collide(const std::vector<Pair>& meetings)
    {
        std::vector<Part> parts;
        for (const Pair pair : meetings)
            parts.push_back({objects_[pair.a].get(), objects_[pair.b].get(), 0, 0});
        parts = split_for_all_cores(std::move(parts));
        by_thread_.clear();
        tbb::parallel_for(std::size_t{0}, parts.size(),
                          [&](std::size_t k) { Traversal(parts[k], by_thread_.mine()).run(); });
        found_.clear();
        by_thread_.append_to(found_);
    }

    Keep keep_;
    std::vector<std::unique_ptr<Object>> objects_;
    std::vector<Aabb> boxes_;  ///< one per object
    ThreadPairs by_thread_;
};

}  // namespace

std::unique_ptr<Collider> make_fcl_collider(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Fcl>(programs.device(), "fcl",
                                 "FCL, trees built each time, on all cores of the host [Pan2012]",
                                 options, Keep::nothing);
}

std::unique_ptr<Collider> make_fcl_refit_collider(Programs& programs,
                                                  const ColliderOptions& options)
{
    return std::make_unique<Fcl>(
        programs.device(), "fcl-refit",
        "FCL, trees refit to moved points, on all cores of the host [Pan2012]", options,
        Keep::topology);
}

}  // namespace bvhbench
