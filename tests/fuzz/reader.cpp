// SPDX-License-Identifier: MIT
//
// A libFuzzer target for each reader of this project, selected by a define. For any bytes, the reader must succeed or throw an
// error that main() prints as one sentence. Any other exception and any sanitizer report is a finding.
#include <fstream>

#include "builders/host_tree.h"
#include "geometry/error.h"
#include "harness/choice/experiment.h"
#include "harness/commands/command.h"
#include "harness/session/tuning_file.h"
#include "plugins/protocol.h"
#include "scenes/face_order.h"
#include "scenes/facts.h"
#include "scenes/formats/formats.h"
#include "scenes/ground_truth.h"
#include "scenes/mesh_file.h"
#include "scenes/sequence.h"

namespace bvhbench {
namespace {

[[maybe_unused]] void experiment(const std::string& bytes)
{
    parse_experiment(bytes, "fuzz", bytes.size() % 2 == 0);
}

[[maybe_unused]] void tuning(const std::string& bytes) { tuning_text(parse_tuning(bytes, "fuzz")); }

/// Reads each line as one word of the command line.
[[maybe_unused]] void options(const std::string& bytes)
{
    std::vector<std::string> words = {"bvhbench"};
    std::istringstream lines(bytes);
    for (std::string line; words.size() < 30 && std::getline(lines, line);)
        words.push_back(line.substr(0, line.find('\0')));
    std::vector<const char*> argv;
    for (const std::string& word : words)
        argv.push_back(word.c_str());
    check_words(static_cast<int>(argv.size()), argv.data());
}

/// Makes a scene of what was read, as loading a file does.
void make_scene(FileMesh file)
{
    cut_polygons(file, "fuzz");
    Scene scene;
    scene.name = scene.source = "fuzz";
    scene.frames.push_back(std::move(file.mesh.points));
    if (!file.floats_hold)
        take_doubles(scene, {std::move(file.wide)}, Doubles::recentred);
    take_mesh(scene, std::move(file));
    scene = finished(std::move(scene));
    scene.facts = mesh_facts(scene, 8);
    surprises(scene);
    if (!scene.groups.empty())
        with_objects(scene, ObjectsBy::groups);
    welded(std::move(scene));
}

[[maybe_unused]] void ply(const std::string& bytes) { make_scene(read_ply(bytes, "fuzz")); }
[[maybe_unused]] void obj(const std::string& bytes) { make_scene(read_obj(bytes, "fuzz")); }
[[maybe_unused]] void off(const std::string& bytes) { make_scene(read_off(bytes, "fuzz")); }
[[maybe_unused]] void stl(const std::string& bytes) { make_scene(read_stl(bytes, "fuzz")); }
[[maybe_unused]] void gltf(const std::string& bytes)
{
    make_scene(read_gltf(bytes, "fuzz", [](const std::string&) { return std::string(64, '\1'); }));
}

[[maybe_unused]] void sequence_facts(const std::string& bytes)
{
    static const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()) + ".json");
    std::ofstream(file, std::ios::binary) << bytes;
    Scene scene;
    scene.frames.assign(3, std::vector<Point>(4));
    scene.faces.resize(2);
    add_sequence_facts(scene, file);
    step_facts(scene, file);
}

/// Reads a folder of two numbered files, the first up to an empty line; and the whole as the frames of a compact sequence.
[[maybe_unused]] void sequence(const std::string& bytes)
{
    static const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder / "files");
    std::filesystem::create_directories(folder / "frames");
    const std::size_t end = std::min(bytes.find("\n\n"), bytes.size());
    const auto write = [](const std::filesystem::path& file, const std::string& text) {
        std::ofstream(file, std::ios::binary) << text;
    };
    write(folder / "files/f1.obj", bytes.substr(0, end));
    write(folder / "files/f2.obj", bytes.substr(std::min(end + 2, bytes.size())));
    write(folder / "frames/mesh.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
          "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
          "0\n0 "
          "1 0\n3 0 1 2\n");
    write(folder / "frames/frames.f32", bytes);
    SceneLibrary library;
    library.any_topology = library.weld = bytes.size() % 2 == 0;
    for (const char* const name : {"files", "frames"})
        try {
            load_scene((folder / name).string(), library);
        } catch (const Unavailable&) {
        }
}

/// Reads the vertex-face pairs up to an empty line, then the edge-edge pairs.
[[maybe_unused]] void ground_truth(const std::string& bytes)
{
    static const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    const std::size_t end = std::min(bytes.find("\n\n"), bytes.size());
    std::ofstream(folder / "gt_vf.csv", std::ios::binary) << bytes.substr(0, end);
    std::ofstream(folder / "gt_ee.csv", std::ios::binary)
        << bytes.substr(std::min(end + 2, bytes.size()));
    Scene scene;
    scene.folder = folder;
    scene.frames.assign(2, std::vector<Point>(4));
    scene.faces = {{0, 1, 2}, {0, 2, 3}};
    ground_truth_of(scene, unique_edges(scene));
}

/// Reads the first line as the reply to `hello` and to a timed call, and the rest as a tree: as many nodes as there are whole ones, and
/// entries.
[[maybe_unused]] void plugin_reply(const std::string& bytes)
{
    const auto tried = [](const auto& read) {
        try {
            read();
        } catch (const Unavailable&) {
        }
    };
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string line = bytes.substr(0, end),
                      rest = bytes.substr(std::min(end + 1, bytes.size()));
    tried([&] {
        outside::Library library;
        outside::describe(library, outside::parsed_reply(line));
    });
    tried([&] { outside::stages_of(outside::parsed_reply(line), 1000); });
    outside::last_words(rest);
    std::vector<bvhbench_node> nodes(rest.size() / sizeof(bvhbench_node));
    std::vector<std::uint32_t> entries((rest.size() - nodes.size() * sizeof(bvhbench_node)) / 4);
    const std::size_t of_nodes = nodes.size() * sizeof(bvhbench_node);
    rest.copy(reinterpret_cast<char*>(nodes.data()), of_nodes);
    rest.copy(reinterpret_cast<char*>(entries.data()), entries.size() * 4, of_nodes);
    const std::vector<Point> points(3);
    const std::vector<Face> faces(4, Face{0, 1, 2});
    tried([&] {
        const HostTree tree = outside::tree_of(nodes, entries, points, faces);
        first_violation(tree, points, faces);
    });
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
