// SPDX-License-Identifier: MIT
//
// Shared by the tests of colliders: a session, meshes that are hard for queries, and checks of the pairs of a query.
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "baselines/parameters.h"
#include "builders/device_tree.h"
#include "builders/parameters.h"
#include "collide/oracles/box_pairs.h"
#include "geometry/error.h"
#include "harness/choice/catalog.h"
#include "harness/judge/hard_inputs.h"
#include "harness/measure/pipeline.h"
#include "harness/session/session.h"
#include "scenes/catalog.h"
#include "tests/all_cases.h"
#include "tests/case_name.h"

namespace bvhbench {

inline Session& session()
{
    static Session session{CommonOptions{}};
    return session;
}

/// Returns a session on a device that is tuned as one with many lanes: work-groups wait for each other, those of apetrei-fused
/// merge their own leaves first, and lbvh-levels has one launch.
inline Session& waiting_session()
{
    static Session& waiting = *[] {
        Device device = session().device();
        device.tuning.set(implicit_waits, 1);
        device.tuning.set(radix_local, 1);
        device.tuning.set(levels_at_once, 1);
        return new Session(std::move(device), session().scenes());
    }();
    return waiting;
}

/// A collider or builder of a parametrised test, whose name CaseName reads.
struct Named {
    const char* name;
};

struct NamedMesh {
    std::string name;
    Mesh mesh;
};

/// Returns the first frame of a scene.
inline Mesh scene_mesh(const std::string& name)
{
    const Scene scene = load_scene(name, {});
    return {scene.frames.front(), scene.faces};
}

/// Returns triangles along a line, each overlapping the next few.
inline Mesh collinear_mesh(uint count)
{
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const auto x = static_cast<float>(k);
        mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x + 2.5f, 0, 0}, {x + 1, 0, 0}});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Returns large triangles in a small space, most of whose pairs overlap.
inline Mesh crowded_mesh(std::size_t count)
{
    Mesh mesh = hard_inputs().front().make(count);
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
        if (k % 3 != 0) {
            mesh.points[k].x = 1 - mesh.points[k].x;
            mesh.points[k].y = 1 - mesh.points[k].y;
        }
    return mesh;
}

