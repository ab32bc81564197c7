// SPDX-License-Identifier: MIT
#include "builders/implicit/cut.h"

#include <gtest/gtest.h>

#include <vector>

namespace bvhbench {
namespace {

TEST(Cut, HalvesGroupsUntilTheyFit)
{
    const Cut widest{KernelForm::groups, 512, 2, 11};
    std::vector<uint> asked;
    const Cut cut = cut_that_fits(widest, [&](const Cut& tried) {
        EXPECT_EQ(tried.levels, floor_log2(2 * tried.group_size * 2)) << tried.group_size;
        asked.push_back(tried.group_size);
        return tried.group_size <= 128;
    });
    EXPECT_EQ(asked, (std::vector<uint>{512, 256, 128}));
    EXPECT_EQ(cut.group_size, 128u);
    EXPECT_EQ(cut.items, 2u);
    EXPECT_EQ(cut.levels, 9u);
}

TEST(Cut, KeepsTwoBoxesAWorkItemOrItsEntryLevel)
{
    EXPECT_EQ(local_box_bytes({KernelForm::groups, 512, 1, 10}, 48), 49152u);
    EXPECT_EQ(local_box_bytes({KernelForm::groups, 512, 2, 11}, 48), 49152u);
    EXPECT_EQ(local_box_bytes({KernelForm::groups, 64, 4, 9}, 24), 6144u);
}

TEST(Cut, IsLeftAsItIsWhereItFits)
{
    const Cut cut =
        cut_that_fits({KernelForm::groups, 512, 1, 10}, [](const Cut&) { return true; });
    EXPECT_EQ(cut.group_size, 512u);
    EXPECT_EQ(cut.levels, 10u);
}

TEST(Cut, EndsWhereNothingFits)
{
    const Cut cut =
        cut_that_fits({KernelForm::groups, 512, 1, 10}, [](const Cut&) { return false; });
    EXPECT_EQ(cut.group_size, 1u);
    EXPECT_EQ(cut.levels, 1u);
}

}  // namespace
}  // namespace bvhbench
