// SPDX-License-Identifier: MIT
#include "scenes/formats/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace bvhbench {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// What the last digit of a decimal number counts: 0.01 of "-1.25", 10 of "125e1".
double last_unit(std::string_view word)
{
    const std::size_t e = std::min(word.find_first_of("eE"), word.size());
    const std::size_t point = std::min(word.find('.'), e);
    const auto decimals = static_cast<std::int64_t>(e - std::min(point + 1, e));
    const std::int64_t exponent =
        e < word.size() ? parse_integer(word.substr(e + 1)).value_or(0) : 0;
    return std::pow(10.0, static_cast<double>(exponent - decimals));
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

std::string_view Words::next()
{
    std::size_t begin = 0;
    while (begin < rest_.size() && is_space(rest_[begin]))
        ++begin;
    std::size_t end = begin;
    while (end < rest_.size() && !is_space(rest_[end]))
        ++end;
    const std::string_view word = rest_.substr(begin, end - begin);
    rest_.remove_prefix(end);
    return word;
}

std::optional<float> parse_float(std::string_view word)
{
    word = without_plus(word);
    float value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    if (stop != end || error == std::errc::invalid_argument)
        return std::nullopt;
    if (error != std::errc::result_out_of_range)
        return value;
    // from_chars does not say on which side; a negative exponent, or a text that begins 0., does.
    double wide = 0;
    if (std::from_chars(word.data(), end, wide).ec == std::errc{})
        return static_cast<float>(wide);
    const bool small = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return small ? 0.0f : std::numeric_limits<float>::infinity();
}

std::optional<FileNumber> parse_number(std::string_view word)
{
    const std::optional<float> rounded = parse_float(word);
    if (!rounded)
        return std::nullopt;
    word = without_plus(word);
    FileNumber number{*rounded, *rounded, true};
    double wide = 0;
    if (std::from_chars(word.data(), word.data() + word.size(), wide).ec != std::errc{})
        return number;  // beyond doubles too
    number.wide = wide;
    // `wide` is itself rounded: where a tie was printed, the difference may come out larger than half by that.
    const double allowed = 0.5 * last_unit(word) + 0x1p-53 * std::fabs(wide);
    number.floats_hold = !(std::fabs(wide - double{*rounded}) > allowed);
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

std::optional<FilePoint> parse_point(Words& words)
{
    const auto x = parse_number(words.next());
    const auto y = parse_number(words.next());
    const auto z = parse_number(words.next());
    if (!x || !y || !z)
        return std::nullopt;
    return FilePoint{*x, *y, *z};
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

bool is_utf16(std::string_view text)
{
    return text.substr(0, 2) == "\xfe\xff" || text.substr(0, 2) == "\xff\xfe";
}

void add_fan(std::vector<Face>& faces, const std::vector<uint>& corners)
{
    for (std::size_t k = 2; k < corners.size(); ++k)
        faces.push_back({corners[0], corners[k - 1], corners[k]});
}

}  // namespace bvhbench
