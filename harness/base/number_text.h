// SPDX-License-Identifier: MIT
//
// Numbers as text that gives all their bits back. For JSON that is written by hand too: a value of every node of a large
// tree would take more memory than the tree.
#pragma once

#include <array>
#include <charconv>
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

}  // namespace bvhbench
