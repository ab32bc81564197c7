// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "scenes/formats/gltf_file.h"

namespace bvhbench {

/// A transform: columns, the last of which is the translation.
struct GltfMatrix {
    std::array<double, 16> at = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    WidePoint operator*(const WidePoint& p) const
    {
        const auto row = [&](std::size_t k) {
            return at[k] * p.x + at[4 + k] * p.y + at[8 + k] * p.z + at[12 + k];
        };
        return {row(0), row(1), row(2)};
    }

    GltfMatrix operator*(const GltfMatrix& right) const
    {
        GltfMatrix product;
        for (std::size_t column = 0; column < 4; ++column)
            for (std::size_t row = 0; row < 4; ++row) {
                double sum = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    sum += at[4 * k + row] * right.at[4 * column + k];
                product.at[4 * column + row] = sum;
            }
        return product;
    }
};

/// The nodes of a glTF file, and where they place meshes. Transforms are products in double precision. Functions throw as GltfFile's.
class GltfNodes {
public:
    /// Computes the transform of every node of `file`, which must live as long as this. Throws for nodes that are no forest.
    explicit GltfNodes(const GltfFile& file);

    /// Returns the nodes of the scene that the file shows, each behind its parent; without scenes, all nodes.
    std::vector<std::size_t> in_scene() const;

    /// Returns where a node's mesh is: once, or as often as EXT_mesh_gpu_instancing says.
    std::vector<GltfMatrix> instances_of(std::size_t node) const;

    /// Returns the transform of each joint of a skin, from the mesh's space to that of the scene.
    std::vector<GltfMatrix> joints_of(std::size_t skin) const;

private:
    struct Node {
        GltfMatrix local, world;
        std::size_t parent = none;
    };

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    GltfMatrix local(const nlohmann::json& node) const;

    const GltfFile& gltf_;
    std::vector<Node> nodes_;
};

}  // namespace bvhbench
