// SPDX-License-Identifier: MIT
//
// Queries that leave out pairs of objects find what an oracle does that is asked the same.

#include "collide/object_filter.h"
#include "geometry/hash.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using Random = std::mt19937;

uint below(Random& random, std::size_t count)
{
    return static_cast<uint>(random() % static_cast<unsigned>(count));
}

/// Crowded objects of 1 to 70 triangles, at random places of a cube that leaves about as many neighbours to each, however many.
ManyObjects scattered(std::size_t count, Random& random)
{
    ManyObjects many({});
    const float side = 1.2f * std::cbrt(static_cast<float>(count));
    const auto along = [&] { return side * static_cast<float>(random() >> 8) * 0x1p-24f; };
    for (std::size_t k = 0; k < count; ++k) {
        Mesh part = crowded_mesh(k % 5 == 1 ? 1 : 2 + below(random, 69));
        const float y = along(), z = along();
        for (Point& point : part.points) {
            point.y += y;
            point.z += z;
        }
        many.add(part, along());
    }
    return many;
}

/// Excludes the pairs of objects, b <= a, for which `is_out` is true.
ObjectFilter excluding(uint objects, const std::function<bool(uint a, uint b)>& is_out)
{
    std::vector<Pair> pairs;
    for (uint a = 0; a < objects; ++a)
        for (uint b = 0; b <= a; ++b)
            if (is_out(a, b))
                pairs.push_back({a, b});
    return {.excluded = excluded_pairs(pairs)};
}

bool always(uint, uint) { return true; }

/// Of links of arms of six, neighbours are not tested, nor pairs within a link.
bool in_arms(uint a, uint b) { return a == b || (a == b + 1 && a % 6 != 0); }

/// Groups and masks of a few bits, not symmetric, so that often only one of two objects accepts the other.
ObjectFilter masks(uint objects, Random& random)
{
    ObjectFilter filter;
    for (uint k = 0; k < objects; ++k) {
        filter.groups.push_back(1u << below(random, 4) | (k % 7 == 0 ? 1u << 31 : 0));
        filter.masks.push_back(below(random, 16) | (k % 3 == 0 ? 1u << 31 : 0));
    }
    return filter;
}

std::vector<ObjectFilter> filters(uint objects, Random& random)
{
    // About half of all pairs, for lists of many lengths.
    const auto half = [&](uint, uint) { return random() % 2 == 0; };
    ObjectFilter both = excluding(objects, half);
    const ObjectFilter of_masks = masks(objects, random);
    both.masks = of_masks.masks;
    return {{},       excluding(objects, always), excluding(objects, in_arms),
            of_masks, excluding(objects, half),   both};
}

PairList chosen_by_hand(const PairList& pairs, const ManyObjects& many, const ObjectFilter& filter)
{
    return chosen(pairs, [&](Pair pair) {
        const uint a = many.owners[pair.a], b = many.owners[pair.b];
        const auto bits = [](const std::vector<uint>& words, uint k) {
            return words.empty() ? ~0u : words[k];
        };
        if (a != b && ((bits(filter.groups, a) & bits(filter.masks, b)) == 0 ||
                       (bits(filter.groups, b) & bits(filter.masks, a)) == 0))
            return false;
        return std::ranges::count(filter.excluded, Pair{std::min(a, b), std::max(a, b)}) == 0;
    });
}

class FilterTest : public testing::TestWithParam<ObjectsCase> {};

TEST_P(FilterTest, LeavesOutWhatItShouldAndNothingElse)
{
    const auto& [collider, builder, form] = GetParam();
    Random random{11};
    for (const std::size_t count : {1, 2, 7, 40, 200}) {
        const ManyObjects many = scattered(count, random);
        const Standing standing = many.standing(find_builder(builder.name).make);
        for (const ObjectFilter& filter : filters(static_cast<uint>(count), random))
            for (const Among among : {Among::all, Among::between_objects, Among::within_objects}) {
                SCOPED_TRACE(std::to_string(count) + " objects, filter " + hex(filter.hash()) +
                             ", among " + std::to_string(static_cast<int>(among)));
                const auto one =
                    made(collider.name, {.among = among, .form = form, .filter = filter});
                one->reserve(standing.tree, standing.input);
                const PairList wanted =
                    chosen_by_hand(standing.expected(true, among), many, filter);
                expect_pairs(*one, standing, wanted);
            }
    }
}

