// SPDX-License-Identifier: MIT
//
// Random sequences of frames have the same pairs and contacts with all rules of skips.h, with each alone, and with none.
#include <cstring>

#include "tests/collide/near_objects.h"
#include "tests/needing.h"

namespace bvhbench {
namespace {

constexpr std::size_t frames = 6;

enum class Moves { not_at_all, slowly, fast, rigidly, scaled, folding, away, count };

/// One to 200 objects of 1 to 40 triangles, which rest until a frame and then move, each in its own way.
class Sequence {
public:
    explicit Sequence(unsigned seed) : random_(seed), many({})
    {
        const bool is_long = seed % 8 == 7;
        const unsigned objects = 1 + below(is_long ? 200 : 12);
        const double rest = uniform();
        for (std::size_t k = 0; k < objects; ++k) {
            Mesh part = below(3) == 0 ? scene_mesh("grid:" + std::to_string(2 + 2 * below(16)))
                                      : crowded_mesh(1 + below(is_long ? 4 : 40));
            const float y = static_cast<float>(below(4)) * 0.6f;
            const float z = static_cast<float>(below(4)) * 0.6f;
            for (Point& point : part.points)
                point = {point.x, point.y + y, point.z + z};
            begins_.push_back(2 * below(3));
            many.add(part, static_cast<float>(below(4)) * 0.6f);
            moves_.push_back(uniform() < rest
                                 ? static_cast<Moves>(below(2))
                                 : static_cast<Moves>(below(static_cast<unsigned>(Moves::count))));
        }
        if (below(2) == 0) {  // one moves among others at rest
            std::fill(moves_.begin(), moves_.end(), Moves::not_at_all);
            moves_[below(objects)] = Moves::fast;
        }
        scene.faces = many.mesh.faces;
        for (const FaceRange& object : many.objects)
            scene.objects.push_back({"", object.first, object.count});
        scene.frames.push_back(many.mesh.points);
        for (std::size_t frame = 1; frame < frames; ++frame)
            scene.frames.push_back(moved(scene.frames.back(), frame));
    }

    unsigned below(unsigned count) { return static_cast<unsigned>(random_() % count); }
    double uniform() { return static_cast<double>(random_()) / 4294967296.0; }

private:
    std::vector<Point> moved(std::vector<Point> points, std::size_t frame)
    {
        const auto step = static_cast<float>(uniform());
        for (std::size_t k = 0; k < points.size(); ++k) {
            Point& p = points[k];
            const float turn = 0.1f * step;
            const uint owner = many.point_owners[k];
            switch (frame < begins_[owner] ? Moves::not_at_all : moves_[owner]) {
                case Moves::not_at_all:
                case Moves::count:
                    break;
                case Moves::slowly:
                    p.x += 0.004f;
                    p.z += 0.002f * step;
                    break;
                case Moves::fast:
                    (owner % 3 == 0   ? p.x
                     : owner % 3 == 1 ? p.y
                                      : p.z) += owner % 2 == 0 ? step : -step;
                    break;
                case Moves::rigidly:
                    p = {p.x * std::cos(turn) - p.y * std::sin(turn),
                         p.x * std::sin(turn) + p.y * std::cos(turn), p.z};
                    break;
                case Moves::scaled:
                    p = {p.x * (1 + turn), p.y * (1 + turn), p.z * (1 - turn)};
                    break;
                case Moves::folding:
                    p.z = std::abs(p.x - 0.5f) * (p.z + 1) * turn;
                    break;
                case Moves::away:
                    p.x += k % 2 == 0 ? 1000 * step : 0;
                    break;
            }
        }
        return points;
    }

