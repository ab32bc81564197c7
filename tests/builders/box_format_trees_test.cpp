// SPDX-License-Identifier: MIT
//
// Trees whose boxes are in another format meet the contract of a builder: each equals the reference tree with its boxes
// rounded as the host rounds them, bit for bit.

#include "builders/host_tree.h"
#include "harness/judge/check.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

BuilderChoice rounding(std::string_view name, std::string_view boxes, unsigned group_size)
{
    return {{.group_size = group_size, .sorted_leaves = true, .boxes = std::string(boxes)},
            std::string(name)};
}

std::string broken_over(Session& on, const BuilderChoice& choice, const Mesh& mesh)
{
    const Input input = upload(on.device(), on.queue(), mesh.points, mesh.faces);
    Oracle oracle(on, input);
    return contract_violation(on, choice, input, oracle);
}

void expect_contract(std::string_view builder, std::string_view boxes, unsigned group_size)
{
    const BuilderChoice choice = rounding(builder, boxes, group_size);
    for (const HardInput& input : hard_inputs())
        for (const std::size_t size : {1u, 2u, 3u, 33u, 300u})
            EXPECT_EQ(broken_over(session(), choice, input.make(size)), "")
                << builder << ", " << boxes << ", " << input.name << ", " << size << " triangles, "
                << group_size;
}

class RoundedTrees : public testing::TestWithParam<BoxFormat> {};

TEST_P(RoundedTrees, AreTheReferencesRounded)
{
    for (const unsigned group_size : {0u, 64u})  // one work-item per subtree, and a group
        expect_contract("oibvh-single", GetParam().name, group_size);
}

/// Small inputs, for a device that checks every access.
TEST_P(RoundedTrees, OfFewAreTheReferencesRounded)
{
    for (const HardInput& input : hard_inputs().first(2))
        for (const std::size_t size : {1u, 3u, 33u})
            EXPECT_EQ(broken_over(session(), rounding("oibvh-single", GetParam().name, 16),
                                  input.make(size)),
                      "")
                << input.name << ", " << size << " triangles";
}

/// With groups that wait, boxes are passed on by value, packed as the format requires.
TEST_P(RoundedTrees, AreTheSameWhereGroupsWait)
{
    EXPECT_EQ(broken_over(waiting_session(), rounding("oibvh-single", GetParam().name, 16),
                          hard_inputs().front().make(3000)),
              "");
}

/// Inner nodes of radix trees are packed too, in words that depend on the format.
TEST_P(RoundedTrees, OfFewAreRadixTreesToo)
{
    const Mesh mesh = hard_inputs().front().make(33);
    for (const char* builder : {"karras", "apetrei", "apetrei-fused", "lbvh-levels", "hploc"})
        EXPECT_EQ(broken_over(session(), rounding(builder, GetParam().name, 16), mesh), "")
            << builder;
    for (const char* builder : {"apetrei-fused", "lbvh-levels"})
        EXPECT_EQ(broken_over(waiting_session(), rounding(builder, GetParam().name, 16), mesh), "")
            << builder;
}

TEST_P(RoundedTrees, OfSeveralObjectsAreUpdatedWithTheirCells)
{
    ManyObjects many({70, 129, 3});
    const BuildOptions options{.sorted_leaves = true, .boxes = std::string(GetParam().name)};
    const MakeBuilder make = find_builder("oibvh-multi").make;
    Standing updated = many.standing(make, options);

    // Moves the first object so far away that it is outside of all previous cells.
    const FaceRange& moved = many.objects[0];
    for (uint face = moved.first; face < moved.first + moved.count; ++face)
        for (const uint corner :
             {many.mesh.faces[face].a, many.mesh.faces[face].b, many.mesh.faces[face].c})
            many.mesh.points[corner].y += 5000.0f;
    place(updated.input, many.mesh.points);
    using enum TreeUpdate;
    const std::vector<TreeUpdate> wanted = {rebuild, keep, refit};
    EXPECT_EQ(updated.builder->plan_update(wanted, session().queue()),
              GetParam().has_cells() ? std::vector(3, rebuild) : wanted);
    updated.builder->update(updated.input, session().queue());
    session().queue().finish();
    const Standing anew = many.standing(make, options);
    for (uint object = 0; object < many.objects.size(); ++object)
        EXPECT_EQ(tree_hash(updated.device_tree().object_to_host_tree(object)),
                  tree_hash(anew.device_tree().object_to_host_tree(object)))
            << "object " << object;
}

INSTANTIATE_TEST_SUITE_P(Catalog, RoundedTrees,
                         testing::ValuesIn(box_formats().begin() + 1, box_formats().end()),
                         CaseName());

TEST(RoundedTrees, AreBuiltByAllThatSayThatTheyCan)
{
    // By day each builder takes one format, in turns. f16 compiles to the same code as u16.
    const std::vector<std::string_view> formats = {"f64", "u16", "u8"};
    for (std::size_t turn = 0; const BuilderEntry& entry : builder_catalog())
        if (entry.takes_formats && entry.name != "oibvh-single") {
            ++turn;
            for (const std::string_view boxes : formats)
                if (takes_all_cases() || boxes == formats[turn % formats.size()])
                    expect_contract(entry.name, boxes, 0);
        }
}

TEST(RoundedTrees, AreRefusedByAllOthersInOneSentence)
{
    for (const BuilderEntry& entry : builder_catalog()) {
        if (entry.make == nullptr || entry.takes_formats)
            continue;
        EXPECT_THROW(make_builder(rounding(entry.name, "u16", 0), session().programs()), BadUsage);
        const auto by_itself = entry.make(session().programs(), {});
        if (by_itself->card().runs == BuilderCard::Runs::on_device) {
            EXPECT_THROW(entry.make(session().programs(), {.sorted_leaves = true, .boxes = "u16"}),
                         BadUsage)
                << entry.name;
        }
    }
    EXPECT_THROW(find_builder("oibvh-multi").make(session().programs(), {.boxes = "u16"}), BadUsage)
        << "leaves are not sorted";
    EXPECT_THROW(find_builder("oibvh-multi")
                     .make(session().programs(), {.sorted_leaves = true, .boxes = "u17"}),
                 BadUsage);
}

}  // namespace
}  // namespace bvhbench
