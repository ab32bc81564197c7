// SPDX-License-Identifier: MIT
//
// Tests the search with invented trials, whose times and answers are known.
#include "harness/tune/tuner.h"

#include <gtest/gtest.h>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr Parameter made_up(const char* name, const char* stage, uint usual, uint most,
                            CandidateValues candidates)
{
    return {.name = name,
            .meaning = "made up",
            .stage = stage,
            .on_cpu = usual,
            .elsewhere = usual,
            .least = 1,
            .most = most,
            .candidates = candidates};
}
constexpr Parameter keys_parameter = made_up("fake.keys", "sort", 4, 64, {1, 2, 4, 8, 16});
constexpr Parameter items_parameter = made_up("fake.items", "hierarchy", 1, 8, {1, 2, 3});
constexpr Parameter aside_parameter =
    // No trial reads this parameter.
    made_up("fake.aside", "sort", 1, 8, {1, 2, 3});

/// Times, answers and failures of a trial by its values of `keys` and `items`.
struct World {
    std::function<std::int64_t(uint keys, uint items)> sort_ns = [](uint, uint) { return 1000; };
    std::function<std::int64_t(uint keys, uint items)> hierarchy_ns = [](uint, uint) {
        return 500;
    };
    std::function<std::string(uint keys)> wrong = [](uint) { return ""; };
    std::function<void(uint keys)> make = [](uint) {};
};

class FakeTrial final : public Trial {
public:
    FakeTrial(const World& world, const Tuning& tuning)
        : world_(world)
        , tuning_(tuning)
        , keys_(tuning_.value(keys_parameter, true))
        , items_(tuning_.value(items_parameter, true))
    {
        world_.make(keys_);
    }
    std::string wrong() override { return world_.wrong(keys_); }
    std::vector<StageTime> once() override
    {
        const std::int64_t jitter = 3 * (runs_++ % 5);  // less than one percent
        const std::int64_t sort = world_.sort_ns(keys_, items_) + jitter;
        const std::int64_t hierarchy = world_.hierarchy_ns(keys_, items_);
        return {{"sort", sort, sort, 0, 1, 0}, {"hierarchy", hierarchy, hierarchy, 0, 1, 0}};
    }
    std::set<const Parameter*> asked() const override { return tuning_.asked(); }

private:
    const World& world_;
    Tuning tuning_;
    uint keys_, items_;
    int runs_ = 0;
};

SearchResult searched(
    const World& world, const Tuning& start = {}, int rounds = 2,
    const SearchNote& note = [](const std::string&, const SearchResult&) {})
{
    return search([&](const Tuning& tuning) { return std::make_unique<FakeTrial>(world, tuning); },
                  start, [](const Parameter&) { return true; },
                  {.samples = 7, .warm_up = 1, .rounds = rounds, .is_cpu = true}, note);
}

const TrialResult& tried(const SearchResult& result, const Parameter& parameter, uint value)
{
    for (const TrialResult& one : result.tries)
        if (one.parameter == &parameter && one.value == value)
            return one;
    throw std::out_of_range("not tried");
}

struct Search : testing::Test, World {};

TEST_F(Search, KeepsTheFastestValueOfEachParameter)
{
    sort_ns = [](uint keys, uint) { return keys == 8 ? 600 : keys == 2 ? 800 : 1000; };
    hierarchy_ns = [](uint, uint items) { return items == 3 ? 300 : 500; };
    const SearchResult result = searched(*this);
    EXPECT_EQ(result.best.value(keys_parameter, true), 8u);
    EXPECT_EQ(result.best.value(items_parameter, true), 3u);
    EXPECT_EQ(result.kept.size(), 2u);
    EXPECT_EQ(tried(result, keys_parameter, 8).verdict, TrialResult::Verdict::better);
    EXPECT_NEAR(tried(result, keys_parameter, 8).ratio, 0.6, 0.01);
    EXPECT_EQ(tried(result, keys_parameter, 2).verdict, TrialResult::Verdict::not_better)
        << "but not the fastest";
    EXPECT_EQ(tried(result, keys_parameter, 4).verdict, TrialResult::Verdict::current);
    EXPECT_NEAR(result.start_ns, 1500, 20);
    EXPECT_NEAR(result.best_ns, 900, 20);
}

TEST_F(Search, NeverChoosesAWrongAnswerHoweverFast)
{
    sort_ns = [](uint keys, uint) { return keys == 16 ? 10 : keys == 8 ? 900 : 1000; };
    wrong = [](uint keys) { return keys == 16 ? "box 7 differs" : ""; };
    const SearchResult result = searched(*this);
    EXPECT_EQ(result.best.value(keys_parameter, true), 8u);
    EXPECT_EQ(tried(result, keys_parameter, 16).verdict, TrialResult::Verdict::wrong);
    EXPECT_EQ(tried(result, keys_parameter, 16).median_ns, 0) << "a wrong answer has no time";
    EXPECT_NE(search_report(result).find("wrong: box 7 differs"), std::string::npos);
}

