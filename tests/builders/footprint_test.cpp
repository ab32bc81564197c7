// SPDX-License-Identifier: MIT
//
// Bytes that builders ask for grow with the mesh and nothing else: an array of 2^28 boxes is 6 GiB, and whoever counts
// its bytes or words in 32 bits asks for too few.
#include <gtest/gtest.h>

#include "harness/choice/catalog.h"
#include "harness/judge/check.h"
#include "harness/session/session.h"

namespace bvhbench {
namespace {

Session& session()
{
    static Session session{CommonOptions{}};
    return session;
}

class Footprints : public testing::TestWithParam<BuilderEntry> {};

TEST_P(Footprints, AreInProportionToTheMeshPast32Bits)
{
    if (GetParam().make == nullptr)
        GTEST_SKIP() << GetParam().absent;
    for (const char* order : {"morton30", "hilbert63", "kd"})
        for (const bool sorted_leaves : {false, true}) {
            const auto builder = GetParam().make(session().programs(),
                                                 {.order = order, .sorted_leaves = sorted_leaves});
            const auto bytes_each = [&](unsigned log2) {
                return static_cast<double>(builder->footprint(std::size_t{1} << log2).total()) /
                       static_cast<double>(std::size_t{1} << log2);
            };
            const double at_a_million = bytes_each(20);
            EXPECT_GE(at_a_million, 24.0) << "a box a triangle at least";
            for (unsigned log2 = 24; log2 <= 28; ++log2)
                EXPECT_NEAR(bytes_each(log2) / at_a_million, 1.0, 0.02)
                    << order << (sorted_leaves ? ", sorted" : "") << ", 2^" << log2;
        }
}

INSTANTIATE_TEST_SUITE_P(Catalog, Footprints,
                         testing::ValuesIn(builder_catalog().begin(), builder_catalog().end()),
                         [](const auto& tested) {
                             std::string name(tested.param.name);
                             for (char& letter : name)
                                 letter = letter == '-' ? '_' : letter;
                             return name;
                         });

TEST(CheckBytes, AreInProportionToo)
{
    EXPECT_EQ(check_bytes(std::uint64_t{1} << 28), check_bytes(1u << 20) << 8);
    EXPECT_GT(check_bytes(1), 4 * sizeof(HostTree::Node));
}

}  // namespace
}  // namespace bvhbench
