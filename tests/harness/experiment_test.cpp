// SPDX-License-Identifier: MIT
#include "harness/choice/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "collide/skips.h"
#include "geometry/error.h"
#include "harness/choice/scene_range.h"

namespace bvhbench {
namespace {

/// The sentence that the text is refused with; empty if it is not.
std::string refusal(std::string_view text)
{
    try {
        parse_experiment(text, "x.json", false);
        return {};
    } catch (const BadUsage& error) {
        return error.what();
    }
}

TEST(Experiment, OfEveryNameInThisProgramIsValid)
{
    for (const std::string_view name : experiment_names())
        for (const bool quick : {false, true}) {
            const Experiment experiment = find_experiment(std::string(name), quick);
            EXPECT_EQ(experiment.name, name);
            EXPECT_FALSE(experiment.question.empty());
            EXPECT_EQ(experiment.scenes.empty(), experiment.builders.empty());
            EXPECT_FALSE(experiment.builders.empty() && experiment.collisions.empty());
            for (const CollideTask& task : experiment.collisions) {
                EXPECT_EQ(task.experiment, name);
                EXPECT_FALSE(task.pipelines.empty());
            }
        }
}

TEST(Experiment, MayHaveBuildersAndPipelinesOverTheSameScenes)
{
    const std::string_view text = R"({
        "experiment": "mine", "scenes": ["soup:9", "soup:10"], "builders": ["perfect", "karras"],
        "pipelines": [{"builder": "perfect", "collider": "leaf"}], "samples": 7,
        "quick": {"samples": 2, "scenes": ["soup:1"], "builders": ["perfect"]}})";
    const Experiment whole = parse_experiment(text, "x.json", false);
    EXPECT_EQ(whole.scenes, (std::vector<std::string>{"soup:9", "soup:10"}));
    EXPECT_EQ(whole.builders.size(), 2u);
    ASSERT_EQ(whole.collisions.size(), 2u);
    EXPECT_EQ(whole.collisions[1].scene, "soup:10");
    EXPECT_EQ(whole.samples, 7);
    EXPECT_EQ(whole.collisions[0].samples, 7);
    const Experiment quick = parse_experiment(text, "x.json", true);
    EXPECT_EQ(quick.builders.size(), 1u);
    EXPECT_EQ(quick.scenes, (std::vector<std::string>{"soup:1"}));
    ASSERT_EQ(quick.collisions.size(), 1u);
    EXPECT_EQ(quick.collisions[0].samples, 2);
    EXPECT_THROW(parse_experiment(R"({"experiment": "mine", "builders": ["perfect"],
        "scenes": [{"scene": "soup:9", "frames": "0:"}],
        "pipelines": [{"builder": "perfect", "collider": "leaf"}]})",
                                  "x.json", false),
                 BadUsage)
        << "scenes of both are texts";
}

TEST(Experiment, OfWholeFramesReadsEveryKey)
{
    const std::string_view text = R"({
        "experiment": "mine", "scenes": ["bunny", {"scene": "torus:9", "frames": "2:5", "between": 3,
                                                   "objects": "components", "pairs_of": "between"}],
        "pipelines": [{"collider": "brute", "narrow": "exact", "no_skip": "near"},
                      {"builder": {"name": "perfect", "leaves": "sorted"}, "adjacent": "drop", "pairs_of": "within",
                       "collider": {"name": "bvtt", "jump": 2, "start_level": 3, "group_size": 64}}],
        "samples": 7, "warm_up": 1, "quick": {"samples": 2, "scenes": ["torus:5"]}})";
    const std::vector<CollideTask> tasks = parse_experiment(text, "x.json", false).collisions;
    ASSERT_EQ(tasks.size(), 2u);
    EXPECT_FALSE(tasks[0].swept || tasks[1].swept);
    EXPECT_EQ(tasks[0].scene, "bunny");
    EXPECT_EQ(tasks[0].frames, (FrameRange{0, 1}));
    EXPECT_EQ(tasks[0].samples, 7);
    EXPECT_EQ(tasks[0].warm_up, 1);
    EXPECT_TRUE(tasks[0].may_stand_in);
    EXPECT_EQ(tasks[0].pipelines[0].builder.name, "none");
    EXPECT_EQ(tasks[0].pipelines[0].collider,
              (ColliderChoice{.name = "brute", .narrow = "exact", .rules_off = skip_near}));
    EXPECT_EQ(tasks[0].pipelines[1].builder,
              (BuilderChoice{.name = "perfect", .sorted_leaves = true}));
    EXPECT_EQ(tasks[0].pipelines[1].collider, (ColliderChoice{.name = "bvtt",
                                                              .among = Among::within_objects,
                                                              .keep_adjacent = false,
                                                              .jump = 2,
                                                              .start_level = 3,
                                                              .group_size = 64}));
    EXPECT_EQ(tasks[1].frames, (FrameRange{2, 5}));
    EXPECT_EQ(tasks[1].between, 3u);
    EXPECT_EQ(tasks[1].objects, ObjectsBy::components);
    EXPECT_EQ(tasks[1].pipelines[1].collider.among, Among::between_objects);

    const std::vector<CollideTask> quick = parse_experiment(text, "x.json", true).collisions;
    ASSERT_EQ(quick.size(), 1u);
    EXPECT_EQ(quick[0].scene, "torus:5");
    EXPECT_EQ(quick[0].samples, 2);
    EXPECT_EQ(quick[0].warm_up, 1);
}

