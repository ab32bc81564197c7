// SPDX-License-Identifier: MIT
//
// Triangles that are near another object: those that the definition says, and with nothing else in the frame the pairs
// between objects are the oracle's.
#include "collide/near.h"

#include "harness/pipeline.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

Mesh sphere(std::size_t triangles)
{
    const Scene scene = load_scene("sphere:" + std::to_string(triangles), {});
    return {scene.frames.front(), scene.faces};
}

float width(const Mesh& mesh)
{
    Aabb box = empty_box();
    for (const Face& face : mesh.faces)
        box = merged(box, face_box(mesh.points, face));
    return box.max_x - box.min_x;
}

/// Squares of two triangles in a row, from `first` on. All coordinates are small integers: boxes touch exactly.
Mesh squares(uint first, uint count)
{
    Mesh mesh;
    for (uint k = 0; k < count; ++k) {
        const auto x = static_cast<float>(first + k);
        mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 1, 0}, {x, 1, 0}});
        mesh.faces.push_back({4 * k, 4 * k + 1, 4 * k + 2});
        mesh.faces.push_back({4 * k, 4 * k + 2, 4 * k + 3});
    }
    return mesh;
}

ManyObjects none() { return ManyObjects(std::vector<std::size_t>{}); }

/// Spheres in a row, so many of their widths apart from one to the next.
ManyObjects row(uint count, float step, std::size_t triangles = 400)
{
    const Mesh part = sphere(triangles);
    ManyObjects many = none();
    for (uint k = 0; k < count; ++k)
        many.add(part, static_cast<float>(k) * step * width(part));
    return many;
}

ManyObjects touching_squares()
{
    ManyObjects many = none();
    many.add(squares(0, 6), 0);
    many.add(squares(6, 5), 0);
    many.add(squares(12, 4), 0);  // one square further on
    return many;
}

/// Two that meet, with one between them in the line of triangles that is far away and one behind them.
ManyObjects some_far()
{
    ManyObjects many = row(1, 0);
    const Mesh part = sphere(100);
    many.add(part, 1000);
    many.add(sphere(500), 0.8f * width(sphere(400)));
    many.add(part, -1000);
    return many;
}

/// A triangle inside a sphere, near its box and no triangle's.
ManyObjects one_inside()
{
    ManyObjects many = row(1, 0);
    many.add({{{0, 0, 0}, {0.01f, 0, 0}, {0, 0.01f, 0}}, {{0, 1, 2}}}, 0);
    return many;
}

ManyObjects bodies()
{
    const Scene scene = load_scene("n-body:6100:3", {});
    ManyObjects many = none();
    many.mesh = {scene.frames.front(), scene.faces};
    for (const SceneObject& object : scene.objects) {
        many.objects.push_back({object.first_face, object.face_count});
        many.owners.resize(object.first_face + object.face_count,
                           static_cast<uint>(many.objects.size() - 1));
    }
    return many;
}

struct NamedObjects {
    std::string name;
    ManyObjects many;
};

std::vector<NamedObjects> all_objects()
{
    std::vector<NamedObjects> all;
    all.push_back({"overlapping", row(2, 0.9f)});
    all.push_back({"apart", row(3, 1.5f)});
    all.push_back({"some far", some_far()});
    all.push_back({"touching", touching_squares()});
    all.push_back({"one inside", one_inside()});
    all.push_back({"bodies", bodies()});
    return all;
}

/// By the definition: of each object, the triangles whose box touches another object's.
std::vector<std::vector<uint>> near_by_definition(const ManyObjects& many)
{
    std::vector<Aabb> boxes(many.objects.size(), empty_box());
    for (std::size_t k = 0; k < many.mesh.faces.size(); ++k)
        boxes[many.owners[k]] =
            merged(boxes[many.owners[k]], face_box(many.mesh.points, many.mesh.faces[k]));
    std::vector<std::vector<uint>> near(many.objects.size());
    for (uint k = 0; k < many.mesh.faces.size(); ++k) {
        const Aabb box = face_box(many.mesh.points, many.mesh.faces[k]);
        for (uint other = 0; other < boxes.size(); ++other)
            if (other != many.owners[k] && overlap(box, boxes[other])) {
                near[many.owners[k]].push_back(k);
                break;
            }
    }
    return near;
}

