// SPDX-License-Identifier: MIT
#include "harness/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "geometry/error.h"
#include "harness/cell_identity.h"
#include "harness/exact_counters.h"
#include "harness/report_compare.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

/// Samples whose whole time is spread about `median_ns` by about `noise`, the same for the same seed.
Cell timed_cell(const std::string& builder, double median_ns, double noise = 0.02,
                unsigned seed = 1, int samples = 40)
{
    Cell cell = fake_cell(builder);
    cell.counters["sah_cost"] = 80.25;
    cell.samples.clear();
    std::mt19937 random(seed);
    std::normal_distribution<double> spread(0, noise);
    for (int order = 0; order < samples; ++order) {
        const auto ns = static_cast<std::int64_t>(median_ns * std::exp(spread(random)));
        cell.samples.push_back(
            {order, {{"sort", ns / 2, ns / 2, 0, 2, 8}, {"hierarchy", ns / 2, ns / 2, 0, 2, 8}}});
    }
    return cell;
}

Document document_of(std::vector<Cell> cells) { return {fake_run(), std::move(cells)}; }

std::string refusal(const Document& a, const Document& b, const CompareRules& rules = {})
{
    try {
        require_comparable(a, "a.json", b, "b.json", rules);
        return {};
    } catch (const BadUsage& error) {
        return error.what();
    }
}

/// What the only cell came out as.
ComparedCell only_cell(const Document& a, const Document& b, const CompareRules& rules = {})
{
    const Comparison comparison = compare_documents(a, b, rules);
    EXPECT_EQ(comparison.cells.size(), 1u);
    return comparison.cells.at(0);
}

TimeVerdict verdict_of_change(double factor, double threshold, int samples = 40)
{
    const Document a = document_of({timed_cell("karras", 1e6, 0.02, 1, samples)});
    const Document b = document_of({timed_cell("karras", 1e6 * factor, 0.02, 2, samples)});
    return only_cell(a, b, {.threshold = threshold}).time.verdict;
}

TEST(Compare, TellsFasterSlowerAndSameApartAtTheThreshold)
{
    EXPECT_EQ(verdict_of_change(1.00, 0.05), TimeVerdict::same);
    EXPECT_EQ(verdict_of_change(1.02, 0.05), TimeVerdict::same);
    EXPECT_EQ(verdict_of_change(1.10, 0.05), TimeVerdict::slower);
    EXPECT_EQ(verdict_of_change(0.90, 0.05), TimeVerdict::faster);
    EXPECT_EQ(verdict_of_change(1.10, 0.50), TimeVerdict::same);
    EXPECT_EQ(verdict_of_change(1.60, 0.50), TimeVerdict::slower);
}

TEST(Compare, IsUnsureOfFewSamplesHoweverFarTheyAreApart)
{
    EXPECT_EQ(verdict_of_change(3, 0.05, 8), TimeVerdict::unsure);
    EXPECT_EQ(verdict_of_change(3, 0.05, 9), TimeVerdict::slower);
}

TEST(Compare, IsUnsureWhereNoiseIsLargerThanTheThreshold)
{
    const Document a = document_of({timed_cell("karras", 1e6, 0.4, 1)});
    const Document b = document_of({timed_cell("karras", 1.03e6, 0.4, 2)});
    EXPECT_EQ(only_cell(a, b).time.verdict, TimeVerdict::unsure);
}

TEST(Compare, IsStricterWithEachOfManyCells)
{
    std::vector<Cell> cells;
    for (int i = 0; i < 100; ++i) {
        cells.push_back(timed_cell("karras", 1e6, 0.02, i));
        cells.back().scene.frame = i;
    }
    const Document a = document_of(cells);
    EXPECT_DOUBLE_EQ(compare_documents(a, a, {}).error_of_each, 0.0005);
    // Nine samples are enough for one cell, but no nine can be that sure.
    for (Cell& cell : cells)
        cell.samples.resize(9);
    const Document few = document_of(cells);
    EXPECT_EQ(compare_documents(few, few, {}).cells.front().time.verdict, TimeVerdict::unsure);
}

