// SPDX-License-Identifier: MIT
#include "scenes/formats/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace bvhbench {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Returns the unit of a decimal number's last digit: 0.01 for "-1.25", 10 for "125e1".
double last_unit(std::string_view word)
{
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::size_t point = std::min(word.find('.'), e);
    const auto decimals = static_cast<std::int64_t>(e - std::min(point + 1, e));
    const std::int64_t exponent =
        e < word.size() ? parse_integer(word.substr(e + 1)).value_or(0) : 0;
    return std::pow(10.0, static_cast<double>(exponent - decimals));
}

/// True if a decimal number is less than 1: for numbers far beyond the range of doubles.
bool is_small(std::string_view word)
{
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::size_t point = std::min(word.find('.'), e);
    const std::size_t digit = std::min(word.find_first_of("123456789"), e);
    const auto place = static_cast<std::int64_t>(point) - static_cast<std::int64_t>(digit);
    const std::string_view exponent = word.substr(std::min(e + 1, word.size()));
    const std::int64_t most = std::numeric_limits<std::int64_t>::max() / 2;
    return place + parse_integer(exponent).value_or(exponent.empty()            ? 0
                                                    : exponent.starts_with('-') ? -most
                                                                                : most) <=
           0;
}

std::string_view without_plus(std::string_view word)
{
    const bool signed_twice = word.size() > 1 && (word[1] == '-' || word[1] == '+');
    return !word.empty() && word[0] == '+' && !signed_twice ? word.substr(1) : word;
}

}  // namespace

std::optional<std::string_view> Lines::next()
{
    if (rest_.empty())
        return std::nullopt;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    const bool two = rest_.substr(end, 2) == "\r\n";
    rest_.remove_prefix(std::min(rest_.size(), end + (two ? 2 : 1)));
    ++number_;
    return line;
}

std::string_view next_word(std::string_view& text)
{
    const auto begin = std::find_if_not(text.begin(), text.end(), is_space);
    const auto end = std::find_if(begin, text.end(), is_space);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    return {begin, end};
}

std::optional<FileNumber> parse_number(std::string_view word)
{
    word = without_plus(word);
    const char* const begin = word.data();
    const char* const end = begin + word.size();
    FileNumber number;
    const auto [stop, error] = std::from_chars(begin, end, number.wide);
    if (stop != end || error == std::errc::invalid_argument)
        return std::nullopt;
    if (error == std::errc::result_out_of_range) {  // too large or too small
        number.rounded = is_small(word) ? 0.0f : std::numeric_limits<float>::infinity();
        number.wide = number.rounded;
        return number;
    }
    if (std::from_chars(begin, end, number.rounded).ec != std::errc{})
        number.rounded = static_cast<float>(number.wide);  // zero or infinity
    // `wide` is itself rounded, so the difference may exceed half a unit by that error if the number was a tie.
    const double allowed = 0.5 * last_unit(word) + 0x1p-53 * std::fabs(number.wide);
    number.floats_hold = !(std::fabs(number.wide - double{number.rounded}) > allowed);
    return number;
}

std::optional<std::int64_t> parse_integer(std::string_view word)
{
    word = without_plus(word);
    std::int64_t value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error != std::errc{})
        return std::nullopt;
    return value;
}

std::string lower_case(std::string_view word)
{
    std::string lower(word);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c + 32);
    return lower;
}

std::string in_quotes(std::string_view word)
{
    constexpr std::size_t longest = 40;
    word.remove_prefix(std::min(word.find_first_not_of(" \t"), word.size()));
    std::string text(word.substr(0, longest));
    for (char& c : text)
        if (c < ' ' || c > '~')
            c = '?';
    return "'" + text + (word.size() > longest ? "...'" : "'");
}

}  // namespace bvhbench
