// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace bvhbench {

/// A console table. Columns are as wide as their widest entry and aligned right (numbers), or left (words) if "<" begins the title.
class Table {
public:
    explicit Table(std::vector<std::string> titles) : titles_(std::move(titles)) {}

    /// Adds a row with one entry per column; missing entries at the end are blank.
    void row(std::vector<std::string> entries) { rows_.push_back(std::move(entries)); }

    /// Returns the title line, if any column has a title, then the rows. Each line ends in a newline and has no trailing blanks. With a
    /// `width`, columns that do not fit are wrapped, as one text, in lines of their own or below the column where they begin.
    std::string text(std::size_t width = 0) const;

private:
    std::vector<std::string> titles_;
    std::vector<std::vector<std::string>> rows_;
};

/// Returns the words of `text` in lines of at most `width` characters, if the words are no longer.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

/// Returns `value` with `digits` digits after the point.
std::string fixed(double value, int digits);

/// Returns nanoseconds with three significant digits and a suitable unit: "950 ns", "71.2 us", "1.30 ms".
std::string duration_text(double ns);

/// Returns bytes with three significant digits and a suitable unit: "512 B", "6.91 MB".
std::string bytes_text(double bytes);

}  // namespace bvhbench
