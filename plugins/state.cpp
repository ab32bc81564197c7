// SPDX-License-Identifier: MIT
#include "plugins/state.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "process/worker.h"

namespace bvhbench::outside {
namespace {

constexpr int round_trips = 20;

// Arrays of files are those of memory.
static_assert(sizeof(Point) == 3 * sizeof(float) && sizeof(Face) == 3 * sizeof(std::uint32_t));
static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
static_assert(sizeof(bvhbench_node) == 36);

template <class Value>
std::string_view bytes_of(std::span<const Value> values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
}

/// Compares bit for bit: points may be negative zeros or not numbers.
template <class Value>
bool are_equal(const std::vector<Value>& a, std::span<const Value> b)
{
    return bytes_of(std::span<const Value>(a)) == bytes_of(b);
}

/// Returns the `count` values that the process wrote to a file.
template <class Value>
std::vector<Value> values_in(const MemoryFile& file, std::uint64_t count, const char* what)
{
    if (const std::size_t size = file.size();
        size / sizeof(Value) != count || size % sizeof(Value) != 0)
        throw Unavailable("its file of " + std::string(what) + " has " + std::to_string(size) +
                          " bytes, and it says that there are " + std::to_string(count) + ' ' +
                          what);
    require_host_memory(std::string("reading its ") + what, file.size());
    std::vector<Value> values(count);
    if (!file.read(values.data(), file.size()))
        throw Unavailable("its file of " + std::string(what) + " cannot be read");
    return values;
}

constexpr std::uint64_t most_values = std::uint64_t{1} << 40;
constexpr std::int64_t short_build_ns = 10'000'000;

}  // namespace

void State::start()
{
    process_.reset();  // frees its memory first
    last_build_ns_ = INT64_MAX;
    process_ = std::make_unique<Process>(library_, limits_);
    process_->ask({{"call", "create"}, {"method", method_.name}});
}

void State::measure_round_trip()
{
    for (int k = 0; k < round_trips; ++k) {
        bytes();
        const std::int64_t ns = process_->wall_ns();
        round_trip_ns_ = k == 0 ? ns : std::min(round_trip_ns_, ns);
    }
}

void State::take_mesh(const Input& input, const Sought& sought)
{
    start();
    const MemoryFile file(bytes_of(input.faces));
    process_->ask({{"call", "prepare"},
                   {"vertices", input.points.size()},
                   {"triangles", input.faces.size()},
                   {"faces", file.path()},
                   {"first", sought.first},
                   {"drops_adjacent", sought.drops_adjacent}});
    faces_.assign(input.faces.begin(), input.faces.end());
    points_.clear();
    measure_round_trip();
}

void State::send_queries(std::span<const MovingQuery> queries)
{
    std::vector<double> all;
    all.reserve(24 * queries.size());
    for (const MovingQuery& query : queries)
        for (const auto& points : {query.from, query.to})
            for (const WidePoint& p : points)
                all.insert(all.end(), {p.x, p.y, p.z});
    start();
    const MemoryFile file(bytes_of(std::span<const double>(all)));
    process_->ask({{"call", "queries"},
                   {"count", queries.size()},
                   {"of_edges", queries.front().of_edges},
                   {"points", file.path()}});
    queries_ = queries.size();
    measure_round_trip();
}

bool State::send_frame(const Input& input, const Sought& sought)
{
    if (process_ == nullptr || !are_equal(faces_, input.faces) ||
        (!points_.empty() && points_.size() != input.points.size()))
        take_mesh(input, sought);
    if (!points_.empty() && are_equal(points_, input.points) &&
        are_equal(end_points_, input.end_points))
        return false;
    const MemoryFile file(bytes_of(input.points)), end_file(bytes_of(input.end_points));
    Json request = {{"call", "load"}, {"points", file.path()}};
    if (input.is_swept())
        request["end_points"] = end_file.path();
    process_->ask(request);
    points_.assign(input.points.begin(), input.points.end());
    end_points_.assign(input.end_points.begin(), input.end_points.end());
    return true;
}

void State::send_candidates(std::span<const Pair> pairs)
{
    const MemoryFile file(bytes_of(pairs));
    process_->ask({{"call", "candidates"}, {"count", pairs.size()}, {"candidates", file.path()}});
}

void State::run(std::string_view call, Queue& queue, std::optional<double> within)
{
    Json request = {{"call", call}};
    if (within)
        request["within"] = *within;
    if (call == "build" && last_build_ns_ < short_build_ns)
        process_->ask(request);
    const Json reply = process_->ask(request);
    const std::int64_t wall_ns = process_->wall_ns();
    if (call == "build")
        last_build_ns_ = wall_ns;
    queue.add(process_->reading([&] { return stages_of(reply, wall_ns); }), wall_ns);
}

std::vector<Pair> State::pairs()
{
    const MemoryFile file;
    const Json reply = process_->ask({{"call", "pairs"}, {"pairs", file.path()}});
    return process_->reading([&] {
        auto found = values_in<Pair>(file, number_at(reply, "count", most_values), "pairs");
        put_in_order(found, faces_.size());
        return found;
    });
}

HostTree State::tree()
{
    const MemoryFile nodes, entries;
    const Json reply =
        process_->ask({{"call", "tree"}, {"nodes", nodes.path()}, {"entries", entries.path()}});
    return process_->reading([&] {
        return tree_of(
            values_in<bvhbench_node>(nodes, number_at(reply, "nodes", most_values), "nodes"),
            values_in<std::uint32_t>(entries, number_at(reply, "entries", most_values), "entries"),
            points_, faces_);
    });
}

std::vector<double> State::times()
{
    const MemoryFile file;
    process_->ask({{"call", "times"}, {"times", file.path()}});
    return process_->reading([&] { return values_in<double>(file, queries_, "times"); });
}

std::uint64_t State::bytes()
{
    if (process_ == nullptr)
        return 0;
    const Json reply = process_->ask({{"call", "bytes"}});
    return process_->reading([&] {
        const std::uint64_t held = number_at(reply, "bytes", std::uint64_t{1} << 62);
        if (limits_.device_bytes > 0 && held > limits_.device_bytes)
            throw Unavailable("it holds " + std::to_string(held) + " bytes, and " +
                              std::to_string(limits_.device_bytes) + " are allowed");
        return held;
    });
}

}  // namespace bvhbench::outside
