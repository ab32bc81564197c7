// SPDX-License-Identifier: MIT
#include "harness/commands/command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <ranges>
#include <span>
#include <sstream>

#include "geometry/host_memory.h"
#include "geometry/names.h"
#include "harness/base/build_info.h"
#include "harness/base/failure.h"
#include "harness/base/python.h"
#include "harness/base/terminal.h"
#include "harness/choice/outside.h"
#include "harness/commands/words.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

/// Throws BadUsage if an output option has an empty value, which would otherwise silently write nothing.
void check_outputs_are_named(const CLI::App& command)
{
    for (const char* output : {"--out", "--json", "--dump", "--pairs", "--contacts"})
        if (const CLI::Option* option = command.get_option_no_throw(output);
            option != nullptr && option->count() > 0 && option->results().back().empty())
            throw BadUsage(std::string(output) + " names no file or folder");
}

/// Returns `code` if everything printed was written. Throws Unavailable if not.
int printed(int code)
{
    if (!std::cout.flush())
        throw Unavailable("standard output cannot be written: what was printed is lost");
    return code;
}

/// Returns the position in `argv` of the first word that is neither an option nor an option's value; `argc` without one.
int command_place(int argc, const char* const* argv)
{
    CommonOptions ignored;
    CLI::App app;
    add_common(app, ignored);
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!word.starts_with('-'))
            return i;
        const CLI::Option* option = app.get_option_no_throw(word);
        i += option != nullptr && option->get_items_expected_max() > 0 ? 1 : 0;
    }
    return argc;
}

/// The parsed command line.
class Parsed {
public:
    Parsed(int argc, const char* const* argv) : invocation_{{}, {argv, argv + argc}}
    {
        add_common(app_, invocation_.common);
        app_.set_version_flag("--version", std::string("bvhbench ") + build_info.version);
        app_.require_subcommand(0, 1);
        app_.fallthrough();  // allows common options after the command's own
        for (const CommandEntry& entry : commands()) {
            CLI::App* words =
                app_.add_subcommand(std::string(entry.name), std::string(entry.summary));
            if (entry.make != nullptr)
                (made_[words] = entry.make())->add_options(*words);
        }
        add_help(app_);
        try {
            app_.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            const std::string command = check_names(argc, argv);
            std::ostringstream out;
            if (app_.exit(error, out, out) != 0)
                throw BadUsage(error.what() + ("; `bvhbench help" + command) +
                               "` says what it takes");
            to_print_ = out.str();
            return;
        }
        const std::vector<std::string_view> listed = listed_commands();
        if (app_.get_subcommands().empty())
            throw BadUsage("name a command: " + joined(listed) +
                           "; `bvhbench --help` says what they do");
        check_outputs_are_named(*app_.get_subcommands().front());
        for (const CLI::Option* option : app_.get_options())
            for (const std::string& value : option->results())
                invocation_.common.given.push_back(option->get_name() + '=' + value);
    }

    int run()
    {
        if (!to_print_.empty()) {
            std::cout << to_print_;
            return printed(0);
        }
        const auto run_command = [this] {
            limit_host_memory(invocation_.common.memory_limit);
            for (const std::string& failure : start_outside(invocation_.common))
                std::cerr << "bvhbench: " << failure << '\n';
            return printed(made_.at(app_.get_subcommands().front())->run(invocation_));
        };
        return supervised(invocation_.common.time_limit_s,
                          [&] { return exit_code_of(run_command); });
    }

private:
    /// Returns the command, behind a blank; an empty string if there is none. Throws BadUsage if the first word that is no option is no
    /// command, or if a word behind it is an option that the command lacks. The parser would complain of what is missing first.
    std::string check_names(int argc, const char* const* argv) const
    {
        const int place = command_place(argc, argv);
        if (place == argc)
            return {};
        if (find_name(commands(), argv[place]) == nullptr)
            throw BadUsage("no command is called '" + std::string(argv[place]) + '\'' +
                           there_are(argv[place], listed_commands()));
        const CLI::App& command = *app_.get_subcommand(argv[place]);
        for (const std::string_view word : std::span(argv + place, argv + argc)) {
            const std::string name(word.substr(0, word.find('=')));
            if (name.starts_with("--") && app_.get_option_no_throw(name) == nullptr &&
                command.get_option_no_throw(name) == nullptr)
                refuse_option(name, command);
        }
        return ' ' + command.get_name();
    }
    [[noreturn]] void refuse_option(const std::string& name, const CLI::App& command) const
    {
        std::vector<std::string> known;
        for (const CLI::App* each : {&command, &app_})
            for (const CLI::Option* option : each->get_options())
                for (const std::string& one : option->get_lnames())
                    known.push_back("--" + one);
        const std::vector<std::string_view> all(known.begin(), known.end());
        const std::string_view meant = nearest_name(name, all);
        throw BadUsage("there is no option " + name + "; " +
                       (meant.empty() ? "`bvhbench " + command.get_name() + " --help` lists them"
                                      : "did you mean " + std::string(meant) + "?"));
    }

    static std::vector<std::string_view> listed_commands()
    {
        const auto is_listed = [](const CommandEntry& entry) { return !entry.group.empty(); };
        return names_of(commands() | std::views::filter(is_listed));
    }

    CLI::App app_{"Compare builders of bounding volume hierarchies for collision detection.",
                  "bvhbench"};
    Invocation invocation_;
    std::map<const CLI::App*, std::unique_ptr<Command>> made_;
    std::string to_print_;
};

}  // namespace

int exit_code_of(const std::function<int()>& work)
{
    try {
        return work();
    } catch (const std::exception& error) {
        std::cerr << "bvhbench: " << sentence_of(error) << '\n';
        return dynamic_cast<const BadUsage*>(&error) != nullptr          ? 2
               : dynamic_cast<const NothingMeasured*>(&error) != nullptr ? 4
                                                                         : 3;
    }
}

int run_program(int argc, const char* const* argv)
{
    const PrintableOutput output(std::cout), errors(std::cerr);
    return exit_code_of([&] {
        const int place = command_place(argc, argv);
        const std::string command = place < argc ? argv[place] : "";
        if (command == "help") {  // help COMMAND is COMMAND --help
            std::vector<const char*> words(argv, argv + argc);
            words.erase(words.begin() + place);
            words.push_back("--help");
            return run_program(argc, words.data());
        }
        if (const CommandEntry* entry = find_name(commands(), command);
            entry != nullptr && entry->make == nullptr) {
            std::vector<std::string> words(argv + 1, argv + argc);
            std::rotate(words.begin(), words.begin() + place - 1, words.begin() + place);
            become_python(words);
        }
        return Parsed(argc, argv).run();
    });
}

void check_words(int argc, const char* const* argv) { Parsed(argc, argv); }

}  // namespace bvhbench
