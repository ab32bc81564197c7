// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace bvhbench {

/// FNV-1a, 64 bits: identifies equal content in result files and tests. Not for security.
class Hash {
public:
    void bytes(const void* data, std::size_t size)
    {
        const auto* byte = static_cast<const unsigned char*>(data);
        std::uint64_t state = state_;
        for (std::size_t i = 0; i < size; ++i)
            state = (state ^ byte[i]) * 1099511628211u;
        state_ = state;
    }

    template <class T>
    void values(std::span<const T> values)
    {
        bytes(values.data(), values.size_bytes());
    }
    template <class T>
    void value(const T& value)
    {
        bytes(&value, sizeof value);
    }

    std::uint64_t get() const { return state_; }

private:
    std::uint64_t state_ = 1469598103934665603u;
};

/// Returns `value` as 16 hexadecimal digits. JSON numbers are doubles, so 64-bit numbers are stored as text.
inline std::string hex(std::uint64_t value)
{
    std::string text(16, '0');
    for (std::size_t i = 16; i-- > 0; value >>= 4)
        text[i] = "0123456789abcdef"[value & 15];
    return text;
}

}  // namespace bvhbench
