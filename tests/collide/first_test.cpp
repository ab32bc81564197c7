// SPDX-License-Identifier: MIT
//
// A query up to the first contact says whether there is one, with two triangles that intersect: by the oracle of exact contacts.
#include "collide/oracles/exact_reference.h"
#include "scenes/generate/pair_classes.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

class FirstTest : public testing::TestWithParam<std::tuple<Named, KernelForm>> {
protected:
    Standing standing(const Mesh& mesh, std::span<const FaceRange> objects = {}) const
    {
        return {mesh, std::get<0>(GetParam()).name, {}, objects};
    }

    /// Asks for the first contact and compares the answer with all contacts. Returns the number of queries.
    int expect_answer(const Standing& standing, ColliderOptions options,
                      const PairList& contacts) const
    {
        options.first = true;
        options.form = std::get<1>(GetParam());
        const auto leaf = made("leaf", options);
        EXPECT_TRUE(leaf->finds_contacts());
        leaf->reserve(standing.tree, standing.input);
        const int queries = find_pairs(*leaf, standing.tree, standing.input, session().queue());
        const std::vector<Pair> found = leaf->pairs(session().queue());
        session().queue().finish();
        EXPECT_EQ(leaf->counts(session().queue()).pairs, found.size());
        EXPECT_EQ(found.size(), contacts.size() > 0 ? 1u : 0u);
        for (const Pair pair : found)
            EXPECT_TRUE(std::ranges::binary_search(contacts.pairs(), pair))
                << pair.a << " and " << pair.b;
        return queries;
    }

    /// The same with and without doubles. Returns whether there are contacts.
    bool expect_right(const Standing& standing, ColliderOptions options, const PairList& contacts)
    {
        for (const bool without : {false, true}) {
            options.without_doubles = without;
            expect_answer(standing, options, contacts);
        }
        return contacts.size() > 0;
    }
};

PairList contacts_of(const Standing& standing, bool keep_adjacent, Among among = Among::all)
{
    return intersecting_pairs(standing.mesh.points, standing.mesh.faces,
                              standing.expected(keep_adjacent, among).pairs(), keep_adjacent);
}

/// Triangles of `size` at random places of a cube. Some share a corner or two with the triangle before.
Mesh scattered(uint count, float size, Dice& dice)
{
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const Point at = dice.point();
        for (int corner = 0; corner < 3; ++corner) {
            const Point by = dice.point();
            mesh.points.push_back({at.x + size * by.x, at.y + size * by.y, at.z + size * by.z});
        }
        const uint shared = k == 0 ? 0 : dice.below(3), first = 3 * k;
        mesh.faces.push_back(
            {first - (shared > 0 ? 3 : 0), first + 1 - (shared > 1 ? 3 : 0), first + 2});
    }
    return mesh;
}

TEST_P(FirstTest, IsThereIfTheOracleHasContactsAndIsOneOfThem)
{
    Dice dice(3);
    int answers[2] = {};
    for (const uint count : {1u, 2u, 7u, 40u})
        for (const float size : {0.01f, 0.05f, 0.2f}) {
            ManyObjects many({});
            for (uint k = 0; k < count; ++k)
                many.add(scattered(k % 5 == 1 ? 1 : 2 + dice.below(40), size, dice));
            const Standing standing = this->standing(many.mesh, many.objects);
            ObjectFilter filter;
            for (uint k = 0; k < count; ++k)
                filter.excluded.push_back({k, k + (k % 2 == 0 && k + 1 < count ? 1 : 0)});
            for (const bool keep : {false, true})
                for (const Among among :
                     {Among::all, Among::between_objects, Among::within_objects}) {
                    SCOPED_TRACE(std::to_string(count) + " objects of " + std::to_string(size) +
                                 ", among " + std::to_string(static_cast<int>(among)));
                    const PairList all = contacts_of(standing, keep, among);
                    ++answers[expect_right(standing, {.among = among, .keep_adjacent = keep}, all)];
                    const PairList some = chosen(all, [&](Pair pair) {
                        return filter.allows(many.owners[pair.a], many.owners[pair.b]);
                    });
                    expect_answer(standing,
                                  {.among = among, .keep_adjacent = keep, .filter = filter}, some);
                }
        }
    EXPECT_GT(answers[0], 10);
    EXPECT_GT(answers[1], 10);
}

