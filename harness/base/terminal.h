// SPDX-License-Identifier: MIT
//
// What a terminal is shown: nothing that it would obey, and where a long run is.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace bvhbench {

/// `text` with control characters spelled as \x1b: names of files and scenes may hold some, and a terminal obeys them. Ends
/// of lines and tabs stay.
std::string printable(std::string_view text);

/// Whatever is written to `stream` while this object exists is printable.
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

/// One line on stderr that says where a long run is; silent unless stderr is a terminal.
class Progress {
public:
    explicit Progress(std::size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The next of `total` things has begun.
    void step(const std::string& what);

    /// The same thing goes on with something else.
    void note(const std::string& what) const;

private:
    std::size_t total_;
    std::size_t done_ = 0;
    bool is_shown_;
};

}  // namespace bvhbench
