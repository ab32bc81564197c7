// SPDX-License-Identifier: MIT
//
// Numbers as text that gives all their bits back. For JSON that is written by hand too: a value of every node of a large
// tree would take more memory than the tree.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <string>

namespace bvhbench {

/// The shortest digits that give the number's bits back.
template <class T>
void append_number(std::string& text, T value)
{
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end);
}

/// [a,b,...]
template <class Range>
void append_list(std::string& text, const Range& values)
{
    text += '[';
    bool is_first = true;
    for (const auto value : values) {
        if (!is_first)
            text += ',';
        is_first = false;
        append_number(text, value);
    }
    text += ']';
}

/// With as many digits as tell it from all others.
inline std::string number_text(double value)
{
    char text[40];
    const bool is_plain = std::fabs(value) < 1e15 && (value == 0 || std::fabs(value) >= 1e-4);
    const auto format = is_plain ? std::chars_format::fixed : std::chars_format::scientific;
    return {text, std::to_chars(text, text + sizeof text, value, format).ptr};
}

}  // namespace bvhbench
