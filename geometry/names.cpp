// SPDX-License-Identifier: MIT
#include "geometry/names.h"

#include <cctype>

namespace bvhbench {

constexpr std::size_t longest_list = 12;  ///< names that a sentence has beside a guess
constexpr std::size_t shortest_word = 3;  ///< that is looked for in names and summaries

std::string joined(std::span<const std::string_view> words)
{
    std::string text;
    for (const std::string_view word : words)
        text += (text.empty() ? "" : ", ") + std::string(word);
    return text;
}

namespace {

/// Returns the number of insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`: the distance of
/// optimal string alignment.
std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::vector<std::size_t>> steps(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            std::size_t& least = steps[i][j] = std::max(i, j);
            if (i == 0 || j == 0)
                continue;
            least = std::min({steps[i - 1][j] + 1, steps[i][j - 1] + 1,
                              steps[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                least = std::min(least, steps[i - 2][j - 2] + 1);
        }
    return steps[a.size()][b.size()];
}

/// Returns the letters and digits of `text`, the letters small.
std::string plain(std::string_view text)
{
    std::string out;
    for (const unsigned char c : text)
        if (std::isalnum(c) != 0)
            out += static_cast<char>(std::tolower(c));
    return out;
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
                      std::string_view also, std::span<const std::string_view> summaries)
{
    const std::string_view meant = nearest_name(name, known);
    std::string guess = meant.empty() ? "" : "; did you mean '" + std::string(meant) + "'?";
    const std::string word = plain(name);
    if (meant.empty() && word.size() >= shortest_word)
        for (std::size_t i = 0; i < summaries.size(); ++i)
            if (plain(std::string(known[i]) + std::string(summaries[i])).find(word) !=
                    std::string::npos ||
                word.find(plain(known[i])) != std::string::npos)
                guess += (guess.empty() ? "; did you mean one of: " : ", ") + std::string(known[i]);
    if (!guess.empty() && known.size() > longest_list)
        return guess;
    std::vector<std::string_view> all(known.begin(), known.end());
    if (!also.empty())
        all.push_back(also);
    return "; there are: " + joined(all) + guess;
}

}  // namespace bvhbench
