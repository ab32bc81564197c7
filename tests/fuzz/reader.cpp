// SPDX-License-Identifier: MIT
//
// A libFuzzer target for each of our readers, chosen by a define: whatever bytes it is given, it reads them or throws what
// main tells in a sentence. Anything else thrown, and whatever the sanitizers see, is a find.
#include <fstream>
#include <functional>

#include "geometry/error.h"
#include "harness/experiment.h"
#include "harness/options.h"
#include "harness/record.h"
#include "harness/tuning_file.h"
#include "scenes/formats/formats.h"
#include "scenes/sequence_facts.h"

namespace bvhbench {
namespace {

[[maybe_unused]] void experiment(const std::string& bytes)
{
    parse_experiment(bytes, "fuzz", bytes.size() % 2 == 0);
}

[[maybe_unused]] void result(const std::string& bytes)
{
    for (const Cell& cell : read_document(bytes, "fuzz").cells)
        cell_text(cell);
}

[[maybe_unused]] void tuning(const std::string& bytes) { tuning_text(parse_tuning(bytes, "fuzz")); }

/// A word a line.
[[maybe_unused]] void options(const std::string& bytes)
{
    std::vector<std::string> words = {"bvhbench"};
    std::istringstream lines(bytes);
    for (std::string line; words.size() < 30 && std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));
    std::vector<const char*> argv;
    for (const std::string& word : words)
        argv.push_back(word.c_str());
    parse_options(static_cast<int>(argv.size()), argv.data());
}

[[maybe_unused]] void ply(const std::string& bytes) { read_ply(bytes, "fuzz"); }
[[maybe_unused]] void obj(const std::string& bytes) { read_obj(bytes, "fuzz"); }
[[maybe_unused]] void off(const std::string& bytes) { read_off(bytes, "fuzz"); }
[[maybe_unused]] void stl(const std::string& bytes) { read_stl(bytes, "fuzz"); }

[[maybe_unused]] void sequence_facts(const std::string& bytes)
{
    static const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + ".json");
    std::ofstream(file, std::ios::binary) << bytes;
    Scene scene;
    scene.frames.assign(3, std::vector<Point>(4));
    scene.faces.resize(2);
    add_sequence_facts(scene, file);
}

}  // namespace
}  // namespace bvhbench

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        bvhbench::READER(std::string(reinterpret_cast<const char*>(data), size));
    } catch (const bvhbench::BadUsage&) {
    } catch (const bvhbench::Unavailable&) {
    }
    return 0;
}
