// SPDX-License-Identifier: MIT
#include "scenes/mesh_worker.h"

#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <set>
#include <sstream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "process/child.h"
#include "process/worker.h"

namespace bvhbench {
namespace {

constexpr const char* argument = "--read-mesh";
// Guards against a program whose main does not call is_mesh_worker: it would start itself over and over.
constexpr const char* marker = "BVHBENCH_MESH_WORKER";

constexpr std::string_view magic = "BVHMESH2";

/// Memory that the reader of a file may take at most. Files that are compressed become 50 times as large.
constexpr std::uint64_t least_memory = std::uint64_t{512} << 20, memory_a_file_byte = 200;

template <class List>
void put(std::string& message, const List& list)
{
    const std::uint64_t count = list.size();
    message.append(reinterpret_cast<const char*>(&count), sizeof count);
    message.append(reinterpret_cast<const char*>(list.data()), count * sizeof list[0]);
}

/// Removes a list from the front of `message`. False if the list is incomplete.
template <class List>
bool take(std::string_view& message, List& list)
{
    std::uint64_t count = 0;
    if (message.size() < sizeof count)
        return false;
    std::memcpy(&count, message.data(), sizeof count);
    message.remove_prefix(sizeof count);
    if (count > message.size() / sizeof list[0])
        return false;
    list.resize(count);
    message.copy(reinterpret_cast<char*>(list.data()), count * sizeof list[0]);
    message.remove_prefix(count * sizeof list[0]);
    return true;
}

/// Flattens the node hierarchy. Each mesh of each node becomes an object. assimp makes several meshes of one in the file that has
/// several materials: they have one name and different materials, and become one object again.
class Flattened {
public:
    /// With `names_are_unique`, as in COLLADA, meshes of one name on a node are one in the file.
    Flattened(const aiScene& scene, bool names_are_unique)
        : scene_(scene), names_are_unique_(names_are_unique)
    {}

    FileMesh file;

    void add(const aiNode& node, const aiMatrix4x4& above)
    {
        const aiMatrix4x4 transform = above * node.mTransformation;
        const aiMesh* before = nullptr;
        std::set<unsigned> materials;  // of the object
        std::size_t first_face = file.mesh.faces.size();
        for (unsigned k = 0; k < node.mNumMeshes; ++k) {
            if (node.mMeshes[k] >= scene_.mNumMeshes)
                throw Unavailable("a node names a mesh that is not there");
            const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[k]];
            if (before == nullptr || before->mName != mesh.mName ||
                (!materials.insert(mesh.mMaterialIndex).second && !names_are_unique_)) {
                file.add_object(node.mName.C_Str(), first_face);
                first_face = file.mesh.faces.size();
                materials = {mesh.mMaterialIndex};
                joined_.clear();
            }
            add_mesh(mesh, transform);
            before = &mesh;
        }
        file.add_object(node.mName.C_Str(), first_face);
        for (unsigned k = 0; k < node.mNumChildren; ++k)
            add(*node.mChildren[k], transform);
    }

