// SPDX-License-Identifier: MIT
#include "harness/check.h"

#include <future>

#include "builders/spell_out.h"
#include "geometry/hash.h"
#include "harness/failure.h"

namespace bvhbench {
namespace {

/// What a tree without an oracle is held against.
constexpr std::string_view promises_name = "contract";

}  // namespace

std::uint64_t Oracle::tree_hash(std::string_view reference_name, const std::string& order)
{
    const std::pair key{std::string(reference_name), order};
    if (const auto known = hashes_.find(key); known != hashes_.end())
        return known->second;
    BuilderChoice choice;
    choice.name = reference_name;
    choice.order = order;
    // A builder of its own: the cell under test may be the reference itself.
    const auto reference = make_builder(choice, session_.programs());
    reference->reserve(input_.triangle_count());
    const Tree* tree = nullptr;
    session_.build_once(*reference, input_, Start::from_triangles, &tree);
    return hashes_[key] = bvhbench::tree_hash(tree->spelled_out());
}

std::uint64_t check_bytes(std::uint64_t triangles)
{
    // The tree and the reference's, spelled out, two nodes a triangle; what either is spelled out of, boxes of all nodes
    // and of leaves, and ids; and the reference's codes.
    constexpr std::uint64_t spelled_out = 2 * sizeof(HostTree::Node);
    constexpr std::uint64_t kept = 3 * sizeof(Aabb) + sizeof(uint);
    return triangles * (2 * (spelled_out + kept) + 2 * sizeof(ulong));
}

Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle)
{
    using enum Check::Verdict;
    const std::string_view reference = find_builder(builder.name).oracle;
    Check check{agrees, std::string(reference.empty() ? promises_name : reference), {}, {}};
    // Meanwhile on another core, for it takes as long. Nothing else asks the oracle, or the session that it builds in.
    std::uint64_t expected = 0;
    std::future<std::string> reference_built;
    if (!reference.empty())
        reference_built = std::async(std::launch::async, [&] {
            return reason_of_failure(
                [&] { expected = oracle.tree_hash(reference, builder.order); });
        });
    check.detail = broken_promise(tree, input.points, input.faces);
    check.tree_hash = bvhbench::tree_hash(tree);
    const std::string failure = reference.empty() ? "" : reference_built.get();
    if (!check.detail.empty()) {
        check.verdict = differs;
        return check;
    }
    if (reference.empty())
        return check;
    if (!failure.empty()) {
        check.verdict = not_checked;
        check.detail = "the reference failed: " + failure;
    } else if (*check.tree_hash != expected) {
        check.verdict = differs;
        check.detail = "a valid tree, but the reference's has the hash " + hex(expected);
    }
    return check;
}

Check check_refit(const HostTree& tree, const HostTree& built, const Input& input, Check before)
{
    before.against += ", refitted";
    if (before.verdict == Check::Verdict::differs)
        return before;
    const HostTree expected = refitted(built, input.points, input.faces);
    before.tree_hash = bvhbench::tree_hash(tree);
    const bool is_same = same_refit(tree, expected);
    std::string wrong;
    if (!is_same || !tree.is_tight)  // else the hash says it all
        wrong = broken_promise(tree, input.points, input.faces);
    if (is_same && wrong.empty())
        return before;
    before.verdict = Check::Verdict::differs;
    before.detail = !wrong.empty() ? wrong
                                   : "a valid tree, but the refit on the host has the hash " +
                                         hex(bvhbench::tree_hash(expected));
    return before;
}

Check check_again(const Tree& tree, Check before)
{
    const std::uint64_t hash = bvhbench::tree_hash(tree.spelled_out());
    if (before.verdict == Check::Verdict::differs || hash == before.tree_hash)
        return before;
    before.verdict = Check::Verdict::differs;
    before.detail =
        "it was the tree " + hex(*before.tree_hash) + " at first and " + hex(hash) + " at last";
    before.tree_hash = hash;
    return before;
}

}  // namespace bvhbench
