// SPDX-License-Identifier: MIT
//
// Contacts against what a separate program counted on real meshes, and against CGAL pair for pair: from triangles to
// contacts on the device, with nothing read back in between.
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "collide/narrow/narrow.h"
#include "collide/oracles/exact_reference.h"
#include "geometry/hash.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/data_set.h"

namespace bvhbench {
namespace {

struct Chain {
    PairList candidates;
    PairList contacts;
};

nlohmann::json read_json(const std::filesystem::path& path)
{
    std::ifstream in(path);
    return nlohmann::json::parse(in);
}

/// The broad phase, and the narrow phase right behind it until both had room.
Chain run_chain(const Standing& standing, KernelForm form, bool keep_adjacent)
{
    Queue& queue = session().queue();
    const auto collider = find_collider("group").make(
        session().programs(), {.keep_adjacent = keep_adjacent, .form = form});
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
        const char* data = std::getenv("BVHBENCH_DATA");
        if (data == nullptr || *data == '\0')
            GTEST_SKIP() << "BVHBENCH_DATA is not set: nothing is compared with the data sets";
        data_ = data;
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
                                                     chain.candidates, keep_adjacent));
    }

    std::filesystem::path data_;
};

TEST_P(ContactsReference, StaticMeshesHaveTheContactsTheReferenceCounted)
{
    std::size_t compared = 0;
    const nlohmann::json references = read_json(data_ / "static/reference.json");
    for (const auto& [name, reference] : references.items()) {
        SCOPED_TRACE(name);
        const std::filesystem::path path = data_ / "static" / name;
        if (reference["tris"] > 250'000 || !std::filesystem::exists(path)) {
            std::cout << "large or not there, not compared: " << name << '\n';
            continue;
        }
        const DataSetMesh file = read_data_set_mesh(path);
        const Standing standing({file.points, file.faces}, find_builder("oibvh-multi").make);
        expect_reference(standing, reference);
        expect_cgal(standing, false);
        expect_cgal(standing, true);
        ++compared;
    }
    EXPECT_GT(compared, 0u);
}

TEST_P(ContactsReference, EveryFrameOfTheSequencesHasTheContactsTheReferenceCounted)
{
    std::size_t compared = 0;
    for (const auto& entry : std::filesystem::directory_iterator(data_ / "dynamic")) {
        SCOPED_TRACE(entry.path().filename().string());
        const nlohmann::json meta = read_json(entry.path() / "meta.json");
        const DataSetMesh mesh = read_data_set_mesh(entry.path() / "mesh.ply");
        const auto frames =
            read_frames(entry.path() / "frames.f32", meta["frames"], mesh.points.size());
        for (const nlohmann::json& reference : meta["reference"]) {
            SCOPED_TRACE("frame " + reference["index"].dump());
            const Standing standing({frames.at(reference["index"]), mesh.faces},
                                    find_builder("oibvh-multi").make);
            expect_reference(standing, reference);
            if (reference == meta["reference"].back()) {
                expect_cgal(standing, false);
                expect_cgal(standing, true);
            }
            ++compared;
        }
    }
    EXPECT_GT(compared, 0u);
}

INSTANTIATE_TEST_SUITE_P(Forms, ContactsReference,
                         testing::Values(KernelForm::groups, KernelForm::chunks),
                         [](const auto& tested) {
                             return tested.param == KernelForm::groups ? "groups" : "chunks";
                         });

}  // namespace
}  // namespace bvhbench