TEST_P(FilterTest, TestsOnlyObjectsIfAllAreLeftOut)
{
    const auto& [collider, builder, form] = GetParam();
    Random random{5};
    const ManyObjects many = scattered(30, random);
    const Standing standing = many.standing(find_builder(builder.name).make);
    const auto tests = [&](const ObjectFilter& filter) {
        const auto one = made(collider.name, {.form = form, .filter = filter});
        one->reserve(standing.tree, standing.input);
        expect_pairs(*one, standing, filter.is_empty() ? standing.expected(true) : PairList());
        return one->counts(session().queue()).box_tests.value();
    };
    EXPECT_LT(10 * tests(excluding(30, always)), tests({}));
}

INSTANTIATE_TEST_SUITE_P(Trees, FilterTest, testing::ValuesIn(cases_of_objects()), CaseName());
INSTANTIATE_TEST_SUITE_P(OfOneGroup, FilterTest,
                         testing::Values(ObjectsCase{
                             {"block"}, {"oibvh-single"}, KernelForm::groups}),
                         CaseName());

TEST(Filter, OfTheOracleIsTheSame)
{
    Random random{3};
    const ManyObjects many = scattered(40, random);
    const PairList all = expected_pairs(many, Among::all, true);
    for (const ObjectFilter& filter : filters(40, random)) {
        const PairList wanted = chosen_by_hand(all, many, filter);
        EXPECT_EQ(touching_pairs(many.mesh.points, many.mesh.faces, true, many.objects, Among::all,
                                 filter),
                  wanted);
        const Standing standing(many.mesh, nullptr, {}, many.objects);
        const auto brute = made("brute", {.filter = filter});
        brute->reserve(nullptr, standing.input);
        expect_pairs(*brute, standing, wanted);
    }
}

TEST(Filter, OfOtherObjectsIsRefused)
{
    Random random{3};
    const Standing standing = scattered(3, random).standing(find_builder("oibvh-multi").make);
    for (const ObjectFilter& filter :
         {ObjectFilter{.excluded = {{1, 3}}}, ObjectFilter{.groups = {1, 2}},
          ObjectFilter{.masks = {1, 2, 3, 4}}}) {
        const auto one = made("leaf", {.filter = filter});
        EXPECT_THROW(one->reserve(standing.tree, standing.input), BadUsage);
    }
}

TEST(Filter, IsRefusedByCollidersThatHaveNone)
{
    const ObjectFilter filter{.excluded = {{0, 1}}};
    for (const ColliderEntry& entry : collider_catalog()) {
        ColliderChoice choice{{.filter = filter}, std::string(entry.name)};
        const auto is_refused = [&] {
            try {
                make_collider(choice, session().programs());
                return false;
            } catch (const BadUsage&) {
                return true;
            }
        };
        EXPECT_NE(is_refused(), entry.filters) << entry.name;
        choice.rules_off = skip_apart;
        EXPECT_NE(is_refused(), entry.name == "brute") << entry.name;
    }
}

TEST(Filter, HashTellsFiltersApart)
{
    Random random{9};
    std::set<std::uint64_t> hashes;
    for (const ObjectFilter& filter : filters(20, random))
        EXPECT_TRUE(hashes.insert(filter.hash()).second);
    EXPECT_EQ(ObjectFilter{}.hash(), 0u);
    EXPECT_NE((ObjectFilter{.groups = {1, 2}}.hash()), (ObjectFilter{.masks = {1, 2}}.hash()));
}

}  // namespace
}  // namespace bvhbench