Input uploaded(const ManyObjects& many)
{
    return upload(session().device(), session().queue(), many.mesh.points, many.mesh.faces,
                  many.objects);
}

std::size_t entering(const ManyObjects& many)
{
    std::size_t total = 0;
    for (const std::vector<uint>& near : near_by_definition(many))
        total += near.size();
    return total;
}

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
        const std::vector<Face> on_device =
            frame.triangle_count() > 0 ? frame.device_faces.download(session().queue().cl())
                                       : std::vector<Face>{};
        const std::vector<uint> owners = frame.triangle_count() > 0
                                             ? frame.device_owners.download(session().queue().cl())
                                             : std::vector<uint>{};
        std::size_t place = 0, object = 0;
        for (const std::vector<uint>& triangles : expected) {
            if (triangles.empty())
                continue;
            ASSERT_LT(object, frame.objects.size());
            EXPECT_EQ(frame.objects[object],
                      (FaceRange{static_cast<uint>(place), static_cast<uint>(triangles.size())}));
            for (const uint triangle : triangles) {
                const Face& face = input.faces[triangle];
                EXPECT_EQ(faces[place].a, face.a);
                EXPECT_EQ(on_device[place].c, face.c);
                EXPECT_EQ(owners[place], object);
                ++place;
            }
            ++object;
        }
        EXPECT_EQ(frame.objects.size(), object);
        EXPECT_EQ(frame.triangle_count(), place);
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
    found.counters.upload(queue, std::vector<uint>{2, 0});  // the third is nobody's
    near.map_back(found, session().queue());
    const std::vector<Pair> mapped = found.pairs.download(queue);
    EXPECT_EQ(mapped, (std::vector<Pair>{{10, 12}, {11, 13}, {0, 1}}));
    session().queue().finish();
}

