// SPDX-License-Identifier: MIT
#include "harness/session/tuning_file.h"

#include "builders/parameters.h"
#include "builders/stages/sort/sort.h"
#include "tests/folder.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

std::string with_values(const std::string& values)
{
    return R"({"format": "tuning 1", "device": "a device", "driver": "1", "values": )" + values +
           "}";
}

TuningFile some_file()
{
    TuningFile file{"Some Device (TM) 9000", "3.1", {"sm_90", 114, 49152}, {}};
    file.values["sort.chunk_digit_bits"] = {
        11, "sort", "torus:1000", 0.875, 15, "2025-11-30T08:15:42Z", "abc"};
    file.values["walk.task_leaves"] = {32, "leaf", "bunny", 0.5, 5, "", ""};
    return file;
}

TEST(TuningFile, ComesBackAsItWasWritten)
{
    const TuningFile file = some_file();
    const TuningFile read = parse_tuning(tuning_text(file), "test");
    EXPECT_EQ(read.device, file.device);
    EXPECT_EQ(read.driver, file.driver);
    EXPECT_EQ(read.kind, file.kind);
    EXPECT_EQ(read.values, file.values);
}

TEST(TuningFile, SuitsTheNearestDeviceOfItsFamily)
{
    const DeviceKind own{"sm_90", 132, 49152};
    const DeviceKind few{"sm_90", 60, 49152}, near{"sm_90", 114, 49152}, none{};
    EXPECT_TRUE(is_nearer(near, few, own));
    EXPECT_FALSE(is_nearer(few, near, own));
    EXPECT_FALSE(is_nearer(near, near, own));
    EXPECT_TRUE(is_nearer(few, none, own));
    EXPECT_FALSE(is_nearer({"sm_80", 132, 49152}, none, own));
    EXPECT_FALSE(is_nearer({"sm_90", 132, 65536}, none, own));
    EXPECT_FALSE(is_nearer(none, none, none));
}

TEST(TuningFile, IsNamedAfterTheDevice)
{
    EXPECT_EQ(device_slug("NVIDIA H200"), "nvidia-h200");
    EXPECT_EQ(device_slug("  pthread-Intel(R) Xeon(R) @ 2.80GHz "),
              "pthread-intel-r-xeon-r-2-80ghz");
    EXPECT_EQ(device_slug("../é"), "device");
}

TEST(TuningFile, RefusesInOneSentenceWhatCannotBe)
{
    const auto says = [](const std::string& text) {
        const std::string why = refusal_of([&] { parse_tuning(text, "x.json"); });
        EXPECT_EQ(why.find('\n'), why.npos) << why;
        return why;
    };
    EXPECT_NE(says("{\"format\": ").find("x.json: "), std::string::npos);
    EXPECT_EQ(says("[]"), "x.json: 'format' is not \"tuning 1\"");
    EXPECT_EQ(says(R"({"format": "tuning 2"})"), "x.json: 'format' is not \"tuning 1\"");
    EXPECT_EQ(says(with_values("[]")), "x.json: 'values' must be an object of parameters");
    EXPECT_EQ(says(with_values(R"({"sweep.keys_per_item": 3})")),
              "x.json: 'sweep.keys_per_item' must be an object with a 'value'");
    EXPECT_EQ(says(with_values(R"({"sort.group_size": {"value": 48}})")),
              "x.json: sort.group_size must be a power of two, not 48");
    for (const char* value : {"99", "0", "-3", "2.5", "\"3\"", "4294967299", "null"})
        EXPECT_EQ(
            says(with_values(R"({"sweep.keys_per_item": {"value": )" + std::string(value) + "}}")),
            "x.json: sweep.keys_per_item must be a whole number from 1 to 32, not " +
                std::string(value));
    EXPECT_TRUE(contains(says(with_values(R"({"sweep.keys_per_item": {"value": 3, "luck": 1}})")),
                         "'luck' is no key"));
}

TEST(TuningFile, IsReadWithoutTheValuesOfParametersThatAreNoMore)
{
    testing::internal::CaptureStderr();
    const TuningFile read = parse_tuning(
        with_values(R"({"sort.speed": {"value": 1}, "chunks.per_core": {"value": 8}})"), "x.json");
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              "bvhbench: x.json: no parameter is called 'sort.speed', and its value is not used; "
              "`bvhbench list tuning` shows what there is\n");
    ASSERT_EQ(read.values.size(), 1u);
    EXPECT_EQ(read.values.at("chunks.per_core").value, 8u);
}

