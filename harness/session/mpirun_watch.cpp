// SPDX-License-Identifier: MIT
#include "harness/session/mpirun_watch.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

constexpr double most_s = 50, grace_s = 10;
constexpr auto while_starting = 20ms, while_running = 200ms;
constexpr auto killing = 10s;

/// A process that has not ended.
struct Process {
    pid_t id = 0, parent = 0;
};

/// Returns the process, by its file `stat`; nothing if it has ended.
std::optional<Process> process_of(const std::filesystem::path& folder)
{
    std::ifstream file(folder / "stat");
    const std::string text(std::istreambuf_iterator<char>(file), {});
    // "12 (name) S 3 ...": the name can have any characters.
    std::istringstream rest(text.substr(std::min(text.rfind(')') + 1, text.size())));
    Process process;
    char state = 'X';
    std::from_chars(text.data(), text.data() + text.size(), process.id);
    if (!(rest >> state >> process.parent) || state == 'Z' || state == 'X')
        return std::nullopt;
    return process;
}

std::vector<Process> all_processes()
{
    std::vector<Process> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc"))
        if (const char first = entry.path().filename().string().front();
            first >= '0' && first <= '9')
            if (const auto process = process_of(entry.path()))
                all.push_back(*process);
    return all;
}

std::filesystem::path folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

bool runs_this_program(pid_t process)
{
    std::error_code error;
    const auto other = std::filesystem::read_symlink(folder_of(process) / "exe", error);
    return !error && other == std::filesystem::read_symlink("/proc/self/exe");
}

/// Returns the processes below this one, parents before their children.
std::vector<pid_t> descendants()
{
    const std::vector<Process> all = all_processes();
    std::vector<pid_t> below = {getpid()};
    for (std::size_t k = 0; k < below.size(); ++k)
        for (const Process& process : all)
            if (process.parent == below[k])
                below.push_back(process.id);
    below.erase(below.begin());
    return below;
}

}  // namespace

MpirunWatch::MpirunWatch(pid_t mpirun, unsigned ranks, double time_limit_s)
    : mpirun_(mpirun)
    , wanted_(ranks)
    , limit_(grace_s + (time_limit_s > 0 ? std::min(time_limit_s, most_s) : most_s))
{}

MpirunWatch::State MpirunWatch::state()
{
    const auto now = Clock::now();
    if (ranks_.size() < wanted_)
        for (const Process& process : all_processes())
            if (process.parent == mpirun_ && std::ranges::count(ranks_, process.id) == 0 &&
                runs_this_program(process.id))
                ranks_.push_back(process.id);
    const auto runs = [](pid_t rank) { return process_of(folder_of(rank)).has_value(); };
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

void adopt_descendants() { prctl(PR_SET_CHILD_SUBREAPER, 1); }

void end_descendants(std::chrono::seconds grace)
{
    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto from = now() + grace;
    for (std::vector<pid_t> below = descendants(); !below.empty() && now() < from + killing;
         below = descendants()) {
        if (now() >= from)
            for (const pid_t process : below)
                kill(process, SIGKILL);
        std::this_thread::sleep_for(while_starting);
    }
}

}  // namespace bvhbench
