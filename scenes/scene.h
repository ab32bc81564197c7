// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "geometry/mesh.h"
#include "scenes/doubles.h"

namespace bvhbench {

/// A range of a scene's triangles that moves as one thing.
struct SceneObject {
    std::string name;
    uint first_face = 0;
    uint face_count = 0;
};

/// How a scene differs from another one: by a triangle that was moved away (scenes/generate/derived.h).
struct Outlier {
    std::string of;  ///< that scene; empty: none was moved
    uint triangle = 0;
    double diameters = 0;  ///< how far, in diagonals of that scene's box
};

/// What is built over: triangles of one or more objects, with one or more frames of vertex positions.
///
/// The connectivity holds for all frames. Objects are contiguous, in order, and cover every face.
/// Positions are finite and free of negative zeros, indices are in range: a Scene that exists is valid.
struct Scene {
    std::string name;                        ///< what the user typed, unique in a result file
    std::vector<Face> faces;                 ///< of all objects, at least one
    std::vector<SceneObject> objects;        ///< at least one
    bool has_meshes = false;                 ///< what it was made from names these objects
    std::vector<std::vector<Point>> frames;  ///< positions of all vertices, one vector a frame
    std::vector<std::string>
        frame_labels;  ///< what the frames are called where they come from, or empty
    /// Which triangle of the file (or generator) triangle k is; empty: it is k. Not empty once triangles were
    /// put into another order so that those of an object follow each other (scenes/face_order.h).
    std::vector<uint> file_faces;
    /// The number that the file gives object k; empty: it is k.
    std::vector<std::int64_t> object_ids;
    std::string
        source;  ///< "generated", or the file that was read: its path in the data folder if it is there
    std::filesystem::path
        folder;  ///< where these frames were read from and more may be said of them, or empty
    std::string
        stand_in_for;  ///< the data set this one replaces because it is not there; else empty
    Outlier outlier;
    Rounding rounding;    ///< of coordinates that floats could not hold
    std::string bend_of;  ///< the scene that this one gives a second frame, bent; else empty
    std::uint64_t content_hash = 0;  ///< of faces, objects and all frames; not of names

    uint triangle_count() const { return static_cast<uint>(faces.size()); }
};

/// Makes a Scene valid or refuses it: negative zeros become positive, `content_hash` is set, and a scene
/// without objects gets one over all faces. `name` and `source` must be set.
///
/// Throws Unavailable, in one sentence, when the scene has no triangles or frames, an index is out of
/// range, a position is not finite, or the objects do not cover the faces in order.
Scene finished(Scene scene);

}  // namespace bvhbench
