// SPDX-License-Identifier: MIT
#include "builders/stages/scan.h"

#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

class Scan : public testing::TestWithParam<KernelForm> {};

TEST_P(Scan, SumsUpAllThatComesBefore)
{
    ScanStage scan(bench().programs, GetParam());
    for (const std::size_t size : {1u, 2u, 5u, 255u, 1023u, 1024u, 1025u, 300000u}) {
        SCOPED_TRACE(size);
        std::vector<uint> values(size), expected(size);
        for (std::size_t k = 0; k < size; ++k)
            values[k] = static_cast<uint>(k * 2654435761u % 100);
        values[size / 2] = 4000000000u;  // sums wrap around
        std::exclusive_scan(values.begin(), values.end(), expected.begin(), 0u);

        const Buffer<uint> buffer = on_device(values);
        reserve([&](Arena& arena) { scan.plan(arena, size); });
        bench().queue.begin("scan");
        scan.enqueue(buffer, bench().queue);
        EXPECT_EQ(from_device(buffer), expected);
        bench().queue.finish();
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, Scan, testing::ValuesIn(both_forms), CaseName());

}  // namespace
}  // namespace bvhbench
