// SPDX-License-Identifier: MIT
//
// Reading what people write by hand in JSON. All throw BadUsage, in a sentence that names the key.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

using Json = nlohmann::ordered_json;

/// "a, b, c"
std::string joined(std::span<const std::string_view> words);

void refuse_unknown_keys(const Json& json, const std::vector<std::string_view>& known,
                         const std::string& where);
std::string text_at(const Json& json, const char* key);
bool truth_at(const Json& json, const char* key);
std::int64_t whole_number(const Json& value, const std::string& what, std::int64_t least,
                          std::int64_t most);

/// Each of the list at `key`, which must not be empty.
void read_list(const Json& json, const char* key, const std::function<void(const Json&)>& add);

}  // namespace bvhbench
