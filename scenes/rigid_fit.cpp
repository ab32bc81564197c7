// SPDX-License-Identifier: MIT
#include "scenes/rigid_fit.h"

#include <algorithm>
#include <array>

namespace bvhbench {
namespace {

template <std::size_t n>
using Matrix = std::array<std::array<double, n>, n>;

/// Eigenvectors of the symmetric `a`, in columns, by Jacobi's rotations; `a` becomes diagonal.
template <std::size_t n>
Matrix<n> diagonalise(Matrix<n>& a)
{
    Matrix<n> vectors{};
    for (std::size_t k = 0; k < n; ++k)
        vectors[k][k] = 1;
    for (int sweep = 0; sweep < 30; ++sweep)  // squares what is left each time: some six are enough
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q) {
                if (a[p][q] == 0)
                    continue;
                const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                const double tangent =
                    (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::hypot(theta, 1.0));
                const double cosine = 1 / std::hypot(tangent, 1.0), sine = tangent * cosine;
                for (std::size_t k = 0; k < n; ++k) {
                    const double kp = a[k][p], kq = a[k][q];
                    a[k][p] = cosine * kp - sine * kq;
                    a[k][q] = sine * kp + cosine * kq;
                }
                for (std::size_t k = 0; k < n; ++k) {
                    const double pk = a[p][k], qk = a[q][k];
                    a[p][k] = cosine * pk - sine * qk;
                    a[q][k] = sine * pk + cosine * qk;
                }
                a[p][q] = a[q][p] = 0;
                for (std::size_t k = 0; k < n; ++k) {
                    const double kp = vectors[k][p], kq = vectors[k][q];
                    vectors[k][p] = cosine * kp - sine * kq;
                    vectors[k][q] = sine * kp + cosine * kq;
                }
            }
    return vectors;
}

Vector centre_of(std::span<const Vector> points)
{
    Vector sum;
    for (const Vector point : points)
        sum = sum + point;
    return (1 / static_cast<double>(points.size())) * sum;
}

/// Sum of a b^T over both sets of points, each from its centre.
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

}  // namespace

Vector RigidFit::operator()(Vector point) const
{
    const Vector a = point - from_centre;
    const auto row = [&](const double(&r)[3]) { return r[0] * a.x + r[1] * a.y + r[2] * a.z; };
    return to_centre + Vector{row(turn[0]), row(turn[1]), row(turn[2])};
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
    const double turn[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    for (std::size_t i = 0; i < 3; ++i)
        std::copy(turn[i], turn[i] + 3, fit.turn[i]);
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

}  // namespace bvhbench
