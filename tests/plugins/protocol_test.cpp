// SPDX-License-Identifier: MIT
#include "plugins/protocol.h"

#include <array>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "builders/host_tree.h"
#include "tests/refusal.h"

namespace bvhbench::outside {
namespace {

/// Returns a reply as it is after parsing.
Json stages(const std::vector<Json>& list)
{
    return parsed_reply(Json{{"ok", true}, {"stages", list}}.dump());
}

Json stage(const char* name, int begin, int end, bool device)
{
    return {{"name", name}, {"begin_ns", begin}, {"end_ns", end}, {"device", device}};
}

TEST(Protocol, StagesKeepTheirClocks)
{
    const auto times =
        stages_of(stages({stage("bounds", 100, 130, true), stage("sort", 140, 160, true),
                          stage("build", 170, 175, false)}),
                  75);
    ASSERT_EQ(times.size(), 3u);
    EXPECT_EQ(times[0].span_ns, 30);
    EXPECT_EQ(times[1].start_ns, 40);
    EXPECT_EQ(times[1].elapsed_ns(), 20);
    EXPECT_EQ(times[2].wall_ns, 5);
    EXPECT_EQ(times[2].launches, 0);
}

TEST(Protocol, StagesLongerThanTheCallAreRefused)
{
    const Json reply = stages({stage("build", 100, 200, true)});
    EXPECT_EQ(stages_of(reply, 100).size(), 1u);
    EXPECT_EQ(refusal_of([&] { stages_of(reply, 99); }),
              "its stages last 100 ns, longer than the 99 ns that the whole call took");
}

TEST(Protocol, StagesThatOverlapOrRepeatAreRefused)
{
    for (const Json& reply :
         {stages({stage("bounds", 0, 10, true), stage("build", 9, 20, true)}),
          stages({stage("bounds", 10, 9, true)}), stages({}),
          stages({stage("build", 0, 1, true), stage("build", 1, 2, true)}),
          stages({stage("magic", 0, 1, true)}), stages({stage("build", -1, 1, true)}),
          Json{{"ok", true}, {"stages", 7}}, Json{{"ok", true}, {"stages", {1}}}})
        EXPECT_NE(refusal_of([&] { stages_of(reply, 1000); }), "") << reply;
}

TEST(Protocol, ARepliedErrorIsPrintable)
{
    EXPECT_EQ(refusal_of([] { parsed_reply(R"({"error": "no\nroom\u0007"})"); }),
              "it says: no room ");
    EXPECT_EQ(refusal_of([] { parsed_reply("[1]"); }),
              "its reply is malformed: '[1]' is no JSON object");
    EXPECT_NE(refusal_of([] { parsed_reply("{}"); }), "");
    EXPECT_NE(refusal_of([] { parsed_reply(R"({"ok": "yes"})"); }), "");
}

const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                   {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
const std::vector<Face> faces = {{0, 1, 2}, {3, 4, 5}};

std::string broken(std::vector<bvhbench_node> nodes, std::vector<std::uint32_t> entries)
{
    std::string sentence;
    const std::string why = refusal_of([&] {
        sentence = invariant_violation(tree_of(nodes, entries, points, faces), points, faces);
    });
    return why + sentence;
}

TEST(Protocol, TreesMayHaveLargerBoxesAndLeavesOfSeveralTriangles)
{
    EXPECT_EQ(broken({{{-1, -1, -1}, {9, 9, 9}, 0, 2, 1}}, {1, 0}), "");
    EXPECT_EQ(broken({{{0, 0, 0}, {6, 6, 5}, 0, 2, 0},
                      {{0, 0, 0}, {1, 1, 0}, 2, 1, 1},
                      {{5, 5, 4}, {6, 6, 5}, 3, 1, 1}},
                     {1, 2, 0, 1}),
              "");
}

TEST(Protocol, WrongTreesAreRefused)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto box = [](std::uint32_t first, std::uint32_t count, std::uint32_t is_leaf) {
        return bvhbench_node{{-1, -1, -1}, {9, 9, 9}, first, count, is_leaf};
    };
    EXPECT_NE(broken({}, {}), "");
    EXPECT_NE(broken({box(0, 0, 1)}, {0, 1}), "");
    EXPECT_NE(broken({box(0, 9, 1)}, {0, 1, 0, 1, 0, 1, 0, 1, 0}), "");
    EXPECT_NE(broken({box(1, 2, 1)}, {0, 1}), "");
    EXPECT_NE(broken({box(0xffffffffu, 2, 1)}, {0, 1}), "");
    EXPECT_NE(broken({box(0, 2, 1)}, {0, 2}), "");
    EXPECT_NE(broken({box(0, 2, 1)}, {0, 0}), "");
    EXPECT_NE(broken({box(0, 1, 1)}, {0}), "");
    EXPECT_NE(broken({box(0, 2, 0)}, {0, 1}), "");
    EXPECT_NE(broken({box(0, 2, 0), box(2, 2, 1)}, {1, 1, 0, 1}), "");
    EXPECT_NE(broken({{{nan, -1, -1}, {9, 9, 9}, 0, 2, 1}}, {0, 1}), "");
    EXPECT_NE(broken({{{-1, -1, -1}, {5, 9, 9}, 0, 2, 1}}, {0, 1}), "");
}

TEST(Protocol, PairsAreAmongTheTriangles)
{
    std::vector<Pair> pairs = {{3, 1}, {0, 2}};
    put_in_order(pairs, 4);
    EXPECT_EQ(pairs, (std::vector<Pair>{{1, 3}, {0, 2}}));
    for (Pair wrong : {Pair{4, 1}, Pair{1, 4}, Pair{2, 2}})
        EXPECT_NE(refusal_of([&] { put_in_order({&wrong, 1}, 4); }), "");
}

TEST(Protocol, TheLastWordsAreTheLastLine)
{
    EXPECT_EQ(last_words("first\nCUDA error 700\n \n"), "CUDA error 700");
    EXPECT_EQ(last_words(" \n"), "");
    EXPECT_LT(last_words(std::string(10000, 'x')).size(), 300u);
}

/// A minute of tests/fuzz/fuzz.sh does this thoroughly.
TEST(Protocol, ChangedBytesAreReadOrRefused)
{
    const std::string hello =
        R"({"ok":true,"protocol":1,"library":"a","version":"1","licence":"MIT","device":"host",)"
        R"("methods":[{"name":"m","summary":"s","build":true,"tree":true}]})";
    const std::string timed = stages({stage("build", 1, 2, true)}).dump();
    std::minstd_rand random(1);
    int read = 0, refused = 0;
    for (int k = 0; k < 20000; ++k) {
        std::string text = k % 2 == 0 ? hello : timed;
        for (int change = 0; change < 1 + k % 3; ++change)
            text[random() % text.size()] = static_cast<char>(random());
        const std::string why = refusal_of([&] {
            const Json reply = parsed_reply(text);
            Library library;
            if (k % 2 == 0)
                describe(library, reply);
            else
                stages_of(reply, 10);
        });
        ++(why.empty() ? read : refused);
        std::array<std::uint32_t, 20> words{};
        for (std::uint32_t& word : words)
            word = static_cast<std::uint32_t>(random() % (random() % 2 == 0 ? 4 : ~0u));
        std::array<bvhbench_node, 2> nodes;
        std::memcpy(nodes.data(), words.data(), sizeof nodes);
        broken({nodes.begin(), nodes.end()}, {words[18], words[19]});
    }
    EXPECT_GT(read, 0);
    EXPECT_GT(refused, 10000);
}

}  // namespace
}  // namespace bvhbench::outside
