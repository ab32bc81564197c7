// SPDX-License-Identifier: MIT
#include "harness/choice/experiment.h"

#include "collide/skips.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

Experiment read(std::string_view text, bool quick = false)
{
    return parse_experiment(text, "x.json", quick);
}

/// Returns the sentence that the text is refused with; empty if it is accepted.
std::string refusal(std::string_view text)
{
    return refusal_of<BadUsage>([&] { read(text); });
}

/// Expects that each text (first) is refused with a sentence that contains the second string.
void expect_refusals(const std::vector<std::pair<std::string, std::string>>& wrong)
{
    for (const auto& [text, says] : wrong)
        EXPECT_NE(refusal(text).find(says), std::string::npos) << text << refusal(text);
}

TEST(Experiment, MayHaveBuildersAndPipelinesOverTheSameScenes)
{
    const std::string_view text = R"({
        "experiment": "mine", "scenes": ["soup:9", "soup:10"], "builders": ["perfect", "karras"],
        "pipelines": [{"builder": "perfect", "collider": "leaf"}], "samples": 7,
        "warm_up": 1, "quick": {"samples": 2, "scenes": ["soup:1"], "builders": ["perfect"]}})";
    const Experiment whole = read(text);
    EXPECT_EQ(whole.scenes, (std::vector<std::string>{"soup:9", "soup:10"}));
    EXPECT_EQ(whole.builders.size(), 2u);
    ASSERT_EQ(whole.collisions.size(), 2u);
    EXPECT_EQ(whole.collisions[1].scene, "soup:10");
    EXPECT_EQ(whole.samples, 7);
    EXPECT_EQ(whole.collisions[0].samples, 7);
    const Experiment quick = read(text, true);
    EXPECT_EQ(quick.builders.size(), 1u);
    EXPECT_EQ(quick.scenes, (std::vector<std::string>{"soup:1"}));
    ASSERT_EQ(quick.collisions.size(), 1u);
    EXPECT_EQ(quick.collisions[0].scene, "soup:1");
    EXPECT_EQ(quick.collisions[0].samples, 2);
    EXPECT_EQ(quick.collisions[0].warm_up, 1);
    EXPECT_NE(refusal(R"({"experiment": "mine", "builders": ["perfect"],
        "scenes": [{"scene": "soup:9", "frames": "0:"}],
        "pipelines": [{"builder": "perfect", "collider": "leaf"}]})"),
              "")
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
        "samples": 7, "warm_up": 1})";
    const std::vector<CollideTask> tasks = read(text).collisions;
    ASSERT_EQ(tasks.size(), 2u);
    EXPECT_FALSE(tasks[0].swept || tasks[1].swept);
    EXPECT_EQ(tasks[0].scene, "bunny");
    EXPECT_EQ(tasks[0].frames, (FrameRange{0, 1}));
    EXPECT_EQ(tasks[0].samples, 7);
    EXPECT_EQ(tasks[0].warm_up, 1);
    EXPECT_TRUE(tasks[0].may_stand_in);
    EXPECT_EQ(tasks[0].pipelines[0].builder.name, "none");
    EXPECT_EQ(tasks[0].pipelines[0].collider,
              (ColliderChoice{{.rules_off = skip_near}, "brute", "exact"}));
    EXPECT_EQ(tasks[0].pipelines[1].builder, (BuilderChoice{{.sorted_leaves = true}, "perfect"}));
    EXPECT_EQ(tasks[0].pipelines[1].collider, (ColliderChoice{{.among = Among::within_objects,
                                                               .keep_adjacent = false,
                                                               .jump = 2,
                                                               .start_level = 3,
                                                               .group_size = 64},
                                                              "bvtt"}));
    EXPECT_EQ(tasks[1].frames, (FrameRange{2, 5}));
    EXPECT_EQ(tasks[1].between, 3u);
    EXPECT_EQ(tasks[1].objects, ObjectsBy::components);
    EXPECT_EQ(tasks[1].pipelines[1].collider.among, Among::between_objects);
}