/// Returns triangles with sides from a thousandth to a hundred, so that many grid levels are in use.
inline Mesh mesh_of_many_sizes(uint count)
{
    std::mt19937 engine{7};
    const auto random = [&] { return static_cast<float>(engine() >> 8) * 0x1p-24f; };
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const float side = 0.001f * std::pow(10.0f, 5 * random() * random() * random());
        const Point at{4 * random() - 2, 4 * random() - 2, 4 * random() - 2};
        mesh.points.insert(mesh.points.end(), {at,
                                               {at.x + side * random(), at.y + side, at.z},
                                               {at.x, at.y - side, at.z + side * random()}});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Returns the hard inputs of builders with `count` triangles, and more meshes that are hard for queries.
inline std::vector<NamedMesh> hard_meshes(std::size_t count)
{
    std::vector<NamedMesh> meshes;
    for (const HardInput& input : hard_inputs())
        meshes.push_back({std::string(input.name), input.make(count)});
    meshes.push_back({"collinear", collinear_mesh(static_cast<uint>(count))});
    meshes.push_back({"crowded", crowded_mesh(count)});
    if (count > 1) {  // one with shared vertices, one with each triangle twice
        Mesh surface = scene_mesh("sphere:" + std::to_string(std::max<std::size_t>(8, count)));
        meshes.push_back({"surface", surface});
        const std::size_t once = surface.faces.size() / 2;
        std::copy_n(surface.faces.begin(), once,
                    surface.faces.begin() + static_cast<std::ptrdiff_t>(once));
        meshes.push_back({"duplicates", surface});
    }
    return meshes;
}

/// True if an index occurs more than once; only then can pairs share one.
inline bool shares_vertices(const Mesh& mesh)
{
    std::vector<bool> named(mesh.points.size());
    for (const Face& face : mesh.faces)
        for (const uint index : {face.a, face.b, face.c}) {
            if (named[index])
                return true;
            named[index] = true;
        }
    return false;
}

/// Returns the builders whose trees are in device memory.
inline const std::vector<BuilderEntry>& device_builders()
{
    static const std::vector<BuilderEntry> all = [] {
        std::vector<BuilderEntry> builders;
        for (const BuilderEntry& entry : builder_catalog())
            if (entry.make != nullptr && !entry.name.ends_with("-reference") &&
                entry.make(session().programs(), {})->card().runs == BuilderCard::Runs::on_device)
                builders.push_back(entry);
        return builders;
    }();
    return all;
}

/// Returns the colliders that find pairs of overlapping boxes: only those that query a builder's tree, or all.
inline std::vector<ColliderEntry> box_colliders(bool of_trees)
{
    std::vector<ColliderEntry> colliders;
    for (const ColliderEntry& entry : collider_catalog()) {
        if (entry.make == nullptr)
            continue;
        const auto collider = entry.make(session().programs(), {.keep_adjacent = false});
        if (!collider->finds_contacts() && (collider->needs_tree() || !of_trees))
            colliders.push_back(entry);
    }
    return colliders;
}

inline const auto both_forms = testing::Values(KernelForm::groups, KernelForm::chunks);

/// Makes a collider of the catalog.
inline std::unique_ptr<Collider> made(std::string_view name, const ColliderOptions& options = {})
{
    return find_collider(name).make(session().programs(), options);
}

inline Input uploaded(std::span<const Point> points, std::span<const Face> faces,
                      std::span<const FaceRange> objects = {})
{
    return upload(session().device(), session().queue(), points, faces, objects);
}

/// Gives an input other points, which it refers to.
inline void place(Input& input, std::span<const Point> points)
{
    input.points = points;
    input.device_points.upload(session().queue().cl(), points);
}

/// Takes a pipeline and its input to a frame with these points.
inline void go_to(std::span<const Point> points, Pipeline& pipeline, Input& input,
                  std::span<const Motion> motions = {})
{
    place(input, points);
    pipeline.begin_frame(motions);
    pipeline.prepare(input);
}

/// A mesh of one or several objects on the device, with a tree of each object if there is a builder.
struct Standing {
    Mesh mesh;
    Input input;
    std::unique_ptr<Builder> builder;
    const Tree* tree = nullptr;

    Standing(const Mesh& over, MakeBuilder make, const BuildOptions& options = {},
             std::span<const FaceRange> objects = {})
        : mesh(over)
        , input(uploaded(mesh.points, mesh.faces, objects))
        , builder(make != nullptr ? make(session().programs(), options) : nullptr)
    {
        if (builder == nullptr)
            return;
        builder->reserve_objects(object_sizes(input));
        build();
    }
    Standing(const Mesh& over, std::string_view builder_name, const BuildOptions& options = {},
             std::span<const FaceRange> objects = {})
        : Standing(over, find_builder(builder_name).make, options, objects)
    {}

    /// Replaces the points, without building a tree over them.
    void place(const std::vector<Point>& points)
    {
        mesh.points = points;
        bvhbench::place(input, mesh.points);
    }

    void build() { session().build_once(*builder, input, Start::from_triangles, &tree); }

    const DeviceTree& device_tree() const { return dynamic_cast<const DeviceTree&>(*tree); }

    /// Returns the oracle's pairs. Asks the oracle once for each frame: many cases of a test have the same frames.
    const PairList& expected(bool keep_adjacent, Among among = Among::all) const
    {
        static std::map<std::string, PairList> known;
        std::string asked = {static_cast<char>(keep_adjacent), static_cast<char>(among)};
        const auto append = [&](const auto& of_frame) {
            const std::span bytes = std::as_bytes(std::span(of_frame));
            asked += std::to_string(bytes.size()) + ' ';
            asked.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        };
        append(input.points);
        append(input.faces);
        append(input.objects);
        const auto [answer, is_new] = known.try_emplace(std::move(asked));
        if (is_new)
            answer->second =
                touching_pairs(input.points, input.faces, keep_adjacent, input.objects, among);
        return answer->second;
    }
};

/// Returns the builders whose trees colliders are tested over: one of each tree and of each way in which kernels read it, at night all.
/// Others build the same tree, which their tests compare.
inline const std::vector<BuilderEntry>& builders_to_query()
{
    static const std::vector<BuilderEntry> some = [] {
        std::vector<BuilderEntry> builders;
        std::set<std::pair<std::string_view, std::string_view>> kinds;
        for (const BuilderEntry& entry : device_builders()) {
            const Standing standing(crowded_mesh(3), entry.make);
            const auto kind = std::pair(entry.oracle, standing.device_tree().access_header());
            if (kinds.insert(kind).second || takes_all_cases())
                builders.push_back(entry);
        }
        return builders;
    }();
    return some;
}

/// Where a tree has the boxes of its leaves.
enum class Leaves { as_in_mesh, sorted };

inline std::string name_of(Leaves leaves) { return leaves == Leaves::sorted ? "sorted" : "mesh"; }

/// A collider, a builder whose trees it queries (if it needs any), a kernel form, and where the leaves are.
using ColliderCase = std::tuple<ColliderEntry, BuilderEntry, KernelForm, Leaves>;

/// Each collider with each builder, in one kernel form and with one kind of leaves, which take turns. At night in both.
inline std::vector<ColliderCase> with_each_builder(std::span<const ColliderEntry> colliders)
{
    std::vector<ColliderCase> all;
    for (int place = 0; const ColliderEntry& collider : colliders) {
        ++place;
        for (int turn = place; const BuilderEntry& builder : builders_to_query()) {
            ++turn;
            for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
                for (const Leaves leaves : {Leaves::as_in_mesh, Leaves::sorted})
                    if (takes_combination({turn, form == KernelForm::chunks}) &&
                        takes_combination({turn / 2, leaves == Leaves::sorted}))
                        all.emplace_back(collider, builder, form, leaves);
        }
    }
    return all;
}

/// True if the collider queries such trees; otherwise checks that `reserve` throws BadUsage.
inline bool takes(Collider& collider, const Standing& standing)
{
    if (standing.tree == nullptr || collider.refusal(*standing.tree).empty())
        return true;
    EXPECT_THROW(collider.reserve(standing.tree, standing.input), BadUsage);
    return false;
}

/// Compares one query, repeated until complete, with the expected pairs; memory must be reserved. Returns the number of queries.
inline int expect_pairs(Collider& collider, const Standing& standing, const PairList& expected)
{
    const int queries = find_pairs(collider, standing.tree, standing.input, session().queue());
    const PairList found(collider.pairs(session().queue()));
    session().queue().finish();
    EXPECT_EQ(found.surplus(), 0u);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(collider.counts(session().queue()).pairs, found.size());
    return queries;
}

/// Reserves memory and compares a query with the oracle's pairs, unless the collider refuses such trees.
inline void expect_oracles_pairs(Collider& collider, const Standing& standing,
                                 bool keep_adjacent = true, Among among = Among::all)
{
    if (!takes(collider, standing))
        return;
    collider.reserve(standing.tree, standing.input);
    expect_pairs(collider, standing, standing.expected(keep_adjacent, among));
}

}  // namespace bvhbench
