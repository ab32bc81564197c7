// SPDX-License-Identifier: MIT
#include "harness/session/other_processes.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace bvhbench {

void OtherProcesses::look()
{
    std::optional<int> least;
    for (int again = 0; again < 3 && least.value_or(1) > 0; ++again) {
        if (again > 0)
            std::this_thread::sleep_for(std::chrono::microseconds(50));
        std::ifstream file(path_);
        std::string load;
        int runnable = 0;
        if (!(file >> load >> load >> load >> runnable))  // "0.20 0.18 0.12 1/80 11206"
            return;
        least = std::min(least.value_or(runnable), std::max(0, runnable - 1));
    }
    sum_ += *least;
    ++looks_;
}

std::optional<double> OtherProcesses::mean() const
{
    return looks_ > 0 ? std::optional(sum_ / looks_) : std::nullopt;
}

}  // namespace bvhbench
