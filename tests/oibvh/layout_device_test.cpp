// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "oibvh/layout_probe.h"

namespace bvhbench {
namespace {

/// One of the two dialects in which every kernel must compile, on the default device.
class LayoutOnTheDevice : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override
    {
        if (device_names().empty())
            GTEST_SKIP() << "there is no OpenCL device";
        device_ = std::make_unique<Device>(open_device(""));
        const std::string version = device_->cl.getInfo<CL_DEVICE_VERSION>();  // "OpenCL 3.0 ..."
        if (GetParam() == "CL3.0" && version.rfind("OpenCL 3", 0) != 0)
            GTEST_SKIP() << device_->name() << " has no OpenCL 3.0";
        programs_ = std::make_unique<Programs>(*device_, GetParam());
        queue_ = std::make_unique<Queue>(*device_);
    }

    template <class T>
    Buffer<T> buffer_of(std::size_t size) const
    {
        return {cl::Buffer(device_->context, CL_MEM_READ_WRITE, size * sizeof(T)), size};
    }

    std::unique_ptr<Device> device_;
    std::unique_ptr<Programs> programs_;
    std::unique_ptr<Queue> queue_;
};

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
    const std::vector<LayoutQuestion> asked = questions();
    Buffer<LayoutQuestion> on_device = buffer_of<LayoutQuestion>(asked.size());
    on_device.upload(queue_->cl(), asked);
    const Buffer<LayoutAnswers> binary = buffer_of<LayoutAnswers>(asked.size());
    const Buffer<LayoutAnswers> kary = buffer_of<LayoutAnswers>(asked.size());
    cl::Kernel kernel = programs_->kernel("oibvh/layout_probe.cl", "probe_layout");
    set_arguments(kernel, on_device, static_cast<cl_uint>(asked.size()), binary, kary);
    queue_->begin("probe");
    queue_->launch(kernel, (asked.size() + 63) / 64 * 64, 64, 0);

    const std::vector<LayoutAnswers> binary_answers = binary.download(queue_->cl());
    const std::vector<LayoutAnswers> kary_answers_read = kary.download(queue_->cl());
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
