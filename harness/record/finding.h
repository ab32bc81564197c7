// SPDX-License-Identifier: MIT
//
// Results of `stress`: a system over a scene, with one finding for each invariant.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace bvhbench {

/// Invariants over every scene of finite coordinates. docs/stress.md explains each.
enum class Invariant {
    ends,      ///< it ends, with an answer
    leaves,    ///< each triangle is in exactly one leaf
    boxes,     ///< leaf boxes are the triangles', inner boxes the children's union, bit for bit
    layout,    ///< bytes and number of nodes are as predicted; the tree is the reference's
    pairs,     ///< exactly the pairs of overlapping boxes are found
    contacts,  ///< exactly the pairs of intersecting triangles are found
    agree,     ///< equal results after triangles are shuffled and objects are swapped
    moved,     ///< equal results after scaling by a power of two and after an exact translation
    room,      ///< equal results if buffers and queues begin with room for one entry
    same,      ///< equal results, bit for bit, in every repetition
};

inline constexpr std::array invariant_names = {"ends",     "leaves", "boxes", "layout", "pairs",
                                               "contacts", "agree",  "moved", "room",   "same"};

constexpr std::string_view name_of(Invariant invariant)
{
    return invariant_names[static_cast<std::size_t>(invariant)];
}

struct Finding {
    enum class Verdict { holds, refused, broken } verdict = Verdict::holds;  ///< best to worst
    std::uint64_t checked = 0;  ///< number of things checked: pairs, nodes, runs
    std::uint64_t wrong = 0;    ///< how many of them are wrong; 0 for `broken` if unknown
    std::uint64_t missed = 0;   ///< how many of the wrong ones exist but were not found
    std::string detail = {};    ///< what is wrong, or why the system refused

    bool operator==(const Finding&) const = default;
};

/// Findings by invariant; an invariant that does not apply has no entry.
using Findings = std::map<Invariant, Finding>;

/// Adds the findings of another run of the same system: sums the numbers, and keeps the worse verdict with its detail.
void join(Finding& all, const Finding& more);
void join(Findings& all, const Findings& more);

/// Returns the findings with `words` and a colon before each detail.
Findings with_words(std::string_view words, Findings findings);

/// A system over a scene.
struct StressCell {
    enum class Kind { builder, collider, host, library };

    std::string family = {}, scene = {};
    std::int64_t triangles = 0;
    std::string system = {};
    Kind kind = Kind::builder;
    std::string library = {};  ///< library that the system belongs to; empty: this project
    Findings findings = {};

    bool operator==(const StressCell&) const = default;
};

inline constexpr std::array stress_kind_names = {"builder", "collider", "host", "library"};
inline constexpr std::array stress_verdict_names = {"holds", "refused", "broken"};

/// True if an invariant is broken.
bool is_any_broken(const Findings& findings);

/// True if the system refused under every invariant. Always false for kind `host`, for which a refusal is an answer.
bool is_refused(const StressCell& cell);

/// True if a system of this project, not of a library, breaks an invariant.
bool is_our_fault(const StressCell& cell);

}  // namespace bvhbench