    /// Lists what is not read.
    void list_rest()
    {
        const auto ignore = [&](std::size_t count, const char* what) {
            if (count > 0)
                file.reading.ignored.push_back(std::to_string(count) + ' ' + what);
        };
        ignore(scene_.mNumMaterials, "materials");
        ignore(scene_.mNumAnimations, "animations");
        ignore(skipped_, "points and lines");
        ignore(skins_, "skins");
        ignore(morphs_, "morph targets");
        std::vector<std::string>& surprises = file.reading.surprises;
        if (skins_ + morphs_ > 0)
            surprises.push_back("skins and morph targets are not applied");
        if (const std::uint64_t joined = file.reading.joined_vertices; joined > 0)
            surprises.push_back("its corners come without common vertices, and " +
                                std::to_string(joined) + " of equal position were joined");
    }

private:
    void add_mesh(const aiMesh& mesh, const aiMatrix4x4& transform)
    {
        places_.assign(mesh.mNumVertices, unmade);
        const bool is_split = gives_each_corner_a_vertex(mesh);
        std::vector<uint> corners;
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const aiFace& face = mesh.mFaces[k];
            corners.clear();
            if (face.mNumIndices < 3) {
                ++skipped_;
                continue;
            }
            for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
                if (face.mIndices[corner] >= mesh.mNumVertices)
                    throw Unavailable("a face names vertex " +
                                      std::to_string(face.mIndices[corner]) + " of " +
                                      std::to_string(mesh.mNumVertices));
                corners.push_back(point(mesh, transform, face.mIndices[corner], is_split));
            }
            file.add_polygon(corners);
        }
        skins_ += mesh.mNumBones > 0 ? 1 : 0;
        morphs_ += mesh.mNumAnimMeshes;
    }

    /// True if no two corners of a mesh have a vertex in common. The readers of many formats make meshes so, because corners may
    /// differ in normals and colours.
    static bool gives_each_corner_a_vertex(const aiMesh& mesh)
    {
        std::size_t corners = 0;
        for (unsigned k = 0; k < mesh.mNumFaces; ++k)
            corners += mesh.mFaces[k].mNumIndices;
        return corners == mesh.mNumVertices;
    }

    /// Returns the point of a vertex. Vertices of equal position in split meshes of one object have one point.
    uint point(const aiMesh& mesh, const aiMatrix4x4& transform, unsigned vertex, bool is_split)
    {
        uint& place = places_[vertex];
        if (place != unmade)
            return place;
        const aiVector3D& from = mesh.mVertices[vertex];
        if (!std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.z))
            throw Unavailable("it has a vertex that is not finite");
        if (is_split) {
            const auto [known, is_new] =
                joined_.try_emplace({from.x + 0.0f, from.y + 0.0f, from.z + 0.0f},
                                    static_cast<uint>(file.mesh.points.size()));
            place = known->second;
            if (!is_new) {
                ++file.reading.joined_vertices;
                return place;
            }
        }
        if (file.mesh.points.size() >= unmade)
            throw Unavailable("there are more than 2^32 vertices");
        place = static_cast<uint>(file.mesh.points.size());
        const aiVector3D at = transform * from;
        file.mesh.points.push_back({at.x, at.y, at.z});
        return place;
    }

    static constexpr uint unmade = 0xffffffffu;

    const aiScene& scene_;
    bool names_are_unique_;
    std::vector<uint> places_;                     ///< the point of each vertex of the current mesh
    std::map<std::array<float, 3>, uint> joined_;  ///< the point at each position, in split meshes
    std::size_t skipped_ = 0, skins_ = 0, morphs_ = 0;
};

/// Reads in this process, which assimp may crash.
FileMesh read_with_assimp(const std::string& path)
{
    Assimp::Importer importer;
    // No post-processing: its steps merge vertices and remove faces without area.
    const aiScene* const scene = importer.ReadFile(path, 0);
    if (scene == nullptr || scene->mRootNode == nullptr) {
        const std::string error = importer.GetErrorString();
        const std::size_t begin = error.find_first_not_of(" \t\r\n");
        throw Unavailable(begin == error.npos ? "assimp finds no scene in it, and says no more"
                                              : "assimp says: " + error.substr(begin));
    }
    if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
        throw Unavailable("assimp could not read all of it");
    Flattened flattened(*scene, lower_case(path).ends_with(".dae"));
    flattened.add(*scene->mRootNode, aiMatrix4x4());
    flattened.list_rest();
    cut_polygons(flattened.file, path);
    return std::move(flattened.file);
}

std::string answer_for(const std::string& path, std::size_t memory_bytes)
{
    try {
        limit_worker(memory_bytes);
        return mesh_message(read_with_assimp(path));
    } catch (const std::bad_alloc&) {
        return refusal_message("it takes more memory than the reader may use");
    } catch (const std::exception& error) {
        const std::string_view why = error.what();
        const std::string_view sentence = why.substr(0, why.find('\n'));
        return refusal_message(sentence.empty() ? "it fails without a reason" : sentence);
    }
}

}  // namespace

