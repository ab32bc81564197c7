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

/// The elements of an accessor, converted to doubles when they are asked for: integers that are "normalized" are divided by their
/// largest value.
class GltfNumbers {
public:
    std::size_t size() const { return count_; }

    /// Writes the numbers of element `k` to `to`: as many as the accessor's type has.
    void read(std::size_t k, double* to) const;

private:
    friend class GltfFile;

    /// Elements in a buffer; `bytes` is null for zeros.
    struct Stored {
        const char* bytes = nullptr;
        std::size_t stride = 0, component_bytes = 0;
        double (*value)(const char* bytes) = nullptr;
        double most = 0;  ///< the value that stands for 1; 0: numbers are not normalized
    };

    void read(const Stored& from, std::size_t k, double* to) const;

    std::size_t width_ = 0, count_ = 0;
    Stored stored_, changed_;
    std::vector<std::size_t> changes_;  ///< elements that changed_ has instead, in ascending order
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

    /// Returns the numbers called `key`. Their number must be that of `usual`, which is returned if `key` is missing.
    std::vector<double> numbers(const nlohmann::json& of, const char* key,
                                std::vector<double> usual) const;

    /// Opens an accessor of `width` numbers an element: any component type, stride, sparse values. It is valid as long as this file.
    GltfNumbers accessor(std::size_t index, std::size_t width) const;

    /// As accessor(), of whole numbers that are indices.
    GltfNumbers indices(std::size_t index) const;

    /// Returns the list or object called `key`; an empty one if there is none.
    const nlohmann::json& list(const nlohmann::json& of, const char* key) const;
    const nlohmann::json& object(const nlohmann::json& of, const char* key) const;

    /// Returns the indices in the list called `key`; none if there is no such list.
    std::vector<std::size_t> index_list(const nlohmann::json& of, const char* key) const;

    [[noreturn]] void refuse(const std::string& what) const;

private:
    void open_binary(std::string_view bytes);
    std::string buffer_at(std::size_t index) const;
    const std::string& buffer(std::size_t index) const;

    /// Finds `count` elements in a buffer view.
    GltfNumbers::Stored stored(const nlohmann::json& from, std::size_t view,
                               std::size_t component_type, bool normalized, std::size_t width,
                               std::size_t count) const;

    std::string name_;
    ReadBeside read_beside_;
    nlohmann::json json_;
    std::string_view chunk_;  ///< the binary chunk of a .glb file
    bool has_chunk_ = false;
    std::size_t file_bytes_;
    mutable std::map<std::size_t, std::string> buffers_;  ///< those that were read
};

}  // namespace bvhbench
