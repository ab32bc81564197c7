// SPDX-License-Identifier: MIT
#include "harness/base/terminal.h"

#include <sys/ioctl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace bvhbench {
namespace {

/// Returns the bytes and the code of the first character of a text in UTF-8. A byte that begins none stands for itself.
std::pair<std::size_t, char32_t> first_letter(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const auto size = static_cast<std::size_t>(std::countl_one(byte(0)));
    if (size < 2 || size > 4 || size > text.size())
        return {1, byte(0)};
    char32_t code = byte(0) & (0x7fu >> size);
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(i) & 0xc0) != 0x80)
            return {1, byte(0)};
        code = code << 6 | (byte(i) & 0x3fu);
    }
    return {size, code};
}

/// True for what a terminal obeys: control characters but line ends and tabs, and changes of the direction of writing.
bool is_obeyed(char32_t code)
{
    return (code < 0x20 && code != '\n' && code != '\t') || (code >= 0x7f && code < 0xa0) ||
           (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

constexpr std::chrono::seconds a_while{30};  ///< between two lines where no terminal is

double seconds(std::chrono::steady_clock::duration time)
{
    return std::chrono::duration<double>(time).count();
}

}  // namespace

std::string rough(double seconds)
{
    const auto whole = static_cast<long>(std::ceil(seconds));
    const long minutes = (whole + 59) / 60;
    return whole < 90 ? std::to_string(whole) + " s"
           : minutes < 90
               ? std::to_string(minutes) + " min"
               : std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

std::string printable(std::string_view text)
{
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const auto [size, code] = first_letter(text);
        if (is_obeyed(code)) {
            char escaped[16];
            std::snprintf(escaped, sizeof escaped, code < 0x100 ? "\\x%02x" : "\\u%04x",
                          static_cast<unsigned>(code));
            out += escaped;
        } else {
            out += text.substr(0, size);
        }
        text.remove_prefix(size);
    }
    return out;
}

std::streamsize PrintableOutput::xsputn(const char* text, std::streamsize count)
{
    const std::string shown = printable({text, static_cast<std::size_t>(count)});
    const auto size = static_cast<std::streamsize>(shown.size());
    return to_->sputn(shown.data(), size) == size ? count : 0;
}

int PrintableOutput::overflow(int c)
{
    if (c == traits_type::eof())
        return 0;
    const char text = static_cast<char>(c);
    return xsputn(&text, 1) == 1 ? c : traits_type::eof();
}

std::size_t character_count(std::string_view text)
{
    return static_cast<std::size_t>(  // continuation bytes of UTF-8 start with the bits 10
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::size_t terminal_width(int file)
{
    if (isatty(file) != 1)
        return 0;
    const char* variable = std::getenv("COLUMNS");
    long columns = variable != nullptr ? std::strtol(variable, nullptr, 10) : 0;
    winsize size{};
    if (columns <= 0)
        columns = ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
    return static_cast<std::size_t>(std::max(columns, 40L));
}

std::string so_far(const std::string& what, int seconds, std::size_t done, std::size_t total)
{
    if (done == 0)
        return what + ", " + std::to_string(seconds) + " s";
    const double rest = static_cast<double>(total - done) / static_cast<double>(done);
    return what + ", about " + rough(seconds * rest) + " left, " + std::to_string(done) + " of " +
           std::to_string(total) + " are done";
}

Progress::Progress(std::size_t total)
    : total_(total)
    , is_shown_(isatty(STDERR_FILENO) == 1)
    , shown_(is_shown_ ? Clock::time_point() : start_)
{}

void Progress::clear() const
{
    if (is_shown_)
        std::fputs(clear_line, stderr);
}

void Progress::step(const std::string& what)
{
    ++begun_;
    item_start_ = Clock::now();
    note(what);
}

void Progress::note(const std::string& what, double share)
{
    const auto now = Clock::now();
    const auto since = now - shown_;
    if (is_shown_ ? share > 0 && since < std::chrono::milliseconds(200) : since < a_while)
        return;
    shown_ = now;
    const double left = seconds_left(share, now);
    std::string line = '[' + std::to_string(begun_) + '/' + std::to_string(total_) + ']' +
                       (left > 0 ? " about " + rough(left) + " left:" : "") + ' ' + printable(what);
    while (is_shown_ && character_count(line) >= terminal_width(STDERR_FILENO))
        line.pop_back();
    std::fprintf(stderr, is_shown_ ? "%s%s" : "%.0s%s\n", clear_line, line.c_str());
}

/// Returns 0 if nothing is known.
double Progress::seconds_left(double share, Clock::time_point now) const
{
    const double finished = static_cast<double>(begun_ - passed_) - 1,
                 item = seconds(now - item_start_);
    const double mean = finished > 0 ? seconds(item_start_ - start_) / finished : item / share;
    if (finished <= 0 && share <= 0)
        return 0;
    const double rest = share > 0 ? item / share - item : std::max(0.0, mean - item);
    return rest + mean * static_cast<double>(total_ - begun_);
}

}  // namespace bvhbench
