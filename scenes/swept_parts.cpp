// SPDX-License-Identifier: MIT
#include "scenes/swept_parts.h"

#include <algorithm>

#include "scenes/face_order.h"

namespace bvhbench {

SweptParts vertices_and_faces(const Scene& scene)
{
    const auto vertices = static_cast<uint>(scene.frames.front().size());
    SweptParts parts{{}, {{0, vertices}, {vertices, scene.triangle_count()}}};
    parts.faces.reserve(vertices + scene.faces.size());
    for (uint vertex = 0; vertex < vertices; ++vertex)
        parts.faces.push_back({vertex, vertex, vertex});
    const std::vector<Face> faces = faces_in_file(scene);
    parts.faces.insert(parts.faces.end(), faces.begin(), faces.end());
    return parts;
}

SweptParts unique_edges(const Scene& scene)
{
    std::vector<std::pair<uint, uint>> edges;  // the larger vertex first, as they are sorted
    edges.reserve(3 * scene.faces.size());
    for (const Face& face : scene.faces)
        for (const auto& [a, b] :
             {std::pair(face.a, face.b), std::pair(face.b, face.c), std::pair(face.c, face.a)})
            if (a != b)
                edges.emplace_back(std::max(a, b), std::min(a, b));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    SweptParts parts;
    parts.faces.reserve(edges.size());
    for (const auto& [larger, smaller] : edges)
        parts.faces.push_back({smaller, larger, larger});
    parts.objects = {{0, static_cast<uint>(parts.faces.size())}};
    return parts;
}

std::optional<uint> place_of_edge(const SweptParts& unique_edges, uint a, uint b)
{
    const auto key = [](const Face& edge) { return std::pair(edge.b, edge.a); };
    const std::pair<uint, uint> wanted(std::max(a, b), std::min(a, b));
    const std::vector<Face>& edges = unique_edges.faces;
    const auto found = std::lower_bound(
        edges.begin(), edges.end(), wanted,
        [&](const Face& edge, const std::pair<uint, uint>& other) { return key(edge) < other; });
    if (found == edges.end() || key(*found) != wanted)
        return std::nullopt;
    return static_cast<uint>(found - edges.begin());
}

}  // namespace bvhbench
