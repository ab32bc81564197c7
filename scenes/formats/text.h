// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/mesh.h"
#include "scenes/formats/file_point.h"

namespace bvhbench {

/// Lines of a text, ended by LF, CR LF, CR or the end of the text.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    /// The next line without its end; nothing after the last.
    std::optional<std::string_view> next();
    /// Of the line last returned, from 1.
    std::size_t number() const { return number_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Words of a text, apart by white space of any kind.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// The next word; empty when there is none.
    std::string_view next();
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

/// The whole of `word` as a number, whatever the locale: a decimal point, an optional sign. Infinity and
/// not-a-number parse, too large numbers are infinity, too small ones zero. Nothing if it is no number.
std::optional<float> parse_float(std::string_view word);

/// The same as a double too. A float is taken to hold it if the two differ by no more than half a unit of the last digit
/// that is written: whatever was printed from floats, with however many digits, floats then hold.
std::optional<FileNumber> parse_number(std::string_view word);

/// The whole of `word` as a decimal integer; nothing if it is none or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Three coordinates from `words`; nothing if there are fewer or one is no number.
std::optional<FilePoint> parse_point(Words& words);

/// `word` in quotes for a message: shortened, with unprintable bytes as '?'.
std::string in_quotes(std::string_view word);

/// Whether `text` begins with a UTF-16 byte order mark.
bool is_utf16(std::string_view text);

/// Cuts a polygon into a fan round its first corner.
void add_fan(std::vector<Face>& faces, const std::vector<uint>& corners);

}  // namespace bvhbench
