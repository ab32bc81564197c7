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

double diagonal_of(const Aabb& box)
{
    const auto side = [](float low, float high) { return double{high} - double{low}; };
    return std::hypot(side(box.min_x, box.max_x), side(box.min_y, box.max_y),
                      side(box.min_z, box.max_z));
}

}  // namespace

bool is_distance(const std::string& word) { return parsed_distance(word).has_value(); }

std::optional<double> distance_of(const std::string& word, const Aabb& around)
{
    const std::optional<double> number = parsed_distance(word);
    return number && word.ends_with('%') ? *number / 100 * diagonal_of(around) : number;
}

}  // namespace bvhbench
