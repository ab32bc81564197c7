// SPDX-License-Identifier: MIT
//
// Coal (once HPP-FCL): its broad phase over a dynamic tree of boxes. Every triangle is an object, whose box this adapter sets.
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/collision_object.h>

#include "host_method.h"
#include "tree_writer.h"

#include <deque>

namespace {

using Node = coal::DynamicAABBTreeCollisionManager::DynamicAABBNode;

class Coal : public adapter::HostMethod {
public:
    Coal()
    {
        manager_.tree_init_level = 2;
    }  // Morton codes: of the four ways the fastest for a frame

    void prepare(const bvhbench_mesh& mesh) override
    {
        HostMethod::prepare(mesh);
        manager_.clear();
        objects_.clear();
        listed_.clear();
        const auto shape =
            std::make_shared<coal::Sphere>(1);  // of no meaning: no object is looked into
        for (uint64_t t = 0; t < mesh.triangles; ++t) {
            coal::CollisionObject& object = objects_.emplace_back(shape, false);
            object.setUserData(reinterpret_cast<void*>(t));
            listed_.push_back(&object);
        }
    }

    bvhbench_tree tree() override
    {
        return writer_.written(
            static_cast<const Node*>(manager_.getTree().getRoot()), [](const Node* node) {
                const auto &low = node->bv.min_, &high = node->bv.max_;  // doubles that were floats
                adapter::Spelled<const Node*> spelled{
                    {float(low[0]), float(low[1]), float(low[2])},
                    {float(high[0]), float(high[1]), float(high[2])},
                    {},
                    {}};
                if (node->isLeaf())
                    spelled.triangles = {
                        triangle_of(static_cast<const coal::CollisionObject*>(node->data))};
                else
                    spelled.children = {node->children[0], node->children[1]};
                return spelled;
            });
    }

protected:
    void make_tree() override
    {
        set_boxes();
        manager_.clear();
        manager_.registerObjects(listed_);
    }

    void refit_tree() override
    {
        set_boxes();
        manager_.update();
    }

    void find_pairs() override
    {
        struct Found : coal::CollisionCallBackBase {
            Coal* to;
            bool collide(coal::CollisionObject* a, coal::CollisionObject* b) override
            {
                to->add(0, triangle_of(a), triangle_of(b));
                return false;
            }
        } found;
        found.to = this;
        manager_.collide(&found);
    }

    uint64_t tree_bytes() const override
    {
        return triangles() * (sizeof(coal::CollisionObject) + sizeof(void*) + 2 * sizeof(Node));
    }

private:
    static uint32_t triangle_of(const coal::CollisionObject* object)
    {
        return static_cast<uint32_t>(reinterpret_cast<std::uintptr_t>(object->getUserData()));
    }

    void set_boxes()
    {
        adapter::in_parallel(triangles(), [this](unsigned, uint32_t t) {
            const adapter::Box& box = boxes()[t];
            objects_[t].getAABB() = coal::AABB(coal::Vec3s(box.low[0], box.low[1], box.low[2]),
                                               coal::Vec3s(box.high[0], box.high[1], box.high[2]));
        });
    }

    std::deque<coal::CollisionObject> objects_;
    std::vector<coal::CollisionObject*> listed_;
    coal::DynamicAABBTreeCollisionManager manager_;
    adapter::TreeWriter writer_;
};

}  // namespace

const bvhbench_plugin* bvhbench_plugin_entry(uint32_t host_abi)
{
    static const bvhbench_method methods[] = {adapter::method<adapter::RefittedHostCollider<Coal>>(
        "coal", "DynamicAABBTreeCollisionManager: registerObjects, update and collide; one core")};
    return adapter::plugin(host_abi, "Coal", LIBRARY_VERSION, "BSD-3-Clause", "host", methods);
}
