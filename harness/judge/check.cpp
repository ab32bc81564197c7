// SPDX-License-Identifier: MIT
#include "harness/judge/check.h"

#include "builders/spell_out.h"
#include "geometry/hash.h"
#include "harness/base/failure.h"

namespace bvhbench {
namespace {

/// What a tree without an oracle is held against.
constexpr std::string_view promises_name = "contract";

}  // namespace

void Oracle::begin(std::string_view reference, const std::string& order, const std::string& boxes)
{
    std::shared_future<std::uint64_t>& hash = hashes_[{std::string(reference), order, boxes}];
    if (!hash.valid())
        hash = std::async(std::launch::async, [this, name = std::string(reference), order, boxes] {
            return built(name, order, boxes);
        });
}

void Oracle::wait() const
{
    for (const auto& [of, hash] : hashes_)
        hash.wait();
}

std::uint64_t Oracle::tree_hash(std::string_view reference, const std::string& order,
                                const std::string& boxes)
{
    begin(reference, order, boxes);
    return hashes_[{std::string(reference), order, boxes}].get();
}

/// By a builder of its own, for the cell under test may be the reference itself, in a queue of its own.
std::uint64_t Oracle::built(std::string_view reference, const std::string& order,
                            const std::string& boxes) const
{
    BuilderChoice choice;
    choice.name = reference;
    choice.order = order;
    const auto builder = make_builder(choice, session_.programs());
    builder->reserve(input_.triangle_count());
    Queue queue(session_.device());
    const Tree& tree = builder->build(input_, queue, Start::from_triangles);
    queue.finish();
    return bvhbench::tree_hash(rounded_to(tree.spelled_out(), find_box_format(boxes)));
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
    if (!reference.empty())
        oracle.begin(reference, builder.order, builder.boxes);
    check.tree_hash = bvhbench::tree_hash(tree);
    check.detail = broken_promise(tree, input.points, input.faces);
    if (!check.detail.empty()) {
        check.verdict = differs;
        return check;
    }
    if (reference.empty())
        return check;
    std::uint64_t expected = 0;
    const std::string failure = reason_of_failure(
        [&] { expected = oracle.tree_hash(reference, builder.order, builder.boxes); });
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
    const std::uint64_t expected = bvhbench::tree_hash(refitted(built, input.points, input.faces));
    before.tree_hash = bvhbench::tree_hash(tree);
    if (before.tree_hash == expected)
        return before;
    const std::string wrong = broken_promise(tree, input.points, input.faces);
    before.verdict = Check::Verdict::differs;
    before.detail = !wrong.empty()
                        ? wrong
                        : "a valid tree, but the refit on the host has the hash " + hex(expected);
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
