// SPDX-License-Identifier: MIT
//
// Tests the option that docs/adding.md adds, compiled with the files and changes of that page.

#include <CLI/CLI.hpp>

#include "harness/choice/choices.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

const std::function<bool(const Choice&)> of_builder = [](const Choice& one) {
    return one.of == Choice::Of::builder;
};

TEST(NewOption, IsOneOfTheCommandLine)
{
    CLI::App app;
    CellChoice choice;
    add_choices(app, choice, of_builder);
    app.parse("--bins 8");
    EXPECT_EQ(choice.builder.bins, 8u);
    EXPECT_NE(app.help().find("bins of the surface area heuristic"), std::string::npos);
}

TEST(NewOption, IsAKeyOfExperimentsAndResultFiles)
{
    CellChoice choice;
    read_choices({{"bins", 16}}, Choice::Of::builder, choice);
    EXPECT_EQ(choice.builder.bins, 16u);
    EXPECT_EQ(choices_json(choice, Choice::Of::builder)["bins"], 16);
    EXPECT_EQ(choices_json({}, Choice::Of::builder)["bins"], 32);
    const auto keys = choice_keys(Choice::Of::builder, {});
    EXPECT_NE(std::find(keys.begin(), keys.end(), "bins"), keys.end());
}

TEST(NewOption, IsRefusedInASentenceForAWrongValue)
{
    CellChoice choice;
    EXPECT_EQ(refusal_of<BadUsage>([&] {
                  read_choices({{"bins", 257}}, Choice::Of::builder, choice);
              }),
              "'bins' takes a number of bins up to 256, not '257'");
}

}  // namespace
}  // namespace bvhbench
