// SPDX-License-Identifier: MIT
//
// Oi-BVH as a library: a tree over triangles or boxes, and the pairs that overlap, on a caller's OpenCL queue.
//
//     bvhbench::oibvh::Tree tree(queue);                          // the kernels are compiled here
//     tree.build(bvhbench::oibvh::DeviceTriangles{points, point_count, faces, face_count});
//     const bvhbench::oibvh::Pairs found = tree.find_pairs();     // found.pairs is a cl_mem of found.count pairs
//
// docs/library.md has the guide. Coordinates are floats in any unit; the same unit everywhere. Boxes are closed: touching
// counts. Where a call fails it throws an Error of one sentence, and nothing else but std::bad_alloc.
#pragma once

#include <CL/cl.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#ifndef BVHBENCH_API
#define BVHBENCH_API __attribute__((visibility("default")))
#endif

namespace bvhbench::oibvh {

/// What every failed call throws, in one sentence.
class BVHBENCH_API Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The caller's: an option, a count, a buffer, an index or a coordinate that cannot be; a call out of turn.
class BVHBENCH_API BadInput : public Error {
    using Error::Error;
};

/// The machine's: memory that is not there, or what the device does not have.
class BVHBENCH_API Unavailable : public Error {
    using Error::Error;
};

/// An OpenCL call that failed, or a kernel that did not compile (CL_BUILD_PROGRAM_FAILURE, with the compiler's log).
class BVHBENCH_API OpenClFailure : public Error {
public:
    OpenClFailure(const std::string& sentence, cl_int code) : Error(sentence), code_(code) {}
    cl_int code() const { return code_; }

private:
    cl_int code_;
};

/// 12 bytes.
struct Point {
    float x, y, z;
};

/// A triangle of an indexed mesh: three positions in the points. 12 bytes.
struct Face {
    std::uint32_t a, b, c;
};

/// Axis-aligned, closed on all sides. 24 bytes.
struct Box {
    float min_x, min_y, min_z;
    float max_x, max_y, max_z;
};

/// Two of what the tree was built over, by their positions there, the smaller first. 8 bytes: a uint2.
struct Pair {
    std::uint32_t a, b;
    auto operator<=>(const Pair&) const = default;
};

// What a tree is built over, 1 to 2^31 triangles or boxes, one after the other without gaps. Buffers are the caller's, of
// the queue's context, and may be longer; they are kept, retained, until the next build. Host arrays are copied before the
// call returns.

struct HostTriangles {
    std::span<const Point> points;
    std::span<const Face> faces;
};
struct HostBoxes {
    std::span<const Box> boxes;
};
struct DeviceTriangles {
    cl_mem points = nullptr;  ///< of Point
    std::size_t point_count = 0;
    cl_mem faces = nullptr;  ///< of Face
    std::size_t face_count = 0;
};
struct DeviceBoxes {
    cl_mem boxes = nullptr;  ///< of Box
    std::size_t box_count = 0;
};
using Input = std::variant<HostTriangles, HostBoxes, DeviceTriangles, DeviceBoxes>;

struct DeviceOptions {
    /// Bytes of device memory that all trees of the Device may take together, if less than there is.
    std::size_t memory_limit = std::numeric_limits<std::size_t>::max();
    /// Numbers by which kernels are cut up, by name, as `bvhbench tune` finds them. They change no result.
    std::vector<std::pair<std::string, unsigned>> tuning = {};
};

/// What one call enqueued, in its order.
struct Stage {
    /// input, check, bounds, codes, sort, order, gather, hierarchy, refit, join or broad.
    std::string name;
    int launches = 0;
    std::int64_t busy_ns = 0;  ///< device clock, sum of the commands' run times
    std::int64_t span_ns = 0;  ///< device clock, first start to last end
};

/// A caller's queue, its device and context, and the kernels compiled for them. A handle: copies are the same Device, and
/// trees keep it alive. Retains the queue. Reads and sets no environment variable.
class BVHBENCH_API Device {
public:
    /// In order or out of order, with or without profiling. Throws BadInput for no queue, a queue on the device, or
    /// tuning that cannot be; Unavailable below OpenCL 1.2 or without a compiler.
    explicit Device(cl_command_queue queue, const DeviceOptions& options = {});

    /// Bytes of device memory that all its trees have taken.
    std::size_t memory() const;

    /// Host time that compiling took so far.
    double compile_seconds() const;

    /// Of the last call of any of its trees that enqueued something, and once. Waits. Empty if the queue has no profiling.
    std::vector<Stage> times();

