// SPDX-License-Identifier: MIT
#include "harness/stress/libraries.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "geometry/names.h"
#include "harness/base/failure.h"
#include "scenes/mesh_file.h"
#include "scenes/mesh_worker.h"
#include "scenes/worker/process.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

constexpr std::string_view argument = "--plain-library";
constexpr std::size_t memory_limit = std::size_t{12} << 30;  ///< bytes, of a worker
constexpr std::string_view answer_mark = "PAIRS 1\n", refusal_mark = "ERROR 1\n";

/// A scene in memory that a worker process reads as a file while this object exists.
class SceneFile {
public:
    explicit SceneFile(const StressScene& scene) : file_(memfd_create("scene", MFD_CLOEXEC))
    {
        FileMesh file{scene.mesh, {}};
        for (const FaceRange& range : scene.objects)
            file.objects.push_back({{}, range.first, range.count});
        if (file_ < 0 || !write_all(file_, mesh_message(file)))
            throw Unavailable("there is no room for a scene that a library is to read");
    }
    ~SceneFile() { close(file_); }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;

    std::string path() const
    {
        return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(file_);
    }

private:
    int file_;
};

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
    const SceneFile file(scene);
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
    if (!pairs.empty())
        std::memcpy(pairs.data(), answer.data(), answer.size());
    return PairList(std::move(pairs));
}

bool is_finite(const Mesh& mesh, const Face& face)
{
    return std::ranges::all_of(std::array{face.a, face.b, face.c}, [&](uint corner) {
        const Point& p = mesh.points[corner];
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

/// Returns the pairs whose triangles are both in `triangles`, in ascending order. Triangles with vertices that are not finite
/// have no correct answer, so only the others count.
PairList among_these(const PairList& found, const std::vector<uint>& triangles)
{
    std::vector<Pair> pairs(found.pairs().begin(), found.pairs().end());
    std::erase_if(pairs, [&](const Pair pair) {
        return !std::ranges::binary_search(triangles, pair.a) ||
               !std::ranges::binary_search(triangles, pair.b);
    });
    return PairList(std::move(pairs));
}

/// Returns the correct pairs: between the objects if there are several, else all.
PairList expected_of(const PlainLibrary& library, const StressScene& scene)
{
    const auto& [points, faces] = scene.mesh;
    PairList pairs = touching_pairs(points, faces, !library.finds_contacts);
    if (scene.objects.size() > 1)
        pairs = among_objects(pairs, scene.objects, Among::between_objects);
    return library.finds_contacts ? intersecting_pairs(points, faces, pairs, false) : pairs;
}

}  // namespace

bool is_library_worker(int argc, char** argv) { return argc == 4 && argv[1] == argument; }

int library_worker_main(int, char** argv)
{
    std::ofstream answer("/dev/fd/" + std::to_string(take_standard_output()), std::ios::binary);
    const std::string failure = reason_of_failure([&] {
        limit_worker(memory_limit);
        const std::vector<Pair> found = found_in(argv[2], argv[3]);
        answer << answer_mark;
        answer.write(reinterpret_cast<const char*>(found.data()),
                     static_cast<std::streamsize>(found.size() * sizeof(Pair)));
    });
    if (!failure.empty())
        answer << refusal_mark << failure;
    return answer.flush() ? 0 : 1;
}

StressVariant finite_part(const StressScene& scene)
{
    StressVariant part{Invariant::pairs, "finite", {}, {}};
    part.scene.mesh.points = scene.mesh.points;
    for (const FaceRange& range : scene.objects) {
        const auto first = static_cast<uint>(part.original.size());
        for (uint k = range.first; k < range.first + range.count; ++k)
            if (is_finite(scene.mesh, scene.mesh.faces[k])) {
                part.scene.mesh.faces.push_back(scene.mesh.faces[k]);
                part.original.push_back(k);
            }
        part.scene.objects.push_back({first, static_cast<uint>(part.original.size()) - first});
    }
    return part;
}

Findings judge_library(const PlainLibrary& library, const StressScene& scene, double time_limit_s)
{
    if (library.finds_contacts && !has_exact_reference)
        return {};
    Findings findings;
    const std::string failure = reason_of_failure([&] {
        const StressVariant finite = finite_part(scene);
        const PairList found =
            among_these(found_by_worker(library.name, scene, time_limit_s), finite.original);
        const PairList expected = in_original_numbers(expected_of(library, finite.scene), finite);
        findings[library.finds_contacts ? Invariant::contacts : Invariant::pairs] =
            judge_pairs(found, expected);
    });
    findings[Invariant::ends] = {holds, 1};
    if (!failure.empty())
        findings[Invariant::ends] = {broken, 1, 1, 0, failure};
    return findings;
}

}  // namespace bvhbench
