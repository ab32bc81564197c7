// SPDX-License-Identifier: MIT
#include "harness/check.h"

#include "builders/spell_out.h"
#include "geometry/hash.h"
#include "harness/failure.h"

namespace bvhbench {
namespace {

/// What a tree without an oracle is held against.
constexpr const char* promises_name = "contract";

}  // namespace

std::uint64_t Oracle::tree_hash(const std::string& order)
{
    if (const auto known = hashes_.find(order); known != hashes_.end())
        return known->second;
    BuilderChoice choice;
    choice.name = reference_builder;
    choice.order = order;
    // A builder of its own: the cell under test may be the reference itself.
    const auto reference = make_builder(choice, session_.programs());
    reference->reserve(input_.triangle_count());
    const Tree* tree = nullptr;
    session_.build_once(*reference, input_, Start::from_triangles, &tree);
    return hashes_[order] = bvhbench::tree_hash(tree->spelled_out());
}

Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle)
{
    using enum Check::Verdict;
    const bool has_oracle = !find_builder(builder.name).oracle.empty();
    Check check{agrees,
                has_oracle ? std::string(reference_builder) : promises_name,
                {},
                bvhbench::tree_hash(tree)};
    check.detail = broken_promise(tree, input.points, input.faces);
    if (!check.detail.empty()) {
        check.verdict = differs;
        return check;
    }
    if (!has_oracle)
        return check;
    std::uint64_t expected = 0;
    const std::string failure =
        reason_of_failure([&] { expected = oracle.tree_hash(builder.order); });
    if (!failure.empty()) {
        check.verdict = not_checked;
        check.detail = "the reference failed: " + failure;
    } else if (*check.tree_hash != expected) {
        check.verdict = differs;
        check.detail = "a valid tree, but the reference's has the hash " + hex(expected);
    }
    return check;
}

Check check_again(const Tree& tree, Check before)
{
    const std::uint64_t hash = bvhbench::tree_hash(tree.spelled_out());
    if (before.verdict == Check::Verdict::differs || hash == before.tree_hash)
        return before;
    before.verdict = Check::Verdict::differs;
    before.detail =
        "the first build left the tree " + hex(*before.tree_hash) + ", the last " + hex(hash);
    before.tree_hash = hash;
    return before;
}

}  // namespace bvhbench
