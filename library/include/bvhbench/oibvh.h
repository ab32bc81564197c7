// SPDX-License-Identifier: MIT
//
// Oi-BVH as a library: builds a BVH over triangles or boxes and finds overlapping pairs, on the caller's OpenCL queue.
//
//     bvhbench::oibvh::Tree tree(queue);                          // compiles kernels
//     tree.build(bvhbench::oibvh::DeviceTriangles{points, point_count, faces, face_count});
//     const bvhbench::oibvh::Pairs found = tree.find_pairs();     // found.pairs is a cl_mem of found.count pairs
//
// docs/library.md is the guide. Coordinates are floats, all in one unit of the caller's choice. Boxes are closed: boxes that
// touch overlap. A call that fails throws an Error whose message is one sentence; the only other exception is std::bad_alloc.
#pragma once

#include <CL/cl.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
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

/// Base class of all exceptions of the library. The message is one sentence.
class BVHBENCH_API Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The caller passed an invalid option, count, buffer, index or coordinate, or made a call that needs a tree before a build.
class BVHBENCH_API BadInput : public Error {
    using Error::Error;
};

/// The device or the host has too little memory, or the device lacks a feature that the library needs.
class BVHBENCH_API Unavailable : public Error {
    using Error::Error;
};

/// An OpenCL call failed, or a kernel did not compile (code CL_BUILD_PROGRAM_FAILURE; the message holds the compiler's log).
class BVHBENCH_API OpenClFailure : public Error {
public:
    OpenClFailure(const std::string& sentence, cl_int code) : Error(sentence), code_(code) {}
    cl_int code() const { return code_; }

private:
    cl_int code_;
};

/// A vertex position. 12 bytes.
struct Point {
    float x, y, z;
};

/// A triangle: the indices of its three corners in the array of points. 12 bytes.
struct Face {
    std::uint32_t a, b, c;
};

/// An axis-aligned box that includes its boundary. 24 bytes.
struct Box {
    float min_x, min_y, min_z;
    float max_x, max_y, max_z;
};

/// Two triangles or boxes, as indices into the input, the smaller index first. Of a query between two trees, `a` is an index
/// into the first tree's input and `b` one into the second's. 8 bytes, a uint2 in kernels.
struct Pair {
    std::uint32_t a, b;
    auto operator<=>(const Pair&) const = default;
};

// Input of a build: 1 to 2^31 triangles or boxes, packed without gaps. Host arrays are copied before the call returns. Device
// buffers must belong to the queue's context and may be longer than needed. The tree retains them until its next build, refit
// or update, because queries read them.

struct HostTriangles {
    std::span<const Point> points;
    std::span<const Face> faces;
};
struct HostBoxes {
    std::span<const Box> boxes;
};
struct DeviceTriangles {
    cl_mem points = nullptr;  ///< array of Point
    std::size_t point_count = 0;
    cl_mem faces = nullptr;  ///< array of Face
    std::size_t face_count = 0;
};
struct DeviceBoxes {
    cl_mem boxes = nullptr;  ///< array of Box
    std::size_t box_count = 0;
};
using Input = std::variant<HostTriangles, HostBoxes, DeviceTriangles, DeviceBoxes>;

struct DeviceOptions {
    /// Upper bound, in bytes, on the device memory of all trees of the Device together.
    std::size_t memory_limit = std::numeric_limits<std::size_t>::max();
    /// Values of tuning parameters by name, as `bvhbench tune` finds them. They affect speed only, never results.
    std::vector<std::pair<std::string, unsigned>> tuning = {};
};

/// Times of one stage of a call, from the device's clock.
struct Stage {
    /// input, check, bounds, codes, sort, order, gather, hierarchy, refit, join, broad,
    /// pad, narrow or exact.
    std::string name;
    int launches = 0;          ///< number of commands enqueued
    std::int64_t busy_ns = 0;  ///< sum of the commands' run times
    std::int64_t span_ns = 0;  ///< from the first command's start to the last command's end
};

