// SPDX-License-Identifier: MIT
#include "benchmarks/host.h"

#include <sstream>

#include "collide/narrow/double_filter.h"
#include "geometry/hash.h"
#include "geometry/hilbert.h"
#include "oibvh/layout.h"
#include "scenes/catalog.h"
#include "scenes/formats/formats.h"
#include "scenes/generate/pair_classes.h"

namespace bvhbench {
namespace {

constexpr uint leaves = 144046;
constexpr uint side = 32;
constexpr uint pair_count = 4096;

/// Registers `work`, which processes `items` items and returns a number. The benchmark has an error unless that is `expected`.
template <class Work>
void add_host(const std::string& name, Outcome& outcome, std::int64_t items, std::uint64_t expected,
              Work work)
{
    add_benchmark("host/" + name, outcome, [=](benchmark::State& state) {
        if (const std::uint64_t found = work(); found != expected)
            return wrong + std::to_string(found) + ", not " + std::to_string(expected);
        for (auto _ : state)
            benchmark::DoNotOptimize(work());
        state.SetItemsProcessed(state.iterations() * items);
        state.SetLabel("agrees");
        return std::string();
    });
}

constexpr std::uint64_t sum_below(std::uint64_t count) { return count * (count - 1) / 2; }

/// Returns the sum of the slots of all nodes of a tree. Slots are 0, 1, 2, ...
std::uint64_t sum_of_slots()
{
    const volatile uint count = leaves;  // else the compiler may compute the sum
    const OiShape shape = oi_shape(count);
    std::uint64_t sum = 0;
    for (uint level = 0; level <= shape.leaf_level; ++level)
        for (uint k = 0; k < oi_real_on(shape, level); ++k)
            sum += oi_slot(shape, oi_first(level) + k);
    return sum;
}

/// Registers the sum of the codes of all cells of a cube at the origin. Both curves fill it first, with codes 0, 1, 2, ...
template <class Code>
void add_codes(const char* name, Outcome& outcome, Code code)
{
    constexpr uint cells = side * side * side;
    add_host(name, outcome, cells, sum_below(cells), [code] {
        std::uint64_t sum = 0;
        const volatile uint count = cells;  // else the sum is computed once, or by the compiler
        const uint end = count;
        for (uint k = 0; k < end; ++k)
            sum += code(GridCell{k / side / side, k / side % side, k % side});
        return sum;
    });
}

/// Returns how many of the pairs meet. Pairs that the filter in doubles leaves open, or without it all, are decided exactly.
std::uint64_t count_meeting(const Mesh& mesh, bool filtered)
{
    const auto corners = [&](Face face) {
        return Corners{{mesh.points[face.a], mesh.points[face.b], mesh.points[face.c]}};
    };
    std::uint64_t count = 0;
    for (std::size_t k = 0; k < mesh.faces.size(); k += 2) {
        const Corners a = corners(mesh.faces[k]), b = corners(mesh.faces[k + 1]);
        const uint verdict = filtered ? likely_meet(a, b) : VERDICT_UNSURE;
        count += verdict == VERDICT_UNSURE ? triangles_meet(a, b) : verdict == VERDICT_MEET;
    }
    return count;
}

std::uint64_t hash_of(const Mesh& mesh)
{
    Hash hash;
    for (const Face& face : mesh.faces)
        for (const uint corner : {face.a, face.b, face.c})
            hash.value(mesh.points[corner]);
    return hash.get();
}

std::ostream& operator<<(std::ostream& out, const Point& p)
{
    return out << p.x << ' ' << p.y << ' ' << p.z << '\n';
}

/// Returns `header`, then all points and all faces with these words before each. Corners are counted from `first`.
std::string text_of(const Mesh& mesh, const std::string& header, const char* point_word,
                    const char* face_word, uint first)
{
    std::ostringstream out;
    out.precision(9);  // enough to read the same floats
    out << header;
    for (const Point& point : mesh.points)
        out << point_word << point;
    for (const auto [a, b, c] : mesh.faces)
        out << face_word << a + first << ' ' << b + first << ' ' << c + first << '\n';
    return out.str();
}

std::string stl_of(const Mesh& mesh)
{
    std::ostringstream out;
    out.precision(9);
    out << "solid s\n";
    for (const auto [a, b, c] : mesh.faces)
        out << "facet normal 0 0 1\nouter loop\nvertex " << mesh.points[a] << "vertex "
            << mesh.points[b] << "vertex " << mesh.points[c] << "endloop\nendfacet\n";
    return out.str() + "endsolid s\n";
}

/// Reads the same torus as each format from memory.
void add_readers(Outcome& outcome)
{
    const Scene scene = load_scene("torus:8192", {});
    const Mesh mesh{scene.frames.front(), scene.faces};
    const std::string points = std::to_string(mesh.points.size()),
                      faces = std::to_string(mesh.faces.size());
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex " + points +
                            "\nproperty float x\nproperty float y\nproperty float z\n"
                            "element face " +
                            faces + "\nproperty list uchar int vertex_indices\nend_header\n";
    const auto add = [&](const std::string& format, const std::string& text, auto read) {
        add_host("readers/" + format, outcome, scene.triangle_count(), hash_of(mesh),
                 [=] { return hash_of(read(text, "torus").mesh); });
    };
    add("obj", text_of(mesh, "", "v ", "f ", 1), read_obj);
    add("off", text_of(mesh, "OFF\n" + points + ' ' + faces + " 0\n", "", "3 ", 0), read_off);
    add("ply", text_of(mesh, ply, "", "3 ", 0), read_ply);
    add("stl", stl_of(mesh), read_stl);
}

}  // namespace

void add_host_benchmarks(Outcome& outcome)
{
    constexpr uint nodes = oi_node_count(oi_shape(leaves));
    add_host("layout/slots", outcome, nodes, sum_below(nodes), sum_of_slots);
    add_codes("codes/morton30", outcome, [](GridCell cell) { return morton_30(cell); });
    add_codes("codes/morton63", outcome, [](GridCell cell) { return morton_63(cell); });
    add_codes("codes/hilbert30", outcome, [](GridCell cell) { return hilbert_30(cell); });
    add_codes("codes/hilbert63", outcome, [](GridCell cell) { return hilbert_63(cell); });
    for (const PairClass& of : pair_classes())
        for (const bool filtered : {false, true})
            if (of.meeting != Meeting::some)  // known by construction
                add_host("contacts/" + of.name + (filtered ? "/filtered" : "/exact"), outcome,
                         pair_count, of.meeting == Meeting::all ? pair_count : 0,
                         [filtered, mesh = apart_pairs(of, pair_count, 1)] {
                             return count_meeting(mesh, filtered);
                         });
    add_readers(outcome);
}

}  // namespace bvhbench
