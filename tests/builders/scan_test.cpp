// SPDX-License-Identifier: MIT
#include "builders/stages/scan.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

class Scan : public testing::TestWithParam<KernelForm> {};

TEST_P(Scan, SumsUpAllThatComesBefore)
{
    Bench& b = bench();
    ScanStage scan(b.programs, GetParam());
    for (const std::size_t size : {1u, 2u, 5u, 255u, 1023u, 1024u, 1025u, 300000u}) {
        SCOPED_TRACE(size);
        std::vector<uint> values(size), expected(size);
        for (std::size_t k = 0; k < size; ++k)
            values[k] = static_cast<uint>(k * 2654435761u % 100);
        values[size / 2] = 4000000000u;  // sums wrap
        std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0u);

        Buffer<uint> buffer;
        reserve([&](Arena& arena) {
            buffer = arena.take<uint>(size, Use::scratch);
            scan.plan(arena, size);
        });
        buffer.upload(b.queue.cl(), values);
        b.queue.begin("scan");
        scan.enqueue(buffer, b.queue);
        EXPECT_EQ(buffer.download(b.queue.cl()), expected);
        b.queue.finish();
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, Scan, testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& tested) { return form_name(tested.param); });

}  // namespace
}  // namespace bvhbench
