// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/formats/formats.h"

namespace bvhbench {

/// The numbers of an accessor, converted to doubles: integers that are "normalized" are divided by their largest value.
struct GltfNumbers {
    std::size_t width = 0;  ///< numbers per element: 3 for VEC3
    std::vector<double> values;

    std::size_t size() const { return values.size() / width; }
    const double* operator[](std::size_t k) const { return values.data() + k * width; }
};

/// A glTF 2.0 file: its JSON and its buffers. Every function throws Unavailable, in one sentence that begins with the file's name, for
/// what does not follow the specification.
class GltfFile {
public:
    /// Reads .gltf or .glb, which begins with "glTF".
    GltfFile(std::string_view bytes, const std::string& name, ReadBeside read_beside);

    const nlohmann::json& json() const { return json_; }

    /// Returns element `index` of the list called `key`.
    const nlohmann::json& item(const char* key, std::size_t index) const;

    /// Returns the whole number called `key`; nothing if there is none.
    std::optional<std::size_t> whole(const nlohmann::json& of, const char* key) const;

    /// Returns the numbers called `key`, of which there must be as many as in `usual`, or `usual` if there are none.
    std::vector<double> numbers(const nlohmann::json& of, const char* key,
                                std::vector<double> usual) const;

    /// Decodes an accessor of elements of one of these widths: any component type, stride, sparse values.
    GltfNumbers accessor(std::size_t index, std::size_t width) const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    void open_binary(std::string_view bytes);
    std::string buffer_at(std::size_t index) const;
    const std::string& buffer(std::size_t index) const;

    /// Adds `count` elements, from `view` on, to `values`.
    void decode(const nlohmann::json& from, std::size_t view, int component_type, bool normalized,
                std::size_t width, std::size_t count, std::vector<double>& values) const;

    std::string name_;
    ReadBeside read_beside_;
    nlohmann::json json_;
    std::string_view chunk_;  ///< the binary chunk of a .glb file
    bool has_chunk_ = false;
    mutable std::map<std::size_t, std::string> buffers_;  ///< those that were read
};

}  // namespace bvhbench