TEST(Compare, JudgesAllStagesTogetherAndShowsEach)
{
    Document b = document_of({timed_cell("karras", 1e6, 0.02, 2)});
    for (Sample& sample : b.cells[0].samples)
        sample.stages[0].span_ns *= 2;  // the sort: half of all
    const Document a = document_of({timed_cell("karras", 1e6)});
    const ComparedCell cell = only_cell(a, b);
    EXPECT_EQ(cell.time.verdict, TimeVerdict::slower);
    EXPECT_NEAR(cell.time.ratio.value, 1.5, 0.03);
    ASSERT_EQ(cell.stages.size(), 2u);
    EXPECT_NEAR(cell.stages[0].second.ratio.value, 2, 0.04);
    EXPECT_NEAR(cell.stages[1].second.ratio.value, 1, 0.02);
}

TEST(Compare, FindsEveryCounterThatIsNotWhatItWas)
{
    const Document a = document_of({timed_cell("karras", 1e6)});
    Document b = a;
    EXPECT_FALSE(only_cell(a, b).is_regression());
    b.cells[0].counters["sah_cost"] = std::nextafter(80.25, 81);
    EXPECT_EQ(only_cell(a, b).regressions,
              (std::vector<std::string>{"sah_cost 80.25000000000001, was 80.25"}));
    b.cells[0].counters["sah_cost"] = 70;
    EXPECT_TRUE(only_cell(a, b).regressions.empty());
    EXPECT_EQ(only_cell(a, b).changes, (std::vector<std::string>{"sah_cost 70, was 80.25"}));
    b = a;
    b.cells[0].counters.erase("sah_cost");
    b.cells[0].left_out["sah_cost"] = "the tree is wrong";
    EXPECT_EQ(only_cell(a, b).regressions,
              (std::vector<std::string>{"no sah_cost (the tree is wrong), was 80.25"}));
    EXPECT_TRUE(only_cell(a, b, {.allow_missing = true}).regressions.empty());
    EXPECT_TRUE(only_cell(b, a).regressions.empty());
}

TEST(Compare, TakesAnyOtherNumberOfPairsForARegression)
{
    Document a = document_of({timed_cell("karras", 1e6)});
    a.cells[0].counters["pairs_count"] = 1000;
    for (const double pairs : {999.0, 1001.0}) {
        Document b = a;
        b.cells[0].counters["pairs_count"] = pairs;
        EXPECT_TRUE(only_cell(a, b).is_regression());
    }
    Document b = a;
    a.cells[0].check.pairs_hash = 1;
    b.cells[0].check.pairs_hash = 2;
    EXPECT_TRUE(only_cell(a, b).is_regression());
}

TEST(Compare, LeavesOutTimesAndWhatIsNotTheSameInEachRun)
{
    EXPECT_TRUE(is_time("compile_ns"));
    EXPECT_TRUE(is_time("copy_rate_bytes_per_s"));
    EXPECT_FALSE(is_time("tree_bytes"));
    EXPECT_FALSE(is_time("pairs_count"));
    Cell cell = fake_cell();
    cell.collider.name = "group";
    EXPECT_FALSE(is_exact("box_tests_count", cell));
    EXPECT_TRUE(is_exact("pairs_count", cell));
    cell.collider.name = "leaf";
    EXPECT_TRUE(is_exact("box_tests_count", cell));
}