/// Triangles above each other whose boxes overlap, and one upright that only triangle `k` meets, as a triangle of the same object or as
/// an object of its own.
TEST_P(FirstTest, IsFoundWhicheverLeafHasIt)
{
    constexpr uint count = 70;
    Mesh apart;
    for (uint k = 0; k < count; ++k) {
        const auto z = static_cast<float>(k);
        apart.points.insert(apart.points.end(), {{0, 0, z}, {4, 0, z + 2}, {0, 4, z + 2}});
        apart.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    const Standing none = standing(apart);
    EXPECT_GT(none.expected(false).size(), count);
    expect_right(none, {}, PairList());
    apart.faces.push_back({3 * count, 3 * count + 1, 3 * count + 2});
    for (uint k = 0; k < count; ++k) {
        Mesh mesh = apart;
        const float z = static_cast<float>(k) + 0.25f;
        mesh.points.insert(mesh.points.end(), {{-1, 0.25f, z}, {1, 0.25f, z}, {0.5f, 0.5f, z}});
        const FaceRange objects[] = {{0, count}, {count, 1}};
        const PairList contact({{k, count}});
        SCOPED_TRACE(k);
        expect_answer(standing(mesh), {}, contact);
        expect_answer(standing(mesh, objects), {.among = Among::between_objects}, contact);
    }
}

TEST_P(FirstTest, IsExactOfPairsThatAreHardToTell)
{
    for (const PairClass& of : pair_classes())
        for (uint shared = 0; shared < 3; ++shared) {
            Mesh mesh = apart_pairs(of, 1, 1 + shared);
            if (shared > 0)
                mesh.faces[1].a = mesh.faces[0].b;
            if (shared > 1)
                mesh.faces[1].c = mesh.faces[0].a;
            SCOPED_TRACE(of.name + ", corners shared: " + std::to_string(shared));
            const Standing standing = this->standing(mesh);
            expect_right(standing, {}, contacts_of(standing, true));
        }
}

/// Pairs in one plane whose boxes overlap, which floats and doubles leave unsure: none of them meets, but perhaps the last.
Mesh in_a_plane(uint pairs, bool last_meets)
{
    Mesh mesh;
    for (uint k = 0; k < pairs; ++k) {
        const float x = 2 * static_cast<float>(k), y = last_meets && k + 1 == pairs ? 0.5f : 0.75f;
        mesh.points.insert(mesh.points.end(), {{x, 0, 0},
                                               {x + 1, 0, 0},
                                               {x, 1, 0},
                                               {x + 0.5f, y, 0},
                                               {x + 1, 1, 0},
                                               {x + 0.5f, 1, 0}});
        mesh.faces.insert(mesh.faces.end(),
                          {{6 * k, 6 * k + 1, 6 * k + 2}, {6 * k + 3, 6 * k + 4, 6 * k + 5}});
    }
    return mesh;
}

TEST_P(FirstTest, LosesNoUnsurePairWhereTheirListIsShort)
{
    for (const bool meets : {false, true}) {
        const Standing standing = this->standing(in_a_plane(40, meets));
        const PairList contacts = contacts_of(standing, true);
        EXPECT_EQ(contacts.size(), meets ? 1u : 0u);
        for (const bool without : {false, true}) {
            ColliderOptions options = {.capacity = 1};
            options.without_doubles = without;
            const int queries = expect_answer(standing, options, contacts);
            EXPECT_TRUE(meets || queries > 1) << without;
        }
    }
    Mesh mesh = in_a_plane(40, false);
    mesh.points.insert(mesh.points.end(), {{0.1f, 0.2f, -1}, {0.2f, 0.2f, 1}, {0.2f, 0.1f, 1}});
    mesh.faces.push_back({240, 241, 242});
    EXPECT_EQ(expect_answer(standing(mesh), {.capacity = 1}, PairList({{0, 80}})), 1)
        << "the list was too short, and a contact was found without it";
}

INSTANTIATE_TEST_SUITE_P(
    Over, FirstTest,
    testing::Combine(testing::ValuesIn(first_by_day<Named>(
                         2, {{"oibvh-multi"}, {"apetrei-fused"}, {"oibvh-wide8"}})),
                     both_forms),
    CaseName());

}  // namespace
}  // namespace bvhbench
