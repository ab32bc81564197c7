// SPDX-License-Identifier: MIT
#include "scenes/formats/gltf_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "geometry/error.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

using Json = nlohmann::json;

/// An accessor without bytes has zeros for values. It may have this many elements, or one for each byte of the file if that is more.
constexpr std::size_t few_without_bytes = 65536;

/// A type of components. `most` is the value that stands for 1 where integers are normalized.
struct Component {
    std::size_t type;
    std::size_t bytes;
    double most;
    double (*value)(const char* bytes);
};

template <class T>
double component(const char* bytes)
{
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

constexpr Component components[] = {
    {5120, 1, 127, component<std::int8_t>},           {5121, 1, 255, component<std::uint8_t>},
    {5122, 2, 32767, component<std::int16_t>},        {5123, 2, 65535, component<std::uint16_t>},
    {5125, 4, 4294967295., component<std::uint32_t>}, {5126, 4, 1, component<float>}};

constexpr std::pair<std::string_view, std::size_t> widths[] = {
    {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};

bool is_normalized(const Json& accessor)
{
    const auto found = accessor.find("normalized");
    return found != accessor.end() && *found == Json(true);
}

std::uint32_t word_at(std::string_view bytes, std::size_t at)
{
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

/// Decodes base64 with or without padding; false for other characters.
bool decode_base64(std::string_view text, std::string& bytes)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    signed char value_of[256];
    std::fill(std::begin(value_of), std::end(value_of), static_cast<signed char>(-1));
    for (std::size_t k = 0; k < digits.size(); ++k)
        value_of[static_cast<unsigned char>(digits[k])] = static_cast<signed char>(k);
    while (text.ends_with('='))
        text.remove_suffix(1);
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0, count = 0;
    for (const char c : text) {
        const int value = value_of[static_cast<unsigned char>(c)];
        if (value < 0)
            return false;
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        if ((count += 6) >= 8)
            bytes.push_back(static_cast<char>(bits >> (count -= 8) & 0xff));
    }
    return true;
}

/// Returns a URI with "%20" and the like decoded.
std::string decoded_uri(std::string_view uri)
{
    std::string text;
    for (std::size_t k = 0; k < uri.size(); ++k) {
        unsigned value = 0;
        const auto hex = uri.substr(k + 1, uri[k] == '%' ? 2 : 0);
        const auto end = hex.data() + hex.size();
        if (hex.size() == 2 && std::from_chars(hex.data(), end, value, 16).ptr == end) {
            text.push_back(static_cast<char>(value));
            k += 2;
        } else {
            text.push_back(uri[k]);
        }
    }
    return text;
}

}  // namespace

GltfFile::GltfFile(std::string_view bytes, const std::string& name, ReadBeside read_beside)
    : name_(name), read_beside_(std::move(read_beside)), file_bytes_(bytes.size())
{
    if (bytes.starts_with("glTF"))
        open_binary(bytes);
    else
        json_ = Json::parse(bytes, nullptr, false);  // on errors: is_discarded()
    if (json_.is_discarded() || !json_.is_object())
        refuse("is no glTF: its JSON is damaged");
    const auto asset = json_.find("asset");
    const std::string version = asset == json_.end() || !asset->is_object() ||
                                        !asset->contains("version") ||
                                        !(*asset)["version"].is_string()
                                    ? ""
                                    : (*asset)["version"].get<std::string>();
    if (!version.starts_with("2."))
        refuse("is of glTF version " + in_quotes(version) + ", and version 2 is read");
    if (const auto least = asset->find("minVersion"); least != asset->end() && *least != "2.0")
        refuse("needs glTF version " + least->dump() + ", and 2.0 is read");
}

void GltfFile::refuse(const std::string& what) const { throw Unavailable(name_ + ' ' + what); }

void GltfFile::open_binary(std::string_view bytes)
{
    constexpr std::uint32_t json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
    if (bytes.size() < 20 || word_at(bytes, 4) != 2)
        refuse("is no binary glTF of version 2");
    if (word_at(bytes, 8) != bytes.size())
        refuse("says that it has " + std::to_string(word_at(bytes, 8)) + " bytes, and has " +
               std::to_string(bytes.size()));
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::uint32_t size = word_at(bytes, at), kind = word_at(bytes, at + 4);
        if (size > bytes.size() - at - 8)
            refuse("ends inside a chunk");
        const std::string_view chunk = bytes.substr(at + 8, size);
        if (at == 12 && kind != json_chunk)
            refuse("does not begin with JSON");
        if (at == 12) {
            json_ = Json::parse(chunk, nullptr, false);
        } else if (kind == binary_chunk && !has_chunk_) {
            chunk_ = chunk;
            has_chunk_ = true;
        }
        at += 8 + std::size_t{size};
    }
}

