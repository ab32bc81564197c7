// SPDX-License-Identifier: MIT
#include "scenes/mesh_worker.h"

#include <cstdlib>
#include <new>
#include <string_view>

#include "geometry/error.h"
#include "scenes/worker/assimp_reader.h"
#include "scenes/worker/message.h"
#include "scenes/worker/process.h"
#include "scenes/worker/worker.h"

namespace bvhbench {
namespace {

constexpr const char* argument = "--read-mesh";
// A program whose main forgets to ask is_mesh_worker would start itself again and again.
constexpr const char* marker = "BVHBENCH_MESH_WORKER";

std::string answer_for(const std::string& path, std::size_t memory_bytes)
{
    try {
        limit_worker(memory_bytes);
        return mesh_message(read_with_assimp(path));
    } catch (const std::bad_alloc&) {
        return refusal_message("it takes more memory than the reader may use");
    } catch (const std::exception& error) {
        const std::string_view why = error.what();
        const std::string_view sentence = why.substr(0, why.find('\n'));
        return refusal_message(sentence.empty() ? "it fails without a reason" : sentence);
    }
}

}  // namespace

bool is_mesh_worker(int argc, char** argv)
{
    return argc == 4 && std::string_view(argv[1]) == argument;
}

int mesh_worker_main(int, char** argv)
{
    const int answer = take_standard_output();
    return write_all(answer, answer_for(argv[2], std::strtoull(argv[3], nullptr, 10))) ? 0 : 1;
}

FileMesh read_in_worker(const std::filesystem::path& path, const WorkerLimits& limits)
{
    if (std::getenv(marker) != nullptr)
        throw std::logic_error("main does not begin with is_mesh_worker, see scenes/mesh_worker.h");
    const ProcessEnd end = run_process(
        {"/proc/self/exe", argument, path.string(), std::to_string(limits.memory_bytes)},
        limits.time_s, std::string(marker) + "=1");
    auto answer = decoded(end.output);
    if (end.how != ProcessEnd::How::exited || !answer)
        throw Unavailable("the reader " + spelled(end, limits.time_s) + " on " + path.string());
    if (const auto* const why = std::get_if<std::string>(&*answer))
        throw Unavailable(path.string() + " is not read: " + *why);
    return std::get<FileMesh>(std::move(*answer));
}

}  // namespace bvhbench