TEST(Experiment, OfWholeFramesMayBeOfBoxesSweptFromOneToTheNext)
{
    const auto text = [](const std::string& scene, const std::string& pipeline) {
        return R"({"experiment": "x", "scenes": [{"scene": "n-body", )" + scene +
               R"(}], "pipelines": [{"builder": {"name": "perfect", "order": "kd"}, "collider": "leaf")" +
               pipeline + "}]}";
    };
    const std::string of_edges = R"(, "pairs_of": "within")";
    const auto tasks =
        parse_experiment(text(R"("swept": true)", of_edges), "x.json", false).collisions;
    EXPECT_TRUE(tasks.at(0).swept);
    EXPECT_FALSE(
        parse_experiment(text(R"("swept": false)", ""), "x.json", false).collisions.at(0).swept);
    EXPECT_NE(refusal(text(R"("swept": 1)", of_edges)).find("'swept' takes true or false"),
              std::string::npos);
    EXPECT_NE(refusal(text(R"("swept": true)", "")).find("order kd lines up one object"),
              std::string::npos);
    EXPECT_NE(
        refusal(text(R"("swept": true)", of_edges + R"(, "adjacent": "drop", "narrow": "exact")"))
            .find("'exact' looks at one moment"),
        std::string::npos);
}

TEST(Experiment, OfWholeFramesPairsEachBuilderWithEachCollider)
{
    const std::string_view text = R"({
        "experiment": "mine", "scenes": ["bunny"],
        "pipelines": [{"collider": ["grid", "brute"]},
                      {"builder": ["perfect", {"name": "karras", "order": "hilbert30"}],
                       "collider": ["leaf", {"name": "bvtt", "jump": 2}, "group"], "adjacent": "drop"}]})";
    const std::vector<CollideTask> tasks = parse_experiment(text, "x.json", false).collisions;
    ASSERT_EQ(tasks.size(), 1u);
    std::vector<std::string> seen;
    for (const PipelineChoice& choice : tasks[0].pipelines) {
        seen.push_back(choice.builder.name + ' ' + choice.collider.name);
        EXPECT_EQ(choice.collider.keep_adjacent, choice.builder.name == "none");
    }
    EXPECT_EQ(seen, (std::vector<std::string>{"none grid", "none brute", "perfect leaf",
                                              "perfect bvtt", "perfect group", "karras leaf",
                                              "karras bvtt", "karras group"}));
}

TEST(Experiment, OfWholeFramesIsRefusedForWhatItDoesNotKnow)
{
    const auto of = [](const std::string& rest) {
        return refusal(R"({"experiment": "x", "scenes": ["s"], )" + rest + "}");
    };
    EXPECT_NE(of(R"("pipelines": [])").find("'pipelines' must be a list"), std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"builder": "perfect"}])").find("'collider'"), std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"collider": []}])").find("'collider' must be a list"),
              std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"collider": "leap"}])").find("no collider is called 'leap'"),
              std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"collider": "leaf", "narrow": "guess"}])").find("narrow"),
              std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"collider": "leaf", "no_skip": "far"}])")
                  .find("no rule is called 'far'"),
              std::string::npos);
    EXPECT_NE(of(R"("pipelines": [{"collider": "leaf", "speed": 3}])").find("'speed' is no key"),
              std::string::npos);
}

TEST(FrameRanges, AreOneFrameOrFromOneToBeforeAnother)
{
    EXPECT_EQ(frame_range("3"), (FrameRange{3, 4}));
    EXPECT_EQ(frame_range("3:9"), (FrameRange{3, 9}));
    EXPECT_EQ(frame_range("3:"), (FrameRange{3, 0}));
    for (const char* text : {"", ":", "a", "3:3", "4:3", "-1", "1:2:3"})
        EXPECT_THROW(frame_range(text), BadUsage) << text;
}