/// The caller's queue with its device and context, and the kernels compiled for them. Copies share one state, which lives as
/// long as any copy or tree that uses it. Retains the queue. Reads and sets no environment variable.
class BVHBENCH_API Device {
public:
    /// Accepts in-order and out-of-order queues, with or without profiling. Throws BadInput for a null queue, a device-side
    /// queue or an invalid tuning value, and Unavailable if the device lacks OpenCL 1.2 or a compiler.
    explicit Device(cl_command_queue queue, const DeviceOptions& options = {});

    /// Returns the bytes of device memory that all trees of this Device hold.
    std::size_t memory() const;

    /// Returns the host time spent compiling kernels so far, in seconds.
    double compile_seconds() const;

    /// Returns the stages, in order, of the last call on any tree of this Device that enqueued commands. Waits. Returns an
    /// empty list if the queue has no profiling, or if these stages were returned before.
    std::vector<Stage> times();

    struct Impl;

private:
    friend class Tree;
    friend class Scene;
    std::shared_ptr<Impl> impl_;
};

struct Options {
    /// Builder: oibvh-single builds all levels in one launch, oibvh-multi builds some levels per launch. If empty, the
    /// library chooses by device.
    std::string builder = {};
    /// Order of the leaves: a name from `bvhbench list orders`, such as morton30, hilbert30 or kd. kd takes longer to build,
    /// gives better trees, and takes one object only.
    std::string order = "hilbert30";
    /// True: leaf boxes follow their tree's inner nodes, in leaf order. False: they are in their own buffer, in input order.
    bool sorted_leaves = true;
    /// Collider: leaf, group, block or bvtt. If empty, the library chooses by device.
    std::string collider = {};
    /// Whether queries also report pairs of triangles that share a point index. Queries between two trees always do.
    bool adjacent_pairs = true;
    /// Whether build, refit and update check that indices are in range, coordinates finite and no box's minimum above its
    /// maximum. The check waits for the device. Without it such input is undefined behaviour.
    bool check_input = true;
};

/// What an update does with an object's tree: builds it anew, recomputes its boxes in the same topology, or leaves it as is.
enum class Update { rebuild, refit, keep };

/// Which pairs a query reports: all, only those of two different objects, or only those within one object.
enum class Among { all, between_objects, within_objects };

/// Two objects that a query does not test, or one object twice: pairs within it. 8 bytes.
struct Excluded {
    std::uint32_t a, b;
};

/// Which pairs of objects a query tests. Host arrays, which are copied.
struct Filter {
    std::span<const Excluded> excluded = {};  ///< in any order
    /// For each object, bits of what it is and of what it is tested against; empty: all bits are set. Two objects are tested if
    /// (groups[a] & masks[b]) != 0 and (groups[b] & masks[a]) != 0. Pairs within an object do not depend on them.
    std::span<const std::uint32_t> groups = {};
    std::span<const std::uint32_t> masks = {};
};

/// Device buffers of a tree. The tree owns the handles; they are valid until it is built over other sizes or destroyed, and
/// every build rewrites their contents. To read them from another queue, the caller must synchronize the queues.
struct Buffers {
    cl_mem nodes = nullptr;  ///< array of Box, by slot; levels() gives the slots
    std::size_t node_count = 0;
    /// Array of Box, in input order. Null if leaves are sorted: then the last level of `nodes` holds the leaf boxes.
    cl_mem leaf_boxes = nullptr;
    cl_mem ids = nullptr;  ///< array of uint: the input index of each leaf
    std::uint32_t leaf_count = 0;
    cl_mem objects = nullptr;  ///< array of Object
    std::uint32_t object_count = 0;
};

/// The part of the buffers that holds one object's tree. 16 bytes, a uint4 in kernels.
struct Object {
    std::uint32_t first;   ///< position of its first leaf in `ids`
    std::uint32_t leaves;  ///< number of its leaves
    std::uint32_t nodes;   ///< slot of its root
    std::uint32_t unused;
};

/// One level of a tree; its nodes occupy consecutive slots. The node at position p of a level has children at positions 2p
/// and 2p + 1 of the next level, the second only if it exists. The last level's nodes are the leaves, in the order of `ids`.
struct Level {
    std::uint32_t first_slot;  ///< slot of its leftmost node, relative to the object's root
    std::uint32_t node_count;
};

