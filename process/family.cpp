// SPDX-License-Identifier: MIT
#include "process/family.h"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

namespace bvhbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds between_looks(5);
constexpr std::chrono::seconds killing(10);

bool has_variable(const std::filesystem::path& folder, const std::string& variable)
{
    std::ifstream file(folder / "environ");
    for (std::string one; std::getline(file, one, '\0');)
        if (one == variable)
            return true;
    return false;
}

}  // namespace

ProcessFamily::ProcessFamily()
{
    static std::atomic<unsigned> number = 0;
    name_ = "BVHBENCH_FAMILY_" + std::to_string(getpid()) + '_' + std::to_string(++number);
}

std::vector<pid_t> ProcessFamily::processes() const
{
    std::vector<pid_t> found;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const pid_t process = std::atoi(entry.path().filename().c_str());
        if (process > 0 && has_variable(entry.path(), variable()))
            found.push_back(process);
    }
    return found;
}

void ProcessFamily::end(std::chrono::seconds grace) const
{
    const auto from = Clock::now() + grace;
    for (auto left = processes(); !left.empty() && Clock::now() < from + killing;
         left = processes()) {
        if (Clock::now() >= from)
            for (const pid_t process : left)
                kill(process, SIGKILL);
        std::this_thread::sleep_for(between_looks);
    }
}

std::uint64_t resident_bytes(pid_t process)
{
    std::ifstream file("/proc/" + std::to_string(process) + "/statm");
    std::uint64_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace bvhbench
