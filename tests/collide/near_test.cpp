// SPDX-License-Identifier: MIT
//
// Compares the triangles near another object with the definition.
#include "tests/collide/near_objects.h"

namespace bvhbench {
namespace {

using Form = std::tuple<KernelForm, unsigned>;

class Near : public testing::TestWithParam<Form> {
protected:
    NearOptions options() const { return {std::get<0>(GetParam()), std::get<1>(GetParam())}; }

    void expect_definition(const ManyObjects& many)
    {
        const Input input = uploaded(many);
        NearTriangles near(session().programs(), options());
        near.reserve(input);
        const std::vector<std::vector<uint>> expected = near_by_definition(many);
        for (int repeat = 0; repeat < 2; ++repeat) {
            const std::vector<uint> counts = near.find(input, session().queue());
            session().queue().finish();
            ASSERT_EQ(counts.size(), expected.size());
            for (std::size_t k = 0; k < counts.size(); ++k)
                EXPECT_EQ(counts[k], expected[k].size()) << k;
            if (entering(many) <= NearTriangles::most_of(many.mesh.faces.size()))
                expect_frame(near, input, counts, expected);
        }
    }

private:
    void expect_frame(const NearTriangles& near, const Input& input,
                      const std::vector<uint>& counts,
                      const std::vector<std::vector<uint>>& expected)
    {
        std::vector<Face> faces;
        const Input frame = near.frame(input, counts, faces, session().queue());
        std::vector<FaceRange> objects;
        std::vector<uint> owners, ids;
        for (const std::vector<uint>& triangles : expected) {
            if (triangles.empty())
                continue;
            objects.push_back({static_cast<uint>(ids.size()), static_cast<uint>(triangles.size())});
            ids.insert(ids.end(), triangles.begin(), triangles.end());
            owners.resize(ids.size(), static_cast<uint>(objects.size() - 1));
        }
        EXPECT_EQ(frame.objects, objects);
        ASSERT_EQ(frame.triangle_count(), ids.size());
        if (ids.empty())
            return;
        const cl::CommandQueue& queue = session().queue().cl();
        const std::vector<Face> on_device = frame.device_faces.download(queue);
        EXPECT_EQ(frame.device_owners.download(queue), owners);
        for (std::size_t k = 0; k < ids.size(); ++k) {
            EXPECT_EQ(faces[k].a, input.faces[ids[k]].a);
            EXPECT_EQ(on_device[k].c, input.faces[ids[k]].c);
        }
    }
};

TEST_P(Near, AreThoseThatTheDefinitionSays)
{
    EXPECT_GT(entering(bodies()), 300u);
    EXPECT_LT(entering(bodies()), 6100u / 2);
    for (const NamedObjects& one : all_objects()) {
        SCOPED_TRACE(one.name);
        expect_definition(one.many);
    }
    expect_definition(ManyObjects({1, 70, 3, 2, 129, 200, 1}));
}

TEST_P(Near, OfFewAreThoseAndGetTheirNumbersBack)
{
    const ManyObjects many = touching_squares();
    expect_definition(many);
    const Input input = uploaded(many);
    NearTriangles near(session().programs(), options());
    near.reserve(input);
    EXPECT_EQ(near.find(input, session().queue()), (std::vector<uint>{2, 2, 0}));
    const cl::CommandQueue& queue = session().queue().cl();
    Arena arena = Arena::reserved(session().device(), {0, 1 << 16});
    DevicePairs found{arena.take<Pair>(3, Use::scratch), arena.take<uint>(8, Use::scratch)};
    found.pairs.upload(queue, std::vector<Pair>{{0, 2}, {1, 3}, {0, 1}});
    found.counters.upload(queue, std::vector<uint>{2, 0});  // the count excludes the third pair
    near.map_back(found, session().queue());
    const std::vector<Pair> mapped = found.pairs.download(queue);
    EXPECT_EQ(mapped, (std::vector<Pair>{{10, 12}, {11, 13}, {0, 1}}));
    session().queue().finish();
}

INSTANTIATE_TEST_SUITE_P(Forms, Near, testing::Combine(both_forms, testing::Values(1u, 256u)),
                         [](const auto& tested) {
                             return name_of(std::get<0>(tested.param)) +
                                    (std::get<1>(tested.param) == 1 ? "_ran_over" : "_listed");
                         });

}  // namespace
}  // namespace bvhbench
