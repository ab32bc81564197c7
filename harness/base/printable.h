// SPDX-License-Identifier: MIT
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

}  // namespace bvhbench
