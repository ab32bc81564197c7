// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace bvhbench {

/// A file that says by being locked that somebody is at work; the system unlocks it, however the process ends. Where a file
/// system has no locks, nobody is kept out.
class FileLock {
public:
    enum class Kind { shared, exclusive };

    /// Waits a moment for who holds it, then throws Unavailable, naming the folder.
    FileLock(const std::filesystem::path& path, Kind kind);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

private:
    int file_ = -1;
};

}  // namespace bvhbench
