// SPDX-License-Identifier: MIT

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <sstream>

#include "geometry/names.h"
#include "harness/base/build_info.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

std::string refusal(std::vector<const char*> words)
{
    words.insert(words.begin(), "bvhbench");
    return refusal_of<BadUsage>([&] { check_words(static_cast<int>(words.size()), words.data()); });
}

/// Returns the error messages for a value of an option, from an experiment and from the command line.
std::vector<std::string> refusals(const std::string& key, const std::string& value)
{
    std::vector<std::string> said;
    for (const Choice& option : choices()) {
        if (option.key != key)
            continue;
        CellChoice choice;
        said.push_back(refusal_of<BadUsage>([&] {
            read_choices({{key, value}}, option.of, choice);
        }));
        said.push_back(refusal_of<BadUsage>([&] {
            CLI::App app;
            add_choices(app, choice, [&](const Choice& one) { return &one == &option; });
            std::string name = "--" + key;
            std::replace(name.begin(), name.end(), '_', '-');
            app.parse(std::vector<std::string>{value, name});
        }));
    }
    return said;
}

TEST(Choices, OfACellAreReadFromTheirKeysAndToldByThem)
{
    CellChoice choice;
    const Json builder = {{"order", "morton63"}, {"grid", "scene"}, {"group_size", 64},
                          {"items", 4},          {"boxes", "u16"},  {"leaves", "sorted"}};
    read_choices(builder, Choice::Of::builder, choice);
    EXPECT_EQ(choice.builder, (BuilderChoice{{.order = "morton63",
                                              .grid = GridOver::scene,
                                              .group_size = 64,
                                              .items = 4,
                                              .sorted_leaves = true,
                                              .boxes = "u16"},
                                             {}}));
    EXPECT_EQ(choices_json(choice, Choice::Of::builder), builder);
    read_choices({{"pairs_of", "between"},
                  {"adjacent", "drop"},
                  {"narrow", "exact"},
                  {"first", true},
                  {"within", "none"},
                  {"no_skip", "near"},
                  {"force_skip", "rigid"},
                  {"update", "refit"},
                  {"trees", "scene"}},
                 Choice::Of::query, choice);
    read_choices({{"jump", 3}, {"start_level", 4}, {"group_size", 128}}, Choice::Of::collider,
                 choice);
    EXPECT_EQ(choice.collider, (ColliderChoice{{.among = Among::between_objects,
                                                .keep_adjacent = false,
                                                .jump = 3,
                                                .start_level = 4,
                                                .rules_off = skip_near,
                                                .group_size = 128,
                                                .first = true},
                                               {},
                                               "exact",
                                               skip_rigid,
                                               FrameUpdate::refit,
                                               TreeOver::scene}));
    choice.builder.name = "karras";
    choice.collider.name = "leaf";
    EXPECT_NO_THROW(check_choice(choice));
    choice.collider.narrow = "sat-f32";
    EXPECT_THROW(check_choice(choice), BadUsage) << "the first contact is exact";
    choice.collider.narrow = "exact";
    choice.collider.rules_forced |= skip_near;
    EXPECT_THROW(check_choice(choice), BadUsage) << "near is left out and forced";
    read_choices({{"frames", "2:5"}, {"between", 3}, {"objects", "components"}, {"swept", true}},
                 Choice::Of::scene, choice);
    EXPECT_EQ(choice.scene.frames, (FrameRange{2, 5}));
    EXPECT_EQ(choice.scene.between, 3u);
    EXPECT_EQ(choice.scene.objects, ObjectsBy::components);
    EXPECT_TRUE(choice.scene.swept);
}

TEST(Choices, OfOtherBoxesSortLeavesUnlessTheyAreSaid)
{
    CellChoice choice;
    read_choices({{"boxes", "u16"}}, Choice::Of::builder, choice);
    EXPECT_TRUE(choice.builder.sorted_leaves);
    read_choices({{"leaves", "mesh"}, {"boxes", "u16"}}, Choice::Of::builder, choice);
    EXPECT_FALSE(choice.builder.sorted_leaves);
    EXPECT_THROW(check_choice({.builder = {{.boxes = "u16"}, "karras"}}), BadUsage);
}

TEST(Choices, ThatAreWrongGetTheSameSentenceWhereverTheyStand)
{
    const std::pair<const char*, const char*> wrong[] = {
        {"order", "up"},     {"grid", "mesh"},    {"group_size", "many"}, {"items", "16"},
        {"boxes", "u9"},     {"leaves", "green"}, {"pairs_of", "us"},     {"adjacent", "some"},
        {"narrow", "guess"}, {"no_skip", "far"},  {"force_skip", "far"},  {"jump", "99"},
        {"jump", "-1"},      {"update", "keep"},  {"trees", "mesh"},      {"frames", "3:2"},
        {"between", "1001"}, {"objects", "parts"}};
    for (const auto& [key, value] : wrong) {
        const std::vector<std::string> said = refusals(key, value);
        ASSERT_GE(said.size(), 2u) << key;
        EXPECT_FALSE(said[0].empty()) << key;
        EXPECT_EQ(said[0], said[1]) << key;
        EXPECT_NE(said[0].find(value), std::string::npos) << said[0];
    }
}

