// SPDX-License-Identifier: MIT
#include "tests/harness/host_lbvh.h"

#include "geometry/morton.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

std::vector<std::uint32_t> per_axis_codes(const Mesh& mesh)
{
    Bounds bounds = empty_bounds();
    for (const Face& face : mesh.faces)
        bounds = grown(bounds, face_box(mesh.points, face));
    const Aabb& scene = bounds.scene;
    std::vector<std::uint32_t> codes;
    for (const Face& face : mesh.faces) {
        const Point centre = box_centre(face_box(mesh.points, face));
        const uint x = part_of(centre.x - scene.min_x, scene.max_x - scene.min_x, 1024.0f);
        const uint y = part_of(centre.y - scene.min_y, scene.max_y - scene.min_y, 1024.0f);
        const uint z = part_of(centre.z - scene.min_z, scene.max_z - scene.min_z, 1024.0f);
        codes.push_back(spread_10(x) << 2u | spread_10(y) << 1u | spread_10(z));
    }
    return codes;
}

}  // namespace bvhbench