TEST(Compare, TakesALostVerdictForARegression)
{
    const Document a = document_of({timed_cell("karras", 1e6)});
    Document b = a;
    b.cells[0].check.verdict = Check::Verdict::differs;
    b.cells[0].check.detail = "box 3";
    EXPECT_EQ(only_cell(a, b).regressions,
              (std::vector<std::string>{"differs (box 3), was agrees"}));
    EXPECT_FALSE(only_cell(b, a).is_regression());
    for (const Cell::Status status : {Cell::Status::skipped, Cell::Status::failed}) {
        b = a;
        b.cells[0].status = status;
        b.cells[0].reason = "no room";
        b.cells[0].samples.clear();
        b.cells[0].counters.clear();
        EXPECT_TRUE(only_cell(a, b).is_regression());
        EXPECT_FALSE(only_cell(b, a).is_regression());
    }
}

TEST(Compare, ListsCellsOfOneFileOnlyAndFailsForThoseThatBLacks)
{
    const Document a = document_of({timed_cell("karras", 1e6), timed_cell("apetrei", 1e6)});
    const Document b = document_of({timed_cell("apetrei", 1e6), timed_cell("perfect", 1e6)});
    const Comparison comparison = compare_documents(a, b, {});
    ASSERT_EQ(comparison.only_first.size(), 1u);
    EXPECT_EQ(comparison.only_first[0]->builder.name, "karras");
    ASSERT_EQ(comparison.only_second.size(), 1u);
    EXPECT_EQ(comparison.only_second[0]->builder.name, "perfect");
    EXPECT_TRUE(comparison.has_regression());
    EXPECT_FALSE(compare_documents(a, b, {.allow_missing = true}).has_regression());
    const std::string text = comparison_report(comparison);
    EXPECT_NE(text.find("REGRESSION bunny: karras: not in B"), std::string::npos) << text;
    EXPECT_NE(text.find("new bunny: perfect: only in B"), std::string::npos) << text;
}

TEST(Compare, TellsCellsApartByAllThatTheyAre)
{
    const Cell cell = timed_cell("karras", 1e6);
    std::vector<Cell> others(17, cell);
    others[0].experiment = "fig8";
    others[1].scene.name = "dragon";
    others[2].scene.frame = 1;
    others[3].builder.order = "kd";
    others[4].builder.group_size = 64;
    others[5].builder.sorted_leaves = true;
    others[6].builder.boxes = "u16";
    others[7].operation = Operation::refit;
    others[8].collider.name = "leaf";
    others[9].collider = {.name = "leaf", .narrow = "exact"};
    others[10].collider = {.name = "leaf", .rules_off = 1};
    others[11].swept = {"vertex-face", 1, 5};
    others[12].accuracy = {"sums", "float", 1};
    others[13].accuracy = {"sums", "float", 2};
    others[14].samples[0].stages = {fake_stage("hierarchy", 100, 1)};  // from sorted leaves
    others[15].scene.between = 3;
    others[16].scene.objects_by = "mesh";
    for (std::size_t i = 0; i < others.size(); ++i) {
        const MatchedCells matched = matched_cells({cell}, {others[i]});
        EXPECT_TRUE(matched.both.empty()) << i;
        EXPECT_EQ(matched_cells({others[i]}, {others[i]}).both.size(), 1u) << i;
    }
    EXPECT_EQ(matched_cells({cell, cell}, {cell}).only_first.size(), 1u);
}

TEST(Compare, SeesAChangeThatNoDriftMakesHoweverLittleTheOthersAgree)
{
    const Document a = document_of({timed_cell("karras", 1e6), timed_cell("apetrei", 1e6),
                                    timed_cell("perfect", 1e6), timed_cell("oibvh-multi", 1e6)});
    const Document b = document_of({timed_cell("karras", 1e6), timed_cell("apetrei", 1.2e6),
                                    timed_cell("perfect", 2e6), timed_cell("oibvh-multi", 5e5)});
    const Comparison comparison = compare_documents(a, b, {});
    EXPECT_EQ(comparison.cells[0].time.verdict, TimeVerdict::unsure);
    EXPECT_EQ(comparison.cells[1].time.verdict, TimeVerdict::unsure);
    EXPECT_EQ(comparison.cells[2].time.verdict, TimeVerdict::slower);
    EXPECT_EQ(comparison.cells[3].time.verdict, TimeVerdict::faster);
    EXPECT_EQ(comparison.scenes.at(0).verdict, TimeVerdict::unsure);
}

