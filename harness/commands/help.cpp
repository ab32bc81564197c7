// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <string>

#include "harness/base/table.h"
#include "harness/commands/command.h"

namespace bvhbench {
namespace {

constexpr std::size_t page_width = 100;
constexpr std::size_t indent = 2;
constexpr std::size_t column = 30;  ///< where descriptions begin

constexpr std::string_view exit_codes =
    "Exit codes:\n"
    "  0  done\n"
    "  1  a check differs, or something got worse\n"
    "  2  wrong usage\n"
    "  3  no device, file, library or memory to begin with\n"
    "  4  nothing was measured: every cell was skipped or failed, and says why\n"
    "  128 + n  stopped by signal n; what was finished is in the result file\n";

constexpr HelpLine environment[] = {
    {"BVHBENCH_DATA", "the folder of data sets, where --data names none"},
    {"BVHBENCH_DEVICE", "the device, where --device names none"},
    {"BVHBENCH_TUNING", "a folder of tuned values, where --tuning names none"},
    {"BVHBENCH_PLUGINS", "shared libraries with builders and colliders, with : between"},
    {"BVHBENCH_KERNELS", "a source tree to read kernels from, where --kernels names none"},
    {"BVHBENCH_HOME",
     "the folder that plots/ is in, where that is not where the program was built"},
    {"BVHBENCH_PACKAGES", "of the launcher: skip leaves the system's packages alone"},
    {"POCL_CACHE_DIR", "where PoCL keeps compiled kernels, in place of ~/.cache/bvhbench/pocl"},
};

constexpr HelpLine files[] = {
    {"*.json",
     "results: every raw sample, with machine, commit and verdicts; docs/result-files.md"},
    {"results/baseline/", "what `smoke` compares this version with"},
    {"results/tuning/", "tuned values of known devices, also in the program"},
};

/// Wraps `text`, which begins at column `margin`, at page_width. Lines after the first are indented by `margin` blanks.
std::string on_page(std::string_view text, std::size_t margin)
{
    std::string out;
    for (const std::string& line : wrapped(std::string(text), page_width - margin))
        out += (out.empty() ? "" : '\n' + std::string(margin, ' ')) + line;
    return out;
}

/// Returns a name followed by its description, which begins at `column`.
std::string entry(const std::string& name, std::string_view what)
{
    std::string out = std::string(indent, ' ') + name;
    if (what.empty())
        return out + '\n';
    if (out.size() + indent > column)
        out += '\n' + std::string(column, ' ');
    else
        out.resize(column, ' ');
    return out + on_page(what, column) + '\n';
}

std::string section(std::string_view title, std::span<const HelpLine> list)
{
    std::string out = '\n' + std::string(title) + ":\n";
    for (const HelpLine& each : list)
        out += entry(std::string(each.name), each.what);
    return out;
}

/// Formats options and commands one per line, with wrapped descriptions.
class PageFormatter : public CLI::Formatter {
public:
    std::string make_option(const CLI::Option* option, bool is_positional) const override
    {
        return entry(make_option_name(option, is_positional) + make_option_opts(option),
                     make_option_desc(option));
    }

    /// Returns the kind of value without the allowed range, which error messages contain.
    std::string make_option_opts(const CLI::Option* option) const override
    {
        if (option->get_type_size() == 0)
            return {};
        const std::string type = option->get_type_name();
        const std::string kind = type.substr(0, type.find(':'));
        std::string out = kind == "ENUM" || kind == "TEXT"  ? " WORD"
                          : kind == "FLOAT"                 ? " NUMBER"
                          : kind == "UINT" || kind == "INT" ? " COUNT"
                                                            : ' ' + kind;
        if (!option->get_default_str().empty())
            out += '=' + option->get_default_str();
        if (option->get_expected_max() > 1)
            out += " ...";
        return option->get_required() ? out + ", required" : out;
    }

    std::string make_subcommand(const CLI::App* command) const override
    {
        return entry(command->get_name(), command->get_description());
    }

    std::string make_description(const CLI::App* app) const override
    {
        return on_page(app->get_description(), 0) + "\n\n";
    }
};

std::string examples_text(std::span<const HelpLine> examples)
{
    std::string out = "Examples:\n";
    for (const HelpLine& example : examples)
        out += std::string(indent, ' ') + std::string(example.name) + '\n' +
               std::string(3 * indent, ' ') + on_page(example.what, 3 * indent) + '\n';
    return out;
}

std::string footer_of_program()
{
    static constexpr HelpLine examples[] = {
        {"bvhbench smoke", "does everything run here?"},
        {"bvhbench reproduce table1 --quick", "a table of the paper"},
        {"bvhbench build --builder oibvh-multi --scene torus:100000", "one tree, stage by stage"},
    };
    return "Common options may stand before or behind the command. `bvhbench help COMMAND` has its "
           "own.\n\n" +
           examples_text(examples) + '\n' + std::string(exit_codes) +
           section("Environment", environment) + section("Files", files) +
           "\nSee also: docs/getting-started.md, docs/faq.md, docs/README.md";
}

}  // namespace

void add_help(CLI::App& app)
{
    app.formatter(std::make_shared<PageFormatter>());
    app.footer(footer_of_program());
    for (const CommandEntry& entry : commands()) {
        CLI::App* command = app.get_subcommand(std::string(entry.name));
        command->formatter(app.get_formatter());
        command->group(std::string(entry.group));
        command->footer(on_page(entry.more, 0) + "\n\n" + examples_text(entry.examples) +
                        "\nOptions that all commands have, exit codes and environment: bvhbench "
                        "--help\nMore: " +
                        std::string(entry.see));
    }
}

}  // namespace bvhbench
