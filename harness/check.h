// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "harness/record.h"
#include "harness/session.h"

namespace bvhbench {

/// Knows the right tree of one input in each order: the reference's, built once an order.
class Oracle {
public:
    Oracle(Session& session, const Input& input) : session_(session), input_(input) {}

    /// Throws what the reference throws.
    std::uint64_t tree_hash(const std::string& order);

private:
    Session& session_;
    const Input& input_;
    std::map<std::string, std::uint64_t> hashes_;
};

/// The verdict on a tree over the oracle's input: every promise of a builder, then, if the builder's entry
/// names an oracle, the reference's bits.
Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle);

/// The verdict `before`, unless `tree`, the last of those sampled, is another one: then that differs.
/// Hand-offs that race do so sometimes, so the trees that were timed are looked at as well.
Check check_again(const Tree& tree, Check before);

}  // namespace bvhbench
