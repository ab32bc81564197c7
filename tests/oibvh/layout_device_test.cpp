// SPDX-License-Identifier: MIT
#include "oibvh/layout_probe.h"

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

/// One of the two dialects in which every kernel must compile, on the default device.
class LayoutOnTheDevice : public testing::TestWithParam<std::string> {};

/// Returns trees of critical sizes, and for each tree the ends of every level and some nodes in between.
std::vector<LayoutQuestion> questions()
{
    std::vector<LayoutQuestion> questions;
    std::mt19937 random(1);
    for (const uint arity : {2u, 3u, 4u, 8u}) {
        const uint most = kary_most_leaves(arity);
        std::vector<uint> sizes = {most, most - 1, most / arity + 1, most / 2 + 1, most / 2};
        for (uint leaves = 1; leaves <= 130; ++leaves)
            sizes.push_back(leaves);
        for (uint bit = 10; bit < 30; bit += 2)
            sizes.insert(sizes.end(), {(1u << bit) - 1, 1u << bit, (1u << bit) + 1});
        for (const uint leaves : sizes) {
            const KaryShape shape = kary_shape(leaves, arity);
            for (uint level = 0; level <= shape.leaf_level; ++level) {
                const uint first = kary_first(arity, level);
                const uint width = kary_power(arity, level);
                const uint real = kary_real_on(shape, level);
                for (const uint position :
                     {0u, real - 1, std::min(real, width - 1), width - 1,
                      static_cast<uint>(random()) % width, static_cast<uint>(random()) % real})
                    questions.push_back({leaves, arity, first + position});
            }
        }
    }
    return questions;
}

std::string text(const LayoutQuestion& question)
{
    return "t = " + std::to_string(question.leaves) + ", k = " + std::to_string(question.arity) +
           ", i = " + std::to_string(question.node);
}

bool same(const LayoutAnswers& a, const LayoutAnswers& b)
{
    return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST_P(LayoutOnTheDevice, IsTheLayoutOnTheHost)
{
    const std::string version = bench().device.cl.getInfo<CL_DEVICE_VERSION>();  // "OpenCL 3.0 ..."
    if (GetParam() == "CL3.0" && !version.starts_with("OpenCL 3"))
        GTEST_SKIP() << bench().device.name() << " has no OpenCL 3.0";
    const std::vector<LayoutQuestion> asked = questions();
    const Buffer<LayoutQuestion> there = on_device(asked);
    const auto answers = std::vector<LayoutAnswers>(asked.size());
    const Buffer<LayoutAnswers> binary = on_device(answers), kary = on_device(answers);
    Programs programs(bench().device, GetParam());
    cl::Kernel kernel = programs.kernel("oibvh/layout_probe.cl", "probe_layout");
    set_arguments(kernel, there, static_cast<cl_uint>(asked.size()), binary, kary);
    bench().queue.begin("probe");
    bench().queue.launch(kernel, (asked.size() + 63) / 64 * 64, 64, 0);
    const std::vector<LayoutAnswers> binary_answers = from_device(binary);
    const std::vector<LayoutAnswers> kary_answers_read = from_device(kary);
    bench().queue.finish();
    for (std::size_t q = 0; q < asked.size(); ++q) {
        ASSERT_TRUE(same(kary_answers_read[q], kary_answers(asked[q]))) << text(asked[q]);
        if (asked[q].arity == 2) {
            ASSERT_TRUE(same(binary_answers[q], oi_answers(asked[q]))) << text(asked[q]);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Dialect, LayoutOnTheDevice, testing::Values("CL1.2", "CL3.0"),
                         [](const auto& dialect) { return dialect.index == 0 ? "CL12" : "CL30"; });

}  // namespace
}  // namespace bvhbench