/// A copy of a tree's buffers in host memory.
struct HostTree {
    std::vector<Box> nodes;       ///< by slot
    std::vector<Box> leaf_boxes;  ///< in input order; empty if leaves are sorted
    std::vector<std::uint32_t> ids;
    std::vector<Object> objects;
};

/// Result of a query: each pair once, in no order. The handles are valid until the tree's next query or build.
struct Pairs {
    cl_mem pairs = nullptr;         ///< array of Pair; the first `count` entries are valid
    cl_mem device_count = nullptr;  ///< array of uint: entries 0 and 1 are `count`, low word first
    std::uint64_t count = 0;
};

/// A tree over triangles or boxes, or one tree for each of several objects. Device memory is allocated when the sizes or the
/// kind of the input change and when a query or an update needs more, and is reused otherwise. All calls enqueue on the Device's
/// queue: after everything enqueued there before the call, and before everything enqueued there after it.
class BVHBENCH_API Tree {
public:
    /// Throws BadInput for an unknown builder, order or collider, Unavailable, or OpenClFailure.
    explicit Tree(Device device, Options options = {});
    explicit Tree(cl_command_queue queue, Options options = {});
    Tree(Tree&& other) noexcept;
    Tree& operator=(Tree&& other) noexcept;
    ~Tree();

    /// Builds one tree over `input` or, if `objects` is not empty, one tree over each consecutive run of objects[k] triangles or
    /// boxes; the sizes must sum to the size of the input. Waits if the input is checked, copied from the host, or of other
    /// sizes than before. Throws any Error; afterwards there is no tree until a build succeeds.
    void build(const Input& input, std::span<const std::uint32_t> objects = {});

    /// Recomputes the boxes of the current tree from moved input of the same sizes. This is faster than a build, but queries
    /// get slower the further things have moved. Waits and throws as `build` does.
    void refit(const Input& input);

    /// Rebuilds, refits or keeps the tree of each object, updates[k] for object k, in one set of launches. `input` covers all
    /// objects; that of kept objects is only checked. Waits. Throws BadInput, and leaves the tree as it is, if `updates` has
    /// a wrong length or an unknown value. Any other Error leaves no tree, as in `build`.
    void update(const Input& input, std::span<const Update> updates);

    bool is_built() const;

    // The calls from here to `read_pairs` throw BadInput if there is no tree.

    Buffers buffers() const;

    /// Returns the levels of one object's tree, the root's level first. Throws BadInput if there is no such object.
    std::vector<Level> levels(std::uint32_t object = 0) const;

    HostTree read() const;  ///< Copies the tree to the host. Waits.

    /// Finds all pairs whose boxes overlap. If the pair buffer is too small, it is enlarged and the query repeated, so no
    /// pair is dropped. Waits. Throws BadInput for an unknown Among, after which the pairs of the last query can still be
    /// read, and Unavailable for more than 2^32 - 1 pairs or too little memory.
    Pairs find_pairs(Among among = Among::all);

    /// The same without pairs of objects that `filter` leaves out. A query with another filter than the last one of this Among takes
    /// its memory anew. Throws BadInput for an object that there is not, or groups or masks of another number of objects.
    Pairs find_pairs(Among among, const Filter& filter);

    /// Finds the overlapping pairs of one element of this tree (Pair::a) and one of `other` (Pair::b), each an index into its
    /// own tree's input. Copies both trees. Waits. Throws BadInput unless both trees belong to one Device, have one object
    /// each and the same `sorted_leaves`.
    Pairs find_pairs(const Tree& other);

    /// Returns two triangles that intersect, any of them, or nothing if no two do: exactly, for the coordinates as floats, as
    /// docs/contacts.md says; Options::adjacent_pairs tells whether triangles that share a point index count if they meet beyond
    /// what they share. Ends at the first contact, by `leaf`, whatever the tree's collider. Waits. Throws as find_pairs, and
    /// BadInput if the tree is over boxes. The pairs of the last find_pairs can still be read.
    std::optional<Pair> first_contact(Among among = Among::all, const Filter& filter = {});

