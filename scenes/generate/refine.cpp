// SPDX-License-Identifier: MIT
//
// Cuts an edge at its middle m, in each of its triangles:
//
//          w                 w            a-m keeps the number of the old edge, m-b and m-w are new,
//         / \               /|\           b-w moves from the old triangle to the new one
//        /   \      =>     / | \          .
//       a-----b           a--m--b         (a, b, w) becomes (a, m, w) and (m, b, w)
//
// Half-edge 3f + k is the side of triangle f from its corner k to the next corner. The half-edges of one edge form a circular
// list through `next_in_ring_`; any number of triangles may share an edge.
#include "scenes/generate/derived.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <queue>

#include "geometry/error.h"
#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

/// A vertex in the middle between two others.
struct Middle {
    uint a, b;
};

Point middle_of(Point a, Point b) { return 0.5f * a + 0.5f * b; }

class Refiner {
public:
    Refiner(const std::vector<Point>& points, const std::vector<Face>& faces, uint triangles)
        : points_(points), triangles_(triangles)
    {
        corners_.reserve(std::size_t{3} * triangles);
        for (const Face& face : faces)
            corners_.insert(corners_.end(), {face.a, face.b, face.c});
        origin_.resize(faces.size());
        std::iota(origin_.begin(), origin_.end(), 0u);
        next_in_ring_.resize(corners_.size());
        edge_.resize(corners_.size());
        for (auto* list : {&next_in_ring_, &edge_})
            list->reserve(corners_.capacity());
        find_edges();
    }

    void run()
    {
        while (origin_.size() < triangles_)
            cut_longest();
    }

    std::vector<uint> corners_;    ///< three per triangle
    std::vector<uint> origin_;     ///< for each triangle, the scene's triangle that it is a part of
    std::vector<Middle> middles_;  ///< the new vertices, in order

private:
    struct Candidate {
        float length;
        uint edge;
        bool operator<(const Candidate& other) const  // the top is the greatest
        {
            return length != other.length ? length < other.length : edge > other.edge;
        }
    };

    static uint following(uint half) { return half % 3 == 2 ? half - 2 : half + 1; }
    uint start_of(uint half) const { return corners_[half]; }
    uint end_of(uint half) const { return corners_[following(half)]; }