TEST(Experiment, OfWholeFramesMayBeOfBoxesSweptFromOneToTheNext)
{
    const auto text = [](const std::string& scene, const std::string& pipeline) {
        return R"({"experiment": "x", "scenes": [{"scene": "n-body", )" + scene +
               R"(}], "pipelines": [{"builder": {"name": "perfect", "order": "kd"}, "collider": "leaf")" +
               pipeline + "}]}";
    };
    const std::string of_edges = R"(, "pairs_of": "within")";
    EXPECT_TRUE(read(text(R"("swept": true)", of_edges)).collisions.at(0).swept);
    EXPECT_FALSE(read(text(R"("swept": false)", "")).collisions.at(0).swept);
    const std::string contacts = of_edges + R"(, "adjacent": "drop", "narrow": "exact")";
    expect_refusals({{text(R"("swept": 1)", of_edges), "'swept' takes true or false"},
                     {text(R"("swept": true)", ""), "order kd lines up one object"},
                     {text(R"("swept": true)", contacts), "'exact' looks at one moment"}});
}

TEST(Experiment, OfWholeFramesPairsEachBuilderWithEachCollider)
{
    const std::string_view text = R"({
        "experiment": "mine", "scenes": ["bunny"],
        "pipelines": [{"collider": ["grid", "brute"]},
                      {"builder": ["perfect", {"name": "karras", "order": "hilbert30"}],
                       "collider": ["leaf", {"name": "bvtt", "jump": 2}, "group"], "adjacent": "drop"}]})";
    const std::vector<CollideTask> tasks = read(text).collisions;
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

TEST(Experiment, OfSkipsHasEachPipelineWithoutEachRuleThatMayShortenIt)
{
    const std::vector<CollideTask> tasks = read(R"({
        "experiment": "mine", "scenes": ["s"], "skips": true,
        "pipelines": [{"builder": "perfect", "collider": ["leaf", "front"], "no_skip": "rigid"}, {"collider": ["grid", "embree"]}]})")
                                               .collisions;
    std::vector<std::string> seen;
    for (const auto& [builder, choice] : tasks.at(0).pipelines)
        seen.push_back(choice.name + " -" + skip_rules_text(choice.rules_off) + " +" +
                       skip_rules_text(choice.rules_forced));
    EXPECT_EQ(
        seen,
        (std::vector<std::string>{
            "leaf -rigid +", "leaf -unchanged, rigid +", "leaf -rigid, near +", "leaf -rigid +near",
            "leaf -rigid, apart +", "leaf -rigid, overlap +", "leaf -rigid, deforming +",
            "leaf -rigid +deforming", "leaf -rigid, margin +", "leaf -rigid +margin",
            "leaf -unchanged, rigid, near, apart, overlap, deforming, margin +", "front -rigid +",
            "front -rigid, empty-queue +", "grid - +", "embree - +", "embree -near +"}));
}

TEST(Experiment, OfWholeFramesIsRefusedForWhatItDoesNotKnow)
{
    const auto of = [](const std::string& pipelines) {
        return R"({"experiment": "x", "scenes": ["s"], "pipelines": [)" + pipelines + "]}";
    };
    expect_refusals({{of(""), "'pipelines' must be a list"},
                     {of(R"({"builder": "perfect"})"), "'collider'"},
                     {of(R"({"collider": []})"), "'collider' must be a list"},
                     {of(R"({"collider": "leap"})"), "no collider is called 'leap'"},
                     {of(R"({"collider": "leaf", "narrow": "guess"})"), "narrow"},
                     {of(R"({"collider": "leaf", "no_skip": "far"})"), "no rule is called 'far'"},
                     {of(R"({"collider": "leaf", "speed": 3})"), "'speed' is no key"}});
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
    const Experiment experiment = read(text);
    EXPECT_EQ(experiment.scenes, (std::vector<std::string>{"bunny", "soup:5:x", "soup:9:x"}));
    EXPECT_EQ(experiment.builders[1], (BuilderChoice{{.order = "morton63",
                                                      .grid = GridOver::scene,
                                                      .group_size = 128,
                                                      .items = 2,
                                                      .sorted_leaves = true},
                                                     "oibvh-multi"}));
    EXPECT_EQ(experiment.builders[2],
              (BuilderChoice{{.sorted_leaves = true, .boxes = "u8"}, "perfect"}));
    EXPECT_EQ(experiment.operations, (std::vector{Operation::build, Operation::refit}));
    EXPECT_EQ(experiment.start, Start::from_sorted_leaves);
    EXPECT_EQ(experiment.samples, 7);
    EXPECT_EQ(experiment.warm_up, 0);
    EXPECT_TRUE(experiment.quality);
    EXPECT_EQ(experiment.doubles, Doubles::as_is);
    const Experiment quick = read(text, true);
    EXPECT_EQ(quick.samples, 2);
    EXPECT_EQ(quick.scenes, std::vector<std::string>{"soup:1"});
    EXPECT_EQ(quick.builders.size(), 3u);
}

