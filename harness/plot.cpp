// SPDX-License-Identifier: MIT
#include "harness/plot.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <vector>

#include "harness/build_info.h"

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

/// Exit status of a command run to its end, or -1 if it could not be started.
int run_command(std::vector<std::string> words)
{
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    std::cout.flush();
    if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0)
        return -1;
    int status = 0;
    if (waitpid(child, &status, 0) != child || !WIFEXITED(status))
        return -1;
    return WEXITSTATUS(status);
}

}  // namespace

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

}  // namespace bvhbench
