// SPDX-License-Identifier: MIT
#include "harness/judge/contract.h"

#include <vector>

#include "builders/spell_out.h"
#include "geometry/error.h"
#include "geometry/hash.h"

namespace bvhbench {
namespace {

std::string text_of(const Footprint& footprint)
{
    return std::to_string(footprint.tree_bytes) + " + " + std::to_string(footprint.scratch_bytes) +
           " bytes";
}

std::string broken_footprint(const Builder& builder, std::size_t triangles)
{
    const Footprint predicted = builder.footprint(triangles);
    const Footprint reserved = builder.reserved();
    if (predicted == reserved)
        return {};
    return "predicted " + text_of(predicted) + ", reserved " + text_of(reserved);
}

std::string other_tree(const Tree& tree, std::uint64_t expected, const char* which)
{
    const std::uint64_t hash = tree_hash(tree.spelled_out());
    if (hash == expected)
        return {};
    return std::string(which) + " left the tree " + hex(hash) + ", the first " + hex(expected);
}

/// What is wrong with a refit of the tree that `builder` has just left, all points moved elsewhere.
std::string broken_refit(Session& session, Builder& builder, const Input& input, const Tree& built)
{
    const HostTree before = built.spelled_out();
    std::vector<Point> moved;  // as far as can be without leaving the numbers that the scene holds
    for (std::size_t k = input.points.size(); k-- > 0;)
        moved.push_back({input.points[k].y, input.points[k].z, input.points[k].x});
    const Input moved_input = upload(session.device(), session.queue(), moved, input.faces);
    const Tree& tree = builder.refit(moved_input, session.queue());
    session.queue().finish();
    const HostTree after = tree.spelled_out();
    const std::string wrong = broken_promise(after, moved, input.faces);
    if (!wrong.empty())
        return "after a refit, " + wrong;
    const bool is_same = tree_hash(after) == tree_hash(refitted(before, moved, input.faces));
    return is_same ? "" : "a refit changed the topology";
}

std::string broken_promise_of_build(Session& session, const BuilderChoice& choice,
                                    const Input& input, Oracle& oracle)
{
    Builder& builder = session.builder(choice);
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    session.build_once(builder, input, Start::from_triangles, &tree);
    const Check check = check_tree(tree->spelled_out(), input, choice, oracle);
    if (check.verdict != Check::Verdict::agrees)
        return check.detail;
    std::string wrong = broken_footprint(builder, input.triangle_count());
    if (wrong.empty()) {
        session.build_once(builder, input, Start::from_triangles, &tree);
        wrong = other_tree(*tree, *check.tree_hash, "the second build");
    }
    if (wrong.empty()) {
        session.build_once(builder, input, Start::from_sorted_leaves, &tree);
        wrong = other_tree(*tree, *check.tree_hash, "the build from sorted leaves");
    }
    if (wrong.empty() && builder.can_refit()) {
        wrong = broken_refit(session, builder, input, *tree);
        session.build_once(builder, input, Start::from_triangles, &tree);
        if (wrong.empty())
            wrong = other_tree(*tree, *check.tree_hash, "the build after a refit");
    }
    return wrong;
}

}  // namespace

std::string broken_contract(Session& session, const BuilderChoice& choice, const Input& input,
                            Oracle& oracle, bool* refused)
{
    if (refused != nullptr)
        *refused = false;
    try {
        return broken_promise_of_build(session, choice, input, oracle);
    } catch (const Unavailable&) {
        if (find_builder(choice.name).may_refuse.empty())
            throw;
        session.renew_queue();
        if (refused != nullptr)
            *refused = true;
        return {};
    }
}

}  // namespace bvhbench