TEST(Compare, ShowsTheWorstFirstAndSumsUpTheRest)
{
    Document a = document_of({timed_cell("karras", 1e6), timed_cell("apetrei", 1e6, 0.02, 3),
                              timed_cell("perfect", 1e6, 0.02, 5), timed_cell("oibvh-multi", 1e6)});
    Document b =
        document_of({timed_cell("karras", 1e6, 0.02, 2), timed_cell("apetrei", 1.2e6, 0.02, 4),
                     timed_cell("perfect", 2e6, 0.02, 6), timed_cell("oibvh-multi", 5e5)});
    for (Document* document : {&a, &b})  // each on a frame of its own, by itself
        for (int frame = 0; frame < 4; ++frame)
            document->cells[frame].scene.frame = frame;
    const Comparison comparison = compare_documents(a, b, {});
    const std::string text = comparison_report(comparison);
    const auto at = [&](const char* word) { return text.find(word); };
    EXPECT_LT(at("perfect"), at("apetrei"));
    EXPECT_LT(at("apetrei"), at("oibvh-multi"));
    EXPECT_NE(at("oibvh-multi"), std::string::npos);
    EXPECT_EQ(at("karras"), std::string::npos) << text;
    EXPECT_NE(at("4 cells: 1 SAME, 1 FASTER, 2 SLOWER, 0 UNSURE at 5.0 %"), std::string::npos)
        << text;
    EXPECT_NE(at("2 regressions"), std::string::npos);
    EXPECT_NE(comparison_report(comparison, true).find("karras"), std::string::npos);
}

TEST(Compare, RefusesWhatCannotBeCompared)
{
    const Document a = document_of({timed_cell("karras", 1e6)});
    EXPECT_EQ(refusal(a, a), "");
    Document b = a;
    b.run.dirty = true;
    EXPECT_NE(refusal(a, b).find("b.json was made by a program with changes"), std::string::npos);
    EXPECT_EQ(refusal(a, b, {.allow_dirty = true}), "");
    b = a;
    b.run.test_hooks = {{"BVHBENCH_SLOW", "karras:2"}};
    EXPECT_NE(refusal(b, a).find("a.json was made under BVHBENCH_SLOW=karras:2"),
              std::string::npos);
    EXPECT_EQ(refusal(b, a, {.allow_test_hooks = true}), "");
    b = a;
    b.cells.clear();
    EXPECT_NE(refusal(a, b).find("no cells"), std::string::npos);
    b = a;
    b.minor = 3;
    EXPECT_NE(refusal(a, b).find("format 1.9 and b.json 1.3"), std::string::npos);
    b.minor = 4;
    EXPECT_EQ(refusal(a, b), "");
    b = a;
    b.run.costs = {1, 1};
    EXPECT_NE(refusal(a, b).find("sah_cost"), std::string::npos);
    b = a;
    b.run.device.name = "another device";
    EXPECT_NE(refusal(a, b).find("--other-devices"), std::string::npos);
    EXPECT_EQ(refusal(a, b, {.other_devices = true}), "");
    b = a;
    b.run.host_threads = 2;
    EXPECT_NE(refusal(a, b).find("--other-devices"), std::string::npos);
}

