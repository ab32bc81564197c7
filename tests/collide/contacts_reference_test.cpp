// SPDX-License-Identifier: MIT
//
// Compares contacts with the counts of a separate program on real meshes, and pair for pair with CGAL. From triangles to
// contacts, everything stays on the device.
#include "collide/narrow/narrow.h"
#include "collide/oracles/exact_reference.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/reference_testing.h"

namespace bvhbench {
namespace {

struct Chain {
    PairList candidates;
    PairList contacts;
};

/// Runs the broad phase and the narrow phase directly after it, repeated until both are complete.
Chain run_chain(const Standing& standing, KernelForm form, bool keep_adjacent)
{
    Queue& queue = session().queue();
    const auto collider = made("group", {.keep_adjacent = keep_adjacent, .form = form});
    NarrowPhase narrow(session().programs(), {.keep_adjacent = keep_adjacent, .form = form});
    collider->reserve(standing.tree, standing.input);
    narrow.reserve(standing.mesh.faces.size());
    bool broad_complete = false, narrow_complete = false;
    while (!broad_complete || !narrow_complete) {
        collider->query(standing.tree, standing.input, queue);
        const DevicePairs found = collider->device_pairs(queue);
        narrow.query(standing.input, found.pairs, found.counters, queue);
        narrow_complete = narrow.complete(queue);
        broad_complete = collider->complete(queue);
    }
    Chain chain = {PairList(collider->pairs(queue)), PairList(narrow.contacts(queue))};
    EXPECT_EQ(narrow.counts(queue).candidates(), chain.candidates.size());
    EXPECT_EQ(chain.contacts.surplus(), 0u);
    queue.finish();
    return chain;
}

class ContactsReference : public testing::TestWithParam<KernelForm> {
protected:
    void SetUp() override
    {
        if (data_folder().empty())
            GTEST_SKIP() << no_data_sets;
    }

    static void expect_reference(const Standing& standing, const nlohmann::json& reference)
    {
        const Chain chain = run_chain(standing, GetParam(), false);
        const std::size_t between = reference["exact_inter"];
        const std::size_t apart = reference["exact_self_nonadj"];
        EXPECT_EQ(reference["pairs_with_degenerate"], 0u);
        EXPECT_EQ(chain.contacts.size(), between + apart);
        EXPECT_EQ(hex(chain.contacts.hash()), reference["exact_hash"]);
    }

    static void expect_cgal(const Standing& standing, bool keep_adjacent)
    {
        if (!has_exact_reference)
            return;
        const Chain chain = run_chain(standing, GetParam(), keep_adjacent);
        EXPECT_EQ(chain.contacts, intersecting_pairs(standing.mesh.points, standing.mesh.faces,
                                                     chain.candidates.pairs(), keep_adjacent));
    }
};

TEST_P(ContactsReference, StaticMeshesHaveTheContactsTheReferenceCounted)
{
    compare_static_meshes(250'000, [](const DataSetMesh& file, const nlohmann::json& reference) {
        const Standing standing({file.points, file.faces}, "oibvh-multi");
        expect_reference(standing, reference);
        expect_cgal(standing, false);
        expect_cgal(standing, true);
    });
}

TEST_P(ContactsReference, EveryFrameOfTheSequencesHasTheContactsTheReferenceCounted)
{
    compare_frames([](const DataSetMesh& file, const nlohmann::json& reference, bool is_last) {
        const Standing standing({file.points, file.faces}, "oibvh-multi");
        expect_reference(standing, reference);
        if (is_last) {
            expect_cgal(standing, false);
            expect_cgal(standing, true);
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Forms, ContactsReference, both_forms, CaseName());

}  // namespace
}  // namespace bvhbench
