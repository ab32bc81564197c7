// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace bvhbench {

/// A line that does something, and what.
struct HelpExample {
    std::string_view line;  ///< as a shell takes it; words without quotes or blanks in them
    std::string_view what;
};

/// What a command's help says besides its options.
struct CommandHelp {
    std::string_view command;
    std::string_view group;  ///< with whom it is listed
    std::string_view more;   ///< sentences, wrapped when they are shown
    std::vector<HelpExample> examples;
    std::string_view see;  ///< the document that has more
};

/// Every command's, in the order in which they are listed.
std::span<const CommandHelp> command_helps();

/// Have `--help` of the program and of each of its commands show them, wrapped. Throws std::logic_error for a command that
/// has none.
void add_help(CLI::App& app);

}  // namespace bvhbench
