// SPDX-License-Identifier: MIT
//
// Makes OpenCL calls of the last rank fail, one at a time. Each failure must give all ranks the same Error, none may wait for
// another, and the same tree must work again once no call fails.
#include <optional>

#include "tests/faults/opencl_shim.h"
#include "tests/library_cluster/rank_scene.h"

namespace bvhbench {
namespace {

constexpr std::size_t share_of_paths = 150;

/// A caller's work, which makes every kind of call.
class Work {
public:
    explicit Work(Caller& caller) : caller_(caller) {}

    /// Returns the pairs of each frame, at rank 0.
    std::vector<std::vector<oibvh::Pair>> once()
    {
        if (!tree_)
            tree_.emplace(
                MPI_COMM_WORLD, caller_.queue,
                oibvh::ClusterOptions{.tree = {.adjacent_pairs = false}, .contacts = true});
        std::vector<std::vector<oibvh::Pair>> found;
        tree_->distribute(own_.view());
        for (int frame = 0; frame < 3; ++frame) {
            tree_->find_pairs();
            found.push_back(tree_->gather_pairs());
            found.push_back(tree_->gather_contacts());
            if (frame == 0)
                tree_->update(own_.points);
            if (frame == 1)
                tree_->rebalance();
        }
        return found;
    }

private:
    Caller& caller_;
    OwnTriangles own_ = scattered_part(scene_mesh("torus:400"));
    std::optional<oibvh::DistributedTree> tree_;
};

/// Expects all ranks to have the same text.
void expect_alike(const std::string& own)
{
    const auto texts =
        exchanged(*ranks, std::vector(ranks->count(), std::vector(own.begin(), own.end())));
    for (const std::vector<char>& text : texts)
        EXPECT_EQ(std::string(text.begin(), text.end()), own);
}

/// Runs the work, again if it throws. Returns the number of calls before the library's and of errors.
std::pair<long, std::uint64_t> live(cl_device_id device, shim::Plan plan,
                                    const std::vector<std::vector<oibvh::Pair>>& right)
{
    shim::begin(plan);
    Caller caller(0, {device});
    const long callers = shim::calls();
    std::uint64_t errors = 0;
    Work work(caller);
    for (int time = 0; time < 2; ++time) {
        std::string sentence;
        try {
            EXPECT_EQ(work.once(), right);
        } catch (const oibvh::Error& error) {
            ++errors;
            sentence = error.what();
            EXPECT_NE(sentence, "");
        }
        expect_alike(sentence);
        if (sentence.empty())
            break;
    }
    EXPECT_LE(errors, 1u);
    return {callers, errors};
}

TEST(ClusterLibraryFaults, OfOneRankAreErrorsOfAll)
{
    const bool is_last = ranks->rank() + 1 == ranks->count();
    shim::begin({});
    const cl_device_id device = open_device("").cl();
    std::vector<std::vector<oibvh::Pair>> right;
    {
        Caller caller(0, {device});
        right = Work(caller).once();
    }
    shim::remember_calls(is_last);
    const auto [callers, none] = live(device, {}, right);
    shim::remember_calls(false);
    ASSERT_EQ(none, 0u);
    std::set<std::uint64_t> tried;
    std::vector<long> chosen;
    if (is_last)
        chosen = shim::chosen_calls(tried, callers, share_of_paths);
    const std::uint64_t plans = sum_of_ranks(chosen.size());
    std::uint64_t errors = 0;
    for (std::uint64_t k = 0; k < plans; ++k) {
        errors += live(device, {is_last ? chosen[k] : 0, false}, right).second;
        EXPECT_EQ(shim::leaked(), std::vector<std::string>()) << shim::failed_call();
        EXPECT_EQ(shim::misused(), std::vector<std::string>()) << shim::failed_call();
        if (sum_of_ranks(HasFailure() ? 1 : 0) > 0)
            return;  // the first failing plan is enough
    }
    EXPECT_GT(errors, plans / 2);
    if (is_last)
        std::printf("%zu of the calls failed, %zu with an error\n", static_cast<std::size_t>(plans),
                    static_cast<std::size_t>(errors));
}

}  // namespace
}  // namespace bvhbench