    /// Finds all pairs of triangles that intersect: exactly, for the coordinates as floats, as docs/contacts.md says;
    /// Options::adjacent_pairs as for first_contact. The host decides pairs that floats leave open, and reads points and faces for that,
    /// if the device has no doubles. Waits. Throws as find_pairs, and BadInput if the tree is over boxes.
    Pairs find_contacts(Among among = Among::all, const Filter& filter = {});

    /// Finds all pairs of triangles at most `distance` apart, in the unit of the points: exactly, for the coordinates as floats and the
    /// distance as a double, and 0 has those that touch or intersect. Options::adjacent_pairs tells whether triangles that share a
    /// point index, which are 0 apart, are among them. Each call builds a second tree, over boxes with half of the distance to all sides
    /// of each point, in memory that is kept for the next call: it costs a build and a query. The host decides pairs that doubles leave
    /// open, or all candidates if the device has no doubles, and reads points and faces for that. Waits. Throws as find_pairs, and
    /// BadInput if the tree is over boxes and for a distance that is negative or not finite.
    Pairs find_within(double distance, Among among = Among::all, const Filter& filter = {});

    /// Copies the pairs of the last query to the host. Waits. Throws BadInput if there was no query since the last build,
    /// refit or update.
    std::vector<Pair> read_pairs() const;

    /// Returns the bytes of device memory that this tree holds: its buffers, and scratch memory of builds and queries.
    std::size_t memory() const;

    /// Returns OpenCL C 1.2 functions that traverse this tree, for the caller's own kernels. docs/library.md lists them.
    std::string kernel_text() const;

    std::string_view builder() const;   ///< Name of the builder in use.
    std::string_view collider() const;  ///< Name of the collider in use.

    struct Impl;

private:
    std::unique_ptr<Impl> impl_;
};

/// Where an object of a scene is: the three rows of an affine map from the points that it was given to those of the scene, the
/// last number of each a translation.
struct Pose {
    float x[4] = {1, 0, 0, 0};
    float y[4] = {0, 1, 0, 0};
    float z[4] = {0, 0, 1, 0};
};

/// A triangle of an object of a scene, by its number among those of the object.
struct ObjectTriangle {
    std::uint32_t object, triangle;
};

/// Objects over triangles, each with a tree of its own, that are placed one by one: what a pose or new points cost does not depend on
/// the other objects. Points and faces are kept on the host and on the device. Calls wait for copies from the host alone.
class BVHBENCH_API Scene {
public:
    /// Throws as Tree's constructor. Options::check_input is ignored: each object is checked when it is added or moved.
    explicit Scene(Device device, Options options = {});
    Scene(Scene&& other) noexcept;
    Scene& operator=(Scene&& other) noexcept;
    ~Scene();

    /// Adds an object of 1 to 2^31 triangles, whose faces number its own points from 0, in the pose that moves nothing. Returns its
    /// number, from 0. The next `tree` copies and builds all objects anew. Throws BadInput.
    std::uint32_t add(const HostTriangles& object);

    /// Puts an object into a pose, computed in floats from the points that it was given last. The next `tree` refits its tree. Throws
    /// BadInput for an object that there is not, and for a pose that puts points where floats are not finite.
    void place(std::uint32_t object, const Pose& pose);

    /// Gives an object other points, as many as before; its pose stays. The next `tree` rebuilds its tree. Throws BadInput.
    void move(std::uint32_t object, std::span<const Point> points);

    /// Returns the tree of each object as they are now, for queries; its triangles are those of all objects, in the order of `add`. It
    /// is valid until the next call that changes the scene. Throws BadInput for a scene without objects, and as Tree::build.
    Tree& tree();

    /// Returns the object of a triangle of `tree`. Throws BadInput if there is no such triangle.
    ObjectTriangle origin(std::uint32_t triangle) const;

    std::size_t memory() const;  ///< Returns the bytes of device memory that the scene holds.

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Returns the library's version, "0.2.0".
BVHBENCH_API std::string_view version();

}  // namespace bvhbench::oibvh
