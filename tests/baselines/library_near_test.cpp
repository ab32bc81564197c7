// SPDX-License-Identifier: MIT
//
// The rule `near` of libraries: objects far from all others get no tree, and are found as soon as they come near.
#include "collide/skips.h"
#include "tests/baselines/library_colliders.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using LibraryNear = EachLibraryCollider;

/// Returns three objects in general position, of which the last lies `along` from the others.
ManyObjects three(float along)
{
    ManyObjects many({});
    const Mesh part = crowded_mesh(300);
    many.add(part);
    many.add(part, 0.01f);
    many.add(part, along);
    return many;
}

std::uint64_t trees_made(const Collider& collider)
{
    const QueryCounts counts = collider.counts(session().queue());
    EXPECT_EQ(counts.more.size(), 1u);
    return counts.more.front().second;
}

TEST_P(LibraryNear, LeavesOutObjectsThatMeetNoOtherAndFindsThemWhenTheyDo)
{
    const ManyObjects apart = three(1000), together = three(0.02f);
    const auto ruled = made(Among::between_objects);
    const auto whole = made(Among::between_objects, skip_near);
    bool is_reserved = false;
    for (const ManyObjects* frame : {&apart, &together, &apart}) {
        const Input input = uploaded(frame->mesh.points, frame->mesh.faces, frame->objects);
        if (!std::exchange(is_reserved, true))
            for (Collider* const collider : {ruled.get(), whole.get()})
                collider->reserve(nullptr, input);
        const PairList found = found_by(*ruled, input);
        EXPECT_GT(found.size(), 0u);
        EXPECT_EQ(found, found_by(*whole, input));
        EXPECT_EQ(trees_made(*ruled), frame == &apart ? 2u : 3u);
        EXPECT_EQ(trees_made(*whole), 3u);
    }
}

TEST_P(LibraryNear, MakesEveryTreeForPairsWithinObjects)
{
    const ManyObjects apart = three(1000);
    const Input input = uploaded(apart.mesh.points, apart.mesh.faces, apart.objects);
    for (const Among among : {Among::all, Among::within_objects}) {
        const auto collider = made(among);
        collider->reserve(nullptr, input);
        found_by(*collider, input);
        EXPECT_EQ(trees_made(*collider), 3u);
    }
}

INSTANTIATE_TEST_SUITE_P(Libraries, LibraryNear, testing::ValuesIn(library_colliders), CaseName());

}  // namespace
}  // namespace bvhbench
