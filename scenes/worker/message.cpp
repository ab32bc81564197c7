// SPDX-License-Identifier: MIT
#include "scenes/worker/message.h"

#include <cstring>

namespace bvhbench {
namespace {

constexpr std::string_view magic = "BVHMESH1";

template <class T>
void append(std::string& message, const T* values, std::size_t count)
{
    if (count != 0)
        message.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class T>
void append(std::string& message, const T& value)
{
    append(message, &value, 1);
}

/// Takes values off the front of a message; once one is missing, `ok` stays false.
class Parts {
public:
    explicit Parts(std::string_view rest) : rest_(rest) {}

    std::string_view bytes(std::uint64_t count)
    {
        ok_ = ok_ && count <= rest_.size();
        if (!ok_)
            return {};
        const std::string_view result = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return result;
    }

    template <class T>
    T value()
    {
        T result{};
        const std::string_view raw = bytes(sizeof result);
        if (ok_)
            std::memcpy(&result, raw.data(), sizeof result);
        return result;
    }

    template <class T>
    std::vector<T> values(std::uint64_t count)
    {
        const std::string_view raw = bytes(count <= rest_.size() ? count * sizeof(T) : count);
        std::vector<T> result(raw.size() / sizeof(T));
        if (!raw.empty())
            std::memcpy(result.data(), raw.data(), raw.size());
        return result;
    }

    bool ok() const { return ok_; }
    bool at_end() const { return ok_ && rest_.empty(); }
    std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
    bool ok_ = true;
};

}  // namespace

std::string mesh_message(const FileMesh& file)
{
    std::string message(magic);
    message += 'M';
    append(message, std::uint64_t{file.mesh.points.size()});
    append(message, std::uint64_t{file.mesh.faces.size()});
    append(message, std::uint64_t{file.objects.size()});
    for (const SceneObject& object : file.objects) {
        append(message, object.first_face);
        append(message, object.face_count);
        append(message, static_cast<std::uint32_t>(object.name.size()));
        message += object.name;
    }
    append(message, file.mesh.points.data(), file.mesh.points.size());
    append(message, file.mesh.faces.data(), file.mesh.faces.size());
    return message;
}

std::string refusal_message(std::string_view why)
{
    return std::string(magic) + 'E' + std::string(why);
}

std::optional<std::variant<FileMesh, std::string>> decoded(std::string_view message)
{
    Parts parts(message);
    if (parts.bytes(magic.size()) != magic)
        return std::nullopt;
    const char kind = parts.value<char>();
    if (kind == 'E')
        return std::string(parts.rest());
    if (kind != 'M')
        return std::nullopt;
    FileMesh file;
    const auto points = parts.value<std::uint64_t>();
    const auto faces = parts.value<std::uint64_t>();
    const auto objects = parts.value<std::uint64_t>();
    for (std::uint64_t k = 0; k < objects && parts.ok(); ++k) {
        SceneObject object;
        object.first_face = parts.value<uint>();
        object.face_count = parts.value<uint>();
        object.name = parts.bytes(parts.value<std::uint32_t>());
        file.objects.push_back(object);
    }
    file.mesh.points = parts.values<Point>(points);
    file.mesh.faces = parts.values<Face>(faces);
    if (!parts.at_end())
        return std::nullopt;
    return file;
}

}  // namespace bvhbench
