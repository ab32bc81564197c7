// SPDX-License-Identifier: MIT
//
// Meshes of a glTF file, placed by its nodes. Transforms are products in double precision, and each vertex is rounded once.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/gltf_file.h"

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

/// If a mesh is this many times its size away from the origin, floats there lose as many of its digits.
constexpr double far_away = 16;

/// A transform: columns, the last of which is the translation.
struct Matrix {
    std::array<double, 16> at = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

    WidePoint operator*(const WidePoint& p) const
    {
        const auto row = [&](std::size_t k) {
            return at[k] * p.x + at[4 + k] * p.y + at[8 + k] * p.z + at[12 + k];
        };
        return {row(0), row(1), row(2)};
    }

    Matrix operator*(const Matrix& right) const
    {
        Matrix product;
        for (std::size_t column = 0; column < 4; ++column)
            for (std::size_t row = 0; row < 4; ++row) {
                double sum = 0;
                for (std::size_t k = 0; k < 4; ++k)
                    sum += at[4 * k + row] * right.at[4 * column + k];
                product.at[4 * column + row] = sum;
            }
        return product;
    }
};

/// Returns translation * rotation * scale; `r` is a unit quaternion x, y, z, w.
Matrix placed(const double* t, const double* r, const double* s)
{
    const double x = r[0], y = r[1], z = r[2], w = r[3];
    return {{s[0] * (1 - 2 * (y * y + z * z)), s[0] * 2 * (x * y + z * w),
             s[0] * 2 * (x * z - y * w), 0, s[1] * 2 * (x * y - z * w),
             s[1] * (1 - 2 * (x * x + z * z)), s[1] * 2 * (y * z + x * w), 0,
             s[2] * 2 * (x * z + y * w), s[2] * 2 * (y * z - x * w),
             s[2] * (1 - 2 * (x * x + y * y)), 0, t[0], t[1], t[2], 1}};
}

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
        : gltf_(bytes, name, read_beside), nodes_(list(gltf_.json(), "nodes").size())
    {}

    FileMesh read()
    {
        check_extensions();
        place_nodes();
        for (const std::size_t node : in_scene())
            add_node(node);
        list_rest();
        if (file_.objects.size() == 1)
            file_.objects.clear();
        return std::move(file_);
    }

