// SPDX-License-Identifier: MIT
//
// Polygons become triangles. A polygon is projected along its largest axis of area. If all triangles of the fan around its first
// corner then have the orientation of the polygon, or no area, the fan covers the polygon and nothing else, and stays. Otherwise
// ears are cut off: corners whose triangle has that orientation and contains no other corner.
//
// Either way the triangles' boundaries add up to the polygon's, so at a point of the plane the number of triangles that cover it is
// the polygon's winding number there: 1 inside and 0 outside of a polygon that does not cross itself.
#include <algorithm>
#include <cmath>

#include "geometry/error.h"
#include "scenes/formats/formats.h"

namespace bvhbench {
namespace {

/// Cutting ears takes time in proportion to the square of the number of corners.
constexpr std::size_t most_corners = 10000;

struct Flat {
    double x = 0, y = 0;
    bool operator==(const Flat&) const = default;
};

/// Returns twice the signed area of a triangle.
long double area(Flat a, Flat b, Flat c)
{
    return (static_cast<long double>(b.x) - a.x) * (static_cast<long double>(c.y) - a.y) -
           (static_cast<long double>(b.y) - a.y) * (static_cast<long double>(c.x) - a.x);
}

class Polygon {
public:
    /// Projects the corners so that the polygon's area is positive.
    Polygon(std::vector<uint> corners, const std::vector<WidePoint>& at)
        : corners_(std::move(corners))
    {
        long double normal[3] = {};  // by Newell's sums
        for (std::size_t k = 0; k < at.size(); ++k) {
            const WidePoint &a = at[0], &b = at[k], &c = at[(k + 1) % at.size()];
            normal[0] += area({a.y, a.z}, {b.y, b.z}, {c.y, c.z});
            normal[1] += area({a.z, a.x}, {b.z, b.x}, {c.z, c.x});
            normal[2] += area({a.x, a.y}, {b.x, b.y}, {c.x, c.y});
        }
        const auto larger = [](long double a, long double b) { return std::abs(a) < std::abs(b); };
        const auto axis = std::max_element(std::begin(normal), std::end(normal), larger) - normal;
        for (const WidePoint& p : at) {
            const Flat flat = axis == 0   ? Flat{p.y, p.z}
                              : axis == 1 ? Flat{p.z, p.x}
                                          : Flat{p.x, p.y};
            flat_.push_back(normal[axis] < 0 ? Flat{flat.y, flat.x} : flat);
        }
    }

    bool is_covered_by_fan() const
    {
        for (std::size_t k = 2; k < flat_.size(); ++k)
            if (area(flat_[0], flat_[k - 1], flat_[k]) < 0)
                return false;
        return true;
    }

    /// Writes one triangle fewer than there are corners but one. False if the polygon crosses itself.
    bool cut_ears(Face* faces)
    {
        bool is_simple = true;
        while (corners_.size() > 3) {
            std::size_t ear = find_ear();
            if (ear == corners_.size()) {
                ear = find_flat_corner();
                is_simple = is_simple && ear != corners_.size();
            }
            cut(ear % corners_.size(), faces++);
        }
        *faces = {corners_[0], corners_[1], corners_[2]};
        return is_simple && area(flat_[0], flat_[1], flat_[2]) >= 0;
    }

private:
    std::size_t before(std::size_t k) const { return (k == 0 ? corners_.size() : k) - 1; }
    std::size_t after(std::size_t k) const { return k + 1 == corners_.size() ? 0 : k + 1; }
    long double area_at(std::size_t k) const
    {
        return area(flat_[before(k)], flat_[k], flat_[after(k)]);
    }

    /// Returns an ear; none: the number of corners. Ears beside a straight corner come first, since they leave no triangle without
    /// area there; else the first from where the last one was, so that ears are spread over the polygon.
    std::size_t find_ear() const
    {
        std::size_t first = corners_.size();
        for (std::size_t n = 0; n < corners_.size(); ++n) {
            const std::size_t k = (start_ + n) % corners_.size();
            const bool is_beside = area_at(before(k)) == 0 || area_at(after(k)) == 0;
            if ((is_beside || first == corners_.size()) && is_ear(k)) {
                if (is_beside)
                    return k;
                first = k;
            }
        }
        return first;
    }

    std::size_t find_flat_corner() const
    {
        for (std::size_t k = 0; k < corners_.size(); ++k)
            if (area_at(k) == 0)
                return k;
        return corners_.size();
    }

    bool is_ear(std::size_t k) const
    {
        const Flat a = flat_[before(k)], b = flat_[k], c = flat_[after(k)];
        if (!(area(a, b, c) > 0))
            return false;
        const Flat low = {std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
        const Flat high = {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
        return std::ranges::none_of(flat_, [&](Flat p) {
            return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p != a &&
                   p != b && p != c && area(a, b, p) >= 0 && area(b, c, p) >= 0 &&
                   area(c, a, p) >= 0;
        });
    }

    void cut(std::size_t k, Face* face)
    {
        *face = {corners_[before(k)], corners_[k], corners_[after(k)]};
        corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(k));
        flat_.erase(flat_.begin() + static_cast<std::ptrdiff_t>(k));
        start_ = before(k % corners_.size());  // cutting may have made an ear of the corner before
    }

    std::vector<uint> corners_;
    std::vector<Flat> flat_;
    std::size_t start_ = 0;
};

}  // namespace

void cut_polygons(FileMesh& file, const std::string& name)
{
    const Mesh& mesh = file.mesh;
    const auto point = [&](uint corner) {
        const Point& p = mesh.points[corner];
        return file.wide.empty() ? WidePoint{p.x, p.y, p.z} : file.wide[corner];
    };
    for (const FaceRange run : file.polygons) {
        Face* const faces = file.mesh.faces.data() + run.first;
        std::vector<uint> corners = {faces[0].a, faces[0].b};
        for (std::size_t k = 0; k < run.count; ++k)
            corners.push_back(faces[k].c);
        if (std::ranges::any_of(corners, [&](uint k) { return k >= mesh.points.size(); }))
            continue;  // `finished` refuses it
        std::vector<WidePoint> at;
        for (const uint corner : corners)
            at.push_back(point(corner));
        Polygon polygon(corners, at);
        if (polygon.is_covered_by_fan())
            continue;
        if (corners.size() > most_corners)
            throw Unavailable(name + " has a polygon of " + std::to_string(corners.size()) +
                              " corners that is not convex, and such are cut up to " +
                              std::to_string(most_corners) + ": export it as triangles");
        ++file.reading.polygons_concave;
        file.reading.polygons_crossing += polygon.cut_ears(faces) ? 0 : 1;
    }
    file.reading.polygons_cut += file.polygons.size();
    file.polygons.clear();
}

}  // namespace bvhbench
