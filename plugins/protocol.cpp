// SPDX-License-Identifier: MIT
#include "plugins/protocol.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "geometry/error.h"
#include "geometry/names.h"

namespace bvhbench::outside {
namespace {

constexpr std::size_t most_methods = 64, most_words = 200, most_text = 300;
constexpr std::array<std::string_view, 10> stage_names = {
    "bounds", "codes", "sort", "order", "gather", "hierarchy", "build", "refit", "broad", "narrow"};
constexpr std::uint64_t most_ns = std::uint64_t{1} << 62;

[[noreturn]] void refuse(const std::string& what)
{
    throw Unavailable("its reply is malformed: " + what);
}

const Json& value_at(const Json& object, const char* key)
{
    const auto found = object.find(key);
    if (found == object.end())
        refuse(std::string("there is no '") + key + "'");
    return *found;
}

/// Returns a text of one printable line.
std::string printable(std::string_view text, std::size_t most)
{
    std::string line;
    for (const char c : text.substr(0, most))
        line += static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
    return line + (text.size() > most ? " ..." : "");
}

std::string text_at(const Json& object, const char* key, bool may_be_empty = false)
{
    const Json& value = value_at(object, key);
    if (!value.is_string())
        refuse(std::string("'") + key + "' is no text");
    std::string text = printable(value.get_ref<const std::string&>(), most_text);
    if (text.empty() && !may_be_empty)
        refuse(std::string("'") + key + "' is empty");
    return text;
}

bool truth_at(const Json& object, const char* key)
{
    const auto found = object.find(key);
    if (found == object.end())
        return false;
    if (!found->is_boolean())
        refuse(std::string("'") + key + "' is neither true nor false");
    return found->get<bool>();
}

/// Returns the list at `key`, of at least one and at most `most` objects.
const Json& list_at(const Json& object, const char* key, std::size_t most)
{
    const Json& list = value_at(object, key);
    if (!list.is_array() || list.empty() || list.size() > most)
        refuse(std::string("'") + key + "' is no list of 1 to " + std::to_string(most));
    for (const Json& entry : list)
        if (!entry.is_object())
            refuse(std::string("an entry of '") + key + "' is no object");
    return list;
}

bool is_name(std::string_view name)
{
    const auto is_allowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    };
    return !name.empty() && name.size() <= 64 && name.front() != '-' &&
           std::ranges::all_of(name, is_allowed);
}

Method method_of(const Json& entry)
{
    Method method{.name = text_at(entry, "name"), .summary = text_at(entry, "summary")};
    if (!is_name(method.name))
        throw Unavailable("it calls a method '" + method.name +
                          "'; a name is up to 64 small letters, digits and hyphens");
    method.builds = truth_at(entry, "build");
    method.refits = truth_at(entry, "refit");
    method.queries = truth_at(entry, "query");
    method.has_tree = truth_at(entry, "tree");
    method.finds_contacts = truth_at(entry, "finds_contacts");
    method.answers = truth_at(entry, "answer");
    method.steps = truth_at(entry, "steps");
    method.within = truth_at(entry, "within");
    method.narrows = truth_at(entry, "narrow");
    method.widens = truth_at(entry, "widens_boxes");
    if ((method.queries || method.narrows) && !truth_at(entry, "pairs"))
        throw Unavailable("its method " + method.name + " has `" +
                          (method.queries ? "query" : "narrow") +
                          "` without `pairs`, by which it is judged");
    if ((method.steps || method.within) && !method.queries)
        throw Unavailable("its method " + method.name +
                          " has `load_step` or `query_within` without `query`");
    if (method.refits && !method.builds)
        throw Unavailable("its method " + method.name + " has `refit` without `build`");
    if (!method.is_builder() && !method.queries && !method.answers && !method.narrows)
        throw Unavailable("its method " + method.name +
                          " cannot be judged: it has neither `build` with `tree` nor `query` or "
                          "`narrow` with `pairs` nor `answer` with `times`");
    return method;
}

}  // namespace

Json parsed_reply(std::string_view line)
{
    Json reply = Json::parse(line, nullptr, false);
    if (!reply.is_object())
        refuse("'" + printable(line, most_words) + "' is no JSON object");
    if (reply.contains("error"))
        throw Unavailable("it says: " + text_at(reply, "error"));
    if (!truth_at(reply, "ok"))
        refuse("it has neither 'ok' nor 'error'");
    return reply;
}

std::uint64_t number_at(const Json& reply, const char* key, std::uint64_t most)
{
    const Json& value = value_at(reply, key);
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
        refuse(std::string("'") + key + "' is no whole number from 0 to " + std::to_string(most));
    return value.get<std::uint64_t>();
}

