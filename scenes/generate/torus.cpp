// SPDX-License-Identifier: MIT
#include <numbers>

#include "scenes/generate/generators.h"
#include "scenes/generate/patch.h"

namespace bvhbench {
namespace {

struct Turn {
    double angle, sine, cosine;
};

Turn turn(std::size_t part, std::size_t whole)
{
    const double angle =
        2.0 * std::numbers::pi * static_cast<double>(part) / static_cast<double>(whole);
    return {angle, std::sin(angle), std::cos(angle)};
}

}  // namespace

// In double, stored as float: a = 2 pi i / w round the ring, b = 2 pi j / h round the tube,
// r = 0.4 + 0.05 sin(7a) cos(5b), at ((1 + r cos b) cos a, (1 + r cos b) sin a, r sin b).
Mesh make_torus(uint triangles)
{
    std::vector<Turn> ring;  // the same for every row
    Turn tube{};
    double wave = 0;
    return make_patch(triangles, [&](std::size_t i, std::size_t w, std::size_t j, std::size_t h) {
        if (ring.empty())
            for (std::size_t k = 0; k <= w; ++k)
                ring.push_back(turn(k, w));
        if (i == 0) {
            tube = turn(j, h);
            wave = std::cos(5.0 * tube.angle);
        }
        const Turn& a = ring[i];
        const double r = 0.4 + 0.05 * std::sin(7.0 * a.angle) * wave;
        const double reach = 1.0 + r * tube.cosine;
        return Point{static_cast<float>(reach * a.cosine), static_cast<float>(reach * a.sine),
                     static_cast<float>(r * tube.sine)};
    });
}

}  // namespace bvhbench
