// SPDX-License-Identifier: MIT
#include "harness/base/json_reason.h"

namespace bvhbench {

std::string json_reason(const std::exception& error)
{
    constexpr std::size_t longest = 200;
    std::string text = error.what();
    if (text.starts_with("[json.exception."))
        text.erase(0, text.find("] ") + 2);
    if (text.size() > longest)
        text.replace(longest, text.npos, "...");
    for (char& c : text)
        if (c < ' ' || c > '~')
            c = '?';
    return text;
}

}  // namespace bvhbench
