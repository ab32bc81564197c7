// SPDX-License-Identifier: MIT
#include "builders/ordered/leaf_order.h"

#include <map>

#include "builders/stages/bounds.h"
#include "tests/builders/stage_testing.h"

namespace bvhbench {
namespace {

struct Case {
    KernelForm form;
    std::string order;
    uint at_once = 0;  ///< sort.at_once, on devices whose groups do not wait
};

std::string name_of(const Case& tested)
{
    const std::string name = test_name(tested.order) + "_" + bvhbench::name_of(tested.form);
    return tested.at_once > 0 ? name + "_at_once_" + std::to_string(tested.at_once) : name;
}

/// Returns programs of the same device with sort.at_once as given, so that groups wait on a CPU too.
Programs& programs_at_once(uint at_once)
{
    if (at_once == 0)
        return bench().programs;
    static auto& all = *new std::map<uint, Programs*>;  // never destroyed, like bench()
    Programs*& programs = all[at_once];
    if (programs == nullptr) {
        Device& device = *new Device(bench().device);
        device.tuning.set(sort_at_once, at_once);
        if (device.is_cpu())  // where a team is one work-item, large groups need much local memory
            device.tuning.set(sweep_group_size, sweep_group_size.least);
        programs = new Programs(device);
    }
    return *programs;
}

class LeafOrderContract : public testing::TestWithParam<Case> {
protected:
    void expect_equal_to_host(const Mesh& mesh)
    {
        const auto size = static_cast<uint>(mesh.faces.size());
        reserve([&](Arena& arena) { order_.plan(arena, {&size, 1}, Use::tree, true); });
        order_.prepare(bench().queue.cl());
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
        order_.enqueue(input, bench().queue);
        stages_ = bench().queue.finish();

        const HostLeafOrder host =
            host_leaf_order(face_boxes(mesh.points, mesh.faces), GetParam().order);
        EXPECT_TRUE(same_bits(from_device(order_.boxes()), host.boxes));
        EXPECT_EQ(from_device(order_.ids()), host.ids);
        const std::vector<uint> words = from_device(order_.codes());
        const bool is_wide = order_.code_bits() > 32;
        for (std::size_t k = 0; k < host.codes.size(); ++k) {
            const ulong code =
                is_wide ? words[2 * k] | ulong{words[2 * k + 1]} << 32 : ulong{words[k]};
            ASSERT_EQ(code, host.codes[k]) << "leaf " << k;
        }
    }

