// SPDX-License-Identifier: MIT
//
// Objects that move, and a front that is carried over their frames.
#pragma once

#include "tests/collide/many_objects.h"

namespace bvhbench {

/// Four objects that overlap, one of them a single triangle. In a radix tree, the last two have a parent of their own.
struct Moving : ManyObjects {
    Moving() : ManyObjects({})
    {
        for (const Mesh& part :
             {scene_mesh("sphere:300"), crowded_mesh(90), crowded_mesh(1), crowded_mesh(7)})
            add(part);
    }

    /// Number of entries of front-leaf between the objects if all are far from each other.
    double far_entries() const
    {
        double entries = 0;
        for (std::size_t k = 0; k < objects.size(); ++k)
            entries += static_cast<double>(objects[k].count * (objects.size() - 1 - k));
        return entries;
    }

    /// Returns the points, each displaced by at most `by` along its own path, and each object shifted by `apart` from the
    /// previous one.
    std::vector<Point> moved(float by, int frame, float apart = 0) const
    {
        std::vector<Point> points = mesh.points;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const auto phase = static_cast<float>(k * (static_cast<std::size_t>(frame) + 1));
            points[k].x += by * std::sin(phase) + apart * static_cast<float>(point_owners[k]);
            points[k].y += by * std::sin(1.3f * phase);
            points[k].z += by * std::cos(0.7f * phase);
        }
        return points;
    }
};

/// A front and its tree, carried from frame to frame.
class Tracked {
public:
    Tracked(const Moving& moving, bool as_one, MakeBuilder make, std::string_view collider,
            const ColliderOptions& options, const BuildOptions& build = {})
        : options_(options)
        , standing_(moving.mesh, make, build,
                    as_one ? std::span<const FaceRange>{} : moving.objects)
        , front_(made(collider, options))
    {
        front_->reserve(standing_.tree, standing_.input);
    }

    /// Moves to these points and compares the pairs found with the oracle's.
    void expect_pairs_at(const std::vector<Point>& points)
    {
        standing_.place(points);
        update_ = front_->next_frame();
        refits += update_ == TreeUpdate::refit ? 1 : 0;
        while (!query()) {
        }
        expect_pairs();
        prunes += counted().at("prunes_count");
    }

    /// Repeats the query of the same frame from the same front.
    void expect_the_same_again()
    {
        const std::map<std::string, double> before = counted();
        ASSERT_TRUE(query());
        expect_pairs();
        EXPECT_EQ(counted(), before);
    }

    std::map<std::string, double> counted() const
    {
        const QueryCounts counts = front_->counts(session().queue());
        std::map<std::string, double> all = {{"pairs", static_cast<double>(counts.pairs)},
                                             {"tests", static_cast<double>(*counts.box_tests)},
                                             {"peak", static_cast<double>(*counts.bvtt_peak)}};
        for (const auto& [name, value] : counts.more)
            all[std::string(name)] = static_cast<double>(value);
        return all;
    }

    /// Returns how much of the last query was below the entries: box tests of front-leaf, pairs that front queued.
    double below() const
    {
        const std::map<std::string, double> all = counted();
        return all.contains("sprouts_count") ? all.at("sprouts_count") : all.at("descents_count");
    }

    int refits = 0;
    double prunes = 0;

private:
    bool query()
    {
        Queue& queue = session().queue();
        const Input& input = standing_.input;
        const Tree& tree = update_ == TreeUpdate::refit ? standing_.builder->refit(input, queue)
                                                        : standing_.builder->build(input, queue);
        front_->query(&tree, input, queue);
        queue.finish();
        return front_->complete(queue);
    }

    void expect_pairs() const
    {
        const PairList found(front_->pairs(session().queue()));
        EXPECT_EQ(found.surplus(), 0u);
        EXPECT_EQ(found, standing_.expected(options_.keep_adjacent, options_.among));
    }

    ColliderOptions options_;
    Standing standing_;
    std::unique_ptr<Collider> front_;
    TreeUpdate update_ = TreeUpdate::rebuild;
};

}  // namespace bvhbench