/// Trees and colliders in the same form, over what is near alone.
TEST_P(Near, HaveThePairsBetweenObjects)
{
    const ManyObjects many = some_far();
    const Input input = uploaded(many);
    NearTriangles near(session().programs(), options());
    near.reserve(input);
    const std::vector<uint> counts = near.find(input, session().queue());
    std::vector<Face> faces;
    const Input frame = near.frame(input, counts, faces, session().queue());
    ASSERT_EQ(frame.objects.size(), 2u);
    const PairList expected = expected_pairs(many, Among::between_objects, true);
    ASSERT_GT(expected.size(), 0u);
    for (const char* name : {"oibvh-multi", "karras"}) {
        const auto builder = find_builder(name).make(session().programs(), {});
        builder->reserve_objects(object_sizes(frame));
        const Tree* tree = nullptr;
        session().build_once(*builder, frame, Start::from_triangles, &tree);
        for (const char* collider_name : {"leaf", "bvtt", "group"}) {
            SCOPED_TRACE(std::string(name) + ' ' + collider_name);
            const auto collider = find_collider(collider_name)
                                      .make(session().programs(), {.among = Among::between_objects,
                                                                   .form = options().form});
            collider->reserve(tree, frame);
            find_pairs(*collider, tree, frame, session().queue());
            near.map_back(collider->device_pairs(session().queue()), session().queue());
            session().queue().finish();
            EXPECT_EQ(PairList(collider->pairs(session().queue())), expected);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, Near,
                         testing::Combine(testing::Values(KernelForm::groups, KernelForm::chunks),
                                          testing::Values(1u, 256u)),
                         [](const auto& tested) {
                             return std::string(std::get<0>(tested.param) == KernelForm::groups
                                                    ? "groups"
                                                    : "chunks") +
                                    (std::get<1>(tested.param) == 1 ? "_ran_over" : "_listed");
                         });

ColliderChoice between(const char* name, unsigned rules_off = 0)
{
    ColliderChoice choice;
    choice.name = name;
    choice.among = Among::between_objects;
    choice.keep_adjacent = false;
    choice.narrow = "exact";
    choice.rules_off = rules_off;
    return choice;
}

bool has_stage(const std::vector<StageTime>& stages, std::string_view name)
{
    return std::any_of(stages.begin(), stages.end(),
                       [&](const StageTime& stage) { return stage.stage == name; });
}

class NearPipeline : public testing::TestWithParam<BuilderChoice> {};

TEST_P(NearPipeline, FindsWhatIsFoundWithoutTheRule)
{
    if (!NearTriangles::may_pay(session().device(), 1))
        GTEST_SKIP() << "not worth it on this device";
    for (const NamedObjects& one : all_objects())
        for (const char* name : {"leaf", "bvtt", "group"}) {
            SCOPED_TRACE(one.name + ' ' + name);
            const Input input = uploaded(one.many);
            Pipeline with(session(), GetParam(), between(name), input);
            Pipeline without(session(), GetParam(), between(name, skip_near), input);
            with.settle(input);
            without.settle(input);
            const PairList expected = expected_pairs(one.many, Among::between_objects, false);
            EXPECT_EQ(without.pairs(), expected);
            EXPECT_FALSE(without.counters().contains("entered_count"));
            const bool applies =
                entering(one.many) <= NearTriangles::most_of(one.many.mesh.faces.size());
            std::map<std::string, double> counters = with.counters();
            EXPECT_EQ(counters.contains("entered_count"), applies);
            EXPECT_EQ(counters["entered_count"],
                      applies ? static_cast<double>(entering(one.many)) : 0);
            for (int repeat = 0; repeat < 2; ++repeat) {
                EXPECT_EQ(has_stage(with.once(input), "near"), applies);
                EXPECT_EQ(with.pairs(), expected);
                EXPECT_EQ(with.contacts(), without.contacts());
                EXPECT_EQ(with.counters()["pairs_count"], static_cast<double>(expected.size()));
                EXPECT_EQ(with.counters()["entered_count"], counters["entered_count"]);
            }
        }
}

INSTANTIATE_TEST_SUITE_P(
    Builders, NearPipeline,
    testing::Values(BuilderChoice{.name = "oibvh-multi"},
                    BuilderChoice{
                        .name = "oibvh-multi", .order = "hilbert30", .sorted_leaves = true},
                    BuilderChoice{.name = "oibvh-single"}, BuilderChoice{.name = "perfect"},
                    BuilderChoice{.name = "apetrei-fused"}),
    [](const auto& tested) {
        return test_name(tested.param.name) + (tested.param.sorted_leaves ? "_sorted" : "");
    });

/// Two objects that meet, part, lie across each other, and meet again.
class Frames {
public:
    Frames()
        : many_(row(2, 0.9f))
        , points_(many_.mesh.points)
        , input_(upload(session().device(), session().queue(), points_, many_.mesh.faces,
                        many_.objects))
        , pipeline_(session(), {.name = "oibvh-multi"}, between("group"), input_)
    {}

    /// The second object moved along by so many widths. How many triangles entered: all without the rule.
    double entered_at(float along, Motion motion)
    {
        const std::size_t half = points_.size() / 2;
        for (std::size_t k = 0; k < half; ++k)
            points_[half + k].x = points_[k].x + along * width(sphere(400));
        input_.device_points.upload(session().queue().cl(), points_);
        const std::vector<Motion> motions(2, motion);
        pipeline_.begin_frame(motions);
        pipeline_.settle(input_);
        stages_ = pipeline_.once(input_);
        const PairList all = touching_pairs(points_, many_.mesh.faces, false);
        EXPECT_EQ(pipeline_.pairs(), among_objects(all, many_.objects, Among::between_objects));
        const std::map<std::string, double> counters = pipeline_.counters();
        return counters.contains("entered_count") ? counters.at("entered_count")
                                                  : static_cast<double>(many_.mesh.faces.size());
    }

    TreeUpdate update() const
    {
        return count("kept_objects_count") > 0       ? TreeUpdate::keep
               : count("refitted_objects_count") > 0 ? TreeUpdate::refit
                                                     : TreeUpdate::rebuild;
    }
    bool had(std::string_view stage) const { return has_stage(stages_, stage); }
    double count(const char* name) const { return pipeline_.counters().at(name); }

private:
    ManyObjects many_;
    std::vector<Point> points_;
    Input input_;
    Pipeline pipeline_;
    std::vector<StageTime> stages_;
};

TEST(NearFrames, TakeInWhatIsNearThen)
{
    if (!NearTriangles::may_pay(session().device(), 1))
        GTEST_SKIP() << "not worth it on this device";
    Frames frames;
    const double some = frames.entered_at(0.9f, Motion::deforming);
    EXPECT_GT(some, 0);
    EXPECT_LT(some, 400);
    EXPECT_EQ(frames.entered_at(1.2f, Motion::deforming), 0);
    EXPECT_FALSE(frames.had("hierarchy"));
    EXPECT_FALSE(frames.had("broad"));
    EXPECT_EQ(frames.count("rebuilt_objects_count"), 0);
    EXPECT_EQ(frames.count("pairs_count"), 0);
    EXPECT_EQ(frames.count("contacts_count"), 0);
    EXPECT_EQ(frames.entered_at(0.1f, Motion::deforming), 800);
    EXPECT_FALSE(frames.had("near"));
    EXPECT_EQ(frames.entered_at(0.9f, Motion::deforming), some);
}

TEST(NearFrames, AreKeptWhenNothingMoves)
{
    if (!NearTriangles::may_pay(session().device(), 1))
        GTEST_SKIP() << "not worth it on this device";
    Frames frames;
    const double some = frames.entered_at(0.9f, Motion::deforming);
    EXPECT_EQ(frames.entered_at(0.9f, Motion::unchanged), some);
    EXPECT_EQ(frames.update(), TreeUpdate::keep);
    EXPECT_FALSE(frames.had("near"));
    EXPECT_TRUE(frames.had("broad"));
    EXPECT_EQ(frames.entered_at(1.2f, Motion::deforming), 0);
    EXPECT_EQ(frames.entered_at(1.2f, Motion::unchanged), 0);
    EXPECT_TRUE(frames.had("near"));
}

/// What is refitted is a tree of all triangles, and a frame of fewer has left none.
TEST(NearFrames, AreRefittedAsAWholeOnly)
{
    if (!NearTriangles::may_pay(session().device(), 1))
        GTEST_SKIP() << "not worth it on this device";
    Frames frames;
    EXPECT_EQ(frames.entered_at(0.1f, Motion::deforming), 800);
    EXPECT_EQ(frames.entered_at(0.9f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::refit);
    EXPECT_LT(frames.entered_at(0.9f, Motion::deforming), 400);
    EXPECT_LT(frames.entered_at(0.95f, Motion::rigid), 400);
    EXPECT_EQ(frames.update(), TreeUpdate::rebuild);
    EXPECT_EQ(frames.entered_at(0.1f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::rebuild);
    EXPECT_EQ(frames.entered_at(0.15f, Motion::rigid), 800);
    EXPECT_EQ(frames.update(), TreeUpdate::refit);
}

TEST(NearFrames, AreOnlyThoseOfPairsBetweenObjects)
{
    const ManyObjects many = row(2, 0.9f);
    const Input input = uploaded(many);
    for (const Among among : {Among::all, Among::within_objects}) {
        ColliderChoice choice = between("leaf");
        choice.among = among;
        Pipeline pipeline(session(), {.name = "oibvh-multi"}, choice, input);
        pipeline.settle(input);
        EXPECT_FALSE(pipeline.counters().contains("entered_count"));
        EXPECT_EQ(pipeline.pairs(), expected_pairs(many, among, false));
    }
}

TEST(NearFrames, ThatLaterChangeTheirMindAreAnError)
{
    if (!NearTriangles::may_pay(session().device(), 1))
        GTEST_SKIP() << "not worth it on this device";
    const ManyObjects many = row(2, 0.9f);
    std::vector<Point> points = many.mesh.points;
    Input input =
        upload(session().device(), session().queue(), points, many.mesh.faces, many.objects);
    Pipeline pipeline(session(), {.name = "oibvh-multi"}, between("leaf"), input);
    pipeline.settle(input);
    points.back().x = -100;  // so that its object's box goes round all of the other
    input.device_points.upload(session().queue().cl(), points);
    EXPECT_THROW(pipeline.once(input), Unavailable);
    session().queue().finish();
}

}  // namespace
}  // namespace bvhbench
