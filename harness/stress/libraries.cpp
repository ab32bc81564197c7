// SPDX-License-Identifier: MIT
#include "harness/stress/libraries.h"

#include <algorithm>

#include "collide/oracles/box_pairs.h"
#include "collide/oracles/exact_reference.h"
#include "geometry/names.h"
#include "harness/base/failure.h"
#include "process/child.h"
#include "process/worker.h"
#include "scenes/mesh_file.h"
#include "scenes/mesh_worker.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

constexpr std::string_view argument = "--plain-library";
constexpr std::size_t memory_limit = std::size_t{12} << 30;  ///< bytes, of a worker
constexpr std::string_view answer_mark = "PAIRS 1\n", refusal_mark = "ERROR 1\n";

/// Returns the pairs that the library `name` finds in the scene of a file.
std::vector<Pair> found_in(std::string_view name, const std::string& path)
{
    const auto message = decoded(file_bytes(path));
    if (!message || !std::holds_alternative<FileMesh>(*message))
        throw Unavailable(path + " cannot be read");
    const FileMesh& file = std::get<FileMesh>(*message);
    std::vector<FaceRange> objects;
    for (const SceneObject& object : file.objects)
        objects.push_back({object.first_face, object.face_count});
    return find_called(plain_libraries(), name, "library")
        .find(file.mesh.points, file.mesh.faces, objects);
}

/// Returns what found_in returns, computed in another process. Throws Unavailable, with a sentence, if there is no answer.
PairList found_by_worker(std::string_view library, const StressScene& scene, double time_limit_s)
{
    FileMesh mesh{scene.mesh, {}};
    for (const FaceRange& range : scene.objects)
        mesh.objects.push_back({{}, range.first, range.count});
    const MemoryFile file(mesh_message(mesh));
    const ProcessEnd end =
        run_process({"/proc/self/exe", std::string(argument), std::string(library), file.path()},
                    time_limit_s, "BVHBENCH_LIBRARY_WORKER=1");
    if (end.how != ProcessEnd::How::exited || end.code != 0)
        throw Unavailable("it " + spelled(end, time_limit_s));
    std::string_view answer = end.output;
    if (answer.starts_with(refusal_mark))
        throw Unavailable(end.output.substr(refusal_mark.size()));
    if (!answer.starts_with(answer_mark) ||
        (answer.size() - answer_mark.size()) % sizeof(Pair) != 0)
        throw Unavailable("it ended without an answer");
    answer.remove_prefix(answer_mark.size());
    std::vector<Pair> pairs(answer.size() / sizeof(Pair));
    answer.copy(reinterpret_cast<char*>(pairs.data()), answer.size());
    return PairList(std::move(pairs));
}

/// Returns the correct pairs: between the objects if there are several, else all.
PairList expected_of(const PlainLibrary& library, const StressScene& scene)
{
    const auto& [points, faces] = scene.mesh;
    PairList pairs = touching_pairs(points, faces, !library.finds_contacts);
    if (scene.objects.size() > 1)
        pairs = among_objects(pairs, scene.objects, Among::between_objects);
    return library.finds_contacts ? intersecting_pairs(points, faces, pairs.pairs(), false) : pairs;
}

}  // namespace

bool is_library_worker(int argc, char** argv) { return argc == 4 && argv[1] == argument; }

int library_worker_main(int, char** argv)
{
    const int answer = take_standard_output();
    std::string text(answer_mark);
    const std::string failure = reason_of_failure([&] {
        limit_worker(memory_limit);
        const std::vector<Pair> found = found_in(argv[2], argv[3]);
        text.append(reinterpret_cast<const char*>(found.data()), found.size() * sizeof(Pair));
    });
    if (!failure.empty())
        text = std::string(refusal_mark) + failure;
    return write_all(answer, text) ? 0 : 1;
}

Findings judge_library(const PlainLibrary& library, const StressScene& scene, double time_limit_s)
{
    if (library.finds_contacts && !has_exact_reference)
        return {};
    Findings findings;
    const std::string failure = reason_of_failure([&] {
        // Triangles with vertices that are not finite have no correct answer, so only the others count.
        const auto& [finite, original] = finite_part(scene);
        const auto has = [&](uint triangle) {
            return std::ranges::binary_search(original, triangle);
        };
        const PairList found = chosen(found_by_worker(library.name, scene, time_limit_s),
                                      [&](Pair pair) { return has(pair.a) && has(pair.b); });
        const PairList expected = renumbered(expected_of(library, finite), original);
        findings[library.finds_contacts ? Invariant::contacts : Invariant::pairs] =
            judge_pairs(found, expected);
    });
    findings[Invariant::ends] =
        failure.empty() ? Finding{holds, 1} : Finding{broken, 1, 1, 0, failure};
    return findings;
}

}  // namespace bvhbench