TEST_F(Search, NeverChoosesWhatIsWrongOnlyAfterItWasTimed)
{
    int checks = 0;
    sort_ns = [](uint keys, uint) { return keys == 16 ? 10 : 1000; };
    wrong = [&](uint keys) { return keys == 16 && ++checks % 2 == 0 ? "a race" : ""; };
    const SearchResult result = searched(*this);
    EXPECT_EQ(result.best.value(keys_parameter, true), 4u);
    EXPECT_EQ(tried(result, keys_parameter, 16).verdict, TrialResult::Verdict::wrong);
}

TEST_F(Search, PassesOverWhatTheDeviceCannotDo)
{
    sort_ns = [](uint keys, uint) { return keys == 2 ? 900 : 1000; };
    make = [](uint keys) {
        if (keys == 16)
            throw Unavailable("needs 70000 bytes of local memory\nand a log");
    };
    const SearchResult result = searched(*this);
    EXPECT_EQ(result.best.value(keys_parameter, true), 2u);
    EXPECT_EQ(tried(result, keys_parameter, 16).verdict, TrialResult::Verdict::impossible);
    EXPECT_EQ(tried(result, keys_parameter, 16).detail, "needs 70000 bytes of local memory");
}

TEST_F(Search, LeavesEverythingWhereNothingIsBetterByMoreThanNoise)
{
    sort_ns = [](uint keys, uint) { return keys == 8 ? 995 : 1000; };
    const SearchResult result = searched(*this);
    EXPECT_TRUE(result.kept.empty());
    EXPECT_TRUE(result.best.values().empty());
    EXPECT_EQ(result.best_ns, 0) << "nothing to compare in the end";
    EXPECT_EQ(result.searched, (std::set<const Parameter*>{&keys_parameter, &items_parameter}));
}

TEST_F(Search, GivesUpWhatMakesTheWholeNoFaster)
{
    // The hierarchy loses what the sort gains.
    sort_ns = [](uint keys, uint) { return keys == 8 ? 600 : 1000; };
    hierarchy_ns = [](uint keys, uint) { return keys == 8 ? 900 : 400; };
    const SearchResult result = searched(*this);
    EXPECT_EQ(tried(result, keys_parameter, 8).verdict, TrialResult::Verdict::better);
    EXPECT_TRUE(result.kept.empty());
    EXPECT_FALSE(result.best.has(keys_parameter));
    EXPECT_NE(search_report(result).find("not faster, nothing is kept"), std::string::npos);
}

TEST_F(Search, GoesThroughAllAgainWhereOneDependsOnAnother)
{
    // More keys pay only with more items, which are tuned first (by name).
    sort_ns = [](uint keys, uint items) { return keys == 8 ? (items == 2 ? 500 : 700) : 1000; };
    hierarchy_ns = [](uint keys, uint items) { return items == 2 && keys == 8 ? 100 : 500; };
    EXPECT_EQ(searched(*this, {}, 1).best.value(items_parameter, true), 1u);
    EXPECT_EQ(searched(*this, {}, 2).best.value(items_parameter, true), 2u);
}

TEST_F(Search, StartsFromDefaultsAndLeavesOtherParametersAsTheyAre)
{
    Tuning start;
    start.set(keys_parameter, 16);
    start.set(aside_parameter, 3);
    const SearchResult result = searched({}, start);
    EXPECT_EQ(tried(result, keys_parameter, 4).verdict, TrialResult::Verdict::current);
    EXPECT_FALSE(result.best.has(keys_parameter));
    EXPECT_EQ(result.best.value(aside_parameter, true), 3u);
    EXPECT_THROW(tried(result, aside_parameter, 1), std::out_of_range) << "nobody asked for it";
}

TEST_F(Search, EndsWhereTheAnswerIsWrongBeforeAnythingIsTuned)
{
    wrong = [](uint) { return "wrong everywhere"; };
    EXPECT_THROW(searched(*this), Unavailable);
}

TEST_F(Search, HasWhatWasFoundWheneverItSaysWhatItDoes)
{
    hierarchy_ns = [](uint, uint items) { return items == 3 ? 300 : 500; };
    bool was_told = false, was_there = false;
    searched(*this, {}, 2, [&](const std::string& what, const SearchResult& so_far) {
        if (what != "fake.keys = 16" || was_told)  // last candidate of the second parameter
            return;
        was_told = true;
        was_there = so_far.best.value(items_parameter, true) == 3 && so_far.kept.size() == 1 &&
                    so_far.searched == std::set<const Parameter*>{&items_parameter};
    });
    EXPECT_TRUE(was_there);
}

TEST(IsFaster, WantsMoreThanNoiseAndMoreThanAHundredth)
{
    EXPECT_TRUE(is_faster({90, 91, 89, 90}, {100, 101, 99, 100}));
    EXPECT_FALSE(is_faster({99.5, 99.5, 99.5}, {100, 100, 100}));
    EXPECT_FALSE(is_faster({60, 90, 120, 95}, {70, 100, 140, 98})) << "they scatter";
    EXPECT_FALSE(is_faster({100, 101}, {90, 91}));
}

}  // namespace
}  // namespace bvhbench
