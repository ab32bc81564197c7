// SPDX-License-Identifier: MIT
//
// Where the numbers are: far from the origin, and of any size that a float can have. A stored scene is what it is after
// it was rounded; pairs are exact for that.
#include "scenes/stress/stress_scene.h"

namespace bvhbench {
namespace {

struct Named {
    const char* name;
    double value;
};

}  // namespace

std::vector<StressCase> translated_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const auto& [name, by] :
         {Named{"1", 1}, {"1e3", 1e3}, {"1e6", 1e6}, {"1e9", 1e9}, {"1e12", 1e12}}) {
        const bool is_one_place = by > 1e7;  // floats are a unit apart, and more
        const uint triangles = is_one_place ? size.crowded_triangles() : size.triangles();
        cases.push_back({name, [=, seed = size.seed, by = by] {
                             return changed(crossed_spheres(triangles, seed),
                                            [by](double x) { return x + by; });
                         }});
    }
    return cases;
}

std::vector<StressCase> scaled_cases(const StressSize& size)
{
    std::vector<StressCase> cases;
    for (const auto& [name, by] : {Named{"denormal", 0x1p-140},
                                   {"1e-38", 1e-38},
                                   {"1e-30", 1e-30},
                                   {"1e-20", 1e-20},
                                   {"1e-10", 1e-10},
                                   {"1e10", 1e10},
                                   {"1e17", 1e17},
                                   {"1e20", 1e20},
                                   {"1e30", 1e30}})
        cases.push_back({name, [size, by = by] {
                             return changed(crossed_spheres(size.triangles(), size.seed),
                                            [by](double x) { return x * by; });
                         }});
    return cases;
}

}  // namespace bvhbench
