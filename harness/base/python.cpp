// SPDX-License-Identifier: MIT
#include "harness/base/python.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/build_info.h"
#include "process/child.h"
#include "process/interrupt.h"
#include "process/worker.h"

namespace bvhbench {
namespace {

std::filesystem::path program() { return std::filesystem::read_symlink("/proc/self/exe"); }

/// Returns the script in the named folder, else beside the installed program, else where the program was built.
std::filesystem::path commands_script()
{
    const std::string named = environment("BVHBENCH_HOME");
    const auto installed = program().parent_path().parent_path() / "share" / "bvhbench";
    const std::string built = exists(installed) ? installed : build_info.source_root;
    const auto path =
        std::filesystem::path(named.empty() ? built : named) / "plots" / "__main__.py";
    if (!std::filesystem::exists(path))
        throw Unavailable(path.string() +
                          " is not there (BVHBENCH_HOME names the folder with plots/)");
    return path;
}

constexpr const char* system_python = "/usr/bin/python3";

/// Prefers /usr/bin/python3, which sees the system's NumPy and matplotlib; another Python earlier in PATH may not.
std::string python() { return access(system_python, X_OK) == 0 ? system_python : "python3"; }

/// Returns the words that run a command of plots/. The system's Python is told to ignore what may be meant for another one
/// (PYTHONHOME, PYTHONPATH, packages of the user), with which it may not start.
std::vector<std::string> start_of(const std::vector<std::string>& command)
{
    unsetenv("MPLBACKEND");  // pictures are files, and an unknown name is refused
    std::vector<std::string> words = {python()};
    if (words.front() == system_python)
        words.emplace_back("-Es");
    words.push_back(commands_script());
    words.insert(words.end(), command.begin(), command.end());
    return words;
}

/// Runs a command of plots/ to its end. Returns how it failed, as the end of a sentence; empty if it did not.
std::string failure_of(const std::vector<std::string>& command)
{
    const std::vector<std::string> words = start_of(command);
    std::cout.flush();
    Child child({.path = python(),
                 .words = words,
                 .output = Child::Stream::inherited,
                 .errors = Child::Stream::captured});
    const AtSignal ended([&child] { child.send(SIGKILL); });
    while (child.take()) {
    }
    const ProcessEnd end = child.wait();
    std::cerr << end.output;
    if (end.how == ProcessEnd::How::exited && end.code == 0)
        return {};
    return python() + ' ' + commands_script().string() + ' ' + spelled(end, 0);
}

}  // namespace

void become_python(const std::vector<std::string>& words)
{
    std::vector<std::string> all = start_of(words);
    std::vector<char*> argv;
    for (std::string& word : all)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    setenv("BVHBENCH_PROGRAM", program().c_str(), 1);
    setenv("BVHBENCH_HOST_BYTES", std::to_string(host_memory_left()).c_str(), 1);
    execvp(argv.front(), argv.data());
    throw Unavailable(all.front() + " cannot be run: " + std::strerror(errno));
}

void print_tables(const std::string& document, const CommonOptions& common)
{
    if (common.quiet)
        return;
    const MemoryFile file(document);
    std::vector<std::string> words = {"show", file.path()};
    if (common.wide)
        words.emplace_back("--wide");
    const std::string failure = failure_of(words);
    if (!failure.empty())
        throw Unavailable("no tables were printed, " + failure);
}

std::string draw(const std::filesystem::path& file, const std::filesystem::path& folder, bool force)
{
    std::vector<std::string> words = {"plot", file.string(), "--out", folder.string()};
    if (force)
        words.emplace_back("--force");
    std::string failure;
    try {
        failure = failure_of(words);
    } catch (const Unavailable& error) {
        failure = error.what();
    }
    return failure.empty() ? ""
                           : "nothing was drawn, " + failure +
                                 "; where Python and matplotlib are, draw it with: bvhbench plot " +
                                 file.string() + " --out " + folder.string() + '\n';
}

}  // namespace bvhbench