const Json& GltfFile::item(const char* key, std::size_t index) const
{
    const auto list = json_.find(key);
    const std::size_t count = list == json_.end() || !list->is_array() ? 0 : list->size();
    if (index >= count || !(*list)[index].is_object())
        refuse("names number " + std::to_string(index) + " of '" + key + "', which has " +
               std::to_string(count));
    return (*list)[index];
}

std::optional<std::size_t> GltfFile::whole(const Json& of, const char* key) const
{
    const auto found = of.find(key);
    if (found == of.end())
        return std::nullopt;
    if (!found->is_number_unsigned())
        refuse("has a '" + std::string(key) + "' that is no whole number");
    return found->get<std::size_t>();
}

std::vector<double> GltfFile::numbers(const Json& of, const char* key,
                                      std::vector<double> usual) const
{
    const auto found = of.find(key);
    if (found == of.end())
        return usual;
    const bool are_numbers = found->is_array() && std::ranges::all_of(*found, [](const Json& n) {
                                 return n.is_number();
                             });
    if (!are_numbers || found->size() != usual.size())
        refuse("has a '" + std::string(key) + "' that is not " + std::to_string(usual.size()) +
               " numbers");
    return found->get<std::vector<double>>();
}

std::string GltfFile::buffer_at(std::size_t index) const
{
    const Json& buffer = item("buffers", index);
    const auto length = whole(buffer, "byteLength");
    const auto uri = buffer.find("uri");
    std::string bytes;
    if (uri == buffer.end()) {
        if (index != 0 || !has_chunk_)
            refuse("has a buffer, " + std::to_string(index) +
                   ", without bytes, as files have that are compressed");
        bytes = chunk_;
    } else if (!uri->is_string()) {
        refuse("has a buffer whose uri is no text");
    } else if (const std::string text = *uri; text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        if (comma == text.npos || !text.substr(0, comma).ends_with(";base64") ||
            !decode_base64(std::string_view(text).substr(comma + 1), bytes))
            refuse("has a buffer, " + std::to_string(index) + ", whose base64 is damaged");
    } else if (text.find("://") != text.npos) {
        refuse("names a buffer that is not beside it: " + in_quotes(text));
    } else {
        bytes = read_beside_(decoded_uri(text));
    }
    if (!length || *length > bytes.size())
        refuse("says that buffer " + std::to_string(index) + " has " +
               std::to_string(length.value_or(0)) + " bytes, and there are " +
               std::to_string(bytes.size()));
    return bytes;
}

const std::string& GltfFile::buffer(std::size_t index) const
{
    if (const auto known = buffers_.find(index); known != buffers_.end())
        return known->second;
    return buffers_.emplace(index, buffer_at(index)).first->second;
}

const Json& GltfFile::list(const Json& of, const char* key) const
{
    static const Json empty = Json::array();
    const auto found = of.find(key);
    if (found == of.end())
        return empty;
    if (!found->is_array())
        refuse("has '" + std::string(key) + "' that are no list");
    return *found;
}

std::vector<std::size_t> GltfFile::index_list(const Json& of, const char* key) const
{
    std::vector<std::size_t> all;
    for (const Json& index : list(of, key)) {
        if (!index.is_number_unsigned())
            refuse("has a list '" + std::string(key) + "' of other than indices");
        all.push_back(index.get<std::size_t>());
    }
    return all;
}

const Json& GltfFile::object(const Json& of, const char* key) const
{
    static const Json empty = Json::object();
    const auto found = of.find(key);
    if (found == of.end())
        return empty;
    if (!found->is_object())
        refuse("has '" + std::string(key) + "' that are no object");
    return *found;
}

