// SPDX-License-Identifier: MIT
//
// What a worker does first, which is this program in a child process, and how it exchanges bytes with its parent.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bvhbench {

/// A file in memory that child processes can read and write by its path while this object exists.
class MemoryFile {
public:
    /// Throws Unavailable if there is no room for the bytes.
    explicit MemoryFile(std::string_view bytes = {});
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const;

    /// Returns the size in bytes, which a child may have changed.
    std::size_t size() const;

    /// Reads `bytes` from the front of the file. False if there are fewer.
    bool read(void* to, std::size_t bytes) const;

private:
    int file_;
};

/// First call of a worker: makes it end with its parent, disables core files, and limits its memory to `memory_bytes`, or to
/// host_memory_left() if that is less. Throws Unavailable if the worker already has more.
void limit_worker(std::size_t memory_bytes);

/// Reserves standard output for the worker's answer: other output to it or to standard error is discarded from now on. Returns
/// the file descriptor for the answer.
int take_standard_output();

/// Writes all bytes, also when signals interrupt it. False if they could not be written.
bool write_all(int file, std::string_view bytes);

}  // namespace bvhbench
