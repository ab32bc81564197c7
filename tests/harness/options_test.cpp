// SPDX-License-Identifier: MIT
#include "harness/options.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>
#include <sstream>

#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/catalog.h"
#include "harness/help.h"

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

TEST(Options, OfReportAreAllUnderstood)
{
    const Options options = parsed({"report", "a.json", "b.json", "--scene", "soup:5", "--scene",
                                    "soup:6", "--frame", "2", "--builder", "karras", "--collider",
                                    "group", "--order", "hilbert30", "-o", "r.html"});
    const auto& report = std::get<ReportCommand>(options.command);
    EXPECT_EQ(report.files, (std::vector<std::string>{"a.json", "b.json"}));
    EXPECT_EQ(report.scenes, (std::vector<std::string>{"soup:5", "soup:6"}));
    EXPECT_EQ(report.frame, 2u);
    EXPECT_EQ(report.builder, (BuilderChoice{.name = "karras", .order = "hilbert30"}));
    EXPECT_EQ(report.collider.name, "group");
    EXPECT_FALSE(report.collider.keep_adjacent);
    EXPECT_EQ(report.collider.narrow, "exact");
    EXPECT_EQ(report.out, "r.html");
    const Options usual = parsed({"report", "a.json"});
    EXPECT_EQ(std::get<ReportCommand>(usual.command).builder.name, "oibvh-multi");
    EXPECT_EQ(std::get<ReportCommand>(usual.command).collider.name, "leaf");
    EXPECT_EQ(std::get<ReportCommand>(usual.command).out, "report.html");
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

TEST(Options, OfSweepAreAllUnderstood)
{
    const Options options =
        parsed({"sweep",  "--scenes",      "a,b",     "s.json",  "--sizes",
                "1:8:x2", "--builders",    "karras",  "--set",   "boxes=f32,u16",
                "--set",  "leaves=sorted", "--out",   "folder",  "--device",
                "0",      "--device",      "big one", "--shard", "1/2"});
    const auto& sweep = std::get<SweepCommand>(options.command);
    EXPECT_EQ(sweep.file, "s.json") << "and no third scene";
    EXPECT_EQ(sweep.scenes, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(sweep.builders, std::vector<std::string>{"karras"});
    EXPECT_EQ(sweep.set, (std::vector<std::string>{"boxes=f32,u16", "leaves=sorted"}));
    EXPECT_EQ(sweep.devices, (std::vector<std::string>{"0", "big one"}));
    EXPECT_EQ(sweep.sizes, "1:8:x2");
    EXPECT_EQ(sweep.shard, "1/2");
    EXPECT_EQ(sweep.together, "cell");
    EXPECT_EQ(sweep.jobs, 0u);
    EXPECT_EQ(
        std::get<SweepCommand>(parsed({"--device", "1", "sweep", "s.json", "--out", "f"}).command)
            .devices.size(),
        0u);
    EXPECT_NE(refusal({"sweep", "s.json", "--out", "f", "--together", "all"})
                  .find("there are: cell, scene"),
              std::string::npos);
    EXPECT_EQ(std::get<MergeCommand>(parsed({"merge", "a", "b", "-o", "c"}).command).files,
              (std::vector<std::string>{"a", "b"}));
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
    EXPECT_NE(
        refusal(swept({"--adjacent", "keep"})).find("--swept leaves out pairs that share a vertex"),
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
    const auto whole = std::get<PrintCommand>(parsed({"--help"}).command).text;
    for (const char* words :
         {"Exit codes:", "4  nothing was measured", "128 + n", "BVHBENCH_DATA", "--time-limit"})
        EXPECT_NE(whole.find(words), std::string::npos) << words;
    for (const CommandHelp& help : command_helps()) {
        const std::string command(help.command);
        EXPECT_NE(whole.find("\n  " + command + ' '), std::string::npos) << command;
        const auto text = std::get<PrintCommand>(parsed({command.c_str(), "--help"}).command).text;
        EXPECT_NE(text.find("Usage: bvhbench " + command), std::string::npos) << text;
        EXPECT_NE(text.find("Examples:"), std::string::npos) << text;
        EXPECT_TRUE(
            std::filesystem::exists(std::filesystem::path(build_info.source_root) / help.see))
            << help.see;
    }
    EXPECT_TRUE(std::get<PrintCommand>(parsed({"--version"}).command).text.starts_with("bvhbench"));
}

TEST(Options, ThatHelpShowsAreUnderstood)
{
    for (const CommandHelp& help : command_helps()) {
        EXPECT_FALSE(help.examples.empty()) << help.command;
        for (const HelpExample& example : help.examples) {
            std::istringstream line{std::string(example.line)};
            std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
            ASSERT_GT(words.size(), 1u) << example.line;
            EXPECT_EQ(words[0], "bvhbench");
            EXPECT_EQ(words[1], help.command);
            std::vector<const char*> rest;
            for (std::size_t k = 1; k < words.size(); ++k)
                rest.push_back(words[k].c_str());
            EXPECT_EQ(refusal(rest), "") << example.line;
        }
    }
}

TEST(Options, OfHelpStayWithinThePage)
{
    for (const CommandHelp& help : command_helps()) {
        std::istringstream lines(
            std::get<PrintCommand>(parsed({std::string(help.command).c_str(), "--help"}).command)
                .text);
        for (std::string line; std::getline(lines, line);)
            EXPECT_TRUE(line.size() <= 100 || line.starts_with("  bvhbench ") ||
                        line.find(' ', 30) == line.npos)
                << line;
    }
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
    EXPECT_NE(refusal({"list", "colours"})
                  .find("there is no 'colours'; there are: builders, colliders, narrow, orders, "
                        "formats, skips, "
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
    EXPECT_TRUE(
        names.starts_with("perfect karras apetrei apetrei-fused lbvh-levels oibvh-single "
                          "oibvh-multi oibvh-wide4 oibvh-wide8 oibvh-host oibvh-reference "
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
