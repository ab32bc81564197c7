// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bvhbench {

/// A number in a file: as a double, and as the nearest float.
struct FileNumber {
    double wide = 0;
    float rounded = 0;
    bool floats_hold = true;  ///< true if the float represents the number as written
};

/// Splits a text into lines, ended by LF, CR LF, CR or the end of the text.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    /// Returns the next line without its end; nothing after the last line.
    std::optional<std::string_view> next();
    /// Returns the number of the last returned line, from 1.
    std::size_t number() const { return number_; }

private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Removes the next word and the white space before it from the front of `text`. Returns the word; empty if there is none.
std::string_view next_word(std::string_view& text);

/// Parses the whole of `word` as a number in any locale: a decimal point, an optional sign. Infinity and NaN are accepted;
/// numbers that are too large become infinity, too small ones zero. Nothing if `word` is not a number.
///
/// `floats_hold` is true if the float differs from the double by at most half a unit of the last written digit: floats that
/// were printed with any number of digits are recognised as floats.
std::optional<FileNumber> parse_number(std::string_view word);

/// Parses the whole of `word` as a decimal integer; nothing if it is none or is out of range.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Returns `word` with A to Z as small letters, in any locale.
std::string lower_case(std::string_view word);

/// Returns `word` in quotes for a message: shortened, with unprintable bytes as '?'.
std::string in_quotes(std::string_view word);

}  // namespace bvhbench