TEST(Compare, ComparesOnlyRatiosWithinASceneOfOtherDevices)
{
    const CompareRules rules{.other_devices = true};
    const Document a = document_of({timed_cell("karras", 1e6), timed_cell("apetrei", 2e6, 0.02, 3),
                                    timed_cell("perfect", 1e6, 0.02, 5)});
    Document b =
        document_of({timed_cell("karras", 1e5, 0.02, 2), timed_cell("apetrei", 2e5, 0.02, 4),
                     timed_cell("perfect", 3e5, 0.02, 6)});
    b.cells[0].counters["scratch_bytes"] = 12345;
    const Comparison comparison = compare_documents(a, b, rules);
    EXPECT_EQ(comparison.cells[0].time.verdict, TimeVerdict::same);
    EXPECT_EQ(comparison.cells[1].time.verdict, TimeVerdict::same);
    EXPECT_EQ(comparison.cells[2].time.verdict, TimeVerdict::slower);
    EXPECT_TRUE(comparison.cells[0].regressions.empty());
    // A cell alone on its scene has nothing to be held against.
    const Document lonely_a = document_of({timed_cell("karras", 1e6)});
    const Document lonely_b = document_of({timed_cell("karras", 9e6)});
    EXPECT_EQ(only_cell(lonely_a, lonely_b, rules).time.verdict, TimeVerdict::unsure);
}

/// Six builders that take a million nanoseconds times their number, their samples interleaved; `drift` says by what a sample at
/// that share of the run is longer.
Document six_builders(unsigned seed, const std::function<double(double)>& drift, double karras = 1,
                      int rounds = 100)
{
    std::vector<Cell> cells;
    int number = 0;
    for (const char* name :
         {"perfect", "karras", "apetrei", "lbvh-levels", "oibvh-single", "oibvh-multi"}) {
        ++number;
        Cell cell = timed_cell(name, 1e6 * number, 0.02, seed * 10 + number, rounds);
        for (int i = 0; i < rounds; ++i) {
            Sample& sample = cell.samples[i];
            sample.order = 6 * i + number - 1;
            const double by = drift(static_cast<double>(i) / rounds) * (number == 2 ? karras : 1);
            for (StageTime& stage : sample.stages)
                stage.span_ns = static_cast<std::int64_t>(static_cast<double>(stage.span_ns) * by);
        }
        cells.push_back(std::move(cell));
    }
    return document_of(std::move(cells));
}

std::vector<TimeVerdict> verdicts(const Comparison& comparison)
{
    std::vector<TimeVerdict> found;
    for (const ComparedCell& cell : comparison.cells)
        found.push_back(cell.time.verdict);
    return found;
}

constexpr double steady(double) { return 1; }

TEST(Compare, JudgesCellsOfRunsApartBesideTheOthersOfTheirScene)
{
    const auto slower = [](double) { return 1.2; };  // the device, or all of them
    const Document a = six_builders(1, steady);
    const Document b = six_builders(2, slower);
    const Comparison all = compare_documents(a, b, {});
    EXPECT_EQ(verdicts(all), std::vector<TimeVerdict>(6, TimeVerdict::same));
    ASSERT_EQ(all.scenes.size(), 1u);
    EXPECT_EQ(all.scenes[0].verdict, TimeVerdict::slower);
    EXPECT_NEAR(all.scenes[0].ratio.value, 1.2, 0.01);
    EXPECT_TRUE(all.has_regression());
    const Comparison one = compare_documents(a, six_builders(2, slower, 1.15), {});
    EXPECT_EQ(one.cells[1].time.verdict, TimeVerdict::slower);
    EXPECT_NEAR(one.cells[1].time.ratio.value, 1.15, 0.02);
    EXPECT_EQ(one.cells[0].time.verdict, TimeVerdict::same);
}

TEST(Compare, IsUnsureOfASceneThatWaveredAsMuchAsItChanged)
{
    const auto wavers = [](double at) { return at < 0.5 ? 1.0 : 1.25; };
    const Comparison comparison =
        compare_documents(six_builders(1, wavers), six_builders(2, [](double) { return 1.3; }), {});
    ASSERT_EQ(comparison.scenes.size(), 1u);
    EXPECT_EQ(comparison.scenes[0].verdict, TimeVerdict::unsure);
    EXPECT_FALSE(comparison.has_regression());
}

