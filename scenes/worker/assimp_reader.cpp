// SPDX-License-Identifier: MIT
#include "scenes/worker/assimp_reader.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

Point placed(const aiMatrix4x4& transform, const aiVector3D& position)
{
    const aiVector3D moved = transform * position;
    return {moved.x, moved.y, moved.z};
}

/// The hierarchy laid out flat, each mesh of each node an object.
class Flattened {
public:
    explicit Flattened(const aiScene& scene) : scene_(scene) {}

    FileMesh file;

    void add(const aiNode& node, const aiMatrix4x4& above)
    {
        const aiMatrix4x4 transform = above * node.mTransformation;
        for (unsigned k = 0; k < node.mNumMeshes; ++k) {
            if (node.mMeshes[k] >= scene_.mNumMeshes)
                throw Unavailable("a node names a mesh that is not there");
            add_mesh(*scene_.mMeshes[node.mMeshes[k]], transform, node.mName.C_Str());
        }
        for (unsigned k = 0; k < node.mNumChildren; ++k)
            add(*node.mChildren[k], transform);
    }

private:
    void add_mesh(const aiMesh& mesh, const aiMatrix4x4& transform, const std::string& name)
    {
        const std::size_t first_point = file.mesh.points.size();
        const auto first_face = static_cast<uint>(file.mesh.faces.size());
        if (first_point + mesh.mNumVertices > 0xffffffffu)
            throw Unavailable("there are more than 2^32 vertices");
        for (unsigned k = 0; k < mesh.mNumVertices; ++k)
            file.mesh.points.push_back(placed(transform, mesh.mVertices[k]));
        std::vector<uint> corners;
        for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
            const aiFace& face = mesh.mFaces[k];
            corners.clear();
            for (unsigned corner = 0; corner < face.mNumIndices; ++corner) {
                if (face.mIndices[corner] >= mesh.mNumVertices)
                    throw Unavailable("a face names vertex " +
                                      std::to_string(face.mIndices[corner]) + " of " +
                                      std::to_string(mesh.mNumVertices));
                corners.push_back(static_cast<uint>(first_point) + face.mIndices[corner]);
            }
            add_fan(file.mesh.faces, corners);  // nothing for points and lines
        }
        const auto faces = static_cast<uint>(file.mesh.faces.size()) - first_face;
        if (faces != 0)
            file.objects.push_back({name.empty() ? "unnamed" : name, first_face, faces});
    }

    const aiScene& scene_;
};

std::string reason_in(const std::string& error)
{
    if (error.find_first_not_of(" \t\r\n") == error.npos)
        return "assimp finds no scene in it, and says no more";
    return "assimp says: " + error.substr(error.find_first_not_of(" \t\r\n"));
}

}  // namespace

bool assimp_knows(const std::string& extension)
{
    return extension.size() > 1 && Assimp::Importer().IsExtensionSupported(extension);
}

FileMesh read_with_assimp(const std::string& path)
{
    Assimp::Importer importer;
    // No post-processing: its steps merge vertices and remove faces that have no area.
    const aiScene* const scene = importer.ReadFile(path, 0);
    if (scene == nullptr || scene->mRootNode == nullptr)
        throw Unavailable(reason_in(importer.GetErrorString()));
    if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0)
        throw Unavailable("assimp could not read all of it");
    Flattened flattened(*scene);
    flattened.add(*scene->mRootNode, aiMatrix4x4());
    return std::move(flattened.file);
}

}  // namespace bvhbench
