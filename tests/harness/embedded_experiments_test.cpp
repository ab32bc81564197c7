// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/error.h"
#include "harness/choice/experiment.h"

namespace bvhbench {
namespace {

TEST(ExperimentsHere, AreValidAndAllThatHasAName)
{
    for (const std::string_view name : experiment_names())
        for (const bool quick : {false, true}) {
            const Experiment experiment = find_experiment(std::string(name), quick);
            EXPECT_EQ(experiment.name, name);
            EXPECT_FALSE(experiment.question.empty());
            EXPECT_EQ(experiment.has(Operation::refit), name == "refit" || name == "rivals")
                << "the others only build";
            EXPECT_EQ(experiment.scenes.empty(), experiment.builders.empty());
            EXPECT_FALSE(experiment.builders.empty() && experiment.collisions.empty());
            for (const CollideTask& task : experiment.collisions) {
                EXPECT_EQ(task.experiment, name);
                EXPECT_FALSE(task.pipelines.empty());
            }
        }
    EXPECT_THROW(find_experiment("tabel1", false), BadUsage);
    EXPECT_THROW(find_experiment("/nowhere/mine.json", false), Unavailable);
}

TEST(ExperimentsHere, SmokeHasEveryBuilderAndEveryCollider)
{
    const Experiment smoke = find_experiment("smoke", false);
    for (const BuilderEntry& entry : builder_catalog())
        EXPECT_GT(std::ranges::count(smoke.builders, entry.name, &BuilderChoice::name), 0)
            << entry.name;
    const auto collider = [](const PipelineChoice& one) { return one.collider.name; };
    for (const ColliderEntry& entry : collider_catalog())
        for (const CollideTask& task : smoke.collisions)
            EXPECT_GT(std::ranges::count(task.pipelines, entry.name, collider), 0)
                << task.scene << entry.name;
    EXPECT_EQ(smoke.collisions.size(), smoke.scenes.size());
}

TEST(ExperimentsHere, BuildersHasEveryBuilderThatIsNoReference)
{
    const Experiment all = find_experiment("builders", false);
    for (const BuilderEntry& entry : builder_catalog())
        EXPECT_EQ(std::ranges::count(all.builders, entry.name, &BuilderChoice::name),
                  entry.name.ends_with("-reference") ? 0 : 1)
            << entry.name;
}

TEST(ExperimentsHere, SkipsHasEachRuleSwitchedOffInEachScene)
{
    const Experiment skips = find_experiment("skips", false);
    for (const CollideTask& task : skips.collisions)
        for (const SkipRuleEntry& entry : skip_rules())
            EXPECT_TRUE(std::ranges::any_of(
                task.pipelines,
                [&](const PipelineChoice& one) { return one.collider.rules_off == entry.rule; }))
                << task.scene << entry.name;
}

TEST(ExperimentsHere, EqualityHasEverySizeWhereALayoutCanGoWrong)
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
