// SPDX-License-Identifier: MIT
#include "harness/base/table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace bvhbench {
namespace {

/// Counts characters, not bytes: continuation bytes of UTF-8 start with the bits 10.
std::size_t width(const std::string& text)
{
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

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

std::string Table::text() const
{
    std::vector<std::size_t> widths;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        widths.push_back(width(columns_[i].title));
        for (const auto& row : rows_)
            widths[i] = std::max(widths[i], i < row.size() ? width(row[i]) : 0);
    }
    std::string out;
    const auto line = [&](const auto& entry_at) {
        std::string text;
        for (std::size_t i = 0; i < columns_.size(); ++i) {
            const std::string entry = entry_at(i);
            const std::string blank(widths[i] - width(entry), ' ');
            text += i == 0 ? "" : "  ";
            text += columns_[i].align == Align::left ? entry + blank : blank + entry;
        }
        out += text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
    };
    if (std::any_of(columns_.begin(), columns_.end(),
                    [](const Column& c) { return !c.title.empty(); }))
        line([&](std::size_t i) { return columns_[i].title; });
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
