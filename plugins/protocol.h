// SPDX-License-Identifier: MIT
//
// The protocol between bvhbench and a process with a builder or collider from outside: a line of JSON for each request and reply,
// and files of plain arrays. docs/plugins.md is its reference. Here are its texts and what must be true of replies; process.h
// has the conversation. Nothing that a process says is trusted: all functions throw Unavailable, with one sentence, for a reply
// that is not as it must be.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "builders/tree.h"
#include "collide/pairs.h"
#include "device/queue.h"
#include "geometry/mesh.h"
#include "plugins/include/bvhbench/plugin.h"

namespace bvhbench::outside {

using Json = nlohmann::json;

constexpr unsigned protocol = 1;  ///< its version

/// A method from outside, as it describes itself.
struct Method {
    std::string name, summary;
    bool builds = false;   ///< makes a tree that can be judged
    bool refits = false;   ///< gives the tree of the last build new boxes
    bool queries = false;  ///< finds pairs
    bool has_tree = false;
    bool finds_contacts = false;
    bool answers = false;  ///< single queries of moving points
    bool steps = false;    ///< finds pairs of a step too, and of those leaves out what a mesh says
    bool within = false;   ///< finds pairs within a distance too
    bool narrows = false;  ///< tests given pairs of triangles
    bool widens = false;   ///< rounds boxes outward

    bool is_builder() const { return builds && has_tree; }
};

/// What a library or program says of itself, and where it is.
struct Library {
    std::string file;  ///< absolute path
    bool is_program =
        false;  ///< speaks the protocol itself; if false, it is a shared library with the interface in C
    std::string name, version, licence, device;
    std::vector<Method> methods;
};

/// Returns the reply's JSON. Throws also if the reply is an error.
Json parsed_reply(std::string_view line);

/// Returns the number at `key` of a reply.
std::uint64_t number_at(const Json& reply, const char* key, std::uint64_t most);

/// Completes the library by its reply to `hello`. Each method must be one that can be judged: by a tree, or by pairs.
void describe(Library& library, const Json& reply);

/// Returns the stages of a timed call that took `wall_ns` on the clock of bvhbench. They must be known ones, one after another, and
/// no longer than the call.
std::vector<StageTime> stages_of(const Json& reply, std::int64_t wall_ns);

/// Returns the tree in the form that is judged. A node of one triangle is a leaf; the triangles of a node that has several become
/// leaves below it, with the boxes that the triangles have. Boxes are the process's. Throws if that is no tree over these triangles.
HostTree tree_of(std::span<const bvhbench_node> nodes, std::span<const std::uint32_t> entries,
                 std::span<const Point> points, std::span<const Face> faces);

/// Puts the smaller triangle of each pair first. Throws if one is not among the `triangles`, or is paired with itself.
void put_in_order(std::span<Pair> pairs, std::size_t triangles);

/// Returns the last words of a process: the last line of `errors` that is not blank, shortened to a printable sentence. Empty if there is none.
std::string last_words(std::string_view errors);

}  // namespace bvhbench::outside
