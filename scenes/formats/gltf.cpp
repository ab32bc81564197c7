// SPDX-License-Identifier: MIT
//
// Meshes of a glTF file, placed by its nodes. Each vertex is rounded once.
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/gltf_nodes.h"

namespace bvhbench {
namespace {

using Json = nlohmann::json;

/// Extensions that a file may require: those that are read, and kinds that change no triangle.
constexpr std::string_view read_extensions[] = {"KHR_mesh_quantization",
                                                "EXT_mesh_gpu_instancing",
                                                "KHR_materials_",
                                                "KHR_texture_",
                                                "EXT_texture_",
                                                "MSFT_texture_",
                                                "KHR_lights_",
                                                "EXT_lights_",
                                                "KHR_xmp"};

/// A mesh is far away if its distance from the origin is more than 16 times its size, or 2^16 times its shortest edge. Floats at
/// the second distance resolve 2^8 steps of that edge.
constexpr double far_from_size = 16, far_from_edge = 65536;

FileNumber number(double x)
{
    constexpr double largest = std::numeric_limits<float>::max();
    if (std::fabs(x) > largest)
        return {x, std::numeric_limits<float>::infinity(), true};
    return {x, static_cast<float>(x), true};
}

class GltfReader {
public:
    GltfReader(std::string_view bytes, const std::string& name, const ReadBeside& read_beside)
        : gltf_(bytes, name, read_beside), nodes_(gltf_)
    {}

    FileMesh read()
    {
        check_extensions();
        for (const std::size_t node : nodes_.in_scene())
            add_node(node);
        list_rest();
        if (file_.objects.size() == 1)
            file_.objects.clear();
        return std::move(file_);
    }

private:
    /// What decides where a vertex is: the positions, and with them the morph targets and their weights.
    struct Positions {
        GltfNumbers at;
        std::vector<std::pair<GltfNumbers, double>> moved;
    };

    /// A skin of a primitive: for each set of four, the joints of its vertices and their shares.
    using Skin = std::vector<std::pair<GltfNumbers, GltfNumbers>>;

    /// Numbers of the accessors, and weights, that decide where vertices are.
    using Key = std::vector<std::pair<std::size_t, double>>;

    static bool is_read(const std::string& extension)
    {
        return std::ranges::any_of(read_extensions, [&](std::string_view known) {
            return known.ends_with('_') || known == "KHR_xmp" ? extension.starts_with(known)
                                                              : extension == known;
        });
    }

    /// Refuses what is required and not read, and notes what is used and not read.
    void check_extensions()
    {
        for (const char* const key : {"extensionsRequired", "extensionsUsed"})
            for (const Json& name : gltf_.list(gltf_.json(), key)) {
                const std::string extension = name.is_string() ? name.get<std::string>() : "";
                if (is_read(extension))
                    continue;
                if (key == std::string_view("extensionsRequired"))
                    gltf_.refuse("requires " + in_quotes(extension) +
                                 ", which is not read: export it without that extension");
                file_.reading.surprises.push_back("it uses " + in_quotes(extension) +
                                                  ", which is not read");
            }
    }

    void add_node(std::size_t index)
    {
        const Json& node = gltf_.item("nodes", index);
        const auto mesh = gltf_.whole(node, "mesh");
        if (!mesh)
            return;
        const auto skin = gltf_.whole(node, "skin");
        const std::vector<GltfMatrix> joints =
            skin ? nodes_.joints_of(*skin) : std::vector<GltfMatrix>{};
        const auto named = node.find("name");
        const std::string name =
            named != node.end() && named->is_string() ? named->get<std::string>() : "";
        for (const GltfMatrix& instance : nodes_.instances_of(index))
            add_mesh(node, gltf_.item("meshes", *mesh), instance, joints, name);
    }

    void add_mesh(const Json& node, const Json& mesh, const GltfMatrix& world,
                  const std::vector<GltfMatrix>& joints, const std::string& name)
    {
        const std::size_t first_point = file_.mesh.points.size();
        const std::size_t first_face = file_.mesh.faces.size();
        const std::size_t targets = gltf_.list(mesh, "primitives").empty()
                                        ? 0
                                        : gltf_.list(mesh["primitives"].front(), "targets").size();
        const std::vector<double> weights = gltf_.numbers(
            node, "weights", gltf_.numbers(mesh, "weights", std::vector<double>(targets)));
        std::map<Key, std::unordered_map<std::size_t, uint>> points;
        for (const Json& primitive : gltf_.list(mesh, "primitives"))
            add_primitive(primitive, weights, world, joints, points);
        note_far_mesh(first_point, first_face);
        file_.add_object(name, first_face);
    }

