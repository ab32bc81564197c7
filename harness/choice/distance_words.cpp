// SPDX-License-Identifier: MIT
#include "harness/choice/distance_words.h"

#include <charconv>
#include <cmath>

namespace bvhbench {
namespace {

/// Returns the number in front of a %, if there is one; nothing if the word is no distance.
std::optional<double> parsed_distance(const std::string& word)
{
    const char* const end = word.data() + word.size() - (word.ends_with('%') ? 1 : 0);
    double number = 0;
    const auto [at, error] = std::from_chars(word.data(), end, number);
    const bool is_allowed =
        error == std::errc() && at == end && std::isfinite(number) && !std::signbit(number);
    return is_allowed ? std::optional(number) : std::nullopt;
}

}  // namespace

bool is_distance(const std::string& word) { return parsed_distance(word).has_value(); }

std::optional<double> distance_of(const std::string& word, const Aabb& around)
{
    const std::optional<double> number = parsed_distance(word);
    if (!number || !word.ends_with('%'))
        return number;
    const auto side = [](float low, float high) { return double{high} - double{low}; };
    return *number / 100 *
           std::hypot(side(around.min_x, around.max_x), side(around.min_y, around.max_y),
                      side(around.min_z, around.max_z));
}

}  // namespace bvhbench
