// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace bvhbench {

/// A locked file that says that a process is at work. The system releases the lock however the process ends. Where a file
/// system has no locks, nobody is kept out.
class FileLock {
public:
    enum class Kind { shared, exclusive };

    /// Waits for up to `patience` for a process that holds the lock, then throws Unavailable, as where the file cannot be
    /// made; the sentence speaks of `subject`, what is locked in the user's words.
    FileLock(std::filesystem::path path, Kind kind, const std::string& subject,
             std::chrono::milliseconds patience);
    ~FileLock();
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;

    /// Removes the file when the lock is released. For exclusive locks only.
    void remove_at_end() { is_removed_ = true; }

private:
    std::filesystem::path path_;
    int file_ = -1;
    bool is_removed_ = false;
};

}  // namespace bvhbench
