// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/base/json_keys.h"

namespace bvhbench {

/// A cell as one line of JSON, which is made only once, the id of its run, and its outcome.
struct CellText {
    std::string text, run, verdict, reason;
    bool is_measured;
};

/// Returns a cell that an earlier process has measured, of the run `run`.
CellText text_of(Json cell, const std::string& run);

/// Returns the object `text` with one more key.
std::string with_key(std::string text, const char* key, const std::string& value);

/// Returns a result file with one cell per line, so that files can be compared by diff. If a cell is of another run than `run`, each
/// names its run, and the file those of `runs` that have cells.
std::string result_text(const Json& run, std::span<const Json> runs,
                        std::span<const CellText> cells, const std::vector<std::string>& stress);

}  // namespace bvhbench
