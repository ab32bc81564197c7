// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "scenes/doubles.h"
#include "scenes/reading.h"

namespace bvhbench {

/// A range of a scene's triangles that moves as one object.
struct SceneObject {
    std::string name;
    uint first_face = 0;
    uint face_count = 0;
};

/// Difference of a scene from another scene: one triangle that was moved away (scenes/generate/derived.h).
struct Outlier {
    std::string of;  ///< name of the other scene; empty: no triangle was moved
    uint triangle = 0;
    double diameters = 0;  ///< distance, in diagonals of the other scene's box
};

/// Input of the builders: triangles of one or more objects, with one or more frames of vertex positions.
///
/// All frames share the connectivity. Objects are contiguous, in order, and cover every face. Positions are finite and contain
/// no negative zeros, and indices are in range: every finished Scene is valid.
struct Scene {
    std::string name;                  ///< the name that the user typed, unique in a result file
    std::vector<Face> faces;           ///< faces of all objects, at least one
    std::vector<SceneObject> objects;  ///< at least one
    bool has_meshes = false;           ///< true if the source of the scene names these objects
    std::vector<std::vector<Point>> frames;  ///< positions of all vertices, one vector per frame
    /// The same positions in doubles, whose nearest floats `frames` are, for steps between frames. Empty unless floats could not hold
    /// them and they were kept (Doubles::kept).
    std::vector<std::vector<WidePoint>> wide;
    std::vector<std::string> frame_labels;  ///< names of the frames in the source, or empty
    /// Number of triangle k in the file (or generator); empty: k. Set if triangles were reordered so that those of an object
    /// are consecutive (scenes/face_order.h).
    std::vector<uint> file_faces;
    /// Number of object k in the file; empty: k.
    std::vector<std::int64_t> object_ids;
    /// A second division into objects that the file has (OBJ's groups): names, and the index of the group of each of the file's
    /// triangles. Empty: it has none.
    std::vector<std::string> groups;
    std::vector<uint> group_of_face;
    Reading reading;                 ///< what reading the file did
    std::optional<MeshFacts> facts;  ///< of a scene that was read from a file (scenes/facts.h)
    std::string
        source;  ///< "generated", or the path of the file that was read, relative to the data folder if it is inside
    std::filesystem::path
        folder;  ///< folder that the frames were read from, which may hold ground truth, or empty
    std::string stand_in_for;  ///< name of the data set that this scene replaces, or empty
    Outlier outlier;
    Rounding rounding;               ///< rounding of coordinates that floats could not hold
    std::string bend_of;             ///< scene to which this one adds a bent frame, or empty
    std::uint64_t content_hash = 0;  ///< covers faces, objects and all frames, but no names
    bool objects_are_parts = false;  ///< whether objects are connected components
    /// Frames with other triangles than the first, from the second on, each a scene of one frame. Empty: all frames are in
    /// `frames`.
    std::vector<Scene> later;

    std::size_t frame_count() const { return frames.size() + later.size(); }
    /// Returns the scene that has frame `k`, as its first frame if that is one of `later`.
    const Scene& with_frame(std::size_t k) const
    {
        return later.empty() || k == 0 ? *this : later[k - 1];
    }

    uint triangle_count() const { return static_cast<uint>(faces.size()); }
};

/// Rounds the frames of a scene as round_frames does, whose doubles are `wide`, and keeps these with Doubles::kept.
void take_doubles(Scene& scene, std::vector<std::vector<WidePoint>> wide, Doubles how);

/// Validates a scene: turns negative zeros into positive ones, sets `content_hash`, and gives a scene without objects one
/// object over all faces. `name` and `source` must be set.
///
/// Throws Unavailable, in one sentence, if the scene has no triangles or frames, an index is out of range, a position is not
/// finite, the objects do not cover the faces in order, or `frames` were changed after their doubles were kept.
Scene finished(Scene scene);

}  // namespace bvhbench
