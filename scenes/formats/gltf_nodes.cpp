// SPDX-License-Identifier: MIT
#include "scenes/formats/gltf_nodes.h"

#include <algorithm>

namespace bvhbench {
namespace {

using Json = nlohmann::json;

/// Returns translation * rotation * scale; `r` is a unit quaternion x, y, z, w.
GltfMatrix placed(const double* t, const double* r, const double* s)
{
    const double x = r[0], y = r[1], z = r[2], w = r[3];
    return {{s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
             s[0] * 2 * (x * z - y * w), 0, s[1] * 2 * (x * y - z * w),
             s[1] * (1 - 2 * (x * x + z * z)), s[1] * 2 * (y * z + x * w), 0,
             s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
             s[2] * (1 - 2 * (x * x + y * y)), 0, t[0], t[1], t[2], 1}};
}

}  // namespace

GltfNodes::GltfNodes(const GltfFile& file)
    : gltf_(file), nodes_(file.list(file.json(), "nodes").size())
{
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
        const Json& node = gltf_.item("nodes", k);
        nodes_[k].local = local(node);
        for (const std::size_t child : gltf_.index_list(node, "children")) {
            gltf_.item("nodes", child);
            if (nodes_[child].parent != none || child == k)
                gltf_.refuse("has a node, " + std::to_string(child) + ", with two parents");
            nodes_[child].parent = k;
        }
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k)
        if (nodes_[k].parent == none)
            order.push_back(k);
    for (std::size_t k = 0; k < order.size(); ++k) {
        Node& node = nodes_[order[k]];
        node.world = node.parent == none ? node.local : nodes_[node.parent].world * node.local;
        for (const std::size_t child : gltf_.index_list(gltf_.item("nodes", order[k]), "children"))
            order.push_back(child);
    }
    if (order.size() != nodes_.size())
        gltf_.refuse("has nodes that are their own parents");
}

GltfMatrix GltfNodes::local(const Json& node) const
{
    if (node.contains("matrix")) {
        GltfMatrix matrix;
        std::ranges::copy(gltf_.numbers(node, "matrix", std::vector<double>(16)),
                          matrix.at.begin());
        return matrix;
    }
    return placed(gltf_.numbers(node, "translation", {0, 0, 0}).data(),
                  gltf_.numbers(node, "rotation", {0, 0, 0, 1}).data(),
                  gltf_.numbers(node, "scale", {1, 1, 1}).data());
}

std::vector<std::size_t> GltfNodes::in_scene() const
{
    const std::size_t scenes = gltf_.list(gltf_.json(), "scenes").size();
    const std::size_t shown = gltf_.whole(gltf_.json(), "scene").value_or(0);
    std::vector<std::size_t> order;
    if (scenes == 0) {
        for (std::size_t k = nodes_.size(); k-- > 0;)
            if (nodes_[k].parent == none)
                order.push_back(k);
    } else {
        order = gltf_.index_list(gltf_.item("scenes", shown), "nodes");
        std::ranges::reverse(order);
    }
    std::vector<std::size_t> nodes;
    std::vector<bool> seen(nodes_.size());
    while (!order.empty()) {  // a stack
        const std::size_t node = order.back();
        order.pop_back();
        std::vector<std::size_t> children = gltf_.index_list(gltf_.item("nodes", node), "children");
        if (seen[node])
            gltf_.refuse("has a node, " + std::to_string(node) + ", twice in its scene");
        seen[node] = true;
        nodes.push_back(node);
        order.insert(order.end(), children.rbegin(), children.rend());
    }
    return nodes;
}

std::vector<GltfMatrix> GltfNodes::instances_of(std::size_t index) const
{
    const Json& node = gltf_.item("nodes", index);
    const GltfMatrix& world = nodes_[index].world;
    const Json& extension =
        gltf_.object(gltf_.object(node, "extensions"), "EXT_mesh_gpu_instancing");
    const Json& attributes = gltf_.object(extension, "attributes");
    if (attributes.empty())
        return {world};
    std::optional<std::size_t> count;
    for (const auto& [name, accessor] : attributes.items()) {
        const std::size_t there =
            gltf_
                .whole(gltf_.item("accessors", gltf_.whole(attributes, name.c_str()).value_or(0)),
                       "count")
                .value_or(0);
        if (there != count.value_or(there))
            gltf_.refuse("has instances with attributes of different counts");
        count = there;
    }
    if (node.contains("skin"))
        gltf_.refuse("has instances of a mesh with a skin, whose joints place it");
    const auto all = [&](const char* key, std::size_t width) -> std::optional<GltfNumbers> {
        const auto accessor = gltf_.whole(attributes, key);
        return accessor ? std::optional(gltf_.accessor(*accessor, width)) : std::nullopt;
    };
    const auto t = all("TRANSLATION", 3), r = all("ROTATION", 4), s = all("SCALE", 3);
    std::vector<GltfMatrix> placed_at;
    for (std::size_t k = 0; k < count.value_or(0); ++k) {
        double move[3] = {}, turn[4] = {0, 0, 0, 1}, size[3] = {1, 1, 1};
        if (t)
            t->read(k, move);
        if (r)
            r->read(k, turn);
        if (s)
            s->read(k, size);
        placed_at.push_back(world * placed(move, turn, size));
    }
    return placed_at;
}

std::vector<GltfMatrix> GltfNodes::joints_of(std::size_t index) const
{
    const Json& skin = gltf_.item("skins", index);
    const std::vector<std::size_t> nodes = gltf_.index_list(skin, "joints");
    std::optional<GltfNumbers> inverse;
    if (const auto accessor = gltf_.whole(skin, "inverseBindMatrices"))
        inverse = gltf_.accessor(*accessor, 16);
    if (inverse && inverse->size() < nodes.size())
        gltf_.refuse("has a skin with fewer matrices than joints");
    std::vector<GltfMatrix> joints;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        gltf_.item("nodes", nodes[k]);
        GltfMatrix bind;
        if (inverse)
            inverse->read(k, bind.at.data());
        joints.push_back(nodes_[nodes[k]].world * bind);
    }
    return joints;
}

}  // namespace bvhbench