    LeafOrder order_{programs_at_once(GetParam().at_once), GetParam().order, GetParam().form};
    std::vector<StageTime> stages_;
};

TEST_P(LeafOrderContract, EqualsTheHostsOnHardMeshes)
{
    for (const auto& [name, mesh] : hard_meshes(1000)) {
        SCOPED_TRACE(name);
        expect_equal_to_host(mesh);
    }
}

TEST_P(LeafOrderContract, EqualsTheHostsOfEverySize)
{
    for (const std::size_t size : {1, 2, 3, 4, 5, 255, 256, 257, 511, 512, 513, 1023, 1024, 1025,
                                   2047, 2049, 3841, 50'000}) {
        // Orders with codes differ only in their first kernel, so tiles are tested with the narrowest and the widest codes.
        const std::string& name = GetParam().order;
        const bool has_codes_alone = find_order(name).medians == Medians::nowhere;
        if (size > (takes_all_cases() ? 10'000 : 257) && has_codes_alone && name != "morton30" &&
            name != "hilbert63" && GetParam().at_once == 0)
            continue;
        SCOPED_TRACE(size);
        expect_equal_to_host(random_mesh(size));
    }
}

TEST_P(LeafOrderContract, NamesItsStagesAndWhatTheyMove)
{
    expect_equal_to_host(random_mesh(100));
    const OrderEntry& order = find_order(GetParam().order);
    const Device& device = programs_at_once(GetParam().at_once).device();
    const bool in_one_launch = order.code_bits > 0 && GetParam().form == KernelForm::groups &&
                               device.tuned(sort_at_once) == sort_at_once_with_boxes;
    std::vector<std::string> expected;
    if (!in_one_launch)
        expected.push_back("bounds");
    if (!in_one_launch && order.code_bits > 0)
        expected.insert(expected.end(), {"codes", "sort"});
    if (in_one_launch || order.medians != Medians::nowhere)
        expected.push_back("order");
    std::vector<std::string> stages;
    for (const StageTime& stage : stages_) {
        stages.push_back(stage.stage);
        EXPECT_GT(stage.moved_bytes, 0);
    }
    EXPECT_EQ(stages, expected);
}

INSTANTIATE_TEST_SUITE_P(
    AllOrders, LeafOrderContract, testing::ValuesIn([] {
        std::vector<Case> cases;
        for (const OrderEntry& order : order_catalog())
            for (const KernelForm form : both_forms)
                cases.push_back({form, std::string(order.name)});
        for (const char* order : {"morton30", "hilbert63"})
            cases.push_back({KernelForm::groups, order, 1});
        for (const char* order : {"morton30", "hilbert30-axis", "hilbert63", "hilbert30+kd1024"})
            cases.push_back({KernelForm::groups, order, sort_at_once_with_boxes});
        return cases;
    }()),
    CaseName());

/// Each object's leaves use a grid of that object, or all use the scene's; with many objects the lowest code bits are dropped.
TEST(LeafOrder, OfSeveralObjectsMeasuresCodesAgainstTheGridAskedFor)
{
    const auto size = [](uint object) { return 1 + object * 7 % 40; };
    for (const uint object_count : {50u, 70'000u}) {
        const bool drops_bits = object_count > 1u << 16;
        std::vector<FaceRange> objects;
        std::vector<uint> sizes, owners;
        for (uint k = 0; k < object_count; ++k) {
            sizes.push_back(drops_bits ? 1 + k % 2 : size(k));
            objects.push_back({static_cast<uint>(owners.size()), sizes.back()});
            owners.insert(owners.end(), sizes.back(), k);
        }
        const Mesh mesh = random_mesh(owners.size());
        const std::vector<Aabb> boxes = face_boxes(mesh.points, mesh.faces);
        const Bounds whole = host_bounds(boxes);
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces, objects);
        const OrderEntry& entry = find_order("hilbert48");
        const uint dropped = drops_bits ? 1 : 0;  // 17 bits of object, 47 of the 48 bits of code
        for (const GridOver grid : {GridOver::object, GridOver::scene})
            for (const KernelForm form : both_forms) {
                if (drops_bits && form == KernelForm::groups)
                    continue;  // takes seconds on a CPU, with the same kernel arguments
                SCOPED_TRACE(name_of(form));
                // By groups, and enough triangles for digits to be counted with the codes.
                Programs& programs = programs_at_once(form == KernelForm::groups ? 1 : 0);
                LeafOrder order(programs, entry.name, form, grid);
                reserve([&](Arena& arena) { order.plan(arena, sizes, Use::tree, true); });
                order.prepare(bench().queue.cl());
                order.enqueue(input, bench().queue);
                bench().queue.finish();
                std::vector<ulong> codes;
                for (uint k = 0; k < owners.size(); ++k) {
                    const FaceRange own = objects[owners[k]];
                    const Bounds bounds =
                        grid == GridOver::scene
                            ? whole
                            : host_bounds(std::span(boxes).subspan(own.first, own.count));
                    codes.push_back(ulong{owners[k]} << (48 - dropped) |
                                    entry.code(boxes[k], bounds) >> dropped);
                }
                std::vector<uint> ids(codes.size());
                std::iota(ids.begin(), ids.end(), 0u);
                std::ranges::stable_sort(ids, {}, [&](uint id) { return codes[id]; });
                EXPECT_EQ(from_device(order.ids()), ids);
            }
    }
}

}  // namespace
}  // namespace bvhbench
