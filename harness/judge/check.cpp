// SPDX-License-Identifier: MIT
#include "harness/judge/check.h"

#include "builders/host_tree.h"
#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/base/failure.h"

namespace bvhbench {
namespace {

/// Name of the check for trees that have no oracle.
constexpr std::string_view contract_name = "contract";

std::string footprint_violation(const Builder& builder, std::size_t triangles)
{
    const Footprint predicted = builder.footprint(triangles);
    const Footprint reserved = builder.reserved();
    const auto text_of = [](const Footprint& footprint) {
        return std::to_string(footprint.tree_bytes) + " + " +
               std::to_string(footprint.scratch_bytes) + " bytes";
    };
    if (predicted == reserved)
        return {};
    return "predicted " + text_of(predicted) + ", reserved " + text_of(reserved);
}

/// Returns what is wrong with a refit, to moved points, of the tree that `builder` has just left; empty if it is right.
std::string refit_violation(Session& session, Builder& builder, const Input& input,
                            const Tree& built)
{
    const HostTree before = built.to_host_tree();
    std::vector<Point> moved;  // in reverse order, with permuted axes
    for (std::size_t k = input.points.size(); k-- > 0;)
        moved.push_back({input.points[k].y, input.points[k].z, input.points[k].x});
    const Input moved_input = upload(session.device(), session.queue(), moved, input.faces);
    const Tree& tree = builder.refit(moved_input, session.queue());
    session.queue().finish();
    const std::string wrong = check_refit(tree.to_host_tree(), before, moved_input, {}).detail;
    return wrong.empty() ? "" : "after a refit, " + wrong;
}

}  // namespace

const Tree& built_tree(Session& session, const BuilderChoice& choice, const Input& input)
{
    Builder& builder = session.builder(choice);
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    session.build_once(builder, input, Start::from_triangles, &tree);
    return *tree;
}

std::shared_future<std::uint64_t> Oracle::begin(std::string_view reference,
                                                const std::string& order, const std::string& boxes)
{
    std::shared_future<std::uint64_t>& hash = hashes_[{std::string(reference), order, boxes}];
    // A new builder with a new queue, since the cell under test may use the reference builder itself.
    const auto built = [this, choice = BuilderChoice{{.order = order}, std::string(reference)},
                        boxes] {
        const auto builder = make_builder(choice, session_.programs());
        builder->reserve(input_.triangle_count());
        Queue queue(session_.device());
        const Tree& tree = builder->build(input_, queue, Start::from_triangles);
        queue.finish();
        return tree_hash(rounded_to(tree.to_host_tree(), find_box_format(boxes)));
    };
    if (!hash.valid())
        hash = std::async(std::launch::async, built);
    return hash;
}

void Oracle::wait() const
{
    for (const auto& [of, hash] : hashes_)
        hash.wait();
}

std::uint64_t check_bytes(std::uint64_t triangles)
{
    // Both trees spelled out, two nodes a triangle; the sources of both: boxes of all nodes and of leaves, and ids; the
    // reference's codes.
    constexpr std::uint64_t host_tree_bytes = 2 * sizeof(HostTree::Node);
    constexpr std::uint64_t kept = 3 * sizeof(Aabb) + sizeof(uint);
    return triangles * (2 * (host_tree_bytes + kept) + 2 * sizeof(ulong));
}

Check check_tree(const HostTree& tree, const Input& input, const BuilderChoice& builder,
                 Oracle& oracle)
{
    using enum Check::Verdict;
    const std::string_view reference = find_builder(builder.name).oracle;
    Check check{agrees, std::string(reference.empty() ? contract_name : reference), {}, {}};
    if (!reference.empty())
        oracle.begin(reference, builder.order, builder.boxes);
    check.tree_hash = tree_hash(tree);
    const std::string wrong = invariant_violation(tree, input.points, input.faces);
    if (!wrong.empty())
        check.find_wrong(wrong);
    if (!wrong.empty() || reference.empty())
        return check;
    std::uint64_t expected = 0;
    const std::string failure = reason_of_failure(
        [&] { expected = oracle.begin(reference, builder.order, builder.boxes).get(); });
    if (!failure.empty()) {
        check.verdict = not_checked;
        check.detail = "the reference failed: " + failure;
    } else if (*check.tree_hash != expected) {
        check.find_wrong("a valid tree, but the reference's has the hash " + hex(expected));
    }
    return check;
}

Check check_refit(const HostTree& tree, const HostTree& built, const Input& input, Check before)
{
    before.against += ", refitted";
    if (before.verdict == Check::Verdict::differs)
        return before;
    const std::uint64_t expected = tree_hash(refitted(built, input.points, input.faces));
    before.tree_hash = tree_hash(tree);
    if (before.tree_hash == expected)
        return before;
    const std::string wrong = invariant_violation(tree, input.points, input.faces);
    // Larger boxes are right around the same topology, which the boxes that fit tell.
    if (wrong.empty() && tree.boxes_may_be_larger &&
        tree_hash(refitted(tree, input.points, input.faces)) == expected)
        return before;
    before.find_wrong(!wrong.empty() ? wrong
                                     : "a valid tree, but the refit on the host has the hash " +
                                           hex(expected));
    return before;
}

Check check_again(const Tree& tree, const Input& input, Check before)
{
    const HostTree plain = tree.to_host_tree();
    const std::uint64_t hash = tree_hash(plain);
    if (before.verdict == Check::Verdict::differs || hash == before.tree_hash)
        return before;
    if (plain.boxes_may_be_larger) {
        if (std::string wrong = invariant_violation(plain, input.points, input.faces);
            !wrong.empty())
            before.find_wrong(wrong);
        return before;
    }
    before.find_wrong("it was the tree " + hex(*before.tree_hash) + " at first and " + hex(hash) +
                      " at last");
    before.tree_hash = hash;
    return before;
}

std::string contract_violation(Session& session, const BuilderChoice& choice, const Input& input,
                               Oracle& oracle, bool* refused)
try {
    if (refused != nullptr)
        *refused = false;
    const Tree* tree = &built_tree(session, choice, input);
    Builder& builder = session.builder(choice);
    const Check check = check_tree(tree->to_host_tree(), input, choice, oracle);
    if (check.verdict != Check::Verdict::agrees)
        return check.detail;
    std::string wrong = footprint_violation(builder, input.triangle_count());
    const auto build_again = [&](Start start, const char* which) {
        if (!wrong.empty())
            return;
        session.build_once(builder, input, start, &tree);
        wrong = check_again(*tree, input, check).detail;
        if (!wrong.empty())
            wrong = std::string(which) + ": " + wrong;
    };
    build_again(Start::from_triangles, "the second build");
    if (find_builder(choice.name).outside == nullptr)
        build_again(Start::from_sorted_leaves, "the build from sorted leaves");
    if (wrong.empty() && builder.can_refit()) {
        wrong = refit_violation(session, builder, input, *tree);
        build_again(Start::from_triangles, "the build after a refit");
    }
    return wrong;
} catch (const Unavailable&) {
    if (find_builder(choice.name).may_refuse.empty())
        throw;
    session.renew_queue();
    if (refused != nullptr)
        *refused = true;
    return {};
}

}  // namespace bvhbench