    std::mt19937 random_;
    std::vector<Moves> moves_;
    std::vector<std::size_t> begins_;  ///< frame before which an object rests

public:
    ManyObjects many;
    Scene scene;
};

ColliderChoice with_rules(ColliderChoice asked, unsigned used)
{
    asked.rules_off = skip_rules_called("all") & ~used;
    asked.rules_forced = used;
    return asked;
}

/// Frames of all tests in which a rule served from a list.
std::size_t served = 0;

void expect_same_answers(unsigned seed)
{
    SCOPED_TRACE("sequence " + std::to_string(seed));
    Sequence one(seed);
    constexpr const char* colliders[] = {"group", "leaf", "block", "bvtt", "grid"};
    constexpr const char* builders[] = {"oibvh-multi", "apetrei-fused", "oibvh-wide4",
                                        "sah-binned"};
    ColliderChoice asked;
    asked.name = colliders[one.below(5)];
    asked.among = static_cast<Among>(one.many.objects.size() > 1 ? one.below(3) : 2 * one.below(2));
    asked.keep_adjacent = one.below(2) == 0;
    asked.narrow = "exact";
    asked.form = one.below(2) == 0 ? KernelForm::groups : KernelForm::chunks;
    const bool can_be_one_tree =
        one.many.objects.size() > 1 && asked.name != "grid" && asked.among != Among::within_objects;
    if (can_be_one_tree && one.below(3) == 0)
        asked.trees = TreeOver::scene;
    const bool has_one_tree = one.many.objects.size() == 1 || asked.trees == TreeOver::scene;
    BuilderChoice builder{.name = builders[one.below(has_one_tree ? 4 : 3)]};
    builder.sorted_leaves = builder.name != "sah-binned" && one.below(2) == 0;
    Input input = uploaded(one.many);
    std::vector<unsigned> uses = {0, skip_rules_called("all")};
    for (const SkipRuleEntry& rule : skip_rules())
        if (rule.applies_to(asked.name))
            uses.push_back(rule.rule);
    std::vector<std::unique_ptr<Pipeline>> pipelines;
    for (const unsigned used : uses)
        pipelines.push_back(
            std::make_unique<Pipeline>(session(), builder, with_rules(asked, used), input));
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const std::vector<Point>& points = one.scene.frames[frame];
        std::vector<Motion> motions;
        if (frame > 0)
            motions = object_motions(one.scene, frame - 1, frame);
        const PairList pairs =
            touching_pairs(points, input.faces, asked.keep_adjacent, input.objects, asked.among);
        PairList contacts;
        for (std::size_t k = 0; k < uses.size(); ++k) {
            SCOPED_TRACE(asked.name + " frame " + std::to_string(frame) + " rules " +
                         skip_rules_text(uses[k]));
            go_to(points, *pipelines[k], input, motions);
            pipelines[k]->once(input);
            ASSERT_EQ(PairList(pipelines[k]->pairs()), pairs);
            served += pipelines[k]->counters().contains("listed_count") ? 1 : 0;
            if (k == 0)
                contacts = PairList(pipelines[k]->contacts());
            ASSERT_EQ(PairList(pipelines[k]->contacts()), contacts);
        }
    }
}

TEST(Sequences, HaveTheSameAnswersWithRulesAndWithout)
{
    const unsigned count = takes_all_cases() ? 10'000 : takes_few_cases() ? 2 : 24;
    for (unsigned seed = 0; seed < count && !HasFatalFailure(); ++seed)
        expect_same_answers(seed);
    EXPECT_GT(served, count / 2) << "the rule `margin` is tried";
}

TEST(Margin, FindsWhatComesFromEachSideAfterRest)
{
    for (int k = 0; k < 12; ++k) {
        SCOPED_TRACE(k);
        const int side = k % 6;
        const float far = side % 2 == 0 ? 5 : -5;
        ManyObjects many({});
        many.add(crowded_mesh(1));
        many.add(crowded_mesh(1));
        const std::vector<Point> together = many.mesh.points;
        for (std::size_t corner = 3; corner < 6; ++corner) {
            Point& p = many.mesh.points[corner];
            (side < 2 ? p.x : side < 4 ? p.y : p.z) += far;
        }
        Input input = uploaded(many);
        const KernelForm form = k < 6 ? KernelForm::groups : KernelForm::chunks;
        Pipeline pipeline(session(), {.name = "oibvh-multi"},
                          with_rules({{.form = form}, "group"}, skip_margin), input);
        for (int frame = 0; frame < 4; ++frame) {
            go_to(frame < 3 ? many.mesh.points : together, pipeline, input);
            EXPECT_EQ(pipeline.pairs().size(), frame < 3 ? 0u : 1u);
            EXPECT_EQ(pipeline.counters().contains("listed_count"), frame == 1 || frame == 2);
        }
    }
}

/// A pipeline under the rule `margin` to contacts of all pairs.
class ToContacts {
public:
    ToContacts(const ManyObjects& many, KernelForm form) : input_(uploaded(many))
    {
        pipeline_.emplace(session(), BuilderChoice{.name = "oibvh-multi"},
                          with_rules({{.form = form}, "group", "exact"}, skip_margin), input_);
    }

