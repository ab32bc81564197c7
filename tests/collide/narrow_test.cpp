// SPDX-License-Identifier: MIT
//
// Compares the narrow phase with CGAL, pair for pair, on pairs that are hard to decide.
#include <map>

#include "geometry/error.h"
#include "tests/collide/narrow_testing.h"

namespace bvhbench {
namespace {

constexpr uint pairs_a_class = 20'000;

class Narrow : public Needing<testing::TestWithParam<std::tuple<KernelForm, bool>>, cgal_absent> {
protected:
    NarrowOptions options(bool keep_adjacent) const
    {
        return {.keep_adjacent = keep_adjacent,
                .form = std::get<0>(GetParam()),
                .without_doubles = std::get<1>(GetParam())};
    }

    /// A mesh of pairs of a class, and those of them that meet by the reference.
    struct Decided {
        std::string_view name;
        Mesh mesh;
        PairList right;
    };

    /// Returns `apart` pairs without and `adjacent` pairs with shared corners of every class. Asks the reference, which takes most of
    /// the time, once for all kernels.
    static const std::vector<Decided>& decided(bool keep_adjacent, uint apart, uint adjacent)
    {
        static std::map<std::tuple<bool, uint, uint>, std::vector<Decided>> known;
        const auto [all, is_new] = known.try_emplace({keep_adjacent, apart, adjacent});
        if (is_new)
            for (const PairClass& of : pair_classes())
                for (const Mesh& mesh : {apart_pairs(of, apart, 1), adjacent_pairs(of, adjacent)})
                    all->second.push_back({of.name, mesh,
                                           intersecting_pairs(mesh.points, mesh.faces,
                                                              neighbours(mesh), keep_adjacent)});
        return all->second;
    }

