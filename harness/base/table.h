// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace bvhbench {

/// A console table: columns as wide as their widest entry, words to the left, numbers to the right.
class Table {
public:
    enum class Align { left, right };
    struct Column {
        std::string title;
        Align align = Align::right;
    };

    explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

    /// One entry a column; missing ones at the end are blank.
    void row(std::vector<std::string> entries) { rows_.push_back(std::move(entries)); }

    /// Title line if any column has a title, then the rows, each ended by a newline, no blanks at their ends.
    std::string text() const;

private:
    std::vector<Column> columns_;
    std::vector<std::vector<std::string>> rows_;
};

/// `value` with `digits` after the point.
std::string fixed(double value, int digits);

/// Nanoseconds with three digits and the unit that suits: "950 ns", "71.2 us", "1.30 ms".
std::string duration_text(double ns);

/// Bytes with three digits and the unit that suits: "512 B", "6.91 MB".
std::string bytes_text(double bytes);

}  // namespace bvhbench
