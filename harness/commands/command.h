// SPDX-License-Identifier: MIT
//
// A command: its options, its help, and its work. Each command is a file in this folder and a line in commands.cpp. The program
// parses a command line and runs its command.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/common_options.h"

namespace CLI {
class App;
}

namespace bvhbench {

/// The parsed command line, without the command's own options.
struct Invocation {
    CommonOptions common;
    std::vector<std::string> words;  ///< argv, stored in the result file
};

class Command {
public:
    virtual ~Command() = default;

    /// Adds the command's options to `app`. Parsing sets members of this object.
    virtual void add_options(CLI::App&) {}

    /// Runs the command. Returns the exit code: 0 for success, 1 if a check differs. Throws on errors.
    virtual int run(const Invocation& invocation) = 0;
};

/// A name in the help, or an example of a command line for a shell, whose words contain no quotes or blanks; and what it does.
struct HelpLine {
    std::string_view name, what;
};

/// A command as shown by `bvhbench --help`.
struct CommandEntry {
    std::string_view name;
    std::string_view group = {};  ///< heading in the list; empty: internal, not listed
    std::string_view summary;     ///< one line
    std::string_view more = {};   ///< more sentences for its own help
    std::vector<HelpLine> examples = {};
    std::string_view see = {};  ///< document with more information
    /// nullptr for a command in Python, plots/commands/.
    std::unique_ptr<Command> (*make)() = nullptr;
};

constexpr std::string_view measuring = "Measure";
constexpr std::string_view looking = "Look at results";
constexpr std::string_view checking = "Check";
constexpr std::string_view knowing = "Know what there is";

/// Returns every command, in the order of the help.
std::span<const CommandEntry> commands();

/// Returns the text of a file of plots/commands/, by its path from the source root; nothing if there is none.
std::optional<std::string_view> python_command(std::string_view path);

/// Sets the `--help` texts of the program and of each command from commands(), with wrapped lines.
void add_help(CLI::App& app);

/// Parses `argv`, runs the command and returns the exit code: 0 success, 1 a check differs, 2 wrong usage, 3 no device, file,
/// library or memory, 4 nothing was measured. Prints errors as one sentence on standard error. May be called repeatedly; a
/// command in Python replaces the process.
int run_program(int argc, const char* const* argv);

/// Runs `work` and returns its exit code. Prints an exception as one sentence on standard error and returns the exit code for it.
int exit_code_of(const std::function<int()>& work);

/// Parses `argv` without running anything. Throws BadUsage with one sentence if it is invalid.
void check_words(int argc, const char* const* argv);

template <class Of>
std::unique_ptr<Command> make_command()
{
    return std::make_unique<Of>();
}

}  // namespace bvhbench
