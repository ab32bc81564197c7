// SPDX-License-Identifier: MIT
//
// Terminal output: escapes control characters and shows the progress of long runs.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace bvhbench {

/// Returns `text` with control characters written as \x1b, because names of files and scenes may contain some and a terminal
/// would interpret them. Line ends and tabs are kept.
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

/// Clears the progress line.
constexpr const char* clear_line = "\r\033[K";

/// A progress line on stderr. Prints nothing unless stderr is a terminal.
class Progress {
public:
    explicit Progress(std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows that the next of the `total` items has begun.
    void step(const std::string& what);

    /// Changes the text shown for the current item.
    void note(const std::string& what) const;

private:
    std::size_t total_;
    std::size_t done_ = 0;
    bool is_shown_;
};

}  // namespace bvhbench
