// SPDX-License-Identifier: MIT
//
// Files of queries are read whole, with coordinates that are doubles exactly, or refused with the line.
#include "scenes/moving_queries.h"

#include "tests/scenes/helpers.h"

namespace bvhbench {
namespace {

/// Eight lines of one query: vertex k is at (k, 1/2, 1/4) at time 0 and, one lower, at time 1.
std::string query(const std::string& end, const std::string& x = "0,1")
{
    std::string lines;
    for (int k = 0; k < 8; ++k)
        lines += (k == 0 ? x : std::to_string(k % 4) + ",1") + ",1,2," + (k < 4 ? "1,4" : "-3,4") +
                 end + "\n";
    return lines;
}

std::string said_of(const std::filesystem::path& path)
{
    return refusal_of([&] { read_queries(path); });
}

using MovingQueries = InFolder;

TEST_F(MovingQueries, AreReadByFolderAndKind)
{
    folder.file("spikes/edge-edge/a.csv", query(",1") + query(",0"));
    folder.file("spikes/edge-edge/b.csv", query(",0"));
    // 2^-60 + 2^-90 is no float.
    folder.file("spikes/vertex-face/a.csv",
                query("", "1073741825,1237940039285380274899124224") + query(""));
    folder.file("rod_queries_12vf.csv", query("") + query(""));
    folder.file("truth/rod_12vf.json", "[true, false]");
    folder.file("tree.csv", "no queries");
    const std::vector<QuerySet> sets = read_queries(folder.path());
    ASSERT_EQ(sets.size(), 4u);
    EXPECT_EQ(sets[0].name, "rod 12/vertex-face floats");
    EXPECT_EQ(sets[0].published, (std::vector<char>{1, 0}));
    EXPECT_EQ(sets[1].name, "spikes/edge-edge floats");
    EXPECT_EQ(sets[1].published, (std::vector<char>{1, 0, 0}));
    EXPECT_TRUE(sets[1].queries[2].of_edges);
    EXPECT_EQ(sets[2].name, "spikes/vertex-face");
    ASSERT_EQ(sets[2].queries.size(), 1u);
    EXPECT_TRUE(sets[2].published.empty());
    const MovingQuery& wide = sets[2].queries.front();
    EXPECT_FALSE(wide.of_edges);
    EXPECT_EQ(wide.from[0].x, 0x1p-60 + 0x1p-90);
    EXPECT_EQ(wide.from[3].x, 3);
    EXPECT_EQ(wide.from[3].y, 0.5);
    EXPECT_EQ(wide.from[3].z, 0.25);
    EXPECT_EQ(wide.to[2].z, -0.75);
    EXPECT_EQ(sets[3].name, "spikes/vertex-face floats");
    EXPECT_EQ(read_queries(folder.path() / "rod_queries_12vf.csv").size(), 1u);
}

TEST_F(MovingQueries, AreRefusedInPart)
{
    const auto said = [&](const std::string& name, const std::string& text) {
        return said_of(folder.file(name, text));
    };
    EXPECT_TRUE(said("a_vf.csv", query("") + "0,1,0,1,0,1\n")
                    .ends_with("line 9: the last query has 1 of 8 lines"));
    EXPECT_TRUE(
        said("b_vf.csv", query("", "1,3"))
            .ends_with("line 1: '1/3' is no double: a whole number divided by a power of two"));
    EXPECT_TRUE(contains(said("c_vf.csv", query("", "9007199254740993,1")), "is no double"));
    EXPECT_TRUE(contains(said("d_vf.csv", query("", "1,0")), "is no double"));
    EXPECT_TRUE(said("e_vf.csv", "1,1,1\n").ends_with("line 1: there are 3 numbers, not 6 or 7"));
    EXPECT_TRUE(
        said("f_vf.csv", query(",2")).ends_with("line 1: the seventh number is '2', not 0 or 1"));
    EXPECT_TRUE(contains(said("g_vf.csv", query(",1") + query("")),
                         "line 9: there are 6 numbers, and 7 in the lines before"));
    std::string two_answers = query(",1");
    two_answers[two_answers.size() - 2] = '0';
    EXPECT_TRUE(contains(said("k_vf.csv", two_answers), "line 8: the seventh number is another"));
    EXPECT_TRUE(contains(said("h.csv", query("")), "ends in vf.csv or ee.csv"));
    folder.file("i_queries_vf.csv", query(""));
    folder.file("truth/i_vf.json", "[true, true]");
    EXPECT_TRUE(
        contains(said_of(folder.path() / "i_queries_vf.csv"), "no list of 1 times true or false"));
    std::filesystem::create_directories(folder.path() / "empty");
    EXPECT_TRUE(said_of(folder.path() / "empty").ends_with("there are no files of queries"));
    EXPECT_FALSE(said_of(folder.path() / "missing_vf.csv").empty());
    EXPECT_TRUE(said("j_vf.csv", "").ends_with("there are no files of queries"));
}

}  // namespace
}  // namespace bvhbench
