// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

namespace bvhbench {

/// How many other processes want to run while this one samples. Between two samples its own threads wait, those of the OpenCL
/// driver included, so whatever is runnable then belongs to others.
class OtherProcesses {
public:
    /// Reads proc/loadavg below `root`.
    explicit OtherProcesses(const std::filesystem::path& root = "/") : path_(root / "proc/loadavg")
    {}

    /// Counts the runnable threads of the machine, but for the one that calls it: the least of three counts within 0.1 ms, because the
    /// driver's threads may be about to sleep. Does nothing where the host does not tell.
    void look();

    /// Returns the mean of the counts; nothing if there is none.
    std::optional<double> mean() const;

private:
    std::filesystem::path path_;
    double sum_ = 0;
    int looks_ = 0;
};

}  // namespace bvhbench
