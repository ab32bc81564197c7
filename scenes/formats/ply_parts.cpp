// SPDX-License-Identifier: MIT
#include "scenes/formats/ply_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include "geometry/error.h"
#include "geometry/host_memory.h"

namespace bvhbench {
namespace {

constexpr std::size_t most_header_bytes = 1 << 20, block_bytes = 1 << 24;

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why)
{
    throw Unavailable(path.string() + why);
}

/// Returns up to `bytes` bytes of a file from `at` on.
std::string read_from(const std::filesystem::path& path, std::ifstream& file, std::uint64_t at,
                      std::size_t bytes)
{
    std::string text(bytes, '\0');
    file.clear();
    file.seekg(static_cast<std::streamoff>(at));
    file.read(text.data(), static_cast<std::streamsize>(bytes));
    if (file.bad() || file.gcount() < 0)
        refuse(path, " cannot be read");
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

bool has_list(const PlyElement& element)
{
    return std::ranges::any_of(element.properties, [](const PlyProperty& property) {
        return property.count_type != nullptr;
    });
}

/// Returns the bytes of a record whose lists have three entries.
std::size_t record_bytes(const PlyElement& element)
{
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties)
        bytes += property.count_type ? property.count_type->size + 3 * property.type->size
                                     : property.type->size;
    return bytes;
}

}  // namespace

std::optional<PlyParts> PlyParts::opened(const std::filesystem::path& path,
                                         const std::filesystem::path& frames)
{
    std::error_code error;
    const std::uint64_t file_size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    if (error || !file)
        refuse(path, " cannot be read");
    const std::string begin = read_from(path, file, 0, most_header_bytes);
    const PlyHeader header = read_ply_header(begin, path.string());
    PlyParts parts;
    parts.vertices_.path = parts.faces_.path = path;
    if (header.format != PlyFormat::binary_little_endian ||
        !parts.locate(header, static_cast<std::uint64_t>(header.data.data() - begin.data()),
                      file_size))
        return std::nullopt;
    if (frames.empty())
        return parts.has_float_points_ ? std::optional(parts) : std::nullopt;
    const std::uint64_t frame_bytes = parts.vertices_.count * sizeof(Point);
    const std::uint64_t frames_size = std::filesystem::file_size(frames, error);
    if (error || frames_size == 0 || frames_size % frame_bytes != 0)
        return std::nullopt;
    parts.vertices_ = {frames, 0, parts.vertices_.count, sizeof(Point)};
    for (std::size_t axis = 0; axis < 3; ++axis)
        parts.axis_at_[axis] = axis * sizeof(float);
    return parts;
}

/// False if the file must be read whole.
bool PlyParts::locate(const PlyHeader& header, std::uint64_t data_at, std::uint64_t file_size)
{
    std::uint64_t at = data_at;
    for (const PlyElement& element : header.elements) {
        const std::size_t bytes = record_bytes(element);
        if (bytes == 0)
            continue;
        if (element.count > (file_size - at) / bytes)
            return false;
        Records* const records = element.name == "vertex" ? &vertices_
                                 : element.name == "face" ? &faces_
                                                          : nullptr;
        if (records == nullptr ? has_list(element) : records->bytes != 0)
            return false;
        if (records != nullptr) {
            records->at = at;
            records->count = element.count;
            records->bytes = bytes;
            if (records == &vertices_ ? !locate_vertex(element) : !locate_face(element))
                return false;
        }
        at += element.count * bytes;
    }
    return at == file_size && vertices_.count > 0 && faces_.count > 0 &&
           faces_.count <= 0x80000000u && vertices_.count <= 0xffffffffu;
}

bool PlyParts::locate_vertex(const PlyElement& element)
{
    std::size_t at = 0, axes = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.axis < 3) {
            axis_at_[property.axis] = at;
            axes += std::size_t{1} << 2 * property.axis;  // one of each makes 0b010101
            has_float_points_ = has_float_points_ && property.type->name == "float";
        }
        at += property.type->size;
    }
    return axes == 0b010101 && !has_list(element);
}

