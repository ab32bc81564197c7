// SPDX-License-Identifier: MIT
#include "harness/stress/libraries.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <span>

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/sweep.h"
#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/base/interrupt.h"
#include "scenes/worker/process.h"

namespace bvhbench {
namespace {

using enum Finding::Verdict;

constexpr std::string_view argument = "--plain-library";
constexpr std::size_t memory_limit = std::size_t{12} << 30;  ///< of a worker
constexpr std::string_view answer_mark = "PAIRS 1\n", refusal_mark = "ERROR 1\n";

template <class T>
void put(std::ostream& out, const std::vector<T>& values)
{
    const std::uint64_t count = values.size();
    out.write(reinterpret_cast<const char*>(&count), sizeof count);
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(count * sizeof(T)));
}

template <class T>
std::vector<T> taken(std::istream& in)
{
    std::uint64_t count = 0;
    in.read(reinterpret_cast<char*>(&count), sizeof count);
    std::vector<T> values(in ? count : 0);
    in.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(count * sizeof(T)));
    return values;
}

/// A scene in a file for a worker, gone with the object.
class SceneFile {
public:
    explicit SceneFile(const StressScene& scene)
    {
        static std::atomic<int> made = 0;
        path_ = std::filesystem::temp_directory_path() /
                ("bvhbench-stress-" + std::to_string(getpid()) + '-' + std::to_string(++made));
        std::ofstream out(path_, std::ios::binary);
        put(out, scene.mesh.points);
        put(out, scene.mesh.faces);
        put(out, scene.objects);
        if (!out.flush())
            throw Unavailable(path_.string() + " cannot be written");
    }
    ~SceneFile()
    {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    SceneFile(const SceneFile&) = delete;
    SceneFile& operator=(const SceneFile&) = delete;

    std::string path() const { return path_.string(); }

private:
    std::filesystem::path path_;
    const AtSignal removed_{[this] { std::filesystem::remove(path_); }};
};

const PlainLibrary& library_called(std::string_view name)
{
    for (const PlainLibrary& library : plain_libraries())
        if (library.name == name)
            return library;
    throw BadUsage("no library is called '" + std::string(name) + "'");
}

bool is_finite(const Mesh& mesh, const Face& face)
{
    for (const uint corner : {face.a, face.b, face.c}) {
        const Point& p = mesh.points[corner];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return false;
    }
    return true;
}

/// Pairs of which both triangles are among these, in ascending order. Of one without a place anything may be said: what
/// counts is what becomes of the others.
PairList among_these(const PairList& pairs, const std::vector<uint>& triangles)
{
    const auto is_there = [&](uint triangle) {
        return std::binary_search(triangles.begin(), triangles.end(), triangle);
    };
    std::vector<Pair> chosen;
    for (const Pair pair : pairs.pairs())
        if (is_there(pair.a) && is_there(pair.b))
            chosen.push_back(pair);
    return PairList(std::move(chosen));
}

/// The pairs of two objects that lie between them; of one object all.
PairList expected_of(const PlainLibrary& library, const StressScene& scene)
{
    PairList pairs = touching_pairs(scene.mesh.points, scene.mesh.faces, !library.finds_contacts);
    if (scene.objects.size() > 1)
        pairs = among_objects(pairs, scene.objects, Among::between_objects);
    return library.finds_contacts
               ? intersecting_pairs(scene.mesh.points, scene.mesh.faces, pairs, false)
               : pairs;
}

}  // namespace

bool is_library_worker(int argc, char** argv) { return argc == 4 && argv[1] == argument; }

int library_worker_main(int, char** argv)
{
    std::ofstream answer("/dev/fd/" + std::to_string(take_standard_output()), std::ios::binary);
    const std::string failure = reason_of_failure([&] {
        limit_worker(memory_limit);
        const PlainLibrary& library = library_called(argv[2]);
        std::ifstream in(argv[3], std::ios::binary);
        const auto points = taken<Point>(in);
        const auto faces = taken<Face>(in);
        const auto objects = taken<FaceRange>(in);
        if (!in)
            throw Unavailable(std::string(argv[3]) + " cannot be read");
        const std::vector<Pair> found = library.find(points, faces, objects);
        answer << answer_mark;
        put(answer, found);
    });
    if (!failure.empty())
        answer << refusal_mark << failure;
    return answer.flush() ? 0 : 1;
}

PairList found_by_library(const PlainLibrary& library, const StressScene& scene,
                          double time_limit_s)
{
    const SceneFile file(scene);
    const ProcessEnd end = run_process(
        {"/proc/self/exe", std::string(argument), std::string(library.name), file.path()},
        time_limit_s, "BVHBENCH_LIBRARY_WORKER=1");
    if (end.how != ProcessEnd::How::exited || end.code != 0)
        throw Unavailable("it " + spelled(end, time_limit_s));
    if (end.output.starts_with(refusal_mark))
        throw Unavailable(end.output.substr(refusal_mark.size()));
    std::uint64_t count = 0;
    const std::size_t start = answer_mark.size() + sizeof count;
    if (end.output.starts_with(answer_mark) && end.output.size() >= start)
        std::memcpy(&count, end.output.data() + answer_mark.size(), sizeof count);
    if (end.output.size() != start + count * sizeof(Pair))
        throw Unavailable("it ended without an answer");
    std::vector<Pair> pairs(count);
    std::ranges::copy(std::as_bytes(std::span(end.output)).subspan(start),
                      std::as_writable_bytes(std::span(pairs)).begin());
    return PairList(std::move(pairs));
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
            among_these(found_by_library(library, scene, time_limit_s), finite.original);
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
