// SPDX-License-Identifier: MIT
#include "harness/base/python.h"

#include <re2/re2.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "geometry/error.h"
#include "harness/base/build_info.h"
#include "harness/base/interrupt.h"
#include "scenes/worker/process.h"

namespace bvhbench {
namespace {

std::filesystem::path plots()
{
    const char* variable = std::getenv("BVHBENCH_HOME");
    const std::filesystem::path home =
        variable != nullptr && *variable != '\0' ? variable : build_info.source_root;
    return home / "plots";
}

std::filesystem::path script_called(const std::string& name)
{
    const std::filesystem::path path = plots() / name;
    if (!std::filesystem::exists(path))
        throw Unavailable(path.string() +
                          " is not there (BVHBENCH_HOME names the folder with plots/)");
    return path;
}

/// Prefers /usr/bin/python3, which sees the system's NumPy and matplotlib; another Python earlier in PATH may not.
std::string python()
{
    return access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

/// Runs a command to its end. Returns how it ended, with its standard error in `output`, which is empty if the command could not
/// be started.
ProcessEnd run_command(std::vector<std::string> words)
{
    std::cout.flush();
    const std::string program = words.front();
    Child child({.path = program,
                 .words = std::move(words),
                 .output = Child::Stream::inherited,
                 .errors = Child::Stream::captured});
    const AtSignal ended([&child] { child.send(SIGKILL); });
    while (child.take()) {
    }
    return child.wait();
}

/// Returns the module named by a ModuleNotFoundError in `errors`; empty if there is none.
std::string missing_module(const std::string& errors)
{
    std::string name;
    RE2::PartialMatch(errors, "(?s).*ModuleNotFoundError: No module named '([^']*)'", &name);
    return name;
}

/// Returns the end of a sentence that says why a script failed. Prints the script's errors, except where a missing module
/// explains the failure.
std::string how_it_ended(const std::filesystem::path& script, const ProcessEnd& end)
{
    if (const std::string module = missing_module(end.output); !module.empty())
        return python() + " has no module " + module;
    std::cerr << end.output;
    return python() + ' ' + script.string() +
           (end.how == ProcessEnd::How::exited ? " ended with " + std::to_string(end.code)
                                               : " could not be run to its end");
}

bool is_done(const ProcessEnd& end) { return end.how == ProcessEnd::How::exited && end.code == 0; }

}  // namespace

void become_python(const std::vector<std::string>& words)
{
    std::vector<std::string> all = {python(), plots().string()};
    script_called("__main__.py");
    all.insert(all.end(), words.begin(), words.end());
    std::vector<char*> argv;
    for (std::string& word : all)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    setenv("BVHBENCH_PROGRAM", program.c_str(), 1);
    execvp(argv.front(), argv.data());
    throw Unavailable(all.front() + " cannot be run: " + std::strerror(errno));
}

void print_tables(const std::string& document)
{
    const std::filesystem::path script = script_called("__main__.py");
    const MemoryFile file(document);
    const ProcessEnd end = run_command({python(), plots().string(), "show", file.path()});
    if (!is_done(end))
        throw Unavailable("no tables were printed, " + how_it_ended(script, end));
    std::cerr << end.output;
}

std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder, bool force)
{
    const std::string elsewhere =
        "; where Python and matplotlib are, draw it with: python3 plots/" + script + ' ' +
        file.string() + " --out " + folder.string();
    try {
        const std::filesystem::path path = script_called(script);
        std::vector<std::string> words = {python(), path.string(), file.string(), "--out",
                                          folder.string()};
        if (force)
            words.push_back("--force");
        const ProcessEnd end = run_command(std::move(words));
        if (!is_done(end))
            return "nothing was drawn, " + how_it_ended(path, end) + elsewhere;
        std::cerr << end.output;
        return "drawn into " + folder.string();
    } catch (const Unavailable& error) {
        return std::string("nothing was drawn, ") + error.what() + elsewhere;
    }
}

}  // namespace bvhbench
