// SPDX-License-Identifier: MIT
//
// Counts in the names of scenes, as the 100000 of "torus:100000".
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "geometry/dialect.h"

namespace bvhbench {

/// Returns the whole number that `number` spells in digits, or as "100k", "2.88M" or "1e5"; none if it spells no whole number.
std::optional<std::int64_t> count_of(std::string_view number);

/// A scene's name, split at its first colon.
struct NameParts {
    std::string_view head, rest;

    explicit NameParts(std::string_view text)
        : head(text.substr(0, text.find(':')))
        , rest(text.substr(std::min(head.size() + 1, text.size())))
    {}
};

/// Returns the count that `number`, a part of the name `scene`, spells. Throws BadUsage unless it is from 1 to `most`.
uint count_in(std::string_view scene, std::string_view number, const char* what, uint most);

/// The same of a number of triangles.
uint triangle_count(std::string_view scene, std::string_view number, uint most);

/// Throws Unavailable, naming `scene` as the user typed it, if the host has fewer than `bytes` bytes left.
void require_memory(std::string_view scene, std::uint64_t bytes);

}  // namespace bvhbench