std::string mesh_message(const FileMesh& file)
{
    std::vector<uint> ranges;
    for (const SceneObject& object : file.objects)
        ranges.insert(ranges.end(), {object.first_face, object.face_count});
    std::string message(magic);
    message += 'M';
    put(message, file.mesh.points);
    put(message, file.mesh.faces);
    put(message, ranges);
    for (const SceneObject& object : file.objects)
        put(message, object.name);
    const Reading& reading = file.reading;
    put(message, std::array{reading.polygons_cut, reading.polygons_concave,
                            reading.polygons_crossing, reading.joined_vertices});
    for (const auto* const texts : {&reading.surprises, &reading.ignored}) {
        std::string lines;
        for (const std::string& text : *texts)
            lines += text + '\n';
        put(message, lines);
    }
    return message;
}

std::string refusal_message(std::string_view why)
{
    return std::string(magic) + 'E' + std::string(why);
}

std::optional<std::variant<FileMesh, std::string>> decoded(std::string_view message)
{
    if (!message.starts_with(magic) || message.size() == magic.size())
        return std::nullopt;
    const char kind = message[magic.size()];
    message.remove_prefix(magic.size() + 1);
    if (kind == 'E')
        return std::string(message);
    FileMesh file;
    std::vector<uint> ranges;
    if (kind != 'M' || !take(message, file.mesh.points) || !take(message, file.mesh.faces) ||
        !take(message, ranges))
        return std::nullopt;
    for (std::size_t k = 0; k + 1 < ranges.size(); k += 2) {
        std::string name;
        if (!take(message, name))
            return std::nullopt;
        file.objects.push_back({name, ranges[k], ranges[k + 1]});
    }
    Reading& reading = file.reading;
    std::vector<std::uint64_t> counts;
    if (!take(message, counts) || counts.size() != 4)
        return std::nullopt;
    reading = {counts[0], counts[1], counts[2], counts[3], {}, {}};
    for (auto* const texts : {&reading.surprises, &reading.ignored}) {
        std::string lines;
        if (!take(message, lines))
            return std::nullopt;
        std::istringstream text(lines);
        for (std::string line; std::getline(text, line);)
            texts->push_back(line);
    }
    if (!message.empty())
        return std::nullopt;
    return file;
}

bool is_mesh_worker(int argc, char** argv)
{
    return argc == 4 && std::string_view(argv[1]) == argument;
}

int mesh_worker_main(int, char** argv)
{
    const int answer = take_standard_output();
    return write_all(answer, answer_for(argv[2], std::strtoull(argv[3], nullptr, 10))) ? 0 : 1;
}

bool assimp_knows(const std::string& extension)
{
    return extension.size() > 1 && Assimp::Importer().IsExtensionSupported(extension);
}

FileMesh read_in_worker(const std::filesystem::path& path, const SceneLibrary& library)
{
    if (std::getenv(marker) != nullptr)
        throw std::logic_error("main does not begin with is_mesh_worker, see scenes/mesh_worker.h");
    // The mesh is in the memory of the worker and of this process, so each gets at most half. A damaged file of some bytes makes
    // assimp ask for all that it may have.
    const std::uint64_t enough =
        least_memory + memory_a_file_byte * std::filesystem::file_size(path);
    const std::uint64_t memory =
        std::min<std::uint64_t>({library.memory_limit_bytes, host_memory_left() / 2, enough});
    const ProcessEnd end =
        run_process({"/proc/self/exe", argument, path.string(), std::to_string(memory)},
                    library.time_limit_s, std::string(marker) + "=1");
    auto answer = decoded(end.output);
    if (end.how != ProcessEnd::How::exited || !answer)
        throw Unavailable("the reader " + spelled(end, library.time_limit_s) + " on " +
                          path.string());
    if (const auto* const why = std::get_if<std::string>(&*answer))
        throw Unavailable(path.string() + " is not read: " + *why);
    return std::get<FileMesh>(std::move(*answer));
}

}  // namespace bvhbench
