// SPDX-License-Identifier: MIT
#include "harness/options.h"

#include <gtest/gtest.h>

#include "geometry/error.h"
#include "harness/catalog.h"

namespace bvhbench {
namespace {

Options parsed(std::vector<const char*> words)
{
    words.insert(words.begin(), "bvhbench");
    return parse_options(static_cast<int>(words.size()), words.data());
}

std::string refusal(const std::vector<const char*>& words)
{
    try {
        parsed(words);
        return {};
    } catch (const BadUsage& error) {
        return error.what();
    }
}

TEST(Options, OfBuildAreAllUnderstood)
{
    const Options options =
        parsed({"build", "--builder", "perfect", "--scene", "soup:5", "--order", "morton63",
                "--group-size", "64", "--leaves", "sorted", "--samples", "3", "--json", "a.json",
                "--dump", "b.json", "--device", "some words"});
    const auto& build = std::get<BuildCommand>(options.command);
    EXPECT_EQ(
        build.builder,
        (BuilderChoice{
            .name = "perfect", .order = "morton63", .group_size = 64, .sorted_leaves = true}));
    EXPECT_EQ(build.scene, "soup:5");
    EXPECT_EQ(build.samples, 3);
    EXPECT_EQ(build.json, "a.json");
    EXPECT_EQ(build.dump, "b.json");
    EXPECT_EQ(options.common.device, "some words");
    EXPECT_EQ(options.words.size(), 20u);
}

TEST(Options, OfCostsAreThoseOfAilaUnlessGiven)
{
    const auto costs = [](std::vector<const char*> words) {
        return std::get<RunCommand>(parsed(std::move(words)).command).costs;
    };
    EXPECT_EQ(costs({"run", "quality"}), (NodeCosts{1.2, 1.0}));
    EXPECT_EQ(costs({"run", "quality", "--sah-inner", "2.5"}), (NodeCosts{2.5, 1.0}));
    EXPECT_EQ(costs({"run", "quality", "--sah-inner", "0", "--sah-triangle", "1e3"}),
              (NodeCosts{0, 1000}));
    EXPECT_EQ(
        std::get<ReproduceCommand>(parsed({"reproduce", "table4", "--sah-triangle", "3"}).command)
            .costs,
        (NodeCosts{1.2, 3}));
    for (const char* value : {"-1", "nan", "inf", "-inf", "1e7", "many", "1.2x", "0x10", ""}) {
        const std::string sentence =
            refusal({"run", "quality", (std::string("--sah-inner=") + value).c_str()});
        EXPECT_NE(sentence.find("--sah-inner: "), std::string::npos) << value << ": " << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
}

TEST(Options, OfQualityAreTwoNamesOfOneFlag)
{
    EXPECT_FALSE(std::get<RunCommand>(parsed({"run", "smoke"}).command).quality);
    EXPECT_TRUE(std::get<RunCommand>(parsed({"run", "smoke", "--epo"}).command).quality);
    EXPECT_TRUE(
        std::get<ReproduceCommand>(parsed({"reproduce", "fig13", "--quality"}).command).quality);
}

TEST(Options, OfCollideAreAllUnderstood)
{
    const Options options =
        parsed({"collide", "--builder", "karras",    "--collider",    "leaf",   "--scene",
                "soup:5",  "--order",   "hilbert30", "--leaves",      "sorted", "--adjacent",
                "drop",    "--jump",    "3",         "--start-level", "4",      "--group-size",
                "64",      "--samples", "3",         "--json",        "a.json", "--pairs",
                "p.bin",   "--grid",    "scene"});
    const auto& collide = std::get<CollideCommand>(options.command);
    EXPECT_EQ(collide.builder, (BuilderChoice{.name = "karras",
                                              .order = "hilbert30",
                                              .grid = GridOver::scene,
                                              .sorted_leaves = true}));
    EXPECT_EQ(collide.collider, (ColliderChoice{.name = "leaf",
                                                .keep_adjacent = false,
                                                .jump = 3,
                                                .start_level = 4,
                                                .group_size = 64}));
    EXPECT_EQ(collide.scenes, std::vector<std::string>{"soup:5"});
    EXPECT_EQ(collide.samples, 3);
    EXPECT_EQ(collide.json, "a.json");
    EXPECT_EQ(collide.pairs, "p.bin");
}

TEST(Options, OfSweptBoxesDropPairsThatShareAVertex)
{
    const auto swept = [](std::vector<const char*> more) {
        more.insert(more.begin(), {"collide", "--collider", "leaf", "--scene", "s", "--swept"});
        return more;
    };
    const auto collide = std::get<CollideCommand>(parsed(swept({})).command);
    EXPECT_TRUE(collide.swept);
    EXPECT_FALSE(collide.collider.keep_adjacent);
    parsed(swept({"--adjacent", "drop"}));
    EXPECT_NE(refusal(swept({"--adjacent", "keep"})).find("--swept leaves out pairs that share a vertex"),
              std::string::npos);
}

TEST(Options, OfAccuracyAreAllUnderstood)
{
    const auto accuracy = [](std::vector<const char*> words) {
        words.insert(words.begin(), "accuracy");
        return std::get<AccuracyCommand>(parsed(words).command);
    };
    EXPECT_EQ(accuracy({}).pairs, 1'000'000u);
    EXPECT_EQ(accuracy({}).axis, "");
    const AccuracyCommand all =
        accuracy({"--axis", "sums", "--scene", "a", "b", "--pairs", "10000000", "--seed", "3",
                  "--filter", "x", "--samples", "9", "--out", "o"});
    EXPECT_EQ(all.axis, "sums");
    EXPECT_EQ(all.scenes, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(all.pairs, 10'000'000u);
    EXPECT_EQ(all.seed, 3u);
    EXPECT_EQ(all.filter, "x");
    EXPECT_EQ(all.samples, 9);
    EXPECT_EQ(all.out, "o");
}

TEST(Options, OfStressAreAllUnderstood)
{
    const auto stress = std::get<StressCommand>(
        parsed({"stress", "--quick", "--seed", "7", "--filter", "^scale/", "--out", "s.json"})
            .command);
    EXPECT_TRUE(stress.quick);
    EXPECT_EQ(stress.seed, 7u);
    EXPECT_EQ(stress.filter, "^scale/");
    EXPECT_EQ(stress.out, "s.json");
    EXPECT_EQ(std::get<StressCommand>(parsed({"stress"}).command).seed, 1u);
}

TEST(Options, InCommonMayStandBeforeOrBehindTheCommand)
{
    EXPECT_EQ(parsed({"--data", "d", "show", "f"}).common.data, "d");
    EXPECT_EQ(parsed({"show", "f", "--data", "d"}).common.data, "d");
}

TEST(Options, ThatAskForHelpOnlyPrint)
{
    for (const char* command :
         {"list", "build", "collide", "run", "reproduce", "check", "show", "stress"}) {
        const auto text = std::get<PrintCommand>(parsed({command, "--help"}).command).text;
        EXPECT_NE(text.find("Usage: bvhbench " + std::string(command)), std::string::npos) << text;
    }
    EXPECT_TRUE(std::get<PrintCommand>(parsed({"--version"}).command).text.starts_with("bvhbench"));
}

TEST(Options, ThatAreNotUnderstoodAreAnsweredInOneSentence)
{
    for (const std::vector<const char*>& words : std::vector<std::vector<const char*>>{
             {},
             {"paint"},
             {"list"},
             {"list", "colours"},
             {"stress", "--seed", "x"},
             {"stress", "scale"},
             {"build"},
             {"build", "--builder", "perfect"},
             {"build", "--builder", "perfect", "--scene", "s", "--samples", "0"},
             {"build", "--builder", "perfect", "--scene", "s", "--samples", "many"},
             {"build", "--builder", "perfect", "--scene", "s", "--leaves", "green"},
             {"build", "--builder", "perfect", "--scene", "s", "--group-size", "48"},
             {"build", "--builder", "perfect", "--scene", "s", "--group-size", "-1"},
             {"collide", "--builder", "perfect", "--scene", "s"},
             {"collide", "--builder", "b", "--collider", "c", "--scene", "s", "--adjacent", "some"},
             {"run"},
             {"run", "table1", "--fast"},
             {"run", "table4", "--sah-inner", "-1"},
             {"run", "table4", "--sah-inner", "0", "--sah-triangle", "0"},
             {"reproduce", "table9"},
             {"show"},
             {"show", "a", "b"},
         }) {
        const std::string sentence = refusal(words);
        EXPECT_FALSE(sentence.empty()) << (words.empty() ? "" : words[0]);
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
    EXPECT_NE(
        refusal({"list", "colours"})
            .find("there is no 'colours'; there are: builders, colliders, narrow, orders, formats, skips, "
                  "tuning, scenes, devices, accuracy"),
        std::string::npos);
}

TEST(Catalog, ListsEachBuilderOnceUnderTheNameOnItsCard)
{
    std::string names;
    for (const BuilderEntry& entry : builder_catalog()) {
        names += std::string(entry.name) + ' ';
        EXPECT_EQ(&find_builder(entry.name), &entry);
        EXPECT_FALSE(entry.summary.empty());
        EXPECT_EQ(entry.make == nullptr, !entry.absent.empty());
    }
    EXPECT_TRUE(names.starts_with(
        "perfect karras apetrei apetrei-fused lbvh-levels oibvh-single "
        "oibvh-multi oibvh-wide4 oibvh-wide8 oibvh-wide8-q8 oibvh-host oibvh-reference "
        "radix-reference "))
        << names;
}

TEST(Catalog, ListsEachColliderOnceAndAnswersAnUnknownNameWithThoseThereAre)
{
    for (const ColliderEntry& entry : collider_catalog()) {
        EXPECT_EQ(&find_collider(entry.name), &entry);
        EXPECT_FALSE(entry.summary.empty());
        EXPECT_EQ(entry.make == nullptr, !entry.absent.empty());
    }
    EXPECT_THROW(find_collider("leafs"), BadUsage);
}

TEST(Catalog, AnswersAnUnknownNameWithThoseThereAre)
{
    try {
        find_builder("oibvh");
        FAIL();
    } catch (const BadUsage& error) {
        EXPECT_TRUE(std::string(error.what())
                        .starts_with("no builder is called 'oibvh'; there are: perfect, karras, "
                                     "apetrei, apetrei-fused, lbvh-levels, oibvh-single, "
                                     "oibvh-multi"))
            << error.what();
    }
}

}  // namespace
}  // namespace bvhbench
