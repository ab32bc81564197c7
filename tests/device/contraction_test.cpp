// SPDX-License-Identifier: MIT
//
// No fused multiply-adds: products are rounded before they are added, on the host and on the device. A fused multiply-add
// rounds once and would give other boxes, codes and signs. The functions of the headers that predicates and costs use are
// compared with sums of products that were each stored first.

#include <cstring>
#include <random>
#include <set>
#include <sstream>
#include <vector>

#include "geometry/orient.h"
#include "tests/device/testing.h"

namespace bvhbench {
namespace {

constexpr std::size_t count = 1000;

/// Returns x in a way that the compiler cannot see through, so that it neither folds constants nor fuses operations.
template <class T>
T opaque(T x)
{
    volatile T stored = x;
    return stored;
}

/// Returns x * y, rounded.
template <class T>
T product(T x, T y)
{
    return opaque(opaque(x) * opaque(y));
}

struct Operands {
    std::vector<double> doubles;  ///< six per result: two vectors
    std::vector<float> floats;    ///< three per result: the sides of a box at the origin

    Operands()
    {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> unit(0.5, 1);
        for (std::size_t k = 0; k < 6 * count; ++k)
            doubles.push_back(opaque(unit(random)));
        for (std::size_t k = 0; k < 3 * count; ++k)
            floats.push_back(opaque(static_cast<float>(unit(random))));
    }
    Vector vector(std::size_t k) const { return {doubles[k], doubles[k + 1], doubles[k + 2]}; }
    Aabb box(std::size_t k) const { return {0, 0, 0, floats[k], floats[k + 1], floats[k + 2]}; }
};

struct Results {
    std::vector<double> minors, dots, halves;
    std::vector<float> surfaces;
};

/// Computes the results with every product stored before it is added.
Results stored_results(const Operands& of)
{
    Results results;
    for (std::size_t k = 0; k < count; ++k) {
        const Vector a = of.vector(6 * k), b = of.vector(6 * k + 3);
        results.minors.push_back(opaque(product(a.y, b.z) - product(a.z, b.y)));
        const double two = opaque(product(a.x, b.x) + product(a.y, b.y));
        results.dots.push_back(opaque(two + product(a.z, b.z)));
        const double spread = product(134217729.0, a.x);
        results.halves.push_back(opaque(spread - opaque(spread - a.x)));
        const Aabb box = of.box(3 * k);
        const float xy_yz = opaque(product(box.max_x, box.max_y) + product(box.max_y, box.max_z));
        results.surfaces.push_back(opaque(xy_yz + product(box.max_z, box.max_x)));
    }
    return results;
}

template <class T>
std::size_t differing(const std::vector<T>& a, const std::vector<T>& b)
{
    std::size_t found = 0;
    for (std::size_t k = 0; k < a.size(); ++k)
        found += std::memcmp(&a[k], &b.at(k), sizeof(T)) != 0 ? 1 : 0;
    return found;
}

TEST(Contraction, IsOffOnTheHost)
{
#ifndef __FMA__
    GTEST_SKIP() << "built for a processor without fused multiply-adds: nothing could fuse";
#endif
    const Operands of;
    const Results stored = stored_results(of);
    Results found;
    for (std::size_t k = 0; k < count; ++k) {
        const Vector a = of.vector(6 * k), b = of.vector(6 * k + 3);
        found.minors.push_back(cross_product(a, b).x);
        found.dots.push_back(dot(a, b));
        found.halves.push_back(upper_half(a.x));
        found.surfaces.push_back(half_surface(of.box(3 * k)));
    }
    EXPECT_EQ(differing(found.minors, stored.minors), 0u);
    EXPECT_EQ(differing(found.dots, stored.dots), 0u);
    EXPECT_EQ(differing(found.halves, stored.halves), 0u);
    EXPECT_EQ(differing(found.surfaces, stored.surfaces), 0u);
}

constexpr auto kernel_text = R"(
#include "geometry/orient.h"

kernel void surfaces(global const float* restrict in, global float* restrict out)
{
    const uint k = (uint)get_global_id(0);
    const Aabb box = {0.0f, 0.0f, 0.0f, in[3u * k], in[3u * k + 1u], in[3u * k + 2u]};
    out[k] = half_surface(box);
}

#if HAS_DOUBLES
kernel void predicates(global const double* restrict in, global double* restrict minors,
                       global double* restrict dots, global double* restrict halves)
{
    const uint k = (uint)get_global_id(0);
    const Vector a = {in[6u * k], in[6u * k + 1u], in[6u * k + 2u]};
    const Vector b = {in[6u * k + 3u], in[6u * k + 4u], in[6u * k + 5u]};
    minors[k] = cross_product(a, b).x;
    dots[k] = dot(a, b);
    halves[k] = upper_half(a.x);
}
#endif
)";

/// Fixture with the program's own headers and a kernel that is compiled with the program's usual options.
class DeviceContraction : public OnDeviceWithKernels {
protected:
    DeviceContraction()
    {
        for (const char* name :
             {"geometry/dialect.h", "geometry/box_side.h", "geometry/aabb.h", "geometry/triangle.h",
              "geometry/vectors.h", "geometry/exact_sum.h", "geometry/orient.h"})
            folder.file(name, embedded_kernel(name).value());
        folder.file("contraction.cl", kernel_text);
    }

