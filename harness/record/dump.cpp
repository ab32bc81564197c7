// SPDX-License-Identifier: MIT
#include "harness/record/dump.h"

#include <array>

#include "harness/base/number_text.h"

namespace bvhbench {

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
        append_number(text, primitive);
        text += '}';
    }
    return text + "\n]}\n";
}

}  // namespace bvhbench
