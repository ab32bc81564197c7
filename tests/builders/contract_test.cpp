// SPDX-License-Identifier: MIT
//
// Every builder of the catalog keeps the same promises. A new one is tested the moment it is listed.
#include "harness/judge/check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "builders/orders.h"
#include "harness/judge/hard_inputs.h"

namespace bvhbench {
namespace {

Session& session()
{
    static Session session{CommonOptions{}};
    return session;
}

/// The promise that `choice` breaks over `mesh`, with the card's name checked on the way. A refusal by a
/// builder that may refuse breaks none; without `refused` to tell of it, it does.
std::string broken_over(const BuilderChoice& choice, const Mesh& mesh, bool* refused = nullptr)
{
    const Input input = upload(session().device(), session().queue(), mesh.points, mesh.faces);
    Oracle oracle(session(), input);
    EXPECT_EQ(session().builder(choice).card().name, choice.name);
    bool did_refuse = false;
    const std::string wrong = broken_contract(session(), choice, input, oracle, &did_refuse);
    if (refused != nullptr)
        *refused = did_refuse;
    return did_refuse && refused == nullptr ? "refused" : wrong;
}

BuilderChoice named(std::string_view name)
{
    BuilderChoice choice;
    choice.name = name;
    return choice;
}

class BuilderContract : public testing::TestWithParam<std::tuple<BuilderEntry, HardInput>> {};

TEST_P(BuilderContract, IsKeptAtEveryTellingSize)
{
    const auto& [entry, input] = GetParam();
    if (entry.make == nullptr)
        GTEST_SKIP() << entry.absent;
    for (const std::size_t size : telling_sizes()) {
        bool refused = false;
        EXPECT_EQ(broken_over(named(entry.name), input.make(size), &refused), "")
            << size << " triangles, " << input.name;
        EXPECT_TRUE(!refused || input.name == "huge") << size << " triangles, refused";
    }
}

/// GoogleTest takes letters, digits and _ only.
std::string test_name(std::string name)
{
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

std::string contract_name(const testing::TestParamInfo<BuilderContract::ParamType>& tested)
{
    return test_name(std::string(std::get<0>(tested.param).name) + '_' +
                     std::string(std::get<1>(tested.param).name));
}

std::string options_name(const testing::TestParamInfo<BuilderEntry>& tested)
{
    return test_name(std::string(tested.param.name));
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, BuilderContract,
    testing::Combine(testing::ValuesIn(builder_catalog().begin(), builder_catalog().end()),
                     testing::ValuesIn(hard_inputs().begin(), hard_inputs().end())),
    contract_name);

class BuilderOptions : public testing::TestWithParam<BuilderEntry> {};

TEST_P(BuilderOptions, DoNotChangeTheTreeOtherThanByTheOrder)
{
    if (GetParam().make == nullptr)
        GTEST_SKIP() << GetParam().absent;
    const Mesh mesh = hard_inputs().front().make(777);
    BuilderChoice choice = named(GetParam().name);
    for (const OrderEntry& order : order_catalog())
        for (const bool sorted_leaves : {false, true})
            for (const unsigned group_size : {0u, 64u}) {
                choice.order = order.name;
                choice.sorted_leaves = sorted_leaves;
                choice.group_size = group_size;
                EXPECT_EQ(broken_over(choice, mesh), "")
                    << order.name << (sorted_leaves ? ", sorted, " : ", mesh, ") << group_size;
            }
}

TEST_P(BuilderOptions, DoNotOutliveTheSizeReservedBefore)
{
    if (GetParam().make == nullptr)
        GTEST_SKIP() << GetParam().absent;
    const auto& make = hard_inputs().front().make;
    for (const std::size_t size : {1000u, 3u, 2000u, 1u, 1000u})
        EXPECT_EQ(broken_over(named(GetParam().name), make(size)), "") << size << " triangles";
}

INSTANTIATE_TEST_SUITE_P(Catalog, BuilderOptions,
                         testing::ValuesIn(builder_catalog().begin(), builder_catalog().end()),
                         options_name);

}  // namespace
}  // namespace bvhbench
