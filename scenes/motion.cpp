// SPDX-License-Identifier: MIT
#include "scenes/motion.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <utility>

#include "scenes/generate/vector.h"

namespace bvhbench {
namespace {

template <std::size_t n>
using Matrix = std::array<std::array<double, n>, n>;

/// Returns the eigenvectors of the symmetric matrix `a` as columns, by Jacobi rotations; `a` becomes diagonal.
template <std::size_t n>
Matrix<n> diagonalise(Matrix<n>& a)
{
    Matrix<n> vectors{};
    for (std::size_t k = 0; k < n; ++k)
        vectors[k][k] = 1;
    for (int sweep = 0; sweep < 30; ++sweep)  // quadratic: about six are enough
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (a[p][q] == 0)
                    continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double tangent =
                    (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::hypot(theta, 1.0));
                const double cosine = 1 / std::hypot(tangent, 1.0), sine = tangent * cosine;
                const auto rotate = [&](double& x, double& y) {
                    const double before = x;
                    x = cosine * before - sine * y;
                    y = sine * before + cosine * y;
                };
                for (std::size_t k = 0; k < n; ++k)
                    rotate(a[k][p], a[k][q]);
                for (std::size_t k = 0; k < n; ++k) {
                    rotate(a[p][k], a[q][k]);
                    rotate(vectors[k][p], vectors[k][q]);
                }
                a[p][q] = a[q][p] = 0;
            }
    return vectors;
}

Vector centre_of(std::span<const Vector> points)
{
    Vector sum = {};
    for (const Vector point : points)
        sum = sum + point;
    return (1 / static_cast<double>(points.size())) * sum;
}

/// Returns the sum of a b^T over both sets of points, each relative to its centre.
Matrix<3> products(std::span<const Vector> from, Vector from_centre, std::span<const Vector> to,
                   Vector to_centre)
{
    Matrix<3> sum{};
    for (std::size_t k = 0; k < from.size(); ++k) {
        const Vector a = from[k] - from_centre, b = to[k] - to_centre;
        const double left[] = {a.x, a.y, a.z}, right[] = {b.x, b.y, b.z};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                sum[i][j] += left[i] * right[j];
    }
    return sum;
}

/// Returns how far rounding to float may move one of these points.
double rounding_of(std::span<const Vector> points)
{
    double largest = 0;
    for (const Vector a : points)
        largest = std::max({largest, std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    constexpr double smallest = 0x1p-150;  // half of the smallest positive float
    return std::sqrt(3.0) * std::max(0x1p-24 * largest, smallest);
}

bool is_rigid(std::span<const Vector> from, std::span<const Vector> to)
{
    constexpr double slack = 1 + 1e-3;  // covers higher-order terms and double arithmetic
    const double each = slack * (rounding_of(from) + rounding_of(to));
    const RigidFit fit = fit_rigid(from, to);
    const std::vector<double> allowances = fit_allowances(from);
    for (std::size_t k = 0; k < from.size(); ++k)
        if (length(to[k] - fit(from[k])) > each * allowances[k])
            return false;
    return true;
}

}  // namespace

Vector RigidFit::operator()(Vector point) const
{
    const Vector a = point - from_centre;
    return to_centre + Vector{dot(turn[0], a), dot(turn[1], a), dot(turn[2], a)};
}

RigidFit fit_rigid(std::span<const Vector> from, std::span<const Vector> to)
{
    RigidFit fit;
    fit.from_centre = centre_of(from);
    fit.to_centre = centre_of(to);
    const Matrix<3> s = products(from, fit.from_centre, to, fit.to_centre);
    Matrix<4> horn = {
        {{s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
         {0, s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
         {0, 0, s[1][1] - s[0][0] - s[2][2], s[1][2] + s[2][1]},
         {0, 0, 0, s[2][2] - s[0][0] - s[1][1]}}};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < i; ++j)
            horn[i][j] = horn[j][i];
    const Matrix<4> vectors = diagonalise(horn);
    std::size_t best = 0;
    for (std::size_t k = 1; k < 4; ++k)
        if (horn[k][k] > horn[best][best])
            best = k;
    const double w = vectors[0][best], x = vectors[1][best], y = vectors[2][best],
                 z = vectors[3][best];
    fit.turn = {Vector{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                Vector{2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                Vector{2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    return fit;
}

std::vector<double> fit_allowances(std::span<const Vector> from)
{
    const Vector centre = centre_of(from);
    Matrix<3> spread = products(from, centre, from, centre);
    const Matrix<3> axes = diagonalise(spread);
    std::vector<double> allowances(from.size(), 2);
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector axis = {axes[0][k], axes[1][k], axes[2][k]};
        const auto distance = [&](Vector point) { return length(cross(point - centre, axis)); };
        double sum = 0, squares = 0;
        for (const Vector point : from) {
            const double far = distance(point);
            sum += far;
            squares += far * far;
        }
        for (std::size_t i = 0; squares > 0 && i < from.size(); ++i)
            allowances[i] += distance(from[i]) * sum / squares;
    }
    return allowances;
}

std::vector<Motion> object_motions(const Scene& scene, std::size_t from, std::size_t to)
{
    assert(from < scene.frames.size() && to < scene.frames.size());
    const std::vector<Point>& old_points = scene.frames[from];
    const std::vector<Point>& new_points = scene.frames[to];
    std::vector<std::size_t> seen(old_points.size(), 0);  // last object that uses it, from 1
    std::vector<Vector> before, after;
    std::vector<Motion> motions;
    for (const SceneObject& object : scene.objects) {
        before.clear();
        after.clear();
        bool is_unchanged = true;
        for (uint k = 0; k < object.face_count; ++k) {
            const Face face = scene.faces[object.first_face + k];
            for (const uint corner : {face.a, face.b, face.c}) {
                if (std::exchange(seen[corner], motions.size() + 1) == motions.size() + 1)
                    continue;
                before.push_back(vector_of(old_points[corner]));
                after.push_back(vector_of(new_points[corner]));
                is_unchanged = is_unchanged && std::memcmp(&old_points[corner], &new_points[corner],
                                                           sizeof(Point)) == 0;
            }
        }
        motions.push_back(is_unchanged              ? Motion::unchanged
                          : is_rigid(before, after) ? Motion::rigid
                                                    : Motion::deforming);
    }
    return motions;
}

}  // namespace bvhbench
