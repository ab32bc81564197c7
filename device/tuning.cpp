// SPDX-License-Identifier: MIT
#include "device/tuning.h"

#include <bit>

namespace bvhbench {

std::string Parameter::refusal(uint value) const
{
    const std::string but = ", not " + std::to_string(value);
    if (value < least || value > most)
        return "must be from " + std::to_string(least) + " to " + std::to_string(most) + but;
    if (values == ValueIs::odd && value % 2 == 0)
        return "must be odd" + but;
    const bool is_power = values == ValueIs::power_of_two || values == ValueIs::group_size;
    if (is_power && value != 0 && !std::has_single_bit(value))
        return "must be a power of two" + but;
    return {};
}

}  // namespace bvhbench
