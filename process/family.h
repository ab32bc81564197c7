// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace bvhbench {

/// A child process and all that it starts, also what it leaves behind. They are found by a variable of the environment, which each
/// process inherits.
class ProcessFamily {
public:
    ProcessFamily();

    /// Returns the variable, "NAME=value", to start the child with.
    std::string variable() const { return name_ + "=1"; }

    /// Returns the processes that have not ended.
    std::vector<pid_t> processes() const;

    /// Kills all that have not ended within `grace`. Returns when none is left, or 10 s later, because a call of a driver can keep a
    /// process.
    void end(std::chrono::seconds grace) const;

private:
    std::string name_;
};

/// Returns the resident memory of a process in bytes; 0 if it has ended.
std::uint64_t resident_bytes(pid_t process);

}  // namespace bvhbench