GltfNumbers::Stored GltfFile::stored(const Json& from, std::size_t view, std::size_t component_type,
                                     bool normalized, std::size_t width, std::size_t count) const
{
    const auto kind = std::ranges::find(components, component_type, &Component::type);
    if (kind == std::end(components))
        refuse("has an accessor of components of type " + std::to_string(component_type));
    if (normalized && (kind->most == 1 || kind->bytes == 4))
        refuse("has an accessor of normalized numbers that are no small integers");
    const Json& bytes_of = item("bufferViews", view);
    const std::string& bytes = buffer(whole(bytes_of, "buffer").value_or(0));
    const std::size_t begin = whole(bytes_of, "byteOffset").value_or(0);
    const std::size_t length = whole(bytes_of, "byteLength").value_or(0);
    const std::size_t size = width * kind->bytes;
    const std::size_t stride = whole(bytes_of, "byteStride").value_or(size);
    const std::size_t offset = whole(from, "byteOffset").value_or(0);
    if (begin > bytes.size() || length > bytes.size() - begin || stride < size ||
        stride > 1 << 16 || offset > length ||
        (count > 0 && (length - offset < size || (length - offset - size) / stride < count - 1)))
        refuse("has an accessor that reaches beyond the end of its buffer view, " +
               std::to_string(view));
    return {bytes.data() + begin + offset, stride, kind->bytes, kind->value,
            normalized ? kind->most : 0};
}

GltfNumbers GltfFile::accessor(std::size_t index, std::size_t width) const
{
    const Json& json = item("accessors", index);
    const auto type = json.find("type");
    const auto known = std::ranges::find(
        widths, type == json.end() || !type->is_string() ? "" : type->get<std::string>(),
        &std::pair<std::string_view, std::size_t>::first);
    if (known == std::end(widths) || known->second != width)
        refuse("has an accessor, " + std::to_string(index) + ", that is not of " +
               std::to_string(width) + (width == 1 ? " number" : " numbers") + " an element");
    const auto component_type = whole(json, "componentType").value_or(0);
    GltfNumbers numbers;
    numbers.width_ = width;
    numbers.count_ = whole(json, "count").value_or(0);
    if (const auto view = whole(json, "bufferView"))
        numbers.stored_ =
            stored(json, *view, component_type, is_normalized(json), width, numbers.count_);
    else if (numbers.count_ > std::max(few_without_bytes, file_bytes_))
        refuse("has an accessor of " + std::to_string(numbers.count_) +
               " elements without a buffer view, as files have that are compressed");
    const Json& sparse = object(json, "sparse");
    if (sparse.empty())
        return numbers;
    const std::size_t changes = whole(sparse, "count").value_or(0);
    const auto part = [&](const char* key, std::size_t kind, bool normal, std::size_t wide) {
        const Json& of = object(sparse, key);
        const auto view = whole(of, "bufferView");
        if (!view)
            refuse("has a sparse accessor without " + std::string(key));
        return stored(of, *view, kind, normal, wide, changes);
    };
    GltfNumbers places;
    places.width_ = 1;
    places.stored_ =
        part("indices", whole(object(sparse, "indices"), "componentType").value_or(0), false, 1);
    numbers.changed_ = part("values", component_type, is_normalized(json), width);
    for (std::size_t k = 0; k < changes; ++k) {
        double at = 0;
        places.read(places.stored_, k, &at);
        if (!(at >= 0 && at < static_cast<double>(numbers.count_)) ||
            (k > 0 && at <= static_cast<double>(numbers.changes_.back())))
            refuse("has a sparse accessor whose indices do not ascend, or are too large");
        numbers.changes_.push_back(static_cast<std::size_t>(at));
    }
    return numbers;
}

GltfNumbers GltfFile::indices(std::size_t index) const
{
    const Json& json = item("accessors", index);
    const std::size_t type = whole(json, "componentType").value_or(0);
    if ((type != 5121 && type != 5123 && type != 5125) || is_normalized(json))
        refuse("has an accessor of indices, " + std::to_string(index) +
               ", that are not whole numbers from 0 on");
    return accessor(index, 1);
}

void GltfNumbers::read(const Stored& from, std::size_t k, double* to) const
{
    for (std::size_t c = 0; c < width_; ++c) {
        to[c] = from.bytes == nullptr
                    ? 0
                    : from.value(from.bytes + k * from.stride + c * from.component_bytes);
        if (from.most > 0)
            to[c] = std::max(to[c] / from.most, -1.0);
    }
}

void GltfNumbers::read(std::size_t k, double* to) const
{
    const auto change = std::ranges::lower_bound(changes_, k);
    if (change != changes_.end() && *change == k)
        read(changed_, static_cast<std::size_t>(change - changes_.begin()), to);
    else
        read(stored_, k, to);
}

}  // namespace bvhbench
