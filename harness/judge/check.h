// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Knows the right trees of one input: those of the reference builders, each built once an order, on another core.
/// References are host builders (harness/choice/catalog.cpp), so nothing of the session is shared with who goes on meanwhile.
class Oracle {
public:
    Oracle(Session& session, const Input& input) : session_(session), input_(input) {}

    /// Begin the tree that the builder `reference` leaves of leaves in that order, its boxes rounded to such a format,
    /// unless it was. Nothing may be timed before wait(). Its hash; getting it throws what the builder throws.
    std::shared_future<std::uint64_t> begin(std::string_view reference, const std::string& order,
                                            const std::string& boxes = "f32");

    /// Until all that was begun is there.
    void wait() const;

private:
    Session& session_;
    const Input& input_;
    std::map<std::array<std::string, 3>, std::shared_future<std::uint64_t>>
        hashes_;  ///< by builder, order, boxes
};

/// The tree that the session's builder leaves over an input as one object. It stands until that builder builds again. Throws
/// what the builder throws.
const Tree& built_tree(Session& session, const BuilderChoice& choice, const Input& input);

/// Bytes of the host that check_tree takes at most, about, of trees over so many triangles.
std::uint64_t check_bytes(std::uint64_t triangles);

/// The verdict on a tree over the oracle's input: every promise of a builder, then, if the builder's entry
/// names an oracle, the reference's bits.
Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle);

/// The verdict on `tree`, a refit to `input` of the tree `built`, which has the verdict `before`: its boxes must
/// be those that the host computes for `built` over the moved points, and nothing else may have changed.
Check check_refit(const HostTree& tree, const HostTree& built, const Input& input, Check before);

/// The verdict `before`, unless `tree`, the last of those sampled, is another one: then that differs.
/// Hand-offs that race do so sometimes, so the trees that were timed are looked at as well.
Check check_again(const Tree& tree, Check before);

/// The first promise that a builder breaks over `input`, as a sentence; empty if it keeps all of them:
///
/// what it reserves is what it predicted; its tree is one (broken_promise) and, if its entry names an oracle,
/// the oracle's; a second build leaves the same tree; so does a build from sorted leaves; a refit to moved points
/// keeps the topology and makes every box right, and a build after it leaves the first tree again.
/// A builder whose entry may_refuse passes when it throws Unavailable; `refused`, if given, says whether it did.
std::string broken_contract(Session& session, const BuilderChoice& choice, const Input& input,
                            Oracle& oracle, bool* refused = nullptr);

}  // namespace bvhbench
