// SPDX-License-Identifier: MIT
#include <sstream>

#include "benchmarks/host.h"
#include "geometry/hash.h"
#include "scenes/catalog.h"
#include "scenes/formats/formats.h"

namespace bvhbench {
namespace {

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

/// Writes all points and then all faces, with corners counted from `first`, after `header` and these words before each.
std::string listed(const Mesh& mesh, const std::string& header, const char* point_word,
                   const char* face_word, uint first)
{
    std::ostringstream out;
    out.precision(9);  // enough to read the same floats
    out << header;
    for (const Point& point : mesh.points)
        out << point_word << point;
    for (const Face& face : mesh.faces)
        out << face_word << face.a + first << ' ' << face.b + first << ' ' << face.c + first
            << '\n';
    return out.str();
}

std::string as_stl(const Mesh& mesh)
{
    std::ostringstream out;
    out.precision(9);
    out << "solid s\n";
    for (const Face& face : mesh.faces)
        out << "facet normal 0 0 1\nouter loop\nvertex " << mesh.points[face.a] << "vertex "
            << mesh.points[face.b] << "vertex " << mesh.points[face.c] << "endloop\nendfacet\n";
    out << "endsolid s\n";
    return out.str();
}

}  // namespace

/// Reads the same torus as each format from memory.
void register_host_readers(Outcome& outcome)
{
    const Scene scene = load_scene("torus:8192", {});
    const Mesh mesh{scene.frames.front(), scene.faces};
    const std::string points = std::to_string(mesh.points.size()),
                      faces = std::to_string(mesh.faces.size());
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex " + points +
        "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
        "\nproperty list uchar int vertex_indices\nend_header\n";
    const auto add = [&](const char* format, const std::string& text, auto read) {
        register_host(std::string("readers/") + format, outcome, scene.triangle_count(),
                      hash_of(mesh), [=] { return hash_of(read(text, "torus").mesh); });
    };
    add("obj", listed(mesh, "", "v ", "f ", 1), read_obj);
    add("off", listed(mesh, "OFF\n" + points + ' ' + faces + " 0\n", "", "3 ", 0), read_off);
    add("ply", listed(mesh, ply, "", "3 ", 0), read_ply);
    add("stl", as_stl(mesh), read_stl);
}

}  // namespace bvhbench
