// SPDX-License-Identifier: MIT
#include "scenes/counts.h"

#include <charconv>
#include <cmath>
#include <string>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "geometry/names.h"
#include "scenes/formats/text.h"

namespace bvhbench {

std::optional<std::int64_t> count_of(std::string_view number)
{
    if (number.empty() || number.find_first_not_of("0123456789.ekM") != number.npos)
        return std::nullopt;
    if (number.find_first_of(".ekM") == number.npos)
        return parse_integer(number);
    const char unit = number.back();
    const double factor = unit == 'k' ? 1e3 : unit == 'M' ? 1e6 : 1;
    double value = 0;
    const char* const end = number.data() + number.size() - (factor > 1 ? 1 : 0);
    const auto [stop, error] = std::from_chars(number.data(), end, value);
    value = std::round(value * factor * 1e6) / 1e6;  // a product may miss the whole number
    if (error != std::errc{} || stop != end || value > 1e15 || value != std::floor(value))
        return std::nullopt;
    return static_cast<std::int64_t>(value);
}

uint count_in(std::string_view scene, std::string_view number, const char* what, uint most)
{
    const auto value = count_of(number);
    if (!value || *value < 1 || *value > std::int64_t{most})
        throw BadUsage("scene " + in_quotes(scene) + " ends in " + in_quotes(number) + " where a " +
                       what + " from 1 to " + std::to_string(most) + " goes");
    return static_cast<uint>(*value);
}

uint triangle_count(std::string_view scene, std::string_view number, uint most)
{
    return count_in(scene, number, "triangle count", most);
}

void require_memory(std::string_view scene, std::uint64_t bytes)
{
    require_host_memory("scene " + in_quotes(scene), bytes);
}

}  // namespace bvhbench
