// SPDX-License-Identifier: MIT
//
// Looks up names that a user gives, in the catalogs of all rooms.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/error.h"

namespace bvhbench {

/// Returns the words separated by commas: "a, b, c".
std::string joined(std::span<const std::string_view> words);

/// Returns the name among `known` that `name` probably means, or nothing: the one that the fewest edits of a character lead
/// to, if they are at most a third of the characters. What follows a colon, as in "torus:N", is not compared.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known);

/// Returns the end of a sentence about a `name` that is none of `known`: "; there are: a, b, c; did you mean 'a'?". Of many names
/// only the nearest is given if there is one. `also` is appended as one more entry: "or all". `summaries` are those of `known`, or
/// nothing: if no name is near, those are proposed whose name or summary contains `name`, or whose name it contains. Only letters and
/// digits count, capital or small: "Karras 2012" finds "karras".
std::string there_are(std::string_view name, std::span<const std::string_view> known,
                      std::string_view also = {}, std::span<const std::string_view> summaries = {});

/// Returns the names of the entries, in their order.
template <class Entries>
std::vector<std::string_view> names_of(Entries&& entries)
{
    std::vector<std::string_view> names;
    for (const auto& entry : entries)
        names.emplace_back(entry.name);
    return names;
}

/// Returns the entry called `name`; nullptr if there is none.
template <class Entries>
auto* find_name(const Entries& entries, std::string_view name)
{
    for (const auto& entry : entries)
        if (entry.name == name)
            return &entry;
    return static_cast<decltype(&*std::begin(entries))>(nullptr);
}

/// Returns the entry called `name`. `kind` is what entries are, as "builder". Throws BadUsage with the known names, followed by
/// `also`, if there is none.
template <class Entries>
auto& find_called(const Entries& entries, std::string_view name, const std::string& kind,
                  std::string_view also = {})
{
    if (const auto* entry = find_name(entries, name))
        return *entry;
    std::vector<std::string_view> summaries;
    if constexpr (requires { std::begin(entries)->summary; })
        for (const auto& entry : entries)
            summaries.emplace_back(entry.summary);
    throw BadUsage("no " + kind + " is called '" + std::string(name) + '\'' +
                   there_are(name, names_of(entries), also, summaries));
}

/// Returns the place of `name` among `names`, as a number or an enumerator. Throws BadUsage, which says what it is of, if it has none.
template <class Kind>
Kind value_called(const std::string& what, std::string_view name,
                  std::span<const std::string_view> names)
{
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
        throw BadUsage("no " + what + " is called '" + std::string(name) + '\'' +
                       there_are(name, names));
    return static_cast<Kind>(found - names.begin());
}

}  // namespace bvhbench
