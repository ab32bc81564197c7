// SPDX-License-Identifier: MIT
#include "harness/base/table.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include "harness/base/terminal.h"

namespace bvhbench {
namespace {

/// Formats three significant digits in the largest unit that gives at least 1.
std::string with_unit(double value, const std::vector<const char*>& units)
{
    std::size_t unit = 0;
    for (; unit + 1 < units.size() && value >= 999.5; ++unit)
        value /= 1000;
    const int digits = unit == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
    return fixed(value, digits) + ' ' + units[unit];
}

}  // namespace

std::vector<std::string> wrapped(const std::string& text, std::size_t width)
{
    std::istringstream words(text);
    std::vector<std::string> lines;
    for (std::string word; words >> word;)
        if (lines.empty() || character_count(lines.back() + word) >= width)
            lines.push_back(word);
        else
            lines.back() += ' ' + word;
    return lines;
}

std::string Table::text(std::size_t width) const
{
    constexpr std::size_t gap = 2, indent = 4;
    std::vector<std::size_t> widths;
    std::size_t fitting = 0, end = 0;  // number of columns that fit, and where they end
    std::vector<std::string> titles;
    for (std::size_t i = 0; i < titles_.size(); ++i) {
        titles.push_back(titles_[i].substr(titles_[i].starts_with('<') ? 1 : 0));
        widths.push_back(character_count(titles[i]));
        for (const auto& row : rows_)
            widths[i] = std::max(widths[i], i < row.size() ? character_count(row[i]) : 0);
        if (i == 0 || (i == fitting && (width == 0 || end + gap + widths[i] <= width))) {
            end += widths[i] + (i == 0 ? 0 : gap);
            ++fitting;
        }
    }
    const bool has_room = end + gap <= width / 2;
    const std::size_t margin = has_room ? end + gap : indent;
    std::string out;
    const auto line = [&](const auto& entry_at) {
        std::string text, more;
        for (std::size_t i = 0; i < titles.size(); ++i) {
            const std::string entry = entry_at(i);
            if (i >= fitting) {
                more += (more.empty() || entry.empty() ? "" : "; ") + entry;
                continue;
            }
            const std::string blank(widths[i] - character_count(entry), ' ');
            text += i == 0 ? "" : "  ";
            text += titles_[i].starts_with('<') ? entry + blank : blank + entry;
        }
        text.erase(text.find_last_not_of(' ') + 1);
        for (const std::string& each : wrapped(more, width - margin)) {
            if (!has_room || character_count(text) >= margin) {
                out += text + '\n';
                text.clear();
            }
            text.append(margin - character_count(text), ' ') += each;
        }
        out += text + '\n';
    };
    if (!std::ranges::all_of(titles, &std::string::empty))
        line([&](std::size_t i) { return titles[i]; });
    for (const auto& row : rows_)
        line([&](std::size_t i) { return i < row.size() ? row[i] : std::string(); });
    return out;
}

std::string fixed(double value, int digits)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", digits, value);
    return text.data();
}

std::string duration_text(double ns) { return with_unit(ns, {"ns", "us", "ms", "s"}); }

std::string bytes_text(double bytes) { return with_unit(bytes, {"B", "kB", "MB", "GB", "TB"}); }

}  // namespace bvhbench