    /// Adds the triangles of a primitive. `points` has the points that the mesh's primitives made so far, by their elements.
    void add_primitive(const Json& primitive, const std::vector<double>& weights,
                       const GltfMatrix& world, const std::vector<GltfMatrix>& joints,
                       std::map<Key, std::unordered_map<std::size_t, uint>>& points)
    {
        constexpr std::size_t triangles = 4, fan = 6;
        if (!primitive.is_object())
            gltf_.refuse("has a primitive that is no object");
        const std::size_t mode = gltf_.whole(primitive, "mode").value_or(triangles);
        if (mode < triangles) {
            ++(mode == 0 ? points_ : lines_);
            return;
        }
        if (mode > fan)
            gltf_.refuse("has a primitive of mode " + std::to_string(mode));
        const Json& attributes = gltf_.object(primitive, "attributes");
        const auto accessor = gltf_.whole(attributes, "POSITION");
        if (!accessor)
            gltf_.refuse("has a mesh without POSITION");
        if (gltf_.object(primitive, "extensions").contains("KHR_draco_mesh_compression") &&
            !gltf_.item("accessors", *accessor).contains("bufferView"))
            gltf_.refuse(
                "has a mesh in KHR_draco_mesh_compression, which is not read: export it "
                "without that extension");
        Key key = {{*accessor, 1}};
        const Positions positions = positions_of(primitive, weights, key);
        const Skin skin = joints.empty() ? Skin{} : skin_of(attributes, positions.at.size(), key);
        std::unordered_map<std::size_t, uint>& made = points[key];
        const auto point = [&](std::size_t element) {
            const auto [known, is_new] =
                made.try_emplace(element, static_cast<uint>(file_.mesh.points.size()));
            if (is_new) {
                if (file_.mesh.points.size() >= 0xffffffffu)
                    gltf_.refuse("has more than 2^32 vertices");
                const GltfMatrix& transform = skin.empty() ? world : skinned(skin, element, joints);
                const WidePoint at = transform * position(positions, element);
                file_.add_point(number(at.x), number(at.y), number(at.z));
            }
            return known->second;
        };
        const Corners corners = corners_of(primitive, positions.at.size());
        const std::size_t step = mode == triangles ? 3 : 1;
        if (mode == triangles && corners.size() % 3 != 0)
            gltf_.refuse("has triangles with " + std::to_string(corners.size()) +
                         " corners, which are no multiple of three");
        for (std::size_t k = 0; k + 3 <= corners.size(); k += step) {
            // In a strip every other triangle is turned round.
            const std::size_t turned = mode == 5 && k % 2 == 1 ? 1 : 0;
            const uint first = point(corner(corners, mode == fan ? 0 : k));
            const uint second = point(corner(corners, k + 1 + turned));
            file_.mesh.faces.push_back({first, second, point(corner(corners, k + 2 - turned))});
        }
    }

    Positions positions_of(const Json& primitive, const std::vector<double>& weights, Key& key)
    {
        Positions positions{gltf_.accessor(key[0].first, 3), {}};
        const Json& targets = gltf_.list(primitive, "targets");
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const double weight = k < weights.size() ? weights[k] : 0;
            const auto target = gltf_.whole(targets[k], "POSITION");
            if (weight == 0 || !target) {
                ++morphs_;
                continue;
            }
            key.emplace_back(*target, weight);
            positions.moved.emplace_back(gltf_.accessor(*target, 3), weight);
            if (positions.moved.back().first.size() != positions.at.size())
                gltf_.refuse("has a morph target of another number of vertices than its mesh");
        }
        return positions;
    }

    static WidePoint position(const Positions& positions, std::size_t element)
    {
        double at[3], by[3];
        positions.at.read(element, at);
        for (const auto& [moved, weight] : positions.moved) {
            moved.read(element, by);
            for (std::size_t axis = 0; axis < 3; ++axis)
                at[axis] += weight * by[axis];
        }
        return {at[0], at[1], at[2]};
    }

    /// The corners of a primitive: elements of its accessor of indices, or all vertices in order.
    struct Corners {
        std::optional<GltfNumbers> indices;
        std::size_t vertices = 0;

        std::size_t size() const { return indices ? indices->size() : vertices; }
    };

    Corners corners_of(const Json& primitive, std::size_t vertices) const
    {
        const auto accessor = gltf_.whole(primitive, "indices");
        return {accessor ? std::optional(gltf_.indices(*accessor)) : std::nullopt, vertices};
    }

