// SPDX-License-Identifier: MIT
#include "geometry/hash.h"

namespace bvhbench {

void Hash::bytes(const void* data, std::size_t size)
{
    const auto* byte = static_cast<const unsigned char*>(data);
    std::uint64_t state = state_;
    for (std::size_t i = 0; i < size; ++i)
        state = (state ^ byte[i]) * 1099511628211u;
    state_ = state;
}

std::string hex(std::uint64_t value)
{
    constexpr char digits[] = "0123456789abcdef";
    std::string text(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4)
        text[i] = digits[value & 15];
    return text;
}

}  // namespace bvhbench
