// SPDX-License-Identifier: MIT
#include "harness/choice/scene_range.h"

#include <set>

#include "geometry/error.h"

namespace bvhbench {

std::vector<std::int64_t> sizes_in(const SizeRange& range)
{
    std::set<std::int64_t> sizes(range.listed.begin(), range.listed.end());
    for (std::int64_t size = range.from; size <= range.to; ++size)
        sizes.insert(size);
    for (std::int64_t power = 1; power <= range.powers_of_two_to; power *= 2)
        if (power >= range.powers_of_two_from)
            sizes.insert(power);
    for (std::int64_t power = 1; power <= range.around_powers_of_two_to; power *= 2)
        sizes.insert({power - 1, power, power + 1});
    sizes.erase(sizes.begin(), sizes.lower_bound(1));
    return {sizes.begin(), sizes.end()};
}

std::vector<std::string> scenes_in(const std::string& pattern, const std::string& key,
                                   const SizeRange& range)
{
    const std::string hole = '{' + key + '}';
    const std::size_t at = pattern.find(hole);
    if (at == std::string::npos)
        throw BadUsage("the scene '" + pattern + "' has no " + hole + " for its sizes");
    std::vector<std::string> scenes;
    for (const std::int64_t size : sizes_in(range))
        scenes.push_back(pattern.substr(0, at) + std::to_string(size) +
                         pattern.substr(at + hole.size()));
    return scenes;
}

}  // namespace bvhbench