bool PlyParts::locate_face(const PlyElement& element)
{
    std::size_t at = 0, lists = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.count_type != nullptr)
            ++lists;
        if (property.is_corner_list()) {
            corners_at_ = at;
            length_ = property.count_type;
            corner_ = property.type;
        }
        at += property.count_type ? property.count_type->size + 3 * property.type->size
                                  : property.type->size;
    }
    return lists == 1 && corner_ != nullptr && corner_->is_integer;
}

/// Calls read(k, bytes) for each record from `first` on, in order.
template <class Read>
void PlyParts::each(const Records& records, std::uint64_t first, std::uint64_t count,
                    const Read& read)
{
    std::ifstream file(records.path, std::ios::binary);
    const std::uint64_t at_once = std::max<std::size_t>(1, block_bytes / records.bytes);
    for (std::uint64_t done = 0; done < count; done += at_once) {
        const std::uint64_t here = std::min(at_once, count - done);
        const std::string block =
            read_from(records.path, file, records.at + (first + done) * records.bytes,
                      static_cast<std::size_t>(here) * records.bytes);
        if (block.size() != here * records.bytes)
            refuse(records.path, " ends too soon");
        for (std::uint64_t k = 0; k < here; ++k)
            read(first + done + k, block.data() + k * records.bytes);
    }
}

MeshRun PlyParts::read(FaceRange run) const
{
    MeshRun made;
    made.mesh_points = vertices_.count;
    const std::string what = "a part of " + faces_.path.string();
    require_host_memory(what, sizeof(Face) * std::uint64_t{run.count} + vertices_.count / 8);
    std::vector<bool> is_used(vertices_.count);
    std::size_t used = 0, least = is_used.size(), end = 0;
    made.faces.reserve(run.count);
    each(faces_, run.first, run.count, [&](std::uint64_t face, const char* bytes) {
        const auto refuse_face = [&](const std::string& why) {
            refuse(faces_.path, ", face " + std::to_string(face) + " of " +
                                    std::to_string(faces_.count) + ": " + why);
        };
        bytes += corners_at_;
        if (length_->value(bytes) != 3)
            refuse_face("it is no triangle, and its file has room for triangles only");
        bytes += length_->size;
        uint corners[3];
        for (uint& corner : corners) {
            const double vertex = corner_->value(bytes);
            if (vertex < 0 || vertex >= static_cast<double>(vertices_.count))
                refuse_face("it names vertex " + std::to_string(static_cast<std::int64_t>(vertex)) +
                            " of " + std::to_string(vertices_.count));
            corner = static_cast<uint>(vertex);
            used += is_used[corner] ? 0 : 1;
            is_used[corner] = true;
            least = std::min<std::size_t>(least, corner);
            end = std::max<std::size_t>(end, std::size_t{corner} + 1);
            bytes += corner_->size;
        }
        made.faces.push_back({corners[0], corners[1], corners[2]});
    });
    if (used == 0)
        return made;
    require_host_memory(what, used * (sizeof(Point) + sizeof(uint)));
    made.points.reserve(used);
    made.vertices.reserve(used);
    each(vertices_, least, end - least, [&](std::uint64_t vertex, const char* bytes) {
        if (!is_used[vertex])
            return;
        float at[3];
        for (std::size_t axis = 0; axis < 3; ++axis)
            std::memcpy(&at[axis], bytes + axis_at_[axis], sizeof(float));
        if (!std::isfinite(at[0]) || !std::isfinite(at[1]) || !std::isfinite(at[2]))
            refuse(vertices_.path,
                   " has a vertex, " + std::to_string(vertex) + ", that is not finite in float32");
        made.points.push_back({at[0], at[1], at[2]});
        made.vertices.push_back(static_cast<uint>(vertex));
    });
    return made;
}

}  // namespace bvhbench