TEST(TuningFile, IsOfOneDeviceAndOfGroupsThatItHas)
{
    const Device device = open_device("");
    TuningFile file = some_file();
    EXPECT_EQ(refusal_of([&] { tuning_of(file, device, "x.json"); }),
              "x.json: its values are of 'Some Device (TM) 9000', and the device is '" +
                  device.name() + "'");
    file.device = device.name();
    EXPECT_EQ(tuning_of(file, device, "x.json").values().size(), 2u);
    EXPECT_EQ(tuning_of(file, device, "x.json").origin(), "x.json");
}

class TuningFolder : public testing::Test {
protected:
    /// Writes the device's file and returns its path.
    std::string write(const std::string& text) const
    {
        return folder_.file(device_slug(device_.name()) + ".json", text);
    }
    const Folder folder_;
    const std::string path_ = folder_.path().string();
    Device device_ = open_device("");
};

TEST_F(TuningFolder, GivesTheDevicesFileOrNone)
{
    EXPECT_EQ(tuning_file_for(device_, path_).origin, "none") << "no file of this device";
    TuningFile file = some_file();
    file.device = device_.name();
    const std::string written = write(tuning_text(file));
    const NamedTuning found = tuning_file_for(device_, path_);
    EXPECT_EQ(found.file.values, file.values);
    EXPECT_EQ(found.origin, written);
    EXPECT_EQ(tuning_file_for(device_, "").origin, "none") << "an empty word means none";
    write("{");
    EXPECT_NE(refusal_of([&] { tuning_file_for(device_, path_); }), "");
    EXPECT_EQ(refusal_of([&] { tuning_file_for(device_, "/no/such"); }),
              "tuning: there is no folder '/no/such'");
}

TEST_F(TuningFolder, IsTheOptionsBeforeTheVariables)
{
    unsetenv("BVHBENCH_TUNING");
    EXPECT_EQ(tuning_folder({}), std::nullopt);
    setenv("BVHBENCH_TUNING", "", 1);
    EXPECT_EQ(tuning_folder({}), "");
    setenv("BVHBENCH_TUNING", "from the variable", 1);
    EXPECT_EQ(tuning_folder({}), "from the variable");
    EXPECT_EQ(tuning_folder("from the option"), "from the option");
    unsetenv("BVHBENCH_TUNING");
}

TEST(EmbeddedTuning, AreFilesOfParametersThatThereAre)
{
    EXPECT_FALSE(embedded_tuning("results/tuning/no-such-device.json"));
    for (const std::string& name : device_names()) {
        const std::string path =
            "results/tuning/" + device_slug(name.substr(name.find('/') + 1)) + ".json";
        if (const auto text = embedded_tuning(path)) {
            EXPECT_NO_THROW(parse_tuning(*text, path));
        }
    }
}

TEST(Parameters, HaveNamesOfTheirOwnAndCandidatesThatCanBe)
{
    std::set<std::string_view> names;
    for (const Parameter* parameter : tuning_parameters()) {
        EXPECT_TRUE(names.insert(parameter->name).second) << parameter->name;
        EXPECT_GT(std::distance(parameter->candidates.begin(), parameter->candidates.end()), 1)
            << parameter->name;
        for (const uint value : parameter->candidates)
            EXPECT_EQ(parameter->refusal(value), "") << parameter->name;
        for (const bool is_cpu : {true, false})
            EXPECT_EQ(parameter->refusal(parameter->usual(is_cpu)), "") << parameter->name;
    }
    EXPECT_GT(names.size(), 20u);
}

TEST(TunedDevice, HasItsSortCutUpSo)
{
    Device device = open_device("");
    const SortShape usual = sort_shape(device, KernelForm::chunks);
    EXPECT_EQ(usual.chunk_digit_bits, sort_chunk_digit_bits.usual(device.is_cpu()));
    device.tuning.set(sort_chunk_digit_bits, 11);
    device.tuning.set(chunks_per_core, 7);
    EXPECT_EQ(sort_shape(device, KernelForm::chunks).chunk_digit_bits, 11u);
    EXPECT_EQ(chunk_count(device),
              7 * std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()});
}

}  // namespace
}  // namespace bvhbench
