// SPDX-License-Identifier: MIT
//
// Blocks of leaves as queries, `block`.
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

TEST(Block, FindsTheOraclesPairsWhereItsTreeHasSeveralLevelsOfBlocks)
{
    // Sizes at and next to what five, ten and fifteen levels hold, in an order with jumps and in one without.
    for (const std::size_t size : {31u, 32u, 1023u, 1024u, 1025u, 32769u})
        for (const char* order : {"morton30", "kd"}) {
            SCOPED_TRACE(std::to_string(size) + " triangles, " + order);
            const auto block = made("block", {.form = KernelForm::groups});
            const Mesh surface = scene_mesh("torus:" + std::to_string(size));
            expect_oracles_pairs(*block, Standing(surface, "oibvh-multi", {.order = order}));
        }
}

TEST(Block, FindsTheOraclesPairsInTreesThatItCollapses)
{
    // Sizes at and next to those of classes of wide nodes: 32, 512 and 8192 leaves, in wide trees 16, 64, 256 and 4096. Nodes are
    // numbered in three ways, and leaves of `hploc` are not in the order of the tree.
    for (const std::size_t size : {2u, 17u, 32u, 33u, 65u, 512u, 513u, 4097u, 8193u})
        for (const char* builder :
             {"karras", "apetrei", "lbvh-levels", "hploc", "oibvh-wide4", "oibvh-wide8"}) {
            SCOPED_TRACE(std::to_string(size) + " triangles, " + builder);
            for (const std::size_t capacity : {0u, 1u}) {
                const auto block =
                    made("block", {.form = KernelForm::groups, .capacity = capacity});
                const Mesh surface = scene_mesh("torus:" + std::to_string(size));
                expect_oracles_pairs(*block, Standing(surface, builder));
            }
        }
}

TEST(Block, FindsTheOraclesPairsOfSeveralTreesThatItCollapses)
{
    // Between objects that have wide nodes is one that has none.
    const Mesh surface = scene_mesh("torus:1400");
    const std::vector<FaceRange> objects = {{0, 700}, {700, 20}, {720, 80}, {800, 600}};
    for (const char* builder : {"apetrei-fused", "hploc", "oibvh-wide4", "oibvh-wide8"}) {
        SCOPED_TRACE(builder);
        const auto block = made("block", {.form = KernelForm::groups});
        expect_oracles_pairs(*block, Standing(surface, builder, {}, objects));
    }
}

TEST(Block, FindsTheOraclesPairsInATreeWhoseNodesHaveALeafAndTheRest)
{
    // Each triangle is half as far from the origin as the one before, so wide nodes have leaves and blocks of one leaf as children.
    Mesh mesh = collinear_mesh(30 * 40);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
        mesh.points[k].x =
            std::ldexp(1.0f + 0.01f * static_cast<float>(k % 3), -static_cast<int>(k / 3 % 30));
    for (const bool keep_adjacent : {true, false}) {
        const auto block =
            made("block", {.keep_adjacent = keep_adjacent, .form = KernelForm::groups});
        for (const char* builder : {"karras", "hploc"})
            expect_oracles_pairs(*block, Standing(mesh, builder, {.order = "morton63"}),
                                 keep_adjacent);
    }
}

TEST(Block, FindsMorePairsThanATeamKeeps)
{
    // The same triangle 200 times: seven blocks, most pairs of which meet in more than 256 pairs of triangles.
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector<Face>(200, Face{0, 1, 2})};
    const auto block = made("block", {.form = KernelForm::groups});
    const Standing standing(mesh, "perfect");
    expect_oracles_pairs(*block, standing);
    EXPECT_EQ(block->counts(session().queue()).pairs, 200u * 199 / 2);
}

TEST(Block, FindsThePairsOfTreesThatAreOneLeaf)
{
    const Mesh mesh = collinear_mesh(40);
    std::vector<FaceRange> objects;
    for (uint k = 0; k < 40; ++k)
        objects.push_back({k, 1});
    for (const char* builder : {"oibvh-multi", "apetrei-fused", "hploc", "oibvh-wide4"})
        for (const bool is_sorted : {false, true}) {
            const auto block = made("block", {.form = KernelForm::groups});
            const Standing standing(mesh, builder, {.sorted_leaves = is_sorted}, objects);
            expect_oracles_pairs(*block, standing);
            EXPECT_EQ(block->counts(session().queue()).pairs, 39u + 38u);
        }
}

TEST(Block, CountsWhatAHandCounts)
{
    // 40 triangles in a row, each overlapping the next two: blocks of 32 and of 8 leaves.
    const Standing standing(collinear_mesh(40), "oibvh-multi");
    const auto block = made("block", {.form = KernelForm::groups});
    expect_oracles_pairs(*block, standing);
    const QueryCounts counts = block->counts(session().queue());
    EXPECT_EQ(counts.pairs, 39u + 38u);
    const uint within = 32 * 31 / 2 + 8 * 7 / 2,
               of_nodes = 1 + 1 + 8;  // the second block by two teams, its leaves
    EXPECT_EQ(counts.box_tests, within + of_nodes + 2 * 32);  // two of them meet the first block
}

}  // namespace
}  // namespace bvhbench