TEST(Experiment, SaysWhenToStopSamplingAndWhetherCachesAreCold)
{
    const auto of = [](const std::string& keys) {
        return read(R"({"experiment": "a", "scenes": ["soup:1"], "builders": ["perfect"],
                        "pipelines": [{"builder": "perfect", "collider": "leaf"}])" +
                    keys + "}");
    };
    EXPECT_EQ(of("").sampling, SamplingRules());
    const Experiment experiment = of(
        R"(, "until": 0.02, "min_samples": 20, "max_samples": 300, "time_budget_s": 2.5,
              "race": "query", "caches": "cold")");
    EXPECT_EQ(experiment.sampling, (SamplingRules{.until = 0.02,
                                                  .min_samples = 20,
                                                  .max_samples = 300,
                                                  .time_budget_s = 2.5,
                                                  .race = Race::query,
                                                  .caches = {Caches::cold}}));
    EXPECT_EQ(experiment.collisions.at(0).sampling, experiment.sampling);
    EXPECT_EQ(of(R"(, "caches": ["cold", "host"])").sampling.caches,
              (std::vector{Caches::cold, Caches::host}));
}

TEST(Experiment, NamesTheKeyThatItDoesNotKnowAndThoseItDoes)
{
    expect_refusals(
        {{R"({"experiment": "a", "scene": ["soup:1"], "builders": ["perfect"]})",
          "x.json: 'scene' is no key of an experiment; did you mean 'scenes'?"},
         {R"({"experiment": "a", "meshes": ["soup:1"], "builders": ["perfect"]})",
          "x.json: 'meshes' is no key of an experiment; there are: experiment, question, paper, "
          "scenes, builders, operations, pipelines, stages, samples, warm_up, until, min_samples, "
          "max_samples, time_budget_s, race, caches, quality, doubles, skips, quick"},
         {R"({"experiment": "a", "scenes": ["b"], "builders": [{"name": "perfect", "size": 3}]})",
          "x.json: 'size' is no key of a builder; there are: name, order, grid, group_size, items, "
          "boxes, leaves"},
         {R"({"experiment": "a", "scenes": [{"scene": "{t}", "t": {"til": 3}}], "builders": []})",
          "x.json: 'til' is no key of the sizes 't'; there are: from, to, powers_of_two_from, "
          "powers_of_two_to, around_powers_of_two_to"},
         {R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"], "quick": {"stages": []}})",
          "x.json: 'stages' is no key of 'quick'; there are: scenes, builders, samples, warm_up"}});
}

TEST(Experiment, RefusesWhatMakesNoSense)
{
    std::vector<std::string> texts = {"", "{", "[]", "null", "\"table1\"", "{}"};
    const Json right =
        Json::parse(R"({"experiment": "a", "scenes": ["b"], "builders": ["perfect"]})");
    EXPECT_EQ(refusal(right.dump()), "") << "these would all be refused";
    const Json wrong = Json::parse(R"([
        {"experiment": "../a"}, {"experiment": ""}, {"experiment": 1}, {"scenes": []}, {"scenes": "bunny"},
        {"scenes": [{"scene": "s:{t}"}]}, {"scenes": [{"scene": "s", "t": [1]}]},
        {"scenes": [{"scene": "s:{t}", "t": [0]}]}, {"builders": []}, {"builders": ["no-such"]}, {"builders": [7]},
        {"builders": [{"name": "perfect", "leaves": "both"}]}, {"builders": [{"name": "perfect", "order": "zigzag"}]},
        {"builders": [{"name": "perfect", "grid": "none"}]}, {"builders": [{"name": "perfect", "boxes": "u7"}]},
        {"builders": [{"name": "perfect", "boxes": "u8", "leaves": "mesh"}]},
        {"builders": [{"name": "oibvh-wide4", "boxes": "u8"}]}, {"samples": 0}, {"samples": "9"}, {"samples": 1.5},
        {"warm_up": -1}, {"stages": []}, {"stages": ["x"]}, {"operations": []}, {"operations": "refit"},
        {"operations": ["build", "build"]}, {"operations": ["build", "paint"]}, {"doubles": "exact"}, {"until": -1},
        {"until": "2%"}, {"caches": "warm"}, {"caches": []}, {"caches": ["hot", 1]}, {"caches": ["hot", "hot"]},
        {"caches": "host", "race": "whole"}, {"caches": ["hot", "cold"], "race": "whole"}, {"min_samples": 20},
        {"until": 0.1, "min_samples": 20, "max_samples": 10}, {"time_budget_s": 3}, {"race": "fastest"}])");
    for (const Json& keys : wrong) {
        Json text = right;
        text.update(keys);
        texts.push_back(text.dump());
    }
    for (const std::string& text : texts)
        EXPECT_TRUE(refusal(text).starts_with("x.json: ")) << text;
}

