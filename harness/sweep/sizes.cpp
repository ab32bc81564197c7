// SPDX-License-Identifier: MIT
#include "harness/sweep/sizes.h"

#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr std::int64_t most = std::int64_t{1} << 31;
constexpr std::size_t most_sizes = 10000;

[[noreturn]] void refuse(const std::string& text, const std::string& why)
{
    throw BadUsage("'" + text + "' are no sizes: " + why +
                   "; write 1000,30000 or 1000:1000000:x10 or 1000:5000:+1000");
}

template <class T>
T number(const std::string& text, const std::string& digits)
{
    T value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size() || !(value > 0) ||
        !(value <= static_cast<T>(most)))
        refuse(text, "'" + digits + "' is no number from 1 to " + std::to_string(most));
    return value;
}

void add_range(const std::string& text, const std::string& range, std::set<std::int64_t>& sizes)
{
    std::istringstream words(range);
    std::string from, to, step, more;
    std::getline(words, from, ':');
    std::getline(words, to, ':');
    std::getline(words, step, ':');
    if (step.size() < 2 || (step[0] != 'x' && step[0] != '+') || std::getline(words, more))
        refuse(text, "a range is FROM:TO:xFACTOR or FROM:TO:+STEP, not '" + range + "'");
    const auto first = number<std::int64_t>(text, from), last = number<std::int64_t>(text, to);
    if (first > last)
        refuse(text, from + " is more than " + to);
    const bool multiplies = step[0] == 'x';
    const auto by = number<double>(text, step.substr(1));
    if (multiplies ? by <= 1 : by < 1)
        refuse(text, "'" + step + "' leads nowhere");
    for (auto size = static_cast<double>(first); std::llround(size) <= last;
         size = multiplies ? size * by : size + by) {
        sizes.insert(std::llround(size));
        if (sizes.size() > most_sizes)
            refuse(text, "they are more than " + std::to_string(most_sizes));
    }
}

}  // namespace

std::vector<std::int64_t> sizes_called(const std::string& text)
{
    std::set<std::int64_t> sizes;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');)
        if (item.find(':') != item.npos)
            add_range(text, item, sizes);
        else
            sizes.insert(number<std::int64_t>(text, item));
    if (sizes.empty())
        refuse(text, "there are none");
    return {sizes.begin(), sizes.end()};
}

}  // namespace bvhbench
