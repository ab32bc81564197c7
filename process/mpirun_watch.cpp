// SPDX-License-Identifier: MIT
#include "process/mpirun_watch.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

constexpr double most_s = 50, grace_s = 10;
constexpr auto while_starting = 20ms, while_running = 200ms;

std::filesystem::path folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

/// Returns the parent of a process, by its file `stat`; nothing if the process has ended.
std::optional<pid_t> parent_of(pid_t process)
{
    std::ifstream file(folder_of(process) / "stat");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    // "12 (name) S 3 ...": the name can have any characters.
    std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size())));
    char state = 'X';
    pid_t parent = 0;
    if (!(rest >> state >> parent) || state == 'Z' || state == 'X')
        return std::nullopt;
    return parent;
}

bool runs_this_program(pid_t process)
{
    std::error_code error;
    const auto other = std::filesystem::read_symlink(folder_of(process) / "exe", error);
    return !error && other == std::filesystem::read_symlink("/proc/self/exe");
}

}  // namespace

MpirunWatch::MpirunWatch(pid_t mpirun, const ProcessFamily& family, unsigned ranks,
                         double time_limit_s)
    : mpirun_(mpirun)
    , family_(family)
    , wanted_(ranks)
    , limit_(grace_s + (time_limit_s > 0 ? std::min(time_limit_s, most_s) : most_s))
{}

MpirunWatch::State MpirunWatch::state()
{
    const auto now = Clock::now();
    if (ranks_.size() < wanted_)
        for (const pid_t process : family_.processes())
            if (parent_of(process) == mpirun_ && std::ranges::count(ranks_, process) == 0 &&
                runs_this_program(process))
                ranks_.push_back(process);
    const auto runs = [](pid_t process) { return parent_of(process).has_value(); };
    if (!ended_ && !(runs(mpirun_) && std::ranges::all_of(ranks_, runs)))
        ended_ = now;
    if (ended_)
        return now - *ended_ > limit_ ? State::ends_too_few : State::ranks_run;
    return ranks_.size() < wanted_ && now - started_ > limit_ ? State::starts_too_few
                                                              : State::ranks_run;
}

std::chrono::milliseconds MpirunWatch::pause() const
{
    return ranks_.size() < wanted_ && !ended_ ? while_starting : while_running;
}

}  // namespace bvhbench
