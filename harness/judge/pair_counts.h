// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "builders/input.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Number of errors in a list of pairs. A pair found twice counts as false.
struct Differences {
    std::uint64_t missed = 0;
    std::uint64_t false_ones = 0;

    Differences& operator+=(const Differences& more)
    {
        missed += more.missed;
        false_ones += more.false_ones;
        return *this;
    }
    bool operator==(const Differences&) const = default;

    /// Returns a text such as "2 pairs missed, 1 false".
    std::string text(const std::string& of = "pairs") const
    {
        return std::to_string(missed) + ' ' + of + " missed, " + std::to_string(false_ones) +
               " false";
    }
};

Differences differences(const PairList& found, const PairList& right);

/// Returns "12 pairs of the hash 0123...", with the hash as result files have it.
std::string facts_text(const PairFacts& facts);

/// Sorts the pairs, each with its smaller id first, and returns up to three that are there more than once.
std::vector<Pair> doubled_pairs(std::vector<Pair>& found);

/// Returns how many pairs are missing and how many are not right, with up to three of each kind and of `doubled`: by their numbers
/// in the scene's file (`file_faces` as Scene::file_faces), with their objects and boxes.
std::string examples(const PairList& found, const PairList& right, std::span<const Pair> doubled,
                     const Input& input, std::span<const uint> file_faces);

/// Adds `bytes` to the bytes moved of `stage`, if it has launches.
void add_moved_bytes(std::vector<StageTime>& stages, std::string_view stage, std::int64_t bytes);

}  // namespace bvhbench
