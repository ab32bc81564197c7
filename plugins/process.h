// SPDX-License-Identifier: MIT
//
// A process that runs one method from outside: started, asked, watched and ended. Whatever it does, the caller gets a reply or an
// exception.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "geometry/error.h"
#include "plugins/protocol.h"
#include "process/child.h"
#include "process/family.h"

namespace bvhbench::outside {

/// What a process from outside may take.
struct Limits {
    double call_s = 0;               ///< seconds of one call; 0: no limit
    std::uint64_t host_bytes = 0;    ///< resident memory; 0: no limit
    std::uint64_t device_bytes = 0;  ///< as it tells itself; 0: no limit
};

/// A conversation with one process. Calls are made one at a time, from the thread that started it.
class Process {
public:
    /// Starts the library's process, which has not been asked anything. Throws Unavailable if there is no such file or no process.
    Process(const Library& library, const Limits& limits);
    ~Process();
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    /// Sends a request and returns the reply. Throws Unavailable with a sentence that begins with the library's file name if the
    /// process crashes, ends, takes too long or too much memory, or says that it failed. It is then ended, and later calls throw too.
    Json ask(const Json& request);

    /// Runs `work`, which reads what was replied. If it throws, the sentence begins with the file name and the call.
    template <class Work>
    auto reading(const Work& work)
    {
        try {
            return work();
        } catch (const Unavailable& error) {
            fail(error.what());
        }
    }

    /// Returns how long the last call took on the host's clock, from the request to the reply, in nanoseconds.
    std::int64_t wall_ns() const { return wall_ns_; }

private:
    [[noreturn]] void fail(const std::string& what);
    [[noreturn]] void fail_at_end();
    void end_all();
    std::string next_line();
    void keep_errors();
    void check_resident();

    Library library_;
    Limits limits_;
    std::string call_;  ///< the last one
    int to_ = -1, errors_ = -1;
    ProcessFamily family_;          ///< it and all that it starts
    std::unique_ptr<Child> child_;  ///< null after it was ended
    std::chrono::steady_clock::time_point family_looked_ = std::chrono::steady_clock::now();
    std::string replies_, last_errors_;
    std::int64_t wall_ns_ = 0;
};

/// Starts the library's process and asks what it has. Throws Unavailable, with a sentence.
Library described(const std::string& file, bool is_program, const Limits& limits);

}  // namespace bvhbench::outside
