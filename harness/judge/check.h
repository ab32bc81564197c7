// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <map>
#include <string>
#include <string_view>

#include "harness/record/record.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Hashes of the correct trees over one input: those of the reference builders, each built once per order and format, on another
/// core. Reference builders run on the host (harness/choice/catalog.cpp), so they share nothing of the session with the caller.
class Oracle {
public:
    Oracle(Session& session, const Input& input) : session_(session), input_(input) {}

    /// Starts building, unless it was started, the tree of the builder `reference` over leaves in `order`, with boxes in the
    /// format `boxes`. Nothing may be timed before wait(). Returns the tree's hash; get() throws what the builder throws.
    std::shared_future<std::uint64_t> begin(std::string_view reference, const std::string& order,
                                            const std::string& boxes = "f32");

    /// Blocks until all trees that were begun are built.
    void wait() const;

private:
    Session& session_;
    const Input& input_;
    /// By builder, order, boxes.
    std::map<std::array<std::string, 3>, std::shared_future<std::uint64_t>> hashes_;
};

/// Returns the tree that the session's builder leaves over the input as one object. It is valid until that builder builds again.
/// Throws what the builder throws.
const Tree& built_tree(Session& session, const BuilderChoice& choice, const Input& input);

/// Returns an upper estimate of the host memory, in bytes, that check_tree takes for trees over `triangles` triangles.
std::uint64_t check_bytes(std::uint64_t triangles);

/// Returns the verdict on a tree over the oracle's input: whether it is valid (invariant_violation) and, if the builder's catalog
/// entry names an oracle, whether it equals the reference bit for bit.
Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle);

/// Returns the verdict on `tree`, a refit to `input` of the tree `built`, whose verdict is `before`. Its boxes must be those
/// that the host computes for `built` over the moved points, and nothing else may have changed.
Check check_refit(const HostTree& tree, const HostTree& built, const Input& input, Check before);

/// Returns `before`, or the verdict `differs` if `tree`, the last one sampled over `input`, is not the tree of `before`. Timed trees
/// are checked because data races may strike in some runs only. Trees from outside, which may differ from run to run, need only
/// be valid.
Check check_again(const Tree& tree, const Input& input, Check before);

/// Returns the first requirement that a builder breaks over `input`, as a sentence; empty if it meets all of them:
///
/// it reserves as much memory as it predicted; its tree is valid (invariant_violation) and equals the oracle's if its entry names
/// one; a second build and a build from sorted leaves give the same tree; a refit to moved points keeps the topology and makes
/// every box right; a build after that refit gives the first tree again.
/// A builder whose entry has may_refuse passes if it throws Unavailable; `refused`, if given, is set to true in that case.
std::string contract_violation(Session& session, const BuilderChoice& choice, const Input& input,
                               Oracle& oracle, bool* refused = nullptr);

}  // namespace bvhbench
