// SPDX-License-Identifier: MIT
//
// Every builder of the catalog meets the same contract. New builders are tested as soon as they are listed.
#include "harness/judge/check.h"

#include "builders/orders.h"
#include "tests/collide/collider_testing.h"

namespace bvhbench {
namespace {

/// Returns how `choice` violates the contract over `mesh`, or ""; also checks the name on the builder's card. A refusal is
/// reported through `refused`; without `refused` it counts as a violation.
std::string broken_over(const BuilderChoice& choice, const Mesh& mesh, bool* refused = nullptr)
{
    const Input input = uploaded(mesh.points, mesh.faces);
    Oracle oracle(session(), input);
    EXPECT_EQ(session().builder(choice).card().name, choice.name);
    bool did_refuse = false;
    const std::string wrong = contract_violation(session(), choice, input, oracle, &did_refuse);
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
    for (const std::size_t size : critical_sizes()) {
        bool refused = false;
        EXPECT_EQ(broken_over(named(entry.name), input.make(size), &refused), "")
            << size << " triangles, " << input.name;
        EXPECT_TRUE(!refused || input.name == "huge") << size << " triangles, refused";
    }
}

INSTANTIATE_TEST_SUITE_P(
    Catalog, BuilderContract,
    testing::Combine(testing::ValuesIn(builder_catalog().begin(), builder_catalog().end()),
                     testing::ValuesIn(hard_inputs().begin(), hard_inputs().end())),
    CaseName());

class EachBuilder : public testing::TestWithParam<BuilderEntry> {
protected:
    void SetUp() override
    {
        if (GetParam().make == nullptr)
            GTEST_SKIP() << GetParam().absent;
    }
};

TEST_P(EachBuilder, ChangesItsTreeByTheOrderAndNoOtherOption)
{
    const Mesh mesh = hard_inputs().front().make(777);
    BuilderChoice choice = named(GetParam().name);
    const auto& all = builder_catalog();
    const auto place = static_cast<int>(
        std::ranges::find(all, GetParam().name, &BuilderEntry::name) - all.begin());
    int turn = place;
    for (const OrderEntry& order : order_catalog()) {
        ++turn;
        for (const bool sorted_leaves : {false, true})
            for (const unsigned group_size : {0u, 64u}) {
                const bool in_groups = group_size != 0;
                if (!takes_combination({turn, sorted_leaves}) ||
                    !takes_combination({place / 2, sorted_leaves, in_groups}))
                    continue;
                choice.order = order.name;
                choice.sorted_leaves = sorted_leaves;
                choice.group_size = group_size;
                EXPECT_EQ(broken_over(choice, mesh), "")
                    << order.name << (sorted_leaves ? ", sorted, " : ", mesh, ") << group_size;
            }
    }
}

TEST_P(EachBuilder, KeepsNothingOfTheSizeReservedBefore)
{
    const auto& make = hard_inputs().front().make;
    for (const std::size_t size : {1000u, 3u, 2000u, 1u, 1000u})
        EXPECT_EQ(broken_over(named(GetParam().name), make(size)), "") << size << " triangles";
}

/// An array of 2^28 boxes has 6 GiB: a builder that counts its bytes or words in 32 bits asks for too few.
TEST_P(EachBuilder, AsksForBytesInProportionToTheMeshPast32Bits)
{
    for (const char* order : {"morton30", "hilbert63", "kd"})
        for (const bool sorted_leaves : {false, true}) {
            const auto builder = GetParam().make(session().programs(),
                                                 {.order = order, .sorted_leaves = sorted_leaves});
            const auto bytes_each = [&](unsigned log2) {
                return static_cast<double>(builder->footprint(std::size_t{1} << log2).total()) /
                       static_cast<double>(std::size_t{1} << log2);
            };
            const double at_4_million = bytes_each(22);  // smaller ones may be sorted in one launch
            EXPECT_GE(at_4_million, 24.0) << "a box a triangle at least";
            for (unsigned log2 = 24; log2 <= 28; ++log2)
                EXPECT_NEAR(bytes_each(log2) / at_4_million, 1.0, 0.02)
                    << order << (sorted_leaves ? ", sorted" : "") << ", 2^" << log2;
        }
}

TEST_P(EachBuilder, RefusesAGroupSizeThatIsNoPowerOfTwo)
{
    if (GetParam().make(session().programs(), {})->card().runs != BuilderCard::Runs::on_device)
        return;
    for (const BuildOptions& wrong : {BuildOptions{.group_size = 48}, {.group_size = 1u << 20}})
        EXPECT_THROW(GetParam().make(session().programs(), wrong), BadUsage);
}

INSTANTIATE_TEST_SUITE_P(Catalog, EachBuilder,
                         testing::ValuesIn(builder_catalog().begin(), builder_catalog().end()),
                         CaseName());

TEST(ImplicitBuilders, LineUpLeavesInTheirFirstLaunchUnlessTheyRoundThem)
{
    const Mesh mesh = hard_inputs().front().make(777);
    const Input input = uploaded(mesh.points, mesh.faces);
    Oracle oracle(session(), input);
    for (const std::string_view name : {"oibvh-single", "perfect"})
        for (const unsigned items : {1u, 4u})
            for (const bool rounds : {false, true}) {
                if (!takes_combination({name == "perfect", items == 4, rounds}))
                    continue;
                const std::string boxes = rounds ? "f64" : "f32";
                SCOPED_TRACE(std::string(name) + ' ' + boxes + ' ' + std::to_string(items));
                BuilderChoice choice = named(name);
                choice.group_size = 32;  // several groups in the first launch, and later ones
                choice.items = items;
                choice.sorted_leaves = true;
                choice.boxes = boxes;
                bool refused = false;
                EXPECT_EQ(contract_violation(session(), choice, input, oracle, &refused), "");
                EXPECT_FALSE(refused);
                Builder& builder = session().builder(choice);
                builder.reserve(mesh.faces.size());
                EXPECT_EQ(
                    std::ranges::count(session().build_once(builder, input, Start::from_triangles),
                                       "gather", &StageTime::stage) > 0,
                    rounds);
            }
}

TEST(CheckBytes, AreInProportionToo)
{
    EXPECT_EQ(check_bytes(std::uint64_t{1} << 28), check_bytes(1u << 20) << 8);
    EXPECT_GT(check_bytes(1), 4 * sizeof(HostTree::Node));
}

}  // namespace
}  // namespace bvhbench