TEST(Experiment, HasScenesOnSeveralRanks)
{
    const auto of = [](const std::string& entries) {
        return R"({"experiment": "a", "clusters": [)" + entries + "]}";
    };
    const Experiment experiment = read(of(
        R"({"scene": "torus:9", "ranks": 2, "order": "hilbert30", "narrow": "exact",
            "adjacent": "drop", "frames": "0:6", "samples": 3, "share_devices": true},
           {"scene": "torus:9", "simulate": 8, "partition": "curve", "boxes": 16})"));
    const ClusterTask& first = experiment.clusters.at(0);
    EXPECT_EQ(first.pipeline.builder.order, "hilbert30");
    EXPECT_EQ(first.pipeline.collider.narrow, "exact");
    EXPECT_TRUE(first.share_devices && !first.pipeline.collider.keep_adjacent);
    EXPECT_EQ(first.frames, (FrameRange{0, 6}));
    EXPECT_EQ(first.words,
              (std::vector<std::string>{"cluster", "torus:9", "--ranks", "2", "--order",
                                        "hilbert30", "--narrow", "exact", "--adjacent", "drop",
                                        "--frames", "0:6", "--share-devices", "--builder",
                                        "oibvh-multi", "--collider", "leaf"}));
    const ClusterTask& second = experiment.clusters.at(1);
    EXPECT_EQ((std::vector{first.ranks, first.simulates, second.ranks, second.simulates}),
              (std::vector{2u, 0u, 0u, 8u}));
    EXPECT_EQ(second.partition, PartitionBy::curve);
    EXPECT_EQ((std::vector{first.boxes, second.boxes}), (std::vector{usual_top_boxes, 16u}));
    EXPECT_EQ(experiment.clusters.at(0).samples, 3);
    const auto with = [&](const std::string& keys) {
        return of(R"({"scene": "torus:9", "ranks": 2, )" + keys + "}");
    };
    expect_refusals(
        {{of(R"({"scene": "torus:9"})"),
          "x.json: an entry of 'clusters' must have the key 'ranks'"},
         {of(R"({"ranks": 2})"), "an entry of 'clusters' must have the key 'scene'"},
         {of(R"({"scene": "no-such", "ranks": 2})"), "no scene is called 'no-such'"},
         {of(R"({"scene": "torus:9", "ranks": 5000})"), "ranks must be a whole number from 1 to"},
         {with(R"("simulate": 2)"), "'simulate' runs no 'ranks'"},
         {with(R"("boxes": 63)"), "the number of boxes is a power of two, not 63"},
         {with(R"("partition": "x")"), "no partition is called 'x'"},
         {with(R"("leaves": "mesh")"), "'leaves' is no key of an entry of 'clusters'"},
         {R"({"experiment": "a", "clusters": [], "quick": {}})",
          "'quick' is no key of an experiment with 'clusters'"}});
}

TEST(Experiment, HasScenesOfAllSizesThatItSaysInOrder)
{
    const auto sizes = [](const std::string& said) {
        return read(R"({"experiment": "a", "builders": ["perfect"],
                        "scenes": [{"scene": "{t}", "t": )" +
                    said + "}]}")
            .scenes;
    };
    EXPECT_EQ(sizes(R"({"from": 1, "to": 5, "around_powers_of_two_to": 16})"),
              (std::vector<std::string>{"1", "2", "3", "4", "5", "7", "8", "9", "15", "16", "17"}));
    EXPECT_EQ(sizes(R"({"powers_of_two_from": 1000, "powers_of_two_to": 4096})"),
              (std::vector<std::string>{"1024", "2048", "4096"}));
}

}  // namespace
}  // namespace bvhbench
