// SPDX-License-Identifier: MIT
#include "kinds.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace bvhbench {
namespace {

using Json = nlohmann::json;

std::string text_of(double x)
{
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", x);
    return text;
}

template <class... Text>
std::string one_of(Chance& chance, const Text&... texts)
{
    const std::string all[] = {texts...};
    return all[below(chance, sizeof...(texts))];
}

/// All parts as one mesh: points one after the other.
Model::Part joined(const Model& model)
{
    Model::Part all;
    for (const Model::Part& part : model.parts) {
        const auto first = static_cast<unsigned>(all.points.size());
        all.points.insert(all.points.end(), part.points.begin(), part.points.end());
        for (const auto& [a, b, c] : part.faces)
            all.faces.push_back({first + a, first + b, first + c});
    }
    return all;
}

std::string obj(const Model& model, Chance& chance)
{
    const std::string end = one_of(chance, "\n", "\r\n");
    std::string text = one_of(chance, "", "\xef\xbb\xbf", "# written to C:\\work\\" + end);
    if (below(chance, 2) == 1)
        text += "mtllib C:\\paints\\" + end;
    unsigned first = 1;
    for (const Model::Part& part : model.parts) {
        text += one_of(chance, "o part", "o part\\", "o a b\\", "o") + end;
        text += one_of(chance, "", "usemtl red\\" + end, "# \\" + end, "s off" + end);
        for (const auto& [x, y, z] : part.points)
            text += "v " + one_of(chance, "", " \t") + text_of(x) +
                    one_of(chance, " ", " \\" + end + " ") + text_of(y) + ' ' + text_of(z) +
                    one_of(chance, "", " ", " # \\") + end;
        const auto count = static_cast<long>(part.points.size());
        for (const auto& face : part.faces) {
            text += "f";
            const bool back = below(chance, 3) == 0;
            for (const unsigned corner : face)
                text += one_of(chance, " ", " \\" + end) +
                        std::to_string(back ? long{corner} - count : long{first} + corner);
            text += one_of(chance, "", " # end \\", "\t") + end;
        }
        first += static_cast<unsigned>(count);
    }
    return text;
}

std::string off(const Model& model, Chance& chance)
{
    const Model::Part all = joined(model);
    const std::string kind = one_of(chance, "OFF", "COFF", "NOFF", "CNOFF");
    std::string text = one_of(chance, "", "\xef\xbb\xbf", "# a comment\n") + kind;
    text += one_of(chance, "", "\n", "\n\n# counts\n", " ");
    text += std::to_string(all.points.size()) + ' ' + std::to_string(all.faces.size()) +
            one_of(chance, " 0", "") + "\n";
    for (const auto& [x, y, z] : all.points) {
        text += text_of(x) + ' ' + text_of(y) + ' ' + text_of(z);
        if (kind.find('N') != kind.npos)
            text += " 0 0 1";
        if (kind.find('C') == 0)
            text += " 255 0 0 255";
        text += one_of(chance, "\n", " # vertex\n", "\n\n");
    }
    for (const auto& [a, b, c] : all.faces)
        text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) +
                one_of(chance, "\n", " 255 0 0\n");
    return text;
}

std::string facets(const Model::Part& part, bool capitals, Chance& chance)
{
    const auto word = [&](std::string text) {
        if (capitals)
            std::ranges::transform(text, text.begin(), [](char c) {
                return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
            });
        else if (below(chance, 2) == 1)
            text[0] = static_cast<char>(text[0] - 32);
        return text;
    };
    std::string text;
    for (const auto& face : part.faces) {
        text += word("facet") + " normal 0 0 1\n " + word("outer") + " loop\n";
        for (const unsigned corner : face)
            text += "  " + word("vertex") + ' ' + text_of(part.points[corner][0]) + ' ' +
                    text_of(part.points[corner][1]) + ' ' + text_of(part.points[corner][2]) + '\n';
        text += word("endloop") + "\n" + word("endfacet") + "\n";
    }
    return text;
}

