// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace bvhbench {

/// A number of a file: as it is there, and the float nearest to it.
struct FileNumber {
    double wide = 0;
    float rounded = 0;
    bool floats_hold = true;  ///< whether the float says the same
};

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

/// Takes the next word off the front of `text`, with the white space of any kind before it; empty when there is none.
std::string_view next_word(std::string_view& text);

/// The whole of `word` as a number, whatever the locale: a decimal point, an optional sign. Infinity and
/// not-a-number parse, too large numbers are infinity, too small ones zero. Nothing if it is no number.
///
/// A float is taken to hold it if it differs from the double by no more than half a unit of the last digit that is
/// written: whatever was printed from floats, with however many digits, floats then hold.
std::optional<FileNumber> parse_number(std::string_view word);

/// The whole of `word` as a decimal integer; nothing if it is none or does not fit.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// `word` in quotes for a message: shortened, with unprintable bytes as '?'.
std::string in_quotes(std::string_view word);

}  // namespace bvhbench
