// SPDX-License-Identifier: MIT
#include "geometry/names.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace bvhbench {

std::string joined(std::span<const std::string_view> words)
{
    std::string text;
    for (const std::string_view word : words)
        text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

namespace {

/// Returns the number of insertions, deletions and replacements of a character that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known)
{
    const auto head = [](std::string_view text) { return text.substr(0, text.find(':')); };
    std::size_t least = std::max<std::size_t>(head(name).size() / 3, 1) + 1;
    std::string_view nearest;
    for (const std::string_view one : known)
        if (const std::size_t steps = edit_distance(head(name), head(one));
            steps < std::min(least, head(name).size()))
            least = steps, nearest = one;
    return nearest;
}

std::string there_are(std::string_view name, std::span<const std::string_view> known,
                      std::string_view also)
{
    if (const std::string_view meant = nearest_name(name, known); !meant.empty())
        return "; did you mean '" + std::string(meant) + "'?";
    std::vector<std::string_view> all(known.begin(), known.end());
    if (!also.empty())
        all.push_back(also);
    return "; there are: " + joined(all);
}

}  // namespace bvhbench