std::string stl(const Model& model, Chance& chance)
{
    std::string text;
    const bool capitals = below(chance, 2) == 1;
    for (const Model::Part& part : model.parts)
        text += one_of(chance, "solid", "Solid", "SOLID") + " part\n" +
                facets(part, capitals, chance) + one_of(chance, "endsolid\n", "EndSolid part\n") +
                one_of(chance, "", "\n", "solid empty\nendsolid\n");
    return text;
}

std::string binary_stl(const Model& model, Chance& chance)
{
    const Model::Part all = joined(model);
    std::string bytes = one_of(chance, "binary", "solid part", "SOLID", "Solid\n facet");
    bytes.resize(80, one_of(chance, " ", std::string(1, '\0'))[0]);
    append(bytes, static_cast<std::uint32_t>(all.faces.size()));
    for (const auto& face : all.faces) {
        for (const float normal : {0.f, 0.f, 1.f})
            append(bytes, normal);
        for (const unsigned corner : face)
            for (const double x : all.points[corner])
                append(bytes, static_cast<float>(x));
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

/// Writes faces, or with `strips` triangle strips of one triangle and strips that restart, as text or in bytes.
std::string ply_of(const Model& model, Chance& chance, bool strips)
{
    const Model::Part all = joined(model);
    const unsigned form = below(chance, 3);  // text, little-endian, big-endian
    const char* const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const std::string end = one_of(chance, "\n", "\r\n");
    const bool has_ids = !strips;
    std::vector<std::vector<int>> lists;
    std::vector<int> ids;
    for (std::size_t part = 0; part < model.parts.size(); ++part)
        ids.insert(ids.end(), model.parts[part].faces.size(), static_cast<int>(part));
    for (const auto& [a, b, c] : all.faces) {
        if (!strips || lists.empty() || lists.back().size() > 30 || below(chance, 3) == 0)
            lists.emplace_back();
        std::vector<int>& list = lists.back();
        if (!list.empty() && list.back() != -1)
            list.push_back(-1);
        list.insert(list.end(), {static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
    }
    std::string bytes = "ply" + end + "format " + forms[form] + " 1.0" + end + "comment c" + end +
                        "element vertex " + std::to_string(all.points.size()) + end +
                        "property float x" + end + "property float y" + end + "property float z" +
                        end + "element " + (strips ? "tristrips " : "face ") +
                        std::to_string(lists.size()) + end + "property list uchar int " +
                        one_of(chance, "vertex_indices", "vertex_index") + end +
                        (has_ids ? "property uchar object_id" + end : "") + "end_header" + end;
    const auto put = [&](auto value) {
        if (form == 0)
            bytes += text_of(static_cast<double>(value)) + ' ';
        else
            append(bytes, value, form == 2);
    };
    const auto end_line = [&] { bytes += form == 0 ? end : ""; };
    for (const auto& point : all.points) {
        for (const double x : point)
            put(static_cast<float>(x));
        end_line();
    }
    for (std::size_t k = 0; k < lists.size(); ++k) {
        put(static_cast<std::uint8_t>(lists[k].size()));
        for (const int corner : lists[k])
            put(std::int32_t{corner});
        if (has_ids)
            put(static_cast<std::uint8_t>(ids[k]));
        end_line();
    }
    return bytes;
}

std::string ply(const Model& model, Chance& chance) { return ply_of(model, chance, false); }
std::string strips_ply(const Model& model, Chance& chance) { return ply_of(model, chance, true); }

std::string base64(const std::string& bytes)
{
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t bits = 0;
        for (std::size_t n = 0; n < 3; ++n)
            bits =
                bits << 8 | (k + n < bytes.size() ? static_cast<unsigned char>(bytes[k + n]) : 0u);
        for (std::size_t n = 0; n < 4; ++n)
            text += k + n > bytes.size() ? '=' : digits[bits >> (18 - 6 * n) & 63];
    }
    return text;
}

/// Builds a glTF document with one buffer.
class GltfWriter {
public:
    explicit GltfWriter(Chance& chance) : chance_(chance) {}

    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::string bytes;

    template <class T>
    std::size_t accessor(const std::vector<double>& values, int component_type, const char* type,
                         std::size_t width, bool normalized = false, bool is_sparse = false)
    {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::size_t begin = bytes.size();
        const bool may_pad = width > 1 && width < 16 && !is_sparse;
        const std::size_t padding =
            may_pad ? (4 - width * sizeof(T) % 4) % 4 + 4 * below(chance_, 2) : 0;
        for (std::size_t k = 0; k < values.size(); ++k) {
            append(bytes, static_cast<T>(values[k]));
            if (may_pad && k % width == width - 1)
                bytes.append(padding, '\7');
        }
        Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}};
        if (may_pad)
            view["byteStride"] = width * sizeof(T) + padding;
        json["bufferViews"].push_back(view);
        Json accessor = {{"bufferView", json["bufferViews"].size() - 1},
                         {"componentType", component_type},
                         {"count", values.size() / width},
                         {"type", type}};
        if (normalized)
            accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return json["accessors"].size() - 1;
    }

    std::size_t floats(const std::vector<double>& values, const char* type, std::size_t width)
    {
        return accessor<float>(values, 5126, type, width);
    }

    std::size_t indices(const std::vector<double>& values)
    {
        const unsigned width = below(chance_, 3);
        return width == 0   ? accessor<std::uint8_t>(values, 5121, "SCALAR", 1)
               : width == 1 ? accessor<std::uint16_t>(values, 5123, "SCALAR", 1)
                            : accessor<std::uint32_t>(values, 5125, "SCALAR", 1);
    }

    std::string text()
    {
        json["buffers"] = {{{"byteLength", bytes.size()},
                            {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return json.dump();
    }

    /// Returns the document as .glb.
    std::string binary()
    {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        json["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string head = json.dump(), file = "glTF";
        head.resize((head.size() + 3) / 4 * 4, ' ');
        for (const std::size_t word :
             {std::size_t{2}, 28 + head.size() + bytes.size(), head.size()})
            append(file, static_cast<std::uint32_t>(word));
        file += "JSON" + head;
        append(file, static_cast<std::uint32_t>(bytes.size()));
        return file + std::string("BIN\0", 4) + bytes;
    }

private:
    Chance& chance_;
};

template <class T>
std::vector<double> flat(const std::vector<std::array<T, 3>>& threes)
{
    std::vector<double> all;
    for (const auto& three : threes)
        all.insert(all.end(), three.begin(), three.end());
    return all;
}

/// Adds a node for each part, whose mesh `positions` makes of its points, and which `change` may change.
GltfWriter gltf_of(
    const Model& model, Chance& chance,
    const std::function<std::size_t(GltfWriter&, const std::vector<double>&)>& positions,
    const std::function<void(GltfWriter&, Json& node, Json& mesh)>& change = {})
{
    GltfWriter writer(chance);
    Json nodes = Json::array(), roots = Json::array();
    for (const Model::Part& part : model.parts) {
        Json primitive = {{"attributes", {{"POSITION", positions(writer, flat(part.points))}}},
                          {"indices", writer.indices(flat(part.faces))}};
        Json mesh = {{"primitives", {primitive}}};
        Json node = {{"mesh", writer.json["meshes"].size()}, {"name", "part"}};
        if (change)
            change(writer, node, mesh);
        writer.json["meshes"].push_back(mesh);
        roots.push_back(nodes.size());
        nodes.push_back(node);
    }
    for (const Json& more : writer.json.value("more", Json::array()))
        nodes.push_back(more);
    writer.json.erase("more");
    writer.json["nodes"] = nodes;
    writer.json["scenes"] = {{{"nodes", roots}}};
    return writer;
}

std::size_t as_floats(GltfWriter& writer, const std::vector<double>& points)
{
    return writer.floats(points, "VEC3", 3);
}

std::string gltf(const Model& model, Chance& chance)
{
    return gltf_of(model, chance, as_floats).text();
}

std::string glb(const Model& model, Chance& chance)
{
    return gltf_of(model, chance, as_floats).binary();
}

/// Quantised as KHR_mesh_quantization: quarters as whole numbers, scaled by the node.
template <class T, int component_type>
std::string quantised(const Model& model, Chance& chance)
{
    const bool normalized = below(chance, 2) == 1;
    const double most = static_cast<double>(std::numeric_limits<T>::max());
    const auto positions = [&](GltfWriter& writer, std::vector<double> points) {
        for (double& x : points)
            x *= 4;
        writer.json["extensionsRequired"] = {"KHR_mesh_quantization"};
        return writer.accessor<T>(points, component_type, "VEC3", 3, normalized);
    };
    const auto change = [&](GltfWriter&, Json& node, Json&) {
        const double scale = normalized ? most / 4 : 0.25;
        node["scale"] = {scale, scale, scale};
    };
    return gltf_of(model, chance, positions, change).text();
}

/// Points moved by a node above a node, by a matrix and by a translation.
std::string moved_gltf(const Model& model, Chance& chance)
{
    const double by = 0.25 * below(chance, 40);
    const auto positions = [&](GltfWriter& writer, std::vector<double> points) {
        for (std::size_t k = 0; k < points.size(); k += 3)
            points[k] -= by;
        return as_floats(writer, points);
    };
    const auto change = [&](GltfWriter&, Json& node, Json&) {
        if (below(chance, 2) == 1)
            node["translation"] = {by, 0, 0};
        else
            node["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, by, 0, 0, 1};
    };
    return gltf_of(model, chance, positions, change).text();
}

/// Each part's mesh is moved away by 50 and back by a morph target.
std::string morphed_gltf(const Model& model, Chance& chance)
{
    std::size_t target = 0;
    const auto positions = [&](GltfWriter& writer, std::vector<double> points) {
        std::vector<double> back(points.size());
        for (std::size_t k = 0; k < points.size(); k += 3) {
            points[k] += 50;
            back[k] = -100;
        }
        target = as_floats(writer, back);
        return as_floats(writer, points);
    };
    const auto change = [&](GltfWriter&, Json& node, Json& mesh) {
        mesh["primitives"][0]["targets"] = {{{"POSITION", target}}};
        mesh["weights"] = {0.5};
        if (below(chance, 2) == 1) {
            mesh["weights"] = {7};
            node["weights"] = {0.5};
        }
    };
    return gltf_of(model, chance, positions, change).text();
}

/// Each part hangs on two joints that move it back; its node's own place counts for nothing.
std::string skinned_gltf(const Model& model, Chance& chance)
{
    std::size_t vertices = 0;
    const auto positions = [&](GltfWriter& writer, std::vector<double> points) {
        vertices = points.size() / 3;
        for (std::size_t k = 0; k < points.size(); k += 3)
            points[k] += 8;
        return as_floats(writer, points);
    };
    const auto change = [&](GltfWriter& writer, Json& node, Json& mesh) {
        std::vector<double> joints, weights, binds;
        for (std::size_t k = 0; k < vertices; ++k) {
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {0.25, 0.75, 0, 0});
        }
        for (const double x : {-2.0, -3.0})  // inverse bind matrices
            binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, 0, 1});
        Json& attributes = mesh["primitives"][0]["attributes"];
        attributes["JOINTS_0"] = writer.accessor<std::uint8_t>(joints, 5121, "VEC4", 4);
        attributes["WEIGHTS_0"] = writer.floats(weights, "VEC4", 4);
        const std::size_t part = writer.json["skins"].size(), first = model.parts.size() + 2 * part;
        writer.json["skins"].push_back({{"joints", {first, first + 1}},
                                        {"inverseBindMatrices", writer.floats(binds, "MAT4", 16)}});
        node["skin"] = part;
        node["translation"] = {100, 5, -7};
        writer.json["more"].push_back({{"translation", {-6, 0, 0}}});
        writer.json["more"].push_back({{"translation", {-5, 0, 0}}});
    };
    return gltf_of(model, chance, positions, change).text();
}

/// Each part is one instance of a mesh of twice its size.
std::string instanced_gltf(const Model& model, Chance& chance)
{
    const auto positions = [&](GltfWriter& writer, std::vector<double> points) {
        for (double& x : points)
            x = x * 2 - 3;
        writer.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
        return as_floats(writer, points);
    };
    const auto change = [&](GltfWriter& writer, Json& node, Json&) {
        Json attributes = {{"TRANSLATION", writer.floats({1.5, 1.5, 1.5}, "VEC3", 3)},
                           {"SCALE", writer.floats({0.5, 0.5, 0.5}, "VEC3", 3)}};
        if (below(chance, 2) == 1)
            attributes["ROTATION"] = writer.floats({0, 0, 0, 1}, "VEC4", 4);
        node["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}};
    };
    return gltf_of(model, chance, positions, change).text();
}

/// Positions that a sparse accessor changes, over zeros or over other values.
std::string sparse_gltf(const Model& model, Chance& chance)
{
    const auto positions = [&](GltfWriter& writer, const std::vector<double>& points) {
        std::vector<double> places(points.size() / 3), other(points.size(), 9);
        for (std::size_t k = 0; k < places.size(); ++k)
            places[k] = static_cast<double>(k);
        const bool has_base = below(chance, 2) == 1;
        const std::size_t base = as_floats(writer, other);
        const std::size_t at = writer.accessor<std::uint16_t>(places, 5123, "SCALAR", 1);
        const std::size_t values = as_floats(writer, points);
        Json& accessors = writer.json["accessors"];
        Json sparse = accessors[base];
        if (!has_base)
            sparse.erase("bufferView");
        sparse["sparse"] = {
            {"count", places.size()},
            {"indices", {{"bufferView", accessors[at]["bufferView"]}, {"componentType", 5123}}},
            {"values", {{"bufferView", accessors[values]["bufferView"]}}}};
        accessors.push_back(sparse);
        return accessors.size() - 1;
    };
    return gltf_of(model, chance, positions).text();
}

std::string dae(const Model& model, Chance& chance)
{
    std::string geometries, nodes;
    for (std::size_t k = 0; k < model.parts.size(); ++k) {
        const Model::Part& part = model.parts[k];
        const std::string id = "g" + std::to_string(k);
        std::string values, lists;
        for (const auto& point : part.points)
            for (const double x : point)
                values += text_of(x) + ' ';
        // The faces in one list or in two, as those of two materials are.
        const std::size_t all = part.faces.size(), first = below(chance, 2) == 1 ? all / 2 : all;
        for (const auto& [begin, end] : {std::pair(std::size_t{0}, first), std::pair(first, all)}) {
            if (begin == end)
                continue;
            std::string corners, counts;
            for (std::size_t face = begin; face < end; ++face) {
                for (const unsigned corner : part.faces[face])
                    corners += std::to_string(corner) + ' ';
                counts += "3 ";
            }
            const std::string list = one_of(chance, "triangles", "polylist");
            lists += '<' + list + " count=\"" + std::to_string(end - begin) +
                     "\"><input semantic=\"VERTEX\" source=\"#" + id + "v\" offset=\"0\"/>" +
                     (list == "polylist" ? "<vcount>" + counts + "</vcount>" : "") + "<p>" +
                     corners + "</p></" + list + '>';
        }
        geometries +=
            "<geometry id=\"" + id + "\"><mesh><source id=\"" + id + "p\"><float_array id=\"" + id +
            "a\" count=\"" + std::to_string(3 * part.points.size()) + "\">" + values +
            "</float_array><technique_common><accessor source=\"#" + id + "a\" count=\"" +
            std::to_string(part.points.size()) +
            "\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
            "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
            "id=\"" +
            id + "v\"><input semantic=\"POSITION\" source=\"#" + id + "p\"/></vertices>" + lists +
            "</mesh></geometry>";
        nodes += "<node id=\"n" + id + "\"><instance_geometry url=\"#" + id + "\"/></node>";
    }
    return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
           "version=\"1.4.1\"><asset><up_axis>Y_UP</up_axis></asset><library_geometries>" +
           geometries + "</library_geometries><library_visual_scenes><visual_scene id=\"s\">" +
           nodes +
           "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
           "url=\"#s\"/></scene>"
           "</COLLADA>";
}

/// Left-handed: z is turned round, and with it the order of corners.
std::string x_file(const Model& model, Chance&)
{
    std::string text = "xof 0303txt 0032\n";
    for (const Model::Part& part : model.parts) {
        text += "Mesh part {\n " + std::to_string(part.points.size()) + ";\n";
        for (std::size_t k = 0; k < part.points.size(); ++k)
            text += " " + text_of(part.points[k][0]) + ";" + text_of(part.points[k][1]) + ";" +
                    text_of(-part.points[k][2]) + (k + 1 < part.points.size() ? ";,\n" : ";;\n");
        text += " " + std::to_string(part.faces.size()) + ";\n";
        for (std::size_t k = 0; k < part.faces.size(); ++k)
            text += " 3;" + std::to_string(part.faces[k][2]) + "," +
                    std::to_string(part.faces[k][1]) + "," + std::to_string(part.faces[k][0]) +
                    (k + 1 < part.faces.size() ? ";,\n" : ";;\n");
        text += "}\n";
    }
    return text;
}

}  // namespace

unsigned below(Chance& chance, unsigned end)
{
    return chance.is_plain ? 0 : static_cast<unsigned>(chance.numbers() % end);
}

Model random_model(Chance& chance)
{
    Model model;
    model.parts.resize(1 + below(chance, 3));
    double left = 0;  // parts stand side by side, so that no two points are in one place
    for (Model::Part& part : model.parts) {
        const auto point = [&] {
            for (;;) {
                const std::array<double, 3> at = {left + 0.25 * below(chance, 20),
                                                  0.25 * below(chance, 60),
                                                  0.25 * below(chance, 60)};
                if (std::ranges::find(part.points, at) == part.points.end()) {
                    part.points.push_back(at);
                    return static_cast<unsigned>(part.points.size() - 1);
                }
            }
        };
        part.faces.push_back({point(), point(), point()});
        for (unsigned more = 2 + below(chance, 12); more > 0; --more) {
            const auto face = part.faces[below(chance, static_cast<unsigned>(part.faces.size()))];
            const unsigned b = face[1], c = face[2];
            const unsigned tip = below(chance, 3) == 0 && part.points.size() > 3
                                     ? below(chance, static_cast<unsigned>(part.points.size()))
                                     : point();
            if (tip != b && tip != c)
                part.faces.push_back({c, b, tip});
        }
        left += 5.25;
    }
    return model;
}

const std::vector<Kind>& kinds()
{
    static const std::vector<Kind> all = {
        {"kind.obj", true, true, false, obj},
        {"plain.obj", true, true, true, obj},
        {"plain.off", false, true, true, off},
        {"plain.stl", true, false, true, stl},
        {"plain.ply", true, true, true, ply},
        {"kind.off", false, true, false, off},
        {"kind.stl", true, false, false, stl},
        {"binary.stl", false, false, true, binary_stl},
        {"kind.ply", true, true, false, ply},
        {"strips.ply", false, true, false, strips_ply},
        {"kind.gltf", true, true, true, gltf},
        {"kind.glb", true, true, true, glb},
        {"quantised_u8.gltf", true, true, false, quantised<std::uint8_t, 5121>},
        {"quantised_i8.gltf", true, true, false, quantised<std::int8_t, 5120>},
        {"quantised_u16.gltf", true, true, false, quantised<std::uint16_t, 5123>},
        {"quantised_i16.gltf", true, true, false, quantised<std::int16_t, 5122>},
        {"moved.gltf", true, true, true, moved_gltf},
        {"morphed.gltf", true, true, false, morphed_gltf},
        {"skinned.gltf", true, true, false, skinned_gltf},
        {"instanced.gltf", true, true, false, instanced_gltf},
        {"sparse.gltf", true, true, false, sparse_gltf},
        {"kind.dae", true, true, true, dae},
        {"kind.x", true, true, true, x_file},
    };
    return all;
}

}  // namespace bvhbench
