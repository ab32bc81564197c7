// SPDX-License-Identifier: MIT
//
// Terminal output: escapes control characters and shows the progress of long runs.
#pragma once

#include <unistd.h>

#include <chrono>
#include <functional>
#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace bvhbench {

/// Returns `text` with control characters, and those that change the direction of writing, written as \x1b or \u202e, because
/// names of files and scenes may contain some and a terminal would obey them. Line ends and tabs are kept.
std::string printable(std::string_view text);

/// Escapes everything written to `stream` with printable() for the lifetime of this object.
class PrintableOutput : public std::streambuf {
public:
    explicit PrintableOutput(std::ostream& stream) : stream_(stream), to_(stream.rdbuf(this)) {}
    ~PrintableOutput() override { stream_.rdbuf(to_); }
    PrintableOutput(const PrintableOutput&) = delete;
    PrintableOutput& operator=(const PrintableOutput&) = delete;

private:
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int overflow(int c) override;
    int sync() override { return to_->pubsync(); }

    std::ostream& stream_;
    std::streambuf* to_;
};

/// Returns the columns of the terminal that the file descriptor is, at least 40; 0 if it is no terminal. COLUMNS takes precedence.
std::size_t terminal_width(int file = STDOUT_FILENO);

/// Returns the number of characters, not bytes.
std::size_t character_count(std::string_view text);

/// Returns how far some work is after `seconds`, as "what, about 8 s left, 400 of 2000 are done"; with nothing done, as "what, 2 s".
std::string so_far(const std::string& what, int seconds, std::size_t done, std::size_t total);

/// Returns a time, rounded up: "12 s", "3 min", "5 h".
std::string rough(double seconds);

/// Clears the progress line.
constexpr const char* clear_line = "\r\033[K";

/// Takes what is being done, and which share of the current item is done; 0: unknown.
using Note = std::function<void(const std::string& what, double share)>;

/// A progress line on stderr, no wider than the terminal; where stderr is no terminal, a line at most every 30 seconds. Once something is
/// done it has the time to go: the rest of the items takes as long as those before, or as the current one if it is the first.
class Progress {
public:
    explicit Progress(std::size_t total);
    ~Progress() { clear(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows that the next of the `total` items has begun.
    void step(const std::string& what);

    /// Changes the text shown for the current item. The share is how much of it is done; 0: unknown. Notes with a
    /// share are shown a few times a second.
    void note(const std::string& what, double share = 0);

    /// Counts an item that needs no work.
    void pass() { ++begun_, ++passed_; }

    /// Removes the line, before other output.
    void clear() const;

private:
    using Clock = std::chrono::steady_clock;

    double seconds_left(double share, Clock::time_point now) const;

    std::size_t total_;
    std::size_t begun_ = 0;
    std::size_t passed_ = 0;  ///< number of those that needed no work
    bool is_shown_;
    Clock::time_point start_ = Clock::now(), item_start_ = start_, shown_;
};

}  // namespace bvhbench
