// SPDX-License-Identifier: MIT
#include "harness/plot.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string_view>

#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/interrupt.h"
#include "scenes/worker/child.h"

namespace bvhbench {
namespace {

std::filesystem::path home()
{
    const char* variable = std::getenv("BVHBENCH_HOME");
    return variable != nullptr && *variable != '\0' ? variable : build_info.source_root;
}

/// The system's own Python has the system's matplotlib; one found earlier in PATH may not.
std::string python()
{
    return access("/usr/bin/python3", X_OK) == 0 ? "/usr/bin/python3" : "python3";
}

/// Exit status of a command run to its end, -1 if it was not, and its standard error in `errors`.
int run_command(std::vector<std::string> words, std::string& errors)
{
    std::cout.flush();
    try {
        const std::string program = words.front();
        Child child({.path = program,
                     .words = std::move(words),
                     .output = Child::Stream::inherited,
                     .errors = Child::Stream::captured});
        const AtSignal ended([&child] { child.send(SIGKILL); });
        while (child.take()) {
        }
        const ProcessEnd end = child.wait();
        errors = end.output;
        return end.how == ProcessEnd::How::exited ? end.code : -1;
    } catch (const Unavailable&) {
        return -1;
    }
}

/// The module that Python did not find, if that is what its last line says.
std::string missing_module(const std::string& errors)
{
    constexpr std::string_view mark = "\nModuleNotFoundError: No module named '";
    const std::size_t at = errors.rfind(mark);
    if (at == errors.npos)
        return {};
    const std::size_t name = at + mark.size();
    return errors.substr(name, errors.find('\'', name) - name);
}

/// What became of a script that did not end with 0, as the end of a sentence; what it said of it is printed, unless it is that a
/// module is missing.
std::string how_it_ended(const std::string& script, int status, const std::string& errors)
{
    if (const std::string module = missing_module(errors); !module.empty())
        return python() + " has no module " + module;
    std::cerr << errors;
    return python() + ' ' + script +
           (status < 0 ? " could not be run to its end" : " ended with " + std::to_string(status));
}

/// Lines as one sentence.
std::string joined_lines(const std::string& text)
{
    std::string joined;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (!line.empty())
            joined += (joined.empty() ? "" : "; ") + line;
    return joined;
}

}  // namespace

int run_plots_script(const std::string& script, std::vector<std::string> words)
{
    const std::filesystem::path path = home() / "plots" / script;
    if (!std::filesystem::exists(path))
        throw Unavailable(path.string() +
                          " is not there (BVHBENCH_HOME names the folder with plots/)");
    words.insert(words.begin(), {python(), path.string()});
    std::string errors;
    const int status = run_command(std::move(words), errors);
    if (status < 0 || !missing_module(errors).empty())
        throw Unavailable(how_it_ended(path.string(), status, errors));
    std::cerr << errors;
    return status;
}

std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder, bool force)
{
    const std::string elsewhere =
        "; where Python and matplotlib are, draw it with: python3 plots/" + script + ' ' +
        file.string() + " --out " + folder.string();
    const std::filesystem::path path = home() / "plots" / script;
    if (!std::filesystem::exists(path))
        return "nothing was drawn, " + path.string() +
               " is not there (BVHBENCH_HOME names the folder with plots/)" + elsewhere;
    std::vector<std::string> words = {python(), path.string(), file.string(), "--out",
                                      folder.string()};
    if (force)
        words.push_back("--force");
    std::string errors;
    const int status = run_command(std::move(words), errors);
    if (status != 0)
        return "nothing was drawn, " + how_it_ended(path.string(), status, errors) + elsewhere;
    std::cerr << errors;
    return "drawn into " + folder.string();
}

void draw_all(const std::vector<std::string>& files, const std::filesystem::path& folder,
              bool force)
{
    const std::filesystem::path path = home() / "plots" / "all.py";
    if (!std::filesystem::exists(path))
        throw Unavailable(path.string() +
                          " is not there (BVHBENCH_HOME names the folder with plots/)");
    std::vector<std::string> words = {python(), path.string(), "--out", folder.string()};
    if (force)
        words.push_back("--force");
    words.push_back("--");
    words.insert(words.end(), files.begin(), files.end());
    std::string errors;
    const int status = run_command(std::move(words), errors);
    if (status == 0) {
        std::cerr << errors;
        return;
    }
    const bool says_why = (status == 2 || status == 3) && !errors.empty();
    const std::string why =
        says_why ? joined_lines(errors) : how_it_ended(path.string(), status, errors);
    if (status == 2)
        throw BadUsage(why);
    throw Unavailable(why);
}

}  // namespace bvhbench
