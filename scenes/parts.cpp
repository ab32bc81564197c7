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

Parts parts_of(const std::vector<Face>& faces, std::size_t vertices)
{
    Sets sets(vertices);
    for (const Face& face : faces) {
        sets.join(face.a, face.b);
        sets.join(face.a, face.c);
    }
    constexpr uint none = 0xffffffffu;
    std::vector<uint> number(vertices, none);  // of the part whose smallest vertex it is
    Parts parts;
    parts.of_face.reserve(faces.size());
    for (const Face& face : faces) {
        uint& part = number[sets.find(face.a)];
        if (part == none)
            part = parts.count++;
        parts.of_face.push_back(part);
    }
    return parts;
}

}  // namespace bvhbench
