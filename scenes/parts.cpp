// SPDX-License-Identifier: MIT
#include "scenes/parts.h"

#include <numeric>

namespace bvhbench {
namespace {

/// Disjoint sets of vertices, each known by its smallest.
class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count)
    {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    uint find(uint vertex)
    {
        while (parent_[vertex] != vertex)
            vertex = parent_[vertex] = parent_[parent_[vertex]];
        return vertex;
    }

    void join(uint a, uint b)
    {
        a = find(a);
        b = find(b);
        (a < b ? parent_[b] : parent_[a]) = a < b ? a : b;
    }

private:
    std::vector<uint> parent_;
};

}  // namespace

std::vector<SceneObject> connected_parts(const std::vector<Face>& faces, std::size_t vertices)
{
    Sets sets(vertices);
    for (const Face& face : faces) {
        sets.join(face.a, face.b);
        sets.join(face.a, face.c);
    }
    std::vector<SceneObject> parts;
    std::vector<bool> begun(vertices, false);
    uint current = 0;
    for (uint k = 0; k < faces.size(); ++k) {
        const uint part = sets.find(faces[k].a);
        if (parts.empty() || part != current) {
            if (begun[part])
                return {};
            begun[part] = true;
            parts.push_back({"part " + std::to_string(parts.size()), k, 0});
            current = part;
        }
        ++parts.back().face_count;
    }
    return parts;
}

}  // namespace bvhbench
