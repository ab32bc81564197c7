// SPDX-License-Identifier: MIT
//
// Reads the data sets of BVHBENCH_DATA, which are in one binary PLY form; not a general PLY reader.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/triangle.h"

namespace bvhbench {

struct DataSetMesh {
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<uint> objects;  ///< object of each face; empty if the file has none
};

template <class T>
T read_value(std::istream& in)
{
    T value;
    in.read(reinterpret_cast<char*>(&value), sizeof value);
    return value;
}

/// Reads a little-endian file with float x y z and faces of three ints with an optional ushort object; throws for other forms.
inline DataSetMesh read_data_set_mesh(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    DataSetMesh mesh;
    bool has_objects = false;
    std::string line;
    while (std::getline(in, line) && line != "end_header") {
        std::istringstream words(line);
        std::string word, what;
        std::size_t count = 0;
        words >> word >> what >> count;
        if (word == "element" && what == "vertex")
            mesh.points.resize(count);
        else if (word == "element" && what == "face")
            mesh.faces.resize(count);
        has_objects = has_objects || line == "property ushort object_id";
    }
    for (Point& point : mesh.points)
        point = read_value<Point>(in);
    for (Face& face : mesh.faces) {
        if (read_value<unsigned char>(in) != 3)
            throw std::runtime_error(path.string() + ": a face that is no triangle");
        face = read_value<Face>(in);
        if (has_objects)
            mesh.objects.push_back(read_value<std::uint16_t>(in));
    }
    if (!in || mesh.faces.empty())
        throw std::runtime_error(path.string() + " ends early or is not there");
    return mesh;
}

/// Reads the positions of all frames: frames x points x 3 floats.
inline std::vector<std::vector<Point>> read_frames(const std::filesystem::path& path,
                                                   std::size_t frame_count, std::size_t point_count)
{
    std::ifstream in(path, std::ios::binary);
    std::vector<std::vector<Point>> frames(frame_count, std::vector<Point>(point_count));
    for (std::vector<Point>& frame : frames)
        in.read(reinterpret_cast<char*>(frame.data()),
                static_cast<std::streamsize>(frame.size() * sizeof(Point)));
    if (!in)
        throw std::runtime_error(path.string() + " ends early or is not there");
    return frames;
}

}  // namespace bvhbench
