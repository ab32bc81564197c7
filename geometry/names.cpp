// SPDX-License-Identifier: MIT
#include "geometry/names.h"

namespace bvhbench {

std::string joined(std::span<const std::string_view> words)
{
    std::string text;
    for (const std::string_view word : words)
        text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

std::string there_are(std::string_view, std::span<const std::string_view> known,
                      std::string_view also)
{
    std::vector<std::string_view> all(known.begin(), known.end());
    if (!also.empty())
        all.push_back(also);
    return "; there are: " + joined(all);
}

}  // namespace bvhbench
