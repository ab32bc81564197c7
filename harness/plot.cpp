// SPDX-License-Identifier: MIT
#include "harness/plot.h"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "geometry/error.h"
#include "harness/build_info.h"
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

/// Exit status of a command run to its end, its standard error in `errors` if that is wanted; -1 if it was not.
int run_command(std::vector<std::string> words, std::string* errors = nullptr)
{
    std::cout.flush();
    try {
        const std::string program = words.front();
        Child child(
            {.path = program,
             .words = std::move(words),
             .output = Child::Stream::inherited,
             .errors = errors != nullptr ? Child::Stream::captured : Child::Stream::inherited});
        while (errors != nullptr && child.take()) {
        }
        const ProcessEnd end = child.wait();
        if (errors != nullptr)
            *errors = end.output;
        return end.how == ProcessEnd::How::exited ? end.code : -1;
    } catch (const Unavailable&) {
        return -1;
    }
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
    const int status = run_command(std::move(words));
    if (status < 0)
        throw Unavailable(python() + ' ' + path.string() + " could not be run to its end");
    return status;
}

std::string draw(const std::string& script, const std::filesystem::path& file,
                 const std::filesystem::path& folder)
{
    const std::string elsewhere =
        "; where Python and matplotlib are, draw it with: python3 plots/" + script + ' ' +
        file.string() + " --out " + folder.string();
    const std::filesystem::path path = home() / "plots" / script;
    if (!std::filesystem::exists(path))
        return "nothing was drawn, " + path.string() +
               " is not there (BVHBENCH_HOME names the folder with plots/)" + elsewhere;
    const int status =
        run_command({python(), path.string(), file.string(), "--out", folder.string()});
    if (status != 0)
        return "nothing was drawn, " + python() + ' ' + path.string() +
               (status < 0 ? " could not be run" : " ended with " + std::to_string(status)) +
               elsewhere;
    return "drawn into " + folder.string();
}

Drawn draw_all(const std::vector<std::string>& files, const std::filesystem::path& folder)
{
    const std::filesystem::path path = home() / "plots" / "all.py";
    if (!std::filesystem::exists(path))
        return {.why =
                    path.string() + " is not there (BVHBENCH_HOME names the folder with plots/)"};
    std::vector<std::string> words = {python(), path.string(), "--out", folder.string(), "--"};
    words.insert(words.end(), files.begin(), files.end());
    std::string errors;
    const int status = run_command(std::move(words), &errors);
    if (status == 0)
        return {.all = true};
    errors = joined_lines(errors);
    return {.why = !errors.empty() && status == 1
                       ? errors
                       : python() + ' ' + path.string() +
                             (status < 0 ? " could not be run"
                                         : " ended with " + std::to_string(status)) +
                             (errors.empty() ? "" : ": " + errors)};
}

}  // namespace bvhbench