    void find_edges()
    {
        struct Side {
            std::uint64_t ends;
            uint half;
        };
        std::vector<Side> sides;
        sides.reserve(corners_.size());
        for (uint half = 0; half < corners_.size(); ++half) {
            const std::uint64_t low = std::min(start_of(half), end_of(half));
            const uint high = std::max(start_of(half), end_of(half));
            sides.push_back({low << 32 | high, half});
        }
        std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
            return x.ends != y.ends ? x.ends < y.ends : x.half < y.half;
        });
        for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
            ring_.clear();
            for (last = first; last < sides.size() && sides[last].ends == sides[first].ends; ++last)
                // A triangle with a repeated corner contains an edge twice; each of its sides becomes a separate edge.
                if (is_proper(sides[last].half / 3))
                    ring_.push_back(sides[last].half);
                else
                    make_edge({sides[last].half});
            if (!ring_.empty())
                make_edge(ring_);
        }
    }

    bool is_proper(uint face) const
    {
        const uint a = corners_[3 * face], b = corners_[3 * face + 1], c = corners_[3 * face + 2];
        return a != b && b != c && c != a;
    }

    void close_ring(const std::vector<uint>& halves, uint edge)
    {
        for (std::size_t k = 0; k < halves.size(); ++k) {
            next_in_ring_[halves[k]] = halves[(k + 1) % halves.size()];
            edge_[halves[k]] = edge;
        }
        half_of_[edge] = halves.front();
    }

    void make_edge(const std::vector<uint>& halves)
    {
        const auto edge = static_cast<uint>(half_of_.size());
        half_of_.push_back(0);
        close_ring(halves, edge);
        enqueue(edge);
    }

    void enqueue(uint edge)
    {
        const Point a = points_[start_of(half_of_[edge])], b = points_[end_of(half_of_[edge])];
        queue_.push({static_cast<float>(0.5 * length(difference(a, b))), edge});
    }

    void cut_longest()
    {
        const uint edge = queue_.top().edge;
        queue_.pop();
        ring_.clear();
        uint half = half_of_[edge];
        do
            ring_.push_back(half);
        while ((half = next_in_ring_[half]) != half_of_[edge]);
        if (ring_.size() > triangles_ - origin_.size())
            ring_.resize(triangles_ - origin_.size());  // last cut: no more than needed
        cut_ring(edge);
    }

    void cut_ring(uint edge)
    {
        const uint a = start_of(ring_.front()), b = end_of(ring_.front());
        const auto m = static_cast<uint>(points_.size());
        points_.push_back(middle_of(points_[a], points_[b]));
        middles_.push_back({a, b});
        at_a_.clear();
        at_b_.clear();
        spokes_.clear();
        for (const uint half : ring_)
            cut_triangle(half, m, start_of(half) == a);
        close_ring(at_a_, edge);
        enqueue(edge);
        make_edge(at_b_);
        make_spokes();
    }

    /// Splits (u, v, w) at side u-v into (u, m, w), in place, and (m, v, w).
    void cut_triangle(uint side, uint m, bool starts_at_a)
    {
        const uint to_w = following(side), from_w = following(to_w);
        const auto fresh = static_cast<uint>(corners_.size());
        corners_.insert(corners_.end(), {m, corners_[to_w], corners_[from_w]});
        corners_[to_w] = m;
        origin_.push_back(origin_[side / 3]);
        next_in_ring_.resize(corners_.size());
        edge_.resize(corners_.size());
        move_side(to_w, fresh + 1);
        (starts_at_a ? at_a_ : at_b_).push_back(side);
        (starts_at_a ? at_b_ : at_a_).push_back(fresh);
        spokes_.push_back({corners_[from_w], to_w, fresh + 2});
    }

    /// Makes the side v-w half-edge `to` of the new triangle.
    void move_side(uint from, uint to)
    {
        uint before = from;
        while (next_in_ring_[before] != from)
            before = next_in_ring_[before];
        next_in_ring_[to] = before == from ? to : next_in_ring_[from];
        next_in_ring_[before == from ? to : before] = to;
        edge_[to] = edge_[from];
        half_of_[edge_[to]] = to;
    }

    /// Makes the new edges m-w, one per w. Two triangles may have the same three corners.
    void make_spokes()
    {
        std::sort(spokes_.begin(), spokes_.end());
        for (std::size_t first = 0, last = 0; first < spokes_.size(); first = last) {
            ring_.clear();
            for (last = first; last < spokes_.size() && spokes_[last][0] == spokes_[first][0];
                 ++last)
                ring_.insert(ring_.end(), {spokes_[last][1], spokes_[last][2]});
            make_edge(ring_);
        }
    }

    std::vector<Point> points_;
    uint triangles_;
    std::vector<uint> next_in_ring_;           ///< per half-edge
    std::vector<uint> edge_;                   ///< per half-edge
    std::vector<uint> half_of_;                ///< per edge, one of its half-edges
    std::priority_queue<Candidate> queue_;     ///< every edge, once
    std::vector<uint> ring_, at_a_, at_b_;     // reused by all cuts
    std::vector<std::array<uint, 3>> spokes_;  ///< w and the two half-edges
};

/// Sorts the new triangles by the old triangle that they are a part of, so that objects stay contiguous.
std::vector<Face> in_order(const Refiner& refiner, std::vector<uint>& parts, std::size_t old_count)
{
    parts.assign(old_count + 1, 0);
    for (const uint origin : refiner.origin_)
        ++parts[origin + 1];
    std::partial_sum(parts.begin(), parts.end(), parts.begin());
    std::vector<uint> next(parts);
    std::vector<Face> faces(refiner.origin_.size());
    for (std::size_t k = 0; k < faces.size(); ++k)
        faces[next[refiner.origin_[k]]++] = {refiner.corners_[3 * k], refiner.corners_[3 * k + 1],
                                             refiner.corners_[3 * k + 2]};
    return faces;
}

}  // namespace

Scene refined(Scene scene, uint triangles)
{
    if (scene.faces.size() > triangles)
        throw BadUsage("'" + scene.name + "' has " + std::to_string(scene.faces.size()) +
                       " triangles already, and refining it to " + std::to_string(triangles) +
                       " would take some away");
    Refiner refiner(scene.frames.front(), scene.faces, triangles);
    refiner.run();

    std::vector<uint> first_part;
    const std::size_t old_count = scene.faces.size();
    scene.faces = in_order(refiner, first_part, old_count);
    scene.file_faces.clear();  // the numbers refer to the old triangles
    for (SceneObject& object : scene.objects) {
        const uint last = object.first_face + object.face_count;
        object.first_face = first_part[object.first_face];
        object.face_count = first_part[last] - object.first_face;
    }
    for (auto& points : scene.frames)
        for (const Middle& middle : refiner.middles_)
            points.push_back(middle_of(points[middle.a], points[middle.b]));
    return scene;
}

}  // namespace bvhbench
