// SPDX-License-Identifier: MIT
#include "harness/commands/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/build_info.h"
#include "harness/base/failure.h"
#include "harness/base/python.h"
#include "harness/base/terminal.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/session/watchdog.h"

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
            made_.push_back(entry.make != nullptr ? entry.make() : nullptr);
            if (made_.back() != nullptr)
                made_.back()->add_options(*words);
        }
        add_help(app_);
        try {
            app_.parse(argc, argv);
        } catch (const CLI::ParseError& error) {
            std::ostringstream out;
            if (app_.exit(error, out, out) != 0)
                throw BadUsage(std::string(error.what()) +
                               "; `bvhbench --help` lists what there is");
            to_print_ = out.str();
            return;
        }
        if (app_.get_subcommands().empty())
            throw BadUsage("name a command: " + names() + "; `bvhbench --help` says what they do");
        check_outputs_are_named(*app_.get_subcommands().front());
    }

    int run()
    {
        if (!to_print_.empty()) {
            std::cout << to_print_;
            return printed(0);
        }
        return supervised(invocation_.common.time_limit_s,
                          [this] { return exit_code_of([this] { return run_command(); }); });
    }

private:
    int run_command()
    {
        limit_host_memory(invocation_.common.memory_limit);
        for (std::size_t i = 0; i < made_.size(); ++i)
            if (commands()[i].name == app_.get_subcommands().front()->get_name())
                return printed(made_[i]->run(invocation_));
        return 0;
    }

    /// Returns the listed commands: "build, collide or run".
    static std::string names()
    {
        std::vector<std::string> listed;
        for (const CommandEntry& entry : commands())
            if (!entry.group.empty())
                listed.emplace_back(entry.name);
        std::string text;
        for (std::size_t k = 0; k < listed.size(); ++k)
            text += (k == 0 ? "" : k + 1 < listed.size() ? ", " : " or ") + listed[k];
        return text;
    }

    CLI::App app_{"Compare builders of bounding volume hierarchies for collision detection.",
                  "bvhbench"};
    Invocation invocation_;
    std::vector<std::unique_ptr<Command>> made_;
    std::string to_print_;
};

/// Returns the position in `argv` of a Python command: the first word that is neither an option nor an option's value. Returns 0
/// if that word is not a Python command.
int python_command(int argc, const char* const* argv)
{
    CommonOptions ignored;
    CLI::App app;
    add_common(app, ignored);
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.starts_with('-')) {
            const CLI::Option* option = app.get_option_no_throw(word);
            i += option != nullptr && option->get_type_size() > 0 ? 1 : 0;
            continue;
        }
        const auto all = commands();
        const auto entry = std::find_if(all.begin(), all.end(),
                                        [&](const CommandEntry& one) { return one.name == word; });
        return entry != all.end() && entry->make == nullptr ? i : 0;
    }
    return 0;
}

}  // namespace

int exit_code_of(const std::function<int()>& work)
{
    const auto failed = [](const std::exception& error, int code) {
        std::cerr << "bvhbench: " << sentence_of(error) << '\n';
        return code;
    };
    try {
        return work();
    } catch (const BadUsage& error) {
        return failed(error, 2);
    } catch (const NothingMeasured& error) {
        return failed(error, 4);
    } catch (const std::exception& error) {  // Unavailable, BuildFailure, cl::Error, bad_alloc
        return failed(error, 3);
    }
}

int run_program(int argc, const char* const* argv)
{
    const PrintableOutput output(std::cout), errors(std::cerr);
    return exit_code_of([&] {
        if (const int place = python_command(argc, argv); place > 0) {
            std::vector<std::string> words(argv + 1, argv + argc);
            std::rotate(words.begin(), words.begin() + place - 1, words.begin() + place);
            become_python(words);
        }
        return Parsed(argc, argv).run();
    });
}

void check_words(int argc, const char* const* argv) { Parsed(argc, argv); }

}  // namespace bvhbench