TEST(Compare, IsUnsureOfACellAmongOthersThatAgreeOnNothing)
{
    Document b = six_builders(2, steady);
    for (std::size_t i = 0; i < b.cells.size(); ++i)
        for (Sample& sample : b.cells[i].samples)
            for (StageTime& stage : sample.stages)
                stage.span_ns += stage.span_ns * static_cast<std::int64_t>(i) / 12;
    const Comparison comparison = compare_documents(six_builders(1, steady), b, {});
    EXPECT_EQ(verdicts(comparison), std::vector<TimeVerdict>(6, TimeVerdict::unsure));
}

TEST(Compare, SeesThroughTheDriftThatRunsByTurnsShare)
{
    const auto drift = [](double at) { return 1 + 0.4 * at + (at > 0.3 && at < 0.6 ? 0.5 : 0); };
    Document a = six_builders(1, drift);
    Document b = six_builders(2, drift, 1.08);
    EXPECT_EQ(compare_documents(a, b, {}).cells[1].time.verdict, TimeVerdict::unsure);
    b.run.id = "another";
    a.run.turns_with = {b.run.id};
    EXPECT_FALSE(compare_documents(a, b, {}).by_turns);  // only one of them says so
    b.run.turns_with = {a.run.id};
    const Comparison comparison = compare_documents(a, b, {});
    EXPECT_TRUE(comparison.by_turns);
    EXPECT_EQ(comparison.cells[1].time.verdict, TimeVerdict::slower);
    EXPECT_NEAR(comparison.cells[1].time.ratio.value, 1.08, 0.01);
    for (const std::size_t other : {0, 2, 3, 4, 5})
        EXPECT_EQ(comparison.cells[other].time.verdict, TimeVerdict::same);
    // All of them slower is a change, too: nothing else can have made it.
    Document slow = six_builders(2, [&](double at) { return 1.1 * drift(at); });
    slow.run = b.run;
    EXPECT_EQ(verdicts(compare_documents(a, slow, {})),
              std::vector<TimeVerdict>(6, TimeVerdict::slower));
}

TEST(Compare, ComparesSamplesThatWereTakenAtLikeSpeed)
{
    // A device of two speeds: one run is mostly at the one, the other at the other.
    const auto at_speeds = [](Document document, int fast_of_ten) {
        for (Cell& cell : document.cells)
            for (std::size_t i = 0; i < cell.samples.size(); ++i) {
                const bool fast = static_cast<int>(i % 10) < fast_of_ten;
                cell.samples[i].calibration_ns = fast ? 1000 : 1500;
                for (StageTime& stage : cell.samples[i].stages)
                    stage.span_ns = stage.span_ns * (fast ? 2 : 3);
            }
        return document;
    };
    const Document a = at_speeds(six_builders(1, steady), 7);
    const Comparison comparison = compare_documents(a, at_speeds(six_builders(2, steady), 4), {});
    EXPECT_EQ(verdicts(comparison), std::vector<TimeVerdict>(6, TimeVerdict::same));
    EXPECT_EQ(comparison.cells[0].time.first_count, 70u);
    EXPECT_EQ(comparison.cells[0].time.second_count, 40u);
    EXPECT_NEAR(comparison.scenes.at(0).ratio.value, 1, 0.01);
    // Of no common speed nothing is said.
    EXPECT_EQ(verdicts(compare_documents(at_speeds(six_builders(1, steady), 10),
                                         at_speeds(six_builders(2, steady), 0), {})),
              std::vector<TimeVerdict>(6, TimeVerdict::unsure));
}

TEST(Compare, TakesAnotherSceneOfTheNameForARegression)
{
    const Document a = document_of({timed_cell("karras", 1e6)});
    Document b = a;
    b.cells[0].scene.content_hash ^= 1;
    EXPECT_TRUE(only_cell(a, b).is_regression());
}

}  // namespace
}  // namespace bvhbench