TEST(Choices, ThatMustBePowersOfTwoAreHeldToThatApart)
{
    CellChoice choice;
    read_choices({{"items", 3}}, Choice::Of::builder, choice);
    EXPECT_THROW(check_powers(choice), BadUsage);
    read_choices({{"items", 4}}, Choice::Of::builder, choice);
    EXPECT_NO_THROW(check_powers(choice));
}

TEST(Choices, HaveAKeyOfTheirOwnAndKeepTheirUsualValue)
{
    std::set<std::pair<Choice::Of, std::string_view>> seen;
    for (const Choice& option : choices()) {
        EXPECT_TRUE(seen.insert({option.of, option.key}).second) << option.key;
        const Json usual = option.get({});
        CellChoice choice;
        if (const std::string word = usual.is_string() ? usual.get<std::string>() : usual.dump();
            !word.empty())
            choose(option, choice, word);
        EXPECT_EQ(option.get(choice), usual) << option.key;
    }
}

TEST(Options, AndExamplesThatHelpShowsAreUnderstood)
{
    for (const CommandEntry& entry : commands()) {
        if (entry.make == nullptr || entry.group.empty())
            continue;
        EXPECT_FALSE(entry.examples.empty()) << entry.name;
        EXPECT_TRUE(
            std::filesystem::exists(std::filesystem::path(build_info.source_root) / entry.see))
            << entry.see;
        for (const HelpLine& example : entry.examples) {
            std::istringstream line{std::string(example.name)};
            std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
            ASSERT_GT(words.size(), 1u) << example.name;
            EXPECT_EQ(words[0], "bvhbench");
            EXPECT_EQ(words[1], entry.name);
            std::vector<const char*> rest;
            for (std::size_t k = 1; k < words.size(); ++k)
                rest.push_back(words[k].c_str());
            EXPECT_EQ(refusal(rest), "") << example.name;
        }
    }
}

TEST(Options, ThatAreNotUnderstoodAreAnsweredInOneSentence)
{
    for (const std::vector<const char*>& words : std::vector<std::vector<const char*>>{
             {},
             {"list", "nothing", "more"},
             {"stress", "--seed", "x"},
             {"stress", "scale"},
             {"build"},
             {"build", "--builder", "perfect"},
             {"build", "--builder", "perfect", "--scene", "s", "--samples", "0"},
             {"build", "--builder", "perfect", "--scene", "s", "--samples", "many"},
             {"build", "--builder", "perfect", "--scene", "s", "--group-size", "-1"},
             {"build", "--builder", "perfect", "--scene", "s", "--json", ""},
             {"collide", "--builder", "perfect"},
             {"run"},
             {"run", "table1", "--fast"},
             {"run", "table4", "--sah-inner", "0", "--sah-triangle", "0"},
         }) {
        const std::string sentence = refusal(words);
        EXPECT_FALSE(sentence.empty()) << (words.empty() ? "" : words[0]);
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
    for (const char* value : {"-1", "nan", "inf", "-inf", "1e7", "many", "1.2x", "0x10", ""}) {
        const std::string sentence =
            refusal({"run", "quality", (std::string("--sah-inner=") + value).c_str()});
        EXPECT_NE(sentence.find("--sah-inner: "), std::string::npos) << value << ": " << sentence;
    }
}

template <class Catalog, class Find>
void expect_whole(const Catalog& catalog, const Find& find)
{
    for (const auto& entry : catalog) {
        EXPECT_EQ(&find(entry.name), &entry);
        EXPECT_FALSE(entry.summary.empty());
        EXPECT_EQ(entry.make == nullptr, !entry.absent.empty());
    }
}

TEST(Catalog, ListsEachOnceAndAnswersAnUnknownNameWithThoseThereAre)
{
    expect_whole(builder_catalog(), find_builder);
    expect_whole(collider_catalog(), find_collider);
    constexpr std::size_t few = 12;  // more are not listed beside a guess
    EXPECT_EQ(refusal_of<BadUsage>([] { find_collider("leafs"); }),
              "no collider is called 'leafs'; " +
                  (collider_catalog().size() <= few
                       ? "there are: " + joined(names_of(collider_catalog())) + "; "
                       : "") +
                  "did you mean 'leaf'?");
    EXPECT_GT(builder_catalog().size(), 15u);
    EXPECT_EQ(refusal_of<BadUsage>([] { find_builder("zzz"); }),
              "no builder is called 'zzz'; there are: " + joined(names_of(builder_catalog())));
}

}  // namespace
}  // namespace bvhbench
