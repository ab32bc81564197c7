// SPDX-License-Identifier: MIT
//
// Shared by the tests of libraries' colliders: frames whose points move, and the pairs of one query.
#pragma once

#include "baselines/baselines.h"
#include "tests/collide/collider_testing.h"
#include "tests/needing.h"

namespace bvhbench {

inline constexpr Among all_kinds[] = {Among::all, Among::between_objects, Among::within_objects};

/// Runs one query and returns its pairs, sorted. Expects each pair to occur once.
inline PairList found_by(Collider& collider, const Input& input)
{
    EXPECT_EQ(find_pairs(collider, nullptr, input, session().queue()), 1);
    const PairList found(collider.pairs(session().queue()));
    EXPECT_EQ(found.surplus(), 0u);
    EXPECT_EQ(collider.counts(session().queue()).pairs, found.size());
    session().queue().finish();
    return found;
}

/// Tests of a library's colliders, which build anew or, with the parameter true, refit. Skipped without the library.
template <MakeCollider built, MakeCollider refit, const std::string_view& absent>
class OfALibrary : public Needing<testing::TestWithParam<bool>, absent> {
protected:
    static bool is_refit() { return testing::TestWithParam<bool>::GetParam(); }
    static std::unique_ptr<Collider> made(const ColliderOptions& options)
    {
        return (is_refit() ? refit : built)(session().programs(), options);
    }
};

/// Tests of each collider of a library, by its name. Skipped without the library.
class EachLibraryCollider : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        if (find_collider(GetParam()).make == nullptr)
            GTEST_SKIP() << find_collider(GetParam()).absent;
    }
    static std::unique_ptr<Collider> made(Among among, unsigned rules_off = 0)
    {
        return make_collider(
            {{.among = among, .keep_adjacent = false, .rules_off = rules_off}, GetParam()},
            session().programs());
    }
};

inline constexpr const char* library_colliders[] = {"embree", "embree-refit", "fcl", "fcl-refit"};

/// Returns the points moved, so that other objects overlap than before.
inline std::vector<Point> moved(std::vector<Point> points)
{
    for (std::size_t k = 0; k < points.size(); ++k) {
        points[k].x = 0.75f * points[k].x + 0.01f * static_cast<float>(k % 7);
        points[k].y += 0.01f * static_cast<float>(k % 5);
    }
    return points;
}

}  // namespace bvhbench