    std::size_t corner(const Corners& corners, std::size_t k) const
    {
        double index = static_cast<double>(k);
        if (corners.indices)
            corners.indices->read(k, &index);
        if (index >= static_cast<double>(corners.vertices))
            gltf_.refuse("has a triangle with vertex " +
                         std::to_string(static_cast<std::uint64_t>(index)) + " of " +
                         std::to_string(corners.vertices));
        return static_cast<std::size_t>(index);
    }

    /// Returns the skin of a primitive; empty if it has none.
    Skin skin_of(const Json& attributes, std::size_t vertices, Key& key) const
    {
        Skin skin;
        for (std::size_t set = 0;; ++set) {
            const auto joint = gltf_.whole(attributes, ("JOINTS_" + std::to_string(set)).c_str());
            const auto weight = gltf_.whole(attributes, ("WEIGHTS_" + std::to_string(set)).c_str());
            if (!joint && !weight)
                return skin;
            if (!joint || !weight)
                gltf_.refuse("has a skin with joints or weights alone");
            skin.emplace_back(gltf_.accessor(*joint, 4), gltf_.accessor(*weight, 4));
            if (skin.back().first.size() != vertices || skin.back().second.size() != vertices)
                gltf_.refuse("has a skin of another number of vertices than its mesh");
            key.emplace_back(*joint, -1);
            key.emplace_back(*weight, -2);
        }
    }

    /// Returns the sum of the transforms of a vertex's joints by their weights.
    GltfMatrix skinned(const Skin& skin, std::size_t element,
                       const std::vector<GltfMatrix>& joints) const
    {
        constexpr double most_off = 0.05;  // weights of 8 bits are rounded
        GltfMatrix sum{{}};
        double whole = 0, at[4], shares[4];
        for (const auto& [numbers, weights] : skin) {
            numbers.read(element, at);
            weights.read(element, shares);
            for (std::size_t n = 0; n < 4; ++n) {
                if (shares[n] == 0)
                    continue;
                if (!(at[n] >= 0 && at[n] < static_cast<double>(joints.size())))
                    gltf_.refuse("has a vertex of a joint that its skin lacks");
                whole += shares[n];
                for (std::size_t c = 0; c < 16; ++c)
                    sum.at[c] += shares[n] * joints[static_cast<std::size_t>(at[n])].at[c];
            }
        }
        if (!(std::fabs(whole - 1) <= most_off))
            gltf_.refuse("has a vertex, " + std::to_string(element) +
                         ", whose joints have weights that do not add up to 1");
        return sum;
    }

    /// Notes whether floats lose much of a mesh: if it is far from the origin for its size, or for its shortest edge.
    void note_far_mesh(std::size_t first_point, std::size_t first_face)
    {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double farthest = 0, shortest = infinity;
        WidePoint low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};
        bool is_exact = true;
        for (std::size_t k = first_point; k < file_.wide.size(); ++k) {
            const WidePoint& p = file_.wide[k];
            const Point& rounded = file_.mesh.points[k];
            is_exact = is_exact && double{rounded.x} == p.x && double{rounded.y} == p.y &&
                       double{rounded.z} == p.z;
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            farthest = std::max({farthest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
        }
        if (is_exact)
            return;
        for (std::size_t k = first_face; k < file_.mesh.faces.size(); ++k) {
            const Face& face = file_.mesh.faces[k];
            for (const auto& [u, v] : {std::pair(face.a, face.b), std::pair(face.b, face.c)}) {
                const WidePoint &p = file_.wide[u], &q = file_.wide[v];
                const double length = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
                shortest = length > 0 ? std::min(shortest, length) : shortest;
            }
        }
        const double size = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
        if (farthest > far_from_size * size || farthest > far_from_edge * shortest)
            file_.floats_hold = false;
    }

    /// Lists what the file has besides the triangles that were read.
    void list_rest()
    {
        const auto add = [&](std::size_t count, const char* what) {
            if (count > 0)
                file_.reading.ignored.push_back(std::to_string(count) + ' ' + what);
        };
        const Json& json = gltf_.json();
        add(gltf_.list(json, "materials").size(), "materials");
        add(gltf_.list(json, "animations").size(), "animations");
        add(points_, "meshes of points");
        add(lines_, "meshes of lines");
        add(morphs_, "morph targets of weight 0");
        if (const std::size_t scenes = gltf_.list(json, "scenes").size(); scenes > 1)
            add(scenes - 1, "other scenes");
    }

    GltfFile gltf_;
    GltfNodes nodes_;
    FileMesh file_;
    std::size_t points_ = 0, lines_ = 0, morphs_ = 0;
};

}  // namespace

FileMesh read_gltf(std::string_view bytes, const std::string& name, const ReadBeside& read_beside)
{
    return GltfReader(bytes, name, read_beside).read();
}

}  // namespace bvhbench