    /// Expects the answers of oracles in a frame with these points, each time that it is sampled. Returns its counters.
    std::map<std::string, double> frame(std::span<const Point> points)
    {
        const PairList pairs =
            touching_pairs(points, input_.faces, true, input_.objects, Among::all);
        const PairList contacts = intersecting_pairs(points, input_.faces, pairs.pairs(), true);
        go_to(points, *pipeline_, input_);
        for (int sample = 0; sample < (takes_few_cases() ? 1 : 3); ++sample) {
            EXPECT_EQ(PairList(pipeline_->pairs()), pairs);
            EXPECT_EQ(PairList(pipeline_->contacts()), contacts);
            EXPECT_EQ(pipeline_->contacts().size(), contacts.size());
            pipeline_->once(input_);
        }
        std::map<std::string, double> counters = pipeline_->counters();
        const double spared = counters["standing_count"];
        EXPECT_TRUE(spared == 0 || spared == static_cast<double>(standing_of(pairs)));
        last_.assign(points.begin(), points.end());
        return counters;
    }

private:
    /// Returns how many pairs are of two triangles with the bits of the last frame.
    std::size_t standing_of(const PairList& pairs) const
    {
        if (last_.empty())
            return 0;
        const auto rests = [&](uint triangle) {
            const Face face = input_.faces[triangle];
            return std::ranges::all_of(std::array{face.a, face.b, face.c}, [&](uint k) {
                return std::memcmp(&last_[k], &input_.points[k], sizeof(Point)) == 0;
            });
        };
        return chosen(pairs, [&](Pair pair) { return rests(pair.a) && rests(pair.b); }).size();
    }

    Input input_;
    std::optional<Pipeline> pipeline_;
    std::vector<Point> last_;
};

/// Returns objects of equal triangles, whose boxes overlap in space if the planes have a slope.
ManyObjects sheets(uint objects, uint triangles, float slope)
{
    Mesh part;
    for (uint k = 0; k < triangles; ++k) {
        part.points.insert(part.points.end(), {{-1, -1, 0}, {1, -1, 0}, {0, 1, slope}});
        part.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    ManyObjects many({});
    for (uint k = 0; k < objects; ++k)
        many.add(part);
    return many;
}

/// In each frame an object, or one triangle or vertex of it, may move between three planes; in some a vertex leaves its room.
void expect_contacts_stand(unsigned seed, std::map<std::string, double>& sums)
{
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](unsigned count) { return static_cast<unsigned>(random() % count); };
    ManyObjects many = sheets(4, 8, seed % 4 < 2 ? 0 : 1);
    many.mesh.faces.back() = many.mesh.faces[8];  // a triangle of two objects
    std::vector<Point> points = many.mesh.points;
    ToContacts pipeline(many, seed % 2 == 0 ? KernelForm::groups : KernelForm::chunks);
    for (int frame = 0; frame < 14; ++frame) {
        for (uint object = 0; object < 4; ++object) {
            const unsigned part[] = {24, 3, 1, 0, 0, 0}, vertices = part[below(6)];
            const unsigned first =
                vertices == 24 ? 0 : vertices * below(24 / std::max(1u, vertices));
            const float z = 0.01f * static_cast<float>(below(3));
            for (uint k = 24 * object + first; k < 24 * object + first + vertices; ++k)
                points[k].z = many.mesh.points[k].z + z;
        }
        const std::vector<Point> stay = points;
        if (frame % 6 == 5)
            points[below(96)].x += 100;
        for (const auto& [name, value] : pipeline.frame(points))
            sums[name] += value;
        points = stay;
    }
}

using MarginContacts = Needing<testing::Test, cgal_absent>;

TEST_F(MarginContacts, StandAndThoseOfWhatMoves)
{
    std::map<std::string, double> sums;
    const unsigned count = takes_all_cases() ? 500 : takes_few_cases() ? 2 : 40;
    for (unsigned seed = 0; seed < count && !testing::Test::HasFailure(); ++seed)
        expect_contacts_stand(seed, sums);
    EXPECT_GT(sums["standing_count"], sums["pairs_count"] / 8);
}

TEST_F(MarginContacts, StandIfListsAreTooShort)
{
    for (int variant = 0; variant < 4; ++variant) {
        SCOPED_TRACE(variant);
        // Of planes: only if it is 1 do boxes overlap in each frame.
        const float slope = variant < 2 ? 0 : 1;
        ManyObjects many = sheets(4, 16, slope);
        ToContacts pipeline(many, variant % 2 == 0 ? KernelForm::groups : KernelForm::chunks);
        double standing = 0;
        for (const float z : {variant < 2 ? 0.0f : 0.03f, 0.03f, 0.03f, 0.03f, 0.0f, 0.0f, 0.03f}) {
            for (std::size_t k = 0; k < 96; ++k)  // two of the objects
                many.mesh.points[k].z = (k < 48 ? z : -z) + (k % 3 == 2 ? slope : 0);
            standing += pipeline.frame(many.mesh.points)["standing_count"];
        }
        EXPECT_GT(standing, 0);
    }
}

}  // namespace
}  // namespace bvhbench