private:
    struct Node {
        Matrix local, world;
        std::size_t parent = none;
    };

    /// Positions of an accessor, and the points that the current object has made of them.
    struct Positions {
        GltfNumbers at;
        std::vector<uint> point;        ///< by element; unmade: no point yet
        std::vector<std::size_t> made;  ///< elements that have a point
    };

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    static constexpr uint unmade = 0xffffffffu;

    /// Returns the list called `key`; an empty one if there is none.
    static const Json& list(const Json& of, const char* key)
    {
        static const Json empty = Json::array();
        const auto found = of.find(key);
        return found == of.end() || !found->is_array() ? empty : *found;
    }

    /// Returns the object called `key`; an empty one if there is none.
    static const Json& object(const Json& of, const char* key)
    {
        static const Json empty = Json::object();
        const auto found = of.find(key);
        return found == of.end() || !found->is_object() ? empty : *found;
    }

    std::vector<std::size_t> indices(const Json& of, const char* key) const
    {
        std::vector<std::size_t> all;
        for (const Json& index : list(of, key)) {
            if (!index.is_number_unsigned())
                gltf_.refuse("has a list '" + std::string(key) + "' of other than indices");
            all.push_back(index.get<std::size_t>());
        }
        return all;
    }

    void check_extensions() const
    {
        for (const Json& required : list(gltf_.json(), "extensionsRequired")) {
            const std::string name = required.is_string() ? required.get<std::string>() : "";
            if (std::ranges::none_of(read_extensions, [&](std::string_view known) {
                    return known.ends_with('_') || known == "KHR_xmp" ? name.starts_with(known)
                                                                      : name == known;
                }))
                gltf_.refuse("requires " + in_quotes(name) +
                             ", which is not read: export it without that extension");
        }
    }

    /// Computes the transform of every node.
    void place_nodes()
    {
        std::vector<std::size_t> order;
        for (std::size_t k = 0; k < nodes_.size(); ++k) {
            const Json& node = gltf_.item("nodes", k);
            nodes_[k].local = local(node);
            for (const std::size_t child : indices(node, "children")) {
                if (child >= nodes_.size() || nodes_[child].parent != none || child == k)
                    gltf_.refuse("has a node, " + std::to_string(child) + ", with two parents");
                nodes_[child].parent = k;
            }
        }
        for (std::size_t k = 0; k < nodes_.size(); ++k)
            if (nodes_[k].parent == none)
                order.push_back(k);
        for (std::size_t k = 0; k < order.size(); ++k) {
            Node& node = nodes_[order[k]];
            node.world = node.parent == none ? node.local : nodes_[node.parent].world * node.local;
            for (const std::size_t child : indices(gltf_.item("nodes", order[k]), "children"))
                order.push_back(child);
        }
        if (order.size() != nodes_.size())
            gltf_.refuse("has nodes that are their own parents");
    }

    Matrix local(const Json& node) const
    {
        if (node.contains("matrix")) {
            Matrix matrix;
            std::ranges::copy(gltf_.numbers(node, "matrix", std::vector<double>(16)),
                              matrix.at.begin());
            return matrix;
        }
        return placed(gltf_.numbers(node, "translation", {0, 0, 0}).data(),
                      gltf_.numbers(node, "rotation", {0, 0, 0, 1}).data(),
                      gltf_.numbers(node, "scale", {1, 1, 1}).data());
    }

    /// Returns the nodes of the scene that the file shows, each behind its parent; without scenes, all nodes.
    std::vector<std::size_t> in_scene() const
    {
        const std::size_t scenes = list(gltf_.json(), "scenes").size();
        const std::size_t shown = gltf_.whole(gltf_.json(), "scene").value_or(0);
        std::vector<std::size_t> order;
        if (scenes == 0) {
            for (std::size_t k = nodes_.size(); k-- > 0;)
                if (nodes_[k].parent == none)
                    order.push_back(k);
        } else {
            order = indices(gltf_.item("scenes", shown), "nodes");
            std::ranges::reverse(order);
        }
        std::vector<std::size_t> nodes;
        std::vector<bool> seen(nodes_.size());
        while (!order.empty()) {  // a stack
            const std::size_t node = order.back();
            order.pop_back();
            std::vector<std::size_t> children = indices(gltf_.item("nodes", node), "children");
            if (seen[node])
                gltf_.refuse("has a node, " + std::to_string(node) + ", twice in its scene");
            seen[node] = true;
            nodes.push_back(node);
            order.insert(order.end(), children.rbegin(), children.rend());
        }
        return nodes;
    }

    void add_node(std::size_t index)
    {
        const Json& node = gltf_.item("nodes", index);
        const auto mesh = gltf_.whole(node, "mesh");
        if (!mesh)
            return;
        const auto skin = gltf_.whole(node, "skin");
        const std::vector<Matrix> joints = skin ? joints_of(*skin) : std::vector<Matrix>{};
        const auto named = node.find("name");
        const std::string name =
            named != node.end() && named->is_string() ? named->get<std::string>() : "";
        for (const Matrix& instance : instances(node, nodes_[index].world))
            add_mesh(node, gltf_.item("meshes", *mesh), instance, joints, name);
    }

    /// Returns where a node's mesh is: once, or as often as EXT_mesh_gpu_instancing says.
    std::vector<Matrix> instances(const Json& node, const Matrix& world) const
    {
        const Json& extension = object(object(node, "extensions"), "EXT_mesh_gpu_instancing");
        const Json& attributes = object(extension, "attributes");
        if (attributes.empty())
            return {world};
        std::optional<std::size_t> count;
        const auto all = [&](const char* key, std::size_t width) -> std::optional<GltfNumbers> {
            const auto accessor = gltf_.whole(attributes, key);
            if (!accessor)
                return std::nullopt;
            GltfNumbers numbers = gltf_.accessor(*accessor, width);
            if (numbers.size() != count.value_or(numbers.size()))
                gltf_.refuse("has instances with other numbers of TRANSLATION, ROTATION and SCALE");
            count = numbers.size();
            return numbers;
        };
        const auto t = all("TRANSLATION", 3), r = all("ROTATION", 4), s = all("SCALE", 3);
        constexpr double still[] = {0, 0, 0, 1}, one[] = {1, 1, 1};
        std::vector<Matrix> placed_at;
        for (std::size_t k = 0; k < count.value_or(0); ++k)
            placed_at.push_back(
                world * placed(t ? (*t)[k] : still, r ? (*r)[k] : still, s ? (*s)[k] : one));
        return placed_at;
    }

    /// Returns the transform of each joint of a skin, from the mesh's space to that of the scene.
    std::vector<Matrix> joints_of(std::size_t index) const
    {
        const Json& skin = gltf_.item("skins", index);
        const std::vector<std::size_t> nodes = indices(skin, "joints");
        std::optional<GltfNumbers> inverse;
        if (const auto accessor = gltf_.whole(skin, "inverseBindMatrices"))
            inverse = gltf_.accessor(*accessor, 16);
        if (inverse && inverse->size() < nodes.size())
            gltf_.refuse("has a skin with fewer matrices than joints");
        std::vector<Matrix> joints;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            gltf_.item("nodes", nodes[k]);
            Matrix bind;
            if (inverse)
                std::copy_n((*inverse)[k], 16, bind.at.begin());
            joints.push_back(nodes_[nodes[k]].world * bind);
        }
        return joints;
    }

    void add_mesh(const Json& node, const Json& mesh, const Matrix& world,
                  const std::vector<Matrix>& joints, const std::string& name)
    {
        const std::size_t first_point = file_.mesh.points.size();
        const std::size_t first_face = file_.mesh.faces.size();
        const std::size_t targets = list(mesh, "primitives").empty()
                                        ? 0
                                        : list(mesh["primitives"].front(), "targets").size();
        const std::vector<double> weights = gltf_.numbers(
            node, "weights", gltf_.numbers(mesh, "weights", std::vector<double>(targets)));
        for (const Json& primitive : list(mesh, "primitives"))
            if (primitive.is_object())
                add_primitive(primitive, weights, world, joints);
        for (Positions* const positions : in_object_) {
            for (const std::size_t element : positions->made)
                positions->point[element] = unmade;
            positions->made.clear();
        }
        in_object_.clear();
        note_far_mesh(first_point);
        file_.add_object(name, first_face);
    }

    void add_primitive(const Json& primitive, const std::vector<double>& weights,
                       const Matrix& world, const std::vector<Matrix>& joints)
    {
        constexpr std::size_t triangles = 4, fan = 6;
        const std::size_t mode = gltf_.whole(primitive, "mode").value_or(triangles);
        if (mode < triangles || mode > fan) {
            ++(mode == 0 ? points_ : lines_);
            return;
        }
        const Json& attributes = object(primitive, "attributes");
        const auto accessor = gltf_.whole(attributes, "POSITION");
        const Json& compressed = object(primitive, "extensions");
        if (compressed.contains("KHR_draco_mesh_compression"))
            gltf_.refuse(
                "has a mesh in KHR_draco_mesh_compression, which is not read: export it "
                "without that extension");
        if (!accessor)
            gltf_.refuse("has a mesh without POSITION");
        Positions& positions = positions_of(primitive, *accessor, weights);
        in_object_.push_back(&positions);
        const std::vector<std::size_t> corners = corners_of(primitive, positions.at.size());
        const bool is_skinned = !joints.empty() && attributes.contains("JOINTS_0");
        std::vector<Matrix> skin;
        if (is_skinned)
            skin = skin_of(attributes, joints, corners, positions);
        const auto point = [&](std::size_t element) {
            uint& made = positions.point[element];
            if (made == unmade) {
                if (file_.mesh.points.size() >= unmade)
                    gltf_.refuse("has more than 2^32 vertices");
                made = static_cast<uint>(file_.mesh.points.size());
                positions.made.push_back(element);
                const double* const p = positions.at[element];
                const WidePoint at =
                    (is_skinned ? skin[element] : world) * WidePoint{p[0], p[1], p[2]};
                file_.add_point(number(at.x), number(at.y), number(at.z));
            }
            return made;
        };
        const std::size_t step = mode == triangles ? 3 : 1;
        if (mode == triangles && corners.size() % 3 != 0)
            gltf_.refuse("has triangles with " + std::to_string(corners.size()) +
                         " corners, which are no multiple of three");
        for (std::size_t k = 0; k + 3 <= corners.size(); k += step) {
            // In a strip every other triangle is turned round.
            const std::size_t a = mode == fan ? 0 : k;
            const std::size_t turned = mode == 5 && k % 2 == 1 ? 1 : 0;
            const uint first = point(corners[a]);
            const uint second = point(corners[k + 1 + turned]);
            file_.mesh.faces.push_back({first, second, point(corners[k + 2 - turned])});
        }
    }

    /// Returns the positions of a primitive, with its morph targets added by their weights.
    Positions& positions_of(const Json& primitive, std::size_t accessor,
                            const std::vector<double>& weights)
    {
        const Json& targets = list(primitive, "targets");
        std::vector<std::pair<std::size_t, double>> key = {{accessor, 1}};
        for (std::size_t k = 0; k < targets.size(); ++k) {
            const double weight = k < weights.size() ? weights[k] : 0;
            const auto target =
                targets[k].is_object() ? gltf_.whole(targets[k], "POSITION") : std::nullopt;
            if (weight != 0 && target)
                key.emplace_back(*target, weight);
            morphs_ += weight == 0 ? 1 : 0;
        }
        const auto [entry, is_new] = positions_.try_emplace(key);
        Positions& positions = entry->second;
        if (!is_new)
            return positions;
        positions.at = gltf_.accessor(accessor, 3);
        for (std::size_t k = 1; k < key.size(); ++k) {
            const GltfNumbers moved = gltf_.accessor(key[k].first, 3);
            if (moved.size() != positions.at.size())
                gltf_.refuse("has a morph target of another number of vertices than its mesh");
            for (std::size_t n = 0; n < moved.values.size(); ++n)
                positions.at.values[n] += key[k].second * moved.values[n];
        }
        positions.point.assign(positions.at.size(), unmade);
        return positions;
    }

    std::vector<std::size_t> corners_of(const Json& primitive, std::size_t vertices) const
    {
        std::vector<std::size_t> corners;
        if (const auto accessor = gltf_.whole(primitive, "indices")) {
            for (const double index : gltf_.accessor(*accessor, 1).values) {
                if (!(index >= 0 && index < static_cast<double>(vertices)))
                    gltf_.refuse("has a triangle with vertex " +
                                 std::to_string(static_cast<std::int64_t>(index)) + " of " +
                                 std::to_string(vertices));
                corners.push_back(static_cast<std::size_t>(index));
            }
        } else {
            for (std::size_t k = 0; k < vertices; ++k)
                corners.push_back(k);
        }
        return corners;
    }

    /// Returns the transform of each vertex that a corner names: the sum of its joints' by their weights.
    std::vector<Matrix> skin_of(const Json& attributes, const std::vector<Matrix>& joints,
                                const std::vector<std::size_t>& corners,
                                const Positions& positions) const
    {
        std::vector<Matrix> skin(positions.at.size(), Matrix{{}});
        std::vector<bool> is_used(positions.at.size());
        for (const std::size_t corner : corners)
            is_used[corner] = true;
        for (std::size_t set = 0;; ++set) {
            const auto joint = gltf_.whole(attributes, ("JOINTS_" + std::to_string(set)).c_str());
            const auto weight = gltf_.whole(attributes, ("WEIGHTS_" + std::to_string(set)).c_str());
            if (!joint || !weight)
                return skin;
            const GltfNumbers numbers = gltf_.accessor(*joint, 4);
            const GltfNumbers shares = gltf_.accessor(*weight, 4);
            if (numbers.size() != skin.size() || shares.size() != skin.size())
                gltf_.refuse("has a skin of another number of vertices than its mesh");
            for (std::size_t k = 0; k < skin.size(); ++k)
                for (std::size_t n = 0; n < 4 && is_used[k]; ++n) {
                    const double at = numbers[k][n], share = shares[k][n];
                    if (share == 0)
                        continue;
                    if (!(at >= 0 && at < static_cast<double>(joints.size())))
                        gltf_.refuse("has a vertex of a joint that its skin lacks");
                    for (std::size_t c = 0; c < 16; ++c)
                        skin[k].at[c] += share * joints[static_cast<std::size_t>(at)].at[c];
                }
        }
    }

    /// Notes whether floats lose much of a mesh, because it is far from the origin.
    void note_far_mesh(std::size_t first_point)
    {
        double farthest = 0, low[3], high[3];
        std::fill_n(low, 3, std::numeric_limits<double>::infinity());
        std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
        bool is_exact = true;
        for (std::size_t k = first_point; k < file_.wide.size(); ++k) {
            const WidePoint& p = file_.wide[k];
            const Point& rounded = file_.mesh.points[k];
            const double at[] = {p.x, p.y, p.z};
            is_exact = is_exact && double{rounded.x} == p.x && double{rounded.y} == p.y &&
                       double{rounded.z} == p.z;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], at[axis]);
                high[axis] = std::max(high[axis], at[axis]);
                farthest = std::max(farthest, std::fabs(at[axis]));
            }
        }
        const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
        if (!is_exact && farthest > far_away * size)
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
        add(list(json, "materials").size(), "materials");
        add(list(json, "animations").size(), "animations");
        add(points_, "meshes of points");
        add(lines_, "meshes of lines");
        add(morphs_, "morph targets of weight 0");
        if (const std::size_t scenes = list(json, "scenes").size(); scenes > 1)
            add(scenes - 1, "other scenes");
    }

    GltfFile gltf_;
    std::vector<Node> nodes_;
    FileMesh file_;
    std::map<std::vector<std::pair<std::size_t, double>>, Positions> positions_;
    std::vector<Positions*> in_object_;  ///< those with points of the current object
    std::size_t points_ = 0, lines_ = 0, morphs_ = 0;
};

}  // namespace

FileMesh read_gltf(std::string_view bytes, const std::string& name, const ReadBeside& read_beside)
{
    return GltfReader(bytes, name, read_beside).read();
}

}  // namespace bvhbench