    /// Expects what the reference has, of filters alone at most what they left open besides; returns how much that is in each class.
    static std::map<std::string_view, std::size_t> hold_to_reference(const NarrowOptions& options,
                                                                     uint apart, uint adjacent)
    {
        NarrowPhase narrow(bench().programs, options);
        std::map<std::string_view, std::size_t> more;
        for (const auto& [name, mesh, right] : decided(options.keep_adjacent, apart, adjacent)) {
            SCOPED_TRACE(name);
            narrow.reserve(mesh.faces.size());
            Candidates candidates(mesh, neighbours(mesh));
            if (options.keep_adjacent)  // as of a caller of the library: the host has no copies
                candidates.input.points = {}, candidates.input.faces = {};
            const PairList found = contacts_found(narrow, candidates);
            if (find_narrow_method(options.method).is_exact)
                expect_equal(mesh, found, right);
            EXPECT_TRUE(std::ranges::includes(found.pairs(), right.pairs()));
            EXPECT_LE(found.size() - right.size(), narrow.counts(bench().queue).exactly);
            more[name] += found.size() - right.size();
        }
        return more;
    }
};

TEST_P(Narrow, TellsWhatMeetsInEveryClassAndLeavesOutWhatSharesACorner)
{
    hold_to_reference(options(false), pairs_a_class, 500);
}

TEST_P(Narrow, TellsWhatMeetsBeyondSharedCornersInEveryClass)
{
    hold_to_reference(options(true), 1'000, pairs_a_class);
}

TEST_P(Narrow, DropsNothingWhenBuffersBeginWithOneEntry)
{
    NarrowOptions tiny = options(true);
    tiny.capacity = 1;
    hold_to_reference(tiny, 3'000, 3'000);
}

TEST_P(Narrow, LooksAtNoMoreThanWasCountedAndNoMoreThanThereIsRoomFor)
{
    NarrowPhase narrow(bench().programs, options(false));
    const Mesh mesh = apart_pairs(pair_classes()[5], 2'000, 1);
    narrow.reserve(mesh.faces.size());
    Candidates candidates(mesh, neighbours(mesh));
    for (const std::vector<uint>& counts :
         {std::vector<uint>{0, 0}, {1, 0}, {130, 0}, {2'000, 0}, {2'001, 0}, {99'999, 0}, {5, 1}}) {
        candidates.counters.upload(bench().queue.cl(), std::span<const uint>(counts));
        find_contacts(narrow, candidates.input, candidates.on_device, candidates.counters,
                      bench().queue);
        const std::uint64_t there_are = counts[1] != 0 ? 99'999 : counts[0];
        EXPECT_EQ(narrow.counts(bench().queue).candidates(),
                  std::min<std::uint64_t>(there_are, candidates.on_device.size()));
    }
    bench().queue.finish();
}

TEST_P(Narrow, FindsTheSameEveryTimeAlsoWhenTheFilterLeavesPairsOpenAfterQueriesWithout)
{
    NarrowPhase narrow(bench().programs, options(false));
    narrow.reserve(10'000);
    std::map<std::string_view, PairList> first;
    for (const char* name : {"hairs_breadth", "generic", "hairs_breadth"}) {
        const Mesh mesh = apart_pairs(find_pair_class(name), 5'000, 1);
        const Candidates candidates(mesh, neighbours(mesh));
        for (int repeat = 0; repeat < 5; ++repeat) {
            const PairList found = contacts_found(narrow, candidates);
            EXPECT_EQ(found, first.try_emplace(name, found).first->second);
        }
        narrow.query(candidates.input, candidates.on_device, candidates.counters, bench().queue);
        const bool decides = std::string_view(name) != "generic" && !std::get<1>(GetParam());
        EXPECT_EQ(bench().queue.finish().front().launches, decides ? 2 : 1);
    }
}

TEST_P(Narrow, MissesNoneWithFiltersAloneAndIsFalseOnlyWhereTheyAreInDoubt)
{
    for (const bool keep_adjacent : {false, true}) {
        NarrowOptions alone = options(keep_adjacent);
        alone.method = alone.without_doubles ? "filter-f32" : "filter-f64";
        auto more = keep_adjacent ? hold_to_reference(alone, 1'000, pairs_a_class)
                                  : hold_to_reference(alone, pairs_a_class, 500);
        EXPECT_GT(more["degenerate"], 1'000u);
        EXPECT_GT(more["coplanar_disjoint"], 1'000u);
        EXPECT_EQ(more["generic"] > 100, keep_adjacent || alone.without_doubles);
    }
}

INSTANTIATE_TEST_SUITE_P(Forms, Narrow,
                         testing::Combine(testing::ValuesIn(both_forms), testing::Bool()),
                         [](const auto& tested) {
                             return name_of(std::get<0>(tested.param)) +
                                    (std::get<1>(tested.param) ? "_without_doubles" : "");
                         });

/// Errors of a method on a class: missed and false contacts.
std::array<std::size_t, 2> errors_of(std::string_view method, KernelForm form, const char* name)
{
    NarrowPhase narrow(bench().programs, {.method = method, .form = form});
    const Mesh mesh = apart_pairs(find_pair_class(name), 5'000, 1);
    const Candidates candidates(mesh, neighbours(mesh));
    narrow.reserve(mesh.faces.size());
    const PairList found = contacts_found(narrow, candidates);
    const PairList right =
        intersecting_pairs(mesh.points, mesh.faces, candidates.pairs.pairs(), false);
    std::vector<Pair> missed, more;
    std::ranges::set_difference(right.pairs(), found.pairs(), std::back_inserter(missed));
    std::ranges::set_difference(found.pairs(), right.pairs(), std::back_inserter(more));
    return {missed.size(), more.size()};
}

using RoundingErrors = Needing<testing::Test, cgal_absent>;

TEST_F(RoundingErrors, AreNoneWhereNothingIsClose)
{
    constexpr std::array<std::size_t, 2> none = {0, 0};
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
        for (const NarrowMethod& method : narrow_methods(NarrowOf::moment)) {
            if (method.is_filter() && !method.is_exact)
                continue;  // false where in doubt
            SCOPED_TRACE(std::string(method.name) + ", " + name_of(form));
            EXPECT_EQ(errors_of(method.name, form, "generic"), none);
            if (method.name != "sat-f32") {  // no axis between a segment and others in its plane
                EXPECT_EQ(errors_of(method.name, form, "coplanar_lattice"), none);
            }
            EXPECT_EQ(errors_of(method.name, form, "edge_crosses_edge"), none);
        }
}

// On other classes each rounded method could pass for exact; these are hard for it.
TEST_F(RoundingErrors, AreThereOnHardClasses)
{
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks}) {
        EXPECT_GT(errors_of("guigue-f64", form, "same_place")[0], 100u);
        EXPECT_GT(errors_of("guigue-f32", form, "shared_edge")[0], 100u);
        EXPECT_GT(errors_of("guigue-f32", form, "near_touching")[1], 50u);
        EXPECT_GT(errors_of("moller-f32", form, "scaled_1e-4")[1], 1'000u);
        EXPECT_GT(errors_of("sat-f32", form, "scaled_4e12")[0], 1'000u);
        EXPECT_GT(errors_of("sat-f32", form, "needles")[1], 100u);
    }
}

// Small enough for a simulated device that checks every memory access.
TEST(RoundedNarrow, LooksAtEachOfFewPairs)
{
    const Mesh mesh = apart_pairs(find_pair_class("lattice_3"), 130, 1);
    const Candidates candidates(mesh, neighbours(mesh));
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks})
        for (const NarrowMethod& method : narrow_methods(NarrowOf::moment)) {
            NarrowPhase narrow(bench().programs,
                               {.method = method.name, .form = form, .capacity = 1});
            narrow.reserve(mesh.faces.size());
            EXPECT_GT(contacts_found(narrow, candidates).size(), 30u) << method.name;
        }
}

TEST(RoundedNarrow, RefusesCornersThatAreShared)
{
    const auto make = [](const NarrowOptions& options) { NarrowPhase(bench().programs, options); };
    EXPECT_THROW(make({.method = "guigue-f64", .keep_adjacent = true}), BadUsage);
    EXPECT_THROW(make({.method = "guess"}), BadUsage);
    EXPECT_THROW(make({.method = "guigue-f64", .without_doubles = true}), Unavailable);
    EXPECT_EQ(find_narrow_method("exact").name, "filter-f64+exact");
}

TEST(NarrowStages, EachDecideWhatTheyAreFor)
{
    using Expected = std::array<bool, 3>;  // whether floats, doubles and exact tests decide some
    const std::map<std::string_view, Expected> expected = {
        {"generic", {true, true, false}},           {"near_touching", {false, true, false}},
        {"coplanar_lattice", {false, false, true}}, {"hairs_breadth", {false, false, true}},
        {"lattice_8", {true, true, true}},          {"same_place", {false, false, true}},
        {"any_size", {true, true, true}},           {"scaled_1e-30", {false, true, false}},
        {"scaled_1e30", {false, true, false}},
    };
    std::size_t compared = 0;
    for (const KernelForm form : {KernelForm::groups, KernelForm::chunks}) {
        NarrowPhase narrow(bench().programs, {.form = form});
        for (const PairClass& of : pair_classes()) {
            SCOPED_TRACE(of.name);
            const Mesh mesh = apart_pairs(of, pairs_a_class, pairs_a_class);
            narrow.reserve(mesh.faces.size());
            const auto found = contacts_found(narrow, Candidates(mesh, neighbours(mesh))).size();
            EXPECT_TRUE(found > 0 || of.meeting == Meeting::none);
            EXPECT_TRUE(found < pairs_a_class || of.meeting == Meeting::all || of.name == "twice");
            const NarrowCounts counts = narrow.counts(bench().queue);
            const Expected some = {counts.by_floats > 0, counts.by_doubles > 0, counts.exactly > 0};
            if (const auto wanted = expected.find(of.name); wanted != expected.end()) {
                EXPECT_EQ(some, wanted->second)
                    << counts.by_floats << " by floats, " << counts.by_doubles << " by doubles, "
                    << counts.exactly << " exactly";
                ++compared;
            }
        }
    }
    EXPECT_EQ(compared, 2 * expected.size());
}

}  // namespace
}  // namespace bvhbench