void describe(Library& library, const Json& reply)
{
    if (const std::uint64_t other = number_at(reply, "protocol", ~0u); other != protocol)
        throw Unavailable("it was made for version " + std::to_string(other) +
                          " of the interface, and this is version " + std::to_string(protocol));
    library.name = text_at(reply, "library");
    library.version = text_at(reply, "version");
    library.licence = text_at(reply, "licence");
    library.device = text_at(reply, "device");
    library.methods.clear();
    for (const Json& entry : list_at(reply, "methods", most_methods)) {
        Method method = method_of(entry);
        if (find_name(library.methods, method.name) != nullptr)
            throw Unavailable("two of its methods are called " + method.name);
        library.methods.push_back(std::move(method));
    }
}

std::vector<StageTime> stages_of(const Json& reply, std::int64_t wall_ns)
{
    std::vector<StageTime> stages;
    std::uint64_t first = 0, last = 0;
    for (const Json& entry : list_at(reply, "stages", BVHBENCH_MOST_STAGES)) {
        const std::string name = text_at(entry, "name");
        if (std::ranges::find(stage_names, name) == stage_names.end())
            refuse("no stage is called '" + name + '\'' + there_are(name, stage_names));
        if (std::ranges::find(stages, name, &StageTime::stage) != stages.end())
            refuse("it has two stages '" + name + '\'');
        const std::uint64_t begin = number_at(entry, "begin_ns", most_ns),
                            end = number_at(entry, "end_ns", most_ns);
        if (begin < last || end < begin)
            refuse("its stage '" + name +
                   "' begins before the one before ends, or ends before it begins");
        if (stages.empty())
            first = begin;
        last = end;
        StageTime& time = stages.emplace_back();
        time.stage = name;
        const auto elapsed = static_cast<std::int64_t>(end - begin);
        if (truth_at(entry, "device")) {
            time.launches = 1;  // how many there were is not told
            time.busy_ns = time.span_ns = elapsed;
            time.start_ns = static_cast<std::int64_t>(begin - first);
        } else {
            time.wall_ns = std::max<std::int64_t>(1, elapsed);
        }
    }
    if (const auto span = static_cast<std::int64_t>(last - first); span > wall_ns)
        throw Unavailable("its stages last " + std::to_string(span) + " ns, longer than the " +
                          std::to_string(wall_ns) + " ns that the whole call took");
    return stages;
}

HostTree tree_of(std::span<const bvhbench_node> nodes, std::span<const std::uint32_t> entries,
                 std::span<const Point> points, std::span<const Face> faces)
{
    if (nodes.empty())
        throw Unavailable("its tree has no node");
    HostTree tree;
    tree.boxes_may_be_larger = true;
    tree.nodes.resize(nodes.size());
    const auto node_text = [](std::size_t k) {
        return "node " + std::to_string(k) + " of its tree";
    };
    for (std::size_t k = 0; k < nodes.size(); ++k) {
        const bvhbench_node& node = nodes[k];
        if (node.count < 1 || node.count > HostTree::most_children)
            throw Unavailable(node_text(k) + " has " + std::to_string(node.count) +
                              " entries, and 1 to 8 are allowed");
        if (node.first > entries.size() || node.count > entries.size() - node.first)
            throw Unavailable(node_text(k) + " names entries that are not there");
        const Aabb box = {node.low[0],  node.low[1],  node.low[2],
                          node.high[0], node.high[1], node.high[2]};
        tree.nodes[k].box = box;
        const bool is_one = node.is_leaf != 0 && node.count == 1;
        for (std::size_t side = 0; side < node.count; ++side) {
            const std::uint32_t entry = entries[node.first + side];
            if (node.is_leaf != 0 ? entry >= faces.size() : entry <= k || entry >= nodes.size())
                throw Unavailable(node_text(k) + " has the entry " + std::to_string(entry) +
                                  (node.is_leaf != 0 ? ", which is no triangle"
                                                     : ", which is no node behind it"));
            if (is_one) {
                tree.nodes[k].primitive = static_cast<int>(entry);
            } else if (node.is_leaf != 0) {
                tree.nodes[k].child[side] = static_cast<int>(tree.nodes.size());
                tree.nodes.push_back({.box = face_box(points, faces[entry]),
                                      .child = {},
                                      .primitive = static_cast<int>(entry)});
            } else {
                tree.nodes[k].child[side] = static_cast<int>(entry);
            }
        }
    }
    return tree;
}

void put_in_order(std::span<Pair> pairs, std::size_t triangles)
{
    for (Pair& pair : pairs) {
        if (pair.a >= triangles || pair.b >= triangles || pair.a == pair.b)
            throw Unavailable("it found a pair of " + std::to_string(pair.a) + " and " +
                              std::to_string(pair.b) + ", and there are triangles 0 to " +
                              std::to_string(triangles - 1));
        if (pair.a > pair.b)
            std::swap(pair.a, pair.b);
    }
}

std::string last_words(std::string_view errors)
{
    constexpr std::string_view blanks = " \t\r\n\f\v";
    const std::size_t end = errors.find_last_not_of(blanks);
    if (end == errors.npos)
        return {};
    errors = errors.substr(0, end + 1);
    const std::size_t line = errors.find_last_of('\n');
    return printable(line == errors.npos ? errors : errors.substr(line + 1), most_words);
}

}  // namespace bvhbench::outside
