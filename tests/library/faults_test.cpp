// SPDX-License-Identifier: MIT
//
// Makes OpenCL calls inside the library fail, one at a time. Each failure must give the caller an Error; the same trees must
// work again once no call fails; and no OpenCL object may leak or be released twice. A shim that is linked before the
// OpenCL loader intercepts every call.
//
// BVHBENCH_FAULTS=calls fails every call, alone and with all calls after it. The default tries every 160th call path.
#include <optional>

#include "tests/faults/opencl_shim.h"
#include "tests/library/testing.h"

namespace bvhbench {
namespace {

/// A caller's work, which makes every kind of library call.
class Work {
public:
    explicit Work(Caller& caller) : caller_(caller) {}

    /// Makes all calls and returns the pairs of each query. A second call reuses the Device and trees of the first.
    std::vector<PairList> once()
    {
        if (!tree_) {
            const oibvh::Device device(caller_.queue);
            oibvh::Tree tree(device, {.adjacent_pairs = false});
            other_.emplace(device);
            tree_ = std::move(tree);
        }
        std::vector<PairList> found;
        tree_->build(triangles_);
        found.push_back(query());
        tree_->refit(mesh_.on_host());
        found.push_back(query());
        tree_->build(mesh_.on_host(), halves_);
        const oibvh::Update updates[] = {oibvh::Update::keep, oibvh::Update::rebuild};
        tree_->update(triangles_, updates);
        found.push_back(query());
        tree_->find_within(0.1);
        found.push_back(pair_list(tree_->read_pairs()));
        tree_->build(triangles_);
        other_->build(oibvh::HostBoxes{boxes_});
        tree_->find_pairs(*other_);
        found.push_back(PairList(between()));
        return found;
    }

private:
    PairList query()
    {
        tree_->find_pairs();
        return pair_list(tree_->read_pairs());
    }

    /// Returns the pairs between the two trees, with 100, the first tree's size, added to b, so that a < b as PairList needs.
    std::vector<Pair> between() const
    {
        std::vector<Pair> pairs;
        for (const oibvh::Pair pair : tree_->read_pairs())
            pairs.push_back({pair.a, pair.b + 100});
        return pairs;
    }

    Caller& caller_;
    LibraryMesh mesh_ = soup_mesh(100);
    std::vector<oibvh::Box> boxes_ = mesh_.boxes();
    oibvh::DeviceTriangles triangles_ = mesh_.on_device(caller_);
    std::vector<std::uint32_t> halves_ = {60, 40};
    std::optional<oibvh::Tree> tree_, other_;
};

struct Outcome {
    int errors = 0;
    long callers = 0;  ///< OpenCL calls that the caller made before any library call
};

/// Creates a caller and runs its work, again if the first run throws. If only one call fails, the second run must succeed.
Outcome live(cl_command_queue_properties kind, cl_device_id device, shim::Plan plan,
             const std::vector<PairList>& right)
{
    Outcome outcome;
    shim::begin(plan);
    Caller caller(kind, {device});
    Work work(caller);
    outcome.callers = shim::calls();
    for (int time = 0; time < 2; ++time) {
        try {
            const std::vector<PairList> found = work.once();
            EXPECT_EQ(found, right);
            break;
        } catch (const oibvh::Error& error) {
            ++outcome.errors;
            EXPECT_STRNE(error.what(), "");
        }
    }
    EXPECT_LE(outcome.errors, plan.from_there_on ? 2 : 1);
    return outcome;
}

class LibraryFaults : public testing::TestWithParam<cl_command_queue_properties> {};

TEST_P(LibraryFaults, EndInAnErrorAndLeaveNothing)
{
    shim::begin({});
    const cl_device_id device = open_device("").cl();
    std::vector<PairList> right;
    {
        Caller caller(GetParam(), {device});
        right = Work(caller).once();
    }
    shim::remember_calls(true);
    const Outcome whole = live(GetParam(), device, {}, right);
    shim::remember_calls(false);
    ASSERT_EQ(whole.errors, 0);
    ASSERT_EQ(shim::leaked(), std::vector<std::string>());
    int errors = 0;
    std::set<std::uint64_t> tried;
    for (const long nth : shim::chosen_calls(tried, whole.callers, 160))
        for (const bool from_there_on : {false, true}) {
            const Outcome outcome = live(GetParam(), device, {nth, from_there_on}, right);
            EXPECT_EQ(shim::leaked(), std::vector<std::string>()) << nth << shim::failed_call();
            EXPECT_EQ(shim::misused(), std::vector<std::string>()) << nth << shim::failed_call();
            errors += outcome.errors;
            if (HasFailure())
                return;  // the first failing plan is enough
        }
    EXPECT_GT(errors, 0);
}
INSTANTIATE_TEST_SUITE_P(Queues, LibraryFaults,
                         testing::Values(0, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE),
                         [](const auto& queue) {
                             return queue.param == 0 ? "InOrder" : "OutOfOrder";
                         });

}  // namespace
}  // namespace bvhbench
