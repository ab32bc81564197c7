// SPDX-License-Identifier: MIT
//
// What a command is: its words on the command line, its help, and what it does. A command is a file here and a line in
// commands.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/common_options.h"

namespace CLI {
class App;
}

namespace bvhbench {

/// What the user typed, besides the command's own options.
struct Invocation {
    CommonOptions common;
    std::vector<std::string> words;  ///< argv, for the result file
};

class Command {
public:
    virtual ~Command() = default;

    /// Adds the command's options; parsing sets its members.
    virtual void add_options(CLI::App& app) = 0;

    /// Returns the exit code: 0 done, 1 a check differs. Errors are thrown.
    virtual int run(const Invocation& invocation) = 0;
};

/// A command line that does something, and what.
struct HelpExample {
    std::string_view line;  ///< as a shell takes it; words without quotes or blanks in them
    std::string_view what;
};

/// A line of `bvhbench --help`.
struct CommandEntry {
    std::string_view name;
    std::string_view group =
        {};                    ///< with which others it is listed; empty: for programs, not listed
    std::string_view summary;  ///< one line
    std::string_view more = {};  ///< sentences of its help
    std::vector<HelpExample> examples = {};
    std::string_view see = {};  ///< the document that has more
    /// nullptr: it reads result files and is written in Python, plots/commands/.
    std::unique_ptr<Command> (*make)() = nullptr;
};

constexpr std::string_view measuring = "Measure";
constexpr std::string_view looking = "Look at results";
constexpr std::string_view holding = "Hold to promises";
constexpr std::string_view knowing = "Know what there is";

/// Every command, in the order in which help lists them.
std::span<const CommandEntry> commands();

/// Has `--help` of the program and of each of its commands show what commands() say of them, wrapped.
void add_help(CLI::App& app);

template <class Of>
std::unique_ptr<Command> make_command()
{
    return std::make_unique<Of>();
}

}  // namespace bvhbench