    /// Runs a kernel of `kernel_text` with one work-item per result. Its arguments are a buffer of `operands`, then `outs`.
    template <class T, class... Outs>
    void run(const char* name, const std::vector<T>& operands, const Outs&... outs)
    {
        auto in = buffer<T>(operands.size());
        in.upload(queue.cl(), operands);
        cl::Kernel kernel = programs.kernel("contraction.cl", name);
        set_arguments(kernel, in, outs...);
        queue.begin(name);
        queue.launch(kernel, count, 1, 1);
    }

    const Operands of_;
    const Results stored_ = stored_results(of_);
};

TEST_F(DeviceContraction, IsOffInFloats)
{
    const auto out = buffer<float>(count);
    run("surfaces", of_.floats, out);
    EXPECT_EQ(differing(out.download(queue.cl()), stored_.surfaces), 0u);
}

TEST_F(DeviceContraction, IsOffInDoubles)
{
    if (device.cl.getInfo<CL_DEVICE_DOUBLE_FP_CONFIG>() == 0)
        GTEST_SKIP() << "the device has no doubles";
    const auto minors = buffer<double>(count), dots = buffer<double>(count),
               halves = buffer<double>(count);
    run("predicates", of_.doubles, minors, dots, halves);
    EXPECT_EQ(differing(minors.download(queue.cl()), stored_.minors), 0u);
    EXPECT_EQ(differing(dots.download(queue.cl()), stored_.dots), 0u);
    EXPECT_EQ(differing(halves.download(queue.cl()), stored_.halves), 0u);
}

/// No build option permits other rounding: all options are in a list of known ones.
TEST_F(DeviceContraction, IsNotAskedForByAnOption)
{
    folder.file("nothing.cl", "kernel void nothing() {}\n");
    const cl::Kernel kernel = programs.kernel("nothing.cl", "nothing", {{"NUMBER", 1}});
    const auto program = kernel.getInfo<CL_KERNEL_PROGRAM>();
    std::istringstream words(program.getBuildInfo<CL_PROGRAM_BUILD_OPTIONS>(device.cl));
    const std::set<std::string> known = {
        "-cl-std=CL1.2", "-cl-opt-disable", "-cl-fp32-correctly-rounded-divide-sqrt", "-D",
        "NUMBER=1u",     "_OPENCL_H_"};
    std::string word;
    std::size_t seen = 0;
    for (; words >> word; ++seen)
        EXPECT_EQ(known.count(word), 1u) << word;
    EXPECT_GE(seen, 3u);
}

}  // namespace
}  // namespace bvhbench
