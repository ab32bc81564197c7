// SPDX-License-Identifier: MIT
//
// What `stress` says of a system over a scene: a finding an invariant.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace bvhbench {

/// What must hold over every scene of finite coordinates. docs/stress.md says each in a paragraph.
enum class Invariant {
    ends,    ///< it ends, with an answer
    leaves,  ///< each triangle is in exactly one leaf
    boxes,   ///< boxes of leaves are their triangles', those above their children's, bit for bit
    layout,  ///< nodes and bytes are as many as the layout says, in no other order than the reference's
    pairs,     ///< the pairs of boxes that overlap, all and no others
    contacts,  ///< the pairs of triangles that intersect, all and no others
    agree,     ///< the same after triangles are shuffled, and after objects are swapped
    moved,  ///< the same after a scale by a power of two, and after a translation that no float is rounded by
    room,  ///< the same when buffers and queues begin with room for one entry
    same,  ///< the same, bit for bit, each time
};

inline constexpr std::array invariant_names = {"ends",     "leaves", "boxes", "layout", "pairs",
                                               "contacts", "agree",  "moved", "room",   "same"};

constexpr std::string_view name_of(Invariant invariant)
{
    return invariant_names[static_cast<std::size_t>(invariant)];
}

struct Finding {
    enum class Verdict { holds, broken, refused } verdict = Verdict::holds;
    std::uint64_t checked = 0;  ///< how many things were looked at: pairs, nodes, runs
    std::uint64_t wrong = 0;    ///< of those; 0 beside `broken` if it cannot be said
    std::uint64_t missed = 0;   ///< of those: what is there and was not found
    std::string detail = {};    ///< what is wrong, or why it was refused

    bool operator==(const Finding&) const = default;
};

/// By invariant; one that is not there does not apply.
using Findings = std::map<Invariant, Finding>;

/// Join what another run of the same system found: numbers are added up, the worse verdict stays with its words.
void join(Finding& all, const Finding& more);
void join(Findings& all, const Findings& more);

/// The same findings, with `words` and a colon before what is wrong with them.
Findings with_words(std::string_view words, Findings findings);

/// A system over a scene.
struct StressCell {
    enum class Kind { builder, collider, host, library };

    std::string family, scene;
    std::int64_t triangles = 0;
    std::string system;
    Kind kind = Kind::builder;
    std::string library;  ///< whose code it is; empty: ours
    Findings findings;

    bool operator==(const StressCell&) const = default;
};

inline constexpr std::array stress_kind_names = {"builder", "collider", "host", "library"};
inline constexpr std::array stress_verdict_names = {"holds", "broken", "refused"};

/// Whether nothing was found out but that it is refused. Of the host, a refusal is an answer.
bool is_refused(const StressCell& cell);

/// Whether one of ours is wrong.
bool is_our_fault(const StressCell& cell);

}  // namespace bvhbench
