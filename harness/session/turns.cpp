// SPDX-License-Identifier: MIT
#include "harness/session/turns.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "process/worker.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

constexpr auto longest_wait = 120s;
constexpr auto longest_yield = 20ms;  // afterwards the other runs are taken to be finished

std::vector<std::string> lines_in(const std::string& path)
{
    std::vector<std::string> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

}  // namespace

Turns::Turns(std::string path, int count, std::string id)
    : path_(std::move(path)), count_(count), id_(std::move(id))
{
    if (lines_in(path_).size() >= static_cast<std::size_t>(count_))
        throw BadUsage("--turns: " + path_ +
                       " has been used by others; name a file that is not there");
    descriptor_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
        cannot_write("--turns: " + path_);
}

Turns::~Turns() { close(descriptor_); }

void Turns::meet()
{
    if (!all_come())
        throw Unavailable("--turns: not all of " + std::to_string(count_) + " runs came to " +
                          path_ + " within two minutes");
}

void Turns::part()
{
    reason_of_failure([&] { all_come(); });  // e.g. a full disk; the next meet() throws
}

bool Turns::all_come()
{
    if (!write_all(descriptor_, id_ + '\n'))
        cannot_write("--turns: " + path_);
    ++meetings_;
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
        const std::vector<std::string> lines = lines_in(path_);
        if (lines.size() >=
            static_cast<std::size_t>(count_) * static_cast<std::size_t>(meetings_)) {
            others_.insert(lines.begin(), lines.end());
            others_.erase(id_);
            return true;
        }
        if (std::chrono::steady_clock::now() - start > longest_wait)
            return false;
        std::this_thread::sleep_for(2ms);
    }
}

Turns::Turn::Turn(Turns* turns) : turns_(turns)
{
    if (turns_ == nullptr)
        return;
    const std::string last_file = turns_->path_ + ".last";
    const auto lock = [&] {
        while (flock(turns_->descriptor_, LOCK_EX) != 0 && errno == EINTR) {
        }
    };
    lock();
    // flock prefers the process that has just released the lock, because the waiting ones must first wake up. So yield to them.
    const auto start = std::chrono::steady_clock::now();
    while (lines_in(last_file) == std::vector{turns_->id_} &&
           std::chrono::steady_clock::now() - start < longest_yield) {
        flock(turns_->descriptor_, LOCK_UN);
        std::this_thread::sleep_for(200us);
        lock();
    }
    std::ofstream(last_file) << turns_->id_ << '\n';
}

Turns::Turn::~Turn()
{
    if (turns_ != nullptr)
        flock(turns_->descriptor_, LOCK_UN);
}

}  // namespace bvhbench
