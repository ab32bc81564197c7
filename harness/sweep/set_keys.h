// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "harness/sweep/plan.h"

namespace bvhbench {

/// An option that a sweep goes through the values of.
struct SetKey {
    std::string_view name;
    enum class Of { builder, collider, scene } of;
    std::string_view values;  ///< as a sentence about them says
    /// Sets it. Throws BadUsage for a value that it may not have.
    void (*apply)(SweepCell& cell, const std::string& value);
    /// Whether result files tell its values apart. One whose values they do not tell may have one only.
    bool is_told = true;
};

/// Every option, in the order in which they are applied. To add one, add its line.
std::span<const SetKey> set_keys();

/// By name. Throws BadUsage with the known names.
const SetKey& find_set_key(std::string_view name);

/// The values that a sweep goes through of one option.
struct SetValues {
    const SetKey* key;
    std::vector<std::string> values;
};

/// Those of a sweep's key `set`, in the order of set_keys(). Throws BadUsage unless each value by itself is one that there is.
std::vector<SetValues> set_values_of(const Json& json);

/// What a value in JSON is as the command line would say it.
std::string word_of(const Json& value);

}  // namespace bvhbench
