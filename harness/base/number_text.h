// SPDX-License-Identifier: MIT
//
// Writes numbers as text that round-trips exactly. Large trees are written as JSON with these functions, without a JSON document
// in memory: one JSON value for each node would take more memory than the tree.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace bvhbench {

/// Appends the shortest decimal text that reads back as the same bits.
template <class T>
void append_number(std::string& text, T value)
{
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end);
}

/// Appends "[a,b,...]".
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

}  // namespace bvhbench
