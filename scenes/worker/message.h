// SPDX-License-Identifier: MIT
//
// What the worker sends back, in the byte order of the machine both run on:
//
//     "BVHMESH1"  'E'  text to the end                              a refusal
//     "BVHMESH1"  'M'  points  faces  objects (64 bits each)
//                 objects of: first face, face count, name length (32 bits each), name
//                 points, faces                                     a mesh
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "scenes/formats/formats.h"

namespace bvhbench {

std::string mesh_message(const FileMesh& file);
std::string refusal_message(std::string_view why);

/// The mesh or the refusal in `message`; nothing if it is neither in full, as after a crash.
/// Says nothing of whether the mesh makes sense.
std::optional<std::variant<FileMesh, std::string>> decoded(std::string_view message);

}  // namespace bvhbench
