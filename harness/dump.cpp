// SPDX-License-Identifier: MIT
#include "harness/dump.h"

#include <array>
#include <charconv>

namespace bvhbench {
namespace {

// Written by hand: a JSON value of every node of a large tree would take more memory than the tree.
template <class T>
void append(std::string& text, T value)
{
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    text.append(digits.data(), end);
}

template <class T, std::size_t size>
void append_list(std::string& text, const std::array<T, size>& values)
{
    text += '[';
    for (std::size_t i = 0; i < size; ++i) {
        if (i > 0)
            text += ',';
        append(text, values[i]);
    }
    text += ']';
}

}  // namespace

std::string dump_text(const HostTree& tree)
{
    std::string text = "{\"nodes\":[";
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const auto& [box, child, primitive] = tree.nodes[i];
        text += i == 0 ? "\n{\"box\":{\"min\":" : ",\n{\"box\":{\"min\":";
        append_list(text, std::array{box.min_x, box.min_y, box.min_z});
        text += ",\"max\":";
        append_list(text, std::array{box.max_x, box.max_y, box.max_z});
        text += "},\"child\":";
        append_list(text, child);
        text += ",\"primitive\":";
        append(text, primitive);
        text += '}';
    }
    return text + "\n]}\n";
}

}  // namespace bvhbench