    struct Impl;

private:
    friend class Tree;
    std::shared_ptr<Impl> impl_;
};

struct Options {
    /// oibvh-single: one launch builds all levels. oibvh-multi: some levels a launch. Empty: as the device likes.
    std::string builder = {};
    /// How leaves are lined up: a name of `bvhbench list orders`, as morton30, hilbert30, or kd, which takes longer and
    /// makes better trees.
    std::string order = "hilbert30";
    /// Whether leaves' boxes are kept in the order of the leaves, behind the other nodes, or in that of the input.
    bool sorted_leaves = true;
    /// leaf, group, block or bvtt: how pairs are found. Empty: as the device likes.
    std::string collider = {};
    /// Whether pairs of triangles that share a point's index are wanted too.
    bool adjacent_pairs = true;
    /// Look for indices that are out of range, coordinates that are not finite, boxes that end before they begin. That
    /// waits. Without it a build waits for nothing, and such input is undefined behaviour.
    bool check_input = true;
};

/// What becomes of an object's tree: all anew, new boxes in the same tree, or nothing.
enum class Update { rebuild, refit, keep };

/// Which pairs are wanted, by the objects that the two are of.
enum class Among { all, between_objects, within_objects };

/// Where a tree is on the device. Handles are the tree's: valid until it is built over other sizes or destroyed, and
/// rewritten by each build. Reading them from another queue is the caller's to order.
struct Buffers {
    cl_mem nodes = nullptr;  ///< of Box, by slot: levels() says which is which
    std::size_t node_count = 0;
    /// Of Box, in the input's order; null if leaves are sorted: they are the last level's nodes then.
    cl_mem leaf_boxes = nullptr;
    cl_mem ids = nullptr;  ///< of uint, one a leaf: its position in the input
    std::uint32_t leaf_count = 0;
    cl_mem objects = nullptr;  ///< of Object
    std::uint32_t object_count = 0;
};

/// Where an object's tree is in those buffers. 16 bytes, a uint4.
struct Object {
    std::uint32_t first;  ///< its first leaf's place among ids
    std::uint32_t leaves;
    std::uint32_t nodes;  ///< slot of its root
    std::uint32_t unused;
};

/// A level of a tree, the root's first: its nodes lie side by side. The children of the one at position p are at 2p and
/// 2p + 1 of the next level, the second only if there is one. Those of the last level are the leaves, in the order of ids.
struct Level {
    std::uint32_t first_slot;  ///< of its leftmost node, counted from the object's root
    std::uint32_t node_count;
};

/// A tree, read back.
struct HostTree {
    std::vector<Box> nodes;       ///< by slot
    std::vector<Box> leaf_boxes;  ///< empty if leaves are sorted
    std::vector<std::uint32_t> ids;
    std::vector<Object> objects;
};

/// What a query found: each pair once, in no order. Valid until the next query or build of the tree.
struct Pairs {
    cl_mem pairs = nullptr;         ///< of Pair, at least `count` of them
    cl_mem device_count = nullptr;  ///< of uint: the first two are the count, low word first
    std::uint64_t count = 0;
};

/// A tree over triangles or boxes, or a tree for each of several objects. Takes device memory when built over other sizes
/// than before, and otherwise none. All calls enqueue on the Device's queue: they run after what was enqueued there
/// before, and what is enqueued there afterwards runs after them.
class BVHBENCH_API Tree {
public:
    /// Throws BadInput for options that there are not, Unavailable, OpenClFailure.
    explicit Tree(Device device, Options options = {});
    explicit Tree(cl_command_queue queue, Options options = {});
    Tree(Tree&& other) noexcept;
    Tree& operator=(Tree&& other) noexcept;
    ~Tree();

    /// Build over `input`: one tree, or one for each run of neighbours of the given sizes, which cover it. Waits if input
    /// is checked, copied, or of another size than before. Throws any Error; there is no tree then until the next build.
    void build(const Input& input, std::span<const std::uint32_t> objects = {});

    /// New boxes for the tree that stands, of as many triangles or boxes that have moved: sooner than a build, and worse
    /// the further they moved. Throws as build does.
    void refit(const Input& input);

    /// The same for each object in its own way, in one set of launches. Input is for all; of objects that are kept it is
    /// checked and not otherwise read. Waits. Throws BadInput for an Update that there is not; the tree stays as it is then.
    void update(const Input& input, std::span<const Update> updates);

    bool is_built() const;

    /// All of these throw BadInput where there is no tree.
    Buffers buffers() const;
    std::vector<Level> levels(std::uint32_t object = 0) const;
    HostTree read() const;  ///< waits

    /// All pairs whose boxes overlap, none dropped: room for them grows and the query is repeated. Waits. Throws BadInput
    /// for an Among that there is not; the pairs of the last query are still there then.
    Pairs find_pairs(Among among = Among::all);

    /// The pairs of one of this tree's (a) with one of the other's (b), both numbers as in their own input. Both trees are
    /// of one object each, of one Device and with leaves kept alike. Copies both trees. Waits.
    Pairs find_pairs(const Tree& other);

    std::vector<Pair> read_pairs() const;  ///< of the last query; waits

    /// Bytes of device memory that it has taken; one tree's buffers and what building and queries need.
    std::size_t memory() const;

    /// OpenCL C 1.2 for the caller's own kernels: functions that walk this tree. docs/library.md has an example.
    std::string kernel_text() const;

    std::string_view builder() const;   ///< the name of what builds
    std::string_view collider() const;  ///< of what queries

    struct Impl;

private:
    std::unique_ptr<Impl> impl_;
};

/// The library's version, "0.1.0".
BVHBENCH_API std::string_view version();

}  // namespace bvhbench::oibvh