TEST(Experiment, ReadsEveryKey)
{
    const std::string_view text = R"({
        "experiment": "mine", "question": "q", "paper": "Fig. 8",
        "scenes": ["bunny", {"scene": "soup:{t}:x", "t": [9, 5]}],
        "builders": ["perfect", {"name": "oibvh-multi", "order": "morton63", "group_size": 128, "items": 2,
                                  "leaves": "sorted", "grid": "scene"}, {"name": "perfect", "boxes": "u8"}],
         "doubles": "as-is",
        "operations": ["refit", "build"], "stages": ["hierarchy"], "samples": 7, "warm_up": 0, "quality": true,
        "quick": {"samples": 2, "scenes": ["soup:1"]}})";
    const Experiment experiment = parse_experiment(text, "x.json", false);
    EXPECT_EQ(experiment.scenes, (std::vector<std::string>{"bunny", "soup:5:x", "soup:9:x"}));
    EXPECT_EQ(experiment.builders[1], (BuilderChoice{.name = "oibvh-multi",
                                                     .order = "morton63",
                                                     .grid = GridOver::scene,
                                                     .group_size = 128,
                                                     .items = 2,
                                                     .sorted_leaves = true}));
    EXPECT_EQ(experiment.builders[2],
              (BuilderChoice{.name = "perfect", .sorted_leaves = true, .boxes = "u8"}));
    EXPECT_EQ(experiment.operations, (std::vector{Operation::build, Operation::refit}));
    EXPECT_EQ(experiment.start, Start::from_sorted_leaves);
    EXPECT_EQ(experiment.samples, 7);
    EXPECT_EQ(experiment.warm_up, 0);
    EXPECT_TRUE(experiment.quality);
    EXPECT_EQ(experiment.doubles, Doubles::as_is);
    EXPECT_THROW(
        parse_experiment(R"({"experiment": "e", "scenes": ["soup:1"], "builders": ["perfect"],
                                      "doubles": "exact"})",
                         "x.json", false),
        BadUsage);
    EXPECT_THROW(parse_experiment(R"({"experiment": "e", "scenes": ["soup:1"],
                                      "builders": [{"name": "perfect", "grid": "none"}]})",
                                  "x.json", false),
                 BadUsage);

    const Experiment quick = parse_experiment(text, "x.json", true);
    EXPECT_EQ(quick.samples, 2);
    EXPECT_EQ(quick.scenes, std::vector<std::string>{"soup:1"});
    EXPECT_EQ(quick.builders.size(), 3u);
}

TEST(Experiment, SaysWhenToStopSamplingAndWhetherCachesAreCold)
{
    const auto of = [](const std::string& keys) {
        return parse_experiment(
            R"({"experiment": "a", "scenes": ["soup:1"], "builders": ["perfect"],
                                    "pipelines": [{"builder": "perfect", "collider": "leaf"}])" +
                keys + "}",
            "x.json", false);
    };
    EXPECT_EQ(of("").sampling, SamplingRules());
    const Experiment experiment = of(
        R"(, "until": 0.02, "min_samples": 20, "max_samples": 300, "time_budget_s": 2.5, "caches": "cold")");
    EXPECT_EQ(experiment.sampling, (SamplingRules{.until = 0.02,
                                                  .min_samples = 20,
                                                  .max_samples = 300,
                                                  .time_budget_s = 2.5,
                                                  .cold = true}));
    EXPECT_EQ(experiment.collisions.at(0).sampling, experiment.sampling);
    for (const char* keys :
         {R"(, "until": -1)", R"(, "until": "2%")", R"(, "caches": "warm")",
          R"(, "min_samples": 20)", R"(, "until": 0.1, "min_samples": 20, "max_samples": 10)",
          R"(, "time_budget_s": 3)"})
        EXPECT_THROW(of(keys), BadUsage) << keys;
}

TEST(Experiment, SmokeHasEveryBuilderAndEveryCollider)
{
    const Experiment smoke = find_experiment("smoke", false);
    for (const BuilderEntry& entry : builder_catalog())
        EXPECT_TRUE(std::any_of(smoke.builders.begin(), smoke.builders.end(),
                                [&](const BuilderChoice& one) { return one.name == entry.name; }))
            << entry.name;
    for (const ColliderEntry& entry : collider_catalog())
        for (const CollideTask& task : smoke.collisions)
            EXPECT_TRUE(std::any_of(
                task.pipelines.begin(), task.pipelines.end(),
                [&](const PipelineChoice& one) { return one.collider.name == entry.name; }))
                << entry.name << " on " << task.scene;
    EXPECT_EQ(smoke.collisions.size(), smoke.scenes.size());
}

TEST(Experiment, NamesTheKeyThatItDoesNotKnowAndThoseItDoes)
{
    EXPECT_EQ(
        refusal(R"({"experiment": "a", "scene": ["soup:1"], "builders": ["perfect"]})"),
        "x.json: 'scene' is no key of an experiment; there are: experiment, question, paper, "
        "scenes, builders, operations, pipelines, stages, samples, warm_up, until, min_samples, "
        "max_samples, time_budget_s, caches, quality, doubles, quick");
    EXPECT_EQ(refusal(R"({"experiment": "a", "scenes": ["soup:1"],
                          "builders": [{"name": "perfect", "size": 3}]})"),
              "x.json: 'size' is no key of a builder; there are: name, order, grid, group_size, "
              "items, boxes, "
              "leaves");
    EXPECT_EQ(refusal(R"({"experiment": "a", "scenes": [{"scene": "soup:{t}", "t": {"til": 3}}],
                          "builders": ["perfect"]})"),
              "x.json: 'til' is no key of the sizes 't'; there are: from, to, powers_of_two_from, "
              "powers_of_two_to, around_powers_of_two_to");
    EXPECT_EQ(refusal(R"({"experiment": "a", "scenes": ["soup:1"], "builders": ["perfect"],
                          "quick": {"stages": []}})"),
              "x.json: 'stages' is no key of 'quick'; there are: scenes, builders, samples, "
              "warm_up");
}

TEST(Experiment, RefusesWhatMakesNoSense)
{
    for (
        const char* text : {
            "",
            "{",
            "[]",
            "null",
            "\"table1\"",
            "{}",
            R"({"experiment": "a", "scenes": [], "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": "bunny", "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": ["b"], "builders": []})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["no-such"]})",
            R"({"experiment": "a", "scenes": ["b"], "builders": [7]})",
            R"({"experiment": "../a", "scenes": ["b"], "builders": ["perfect"]})",
            R"({"experiment": "", "scenes": ["b"], "builders": ["perfect"]})",
            R"({"experiment": 1, "scenes": ["b"], "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "samples": 0})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "samples": "9"})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "samples": 1.5})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "warm_up": -1})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "stages": []})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "stages": ["x"]})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "operations": []})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "operations": "refit"})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"],
                 "operations": ["build", "build"]})",
            R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"],
                 "operations": ["build", "paint"]})",
            R"({"experiment": "a", "scenes": [{"scene": "s:{t}"}], "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": [{"scene": "s", "t": [1]}], "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": [{"scene": "s:{t}", "t": [0]}],
                 "builders": ["perfect"]})",
            R"({"experiment": "a", "scenes": ["b"],
                 "builders": [{"name": "perfect", "leaves": "both"}]})",
            R"({"experiment": "a", "scenes": ["b"],
                 "builders": [{"name": "perfect", "order": "zigzag"}]})",
            R"({"experiment": "a", "scenes": ["b"],
                 "builders": [{"name": "perfect", "boxes": "u7"}]})",
            R"({"experiment": "a", "scenes": ["b"],
                 "builders": [{"name": "perfect", "boxes": "u8", "leaves": "mesh"}]})",
            R"({"experiment": "a", "scenes": ["b"],
                 "builders": [{"name": "oibvh-wide4", "boxes": "u8"}]})",
        })
        EXPECT_TRUE(refusal(text).starts_with("x.json: ")) << text;
}

TEST(Experiment, OnlyBuildsUnlessItSaysOtherwise)
{
    for (const std::string_view name : experiment_names())
        EXPECT_EQ(find_experiment(std::string(name), false).has(Operation::refit), name == "refit");
}

TEST(Experiment, OfAnUnknownNameIsAnsweredWithThoseThereAre)
{
    EXPECT_THROW(find_experiment("tabel1", false), BadUsage);
    EXPECT_THROW(find_experiment("/nowhere/mine.json", false), Unavailable);
}

TEST(SizeRange, IsTheUnionOfItsPartsInOrder)
{
    SizeRange range;
    range.from = 1;
    range.to = 5;
    range.around_powers_of_two_to = 16;
    EXPECT_EQ(sizes_in(range), (std::vector<std::int64_t>{1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17}));

    SizeRange powers;
    powers.powers_of_two_from = 1000;
    powers.powers_of_two_to = 4096;
    EXPECT_EQ(sizes_in(powers), (std::vector<std::int64_t>{1024, 2048, 4096}));
}

TEST(SizeRange, GivesEqualityEverySizeWhereALayoutCanGoWrong)
{
    const Experiment experiment = find_experiment("equality", false);
    EXPECT_EQ(experiment.scenes.front(), "soup:1");
    EXPECT_EQ(experiment.scenes[599], "soup:600");
    EXPECT_EQ(experiment.scenes[600], "soup:1023");
    EXPECT_EQ(experiment.scenes.back(), "soup:1048577");
    EXPECT_EQ(experiment.scenes.size(), 600u + 3 * 11);
}

}  // namespace
}  // namespace bvhbench
