// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/ply_values.h"
#include "scenes/formats/text.h"

namespace bvhbench {
namespace {

bool is_corner_list(const PlyProperty& property)
{
    return property.is_list &&
           (property.name == "vertex_indices" || property.name == "vertex_index");
}

class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& name)
        : name_(name)
        , header_(read_ply_header(bytes, name))
        , values_(bytes.substr(header_.size), header_.format, name)
    {}

    FileMesh read()
    {
        check_header();
        for (const PlyElement& element : header_.elements) {
            if (element.properties.empty())
                continue;
            values_.begin(element);
            if (element.name == "vertex")
                vertices(element);
            else if (element.name == "face")
                faces(element);
            else
                skip(element);
        }
        values_.end();
        if (!ids_.empty())
            make_objects();
        return std::move(file_);
    }

private:
    const PlyElement* element_called(std::string_view name) const
    {
        const PlyElement* found = nullptr;
        for (const PlyElement& element : header_.elements)
            if (element.name == name) {
                if (found != nullptr)
                    throw Unavailable(name_ + " has two elements called '" + element.name + "'");
                found = &element;
            }
        return found;
    }

    void check_header()
    {
        const PlyElement* const vertex = element_called("vertex");
        const PlyElement* const face = element_called("face");
        if (vertex == nullptr || face == nullptr || face->count == 0)
            throw Unavailable(name_ + " has no triangles");
        vertex_count_ = vertex->count;
        for (const char* axis : {"x", "y", "z"})
            if (std::count_if(vertex->properties.begin(), vertex->properties.end(),
                              [&](const PlyProperty& property) {
                                  return property.name == axis && !property.is_list;
                              }) != 1)
                throw Unavailable(name_ + " has vertices without one " + axis);
        const auto lists =
            std::count_if(face->properties.begin(), face->properties.end(), is_corner_list);
        if (lists != 1)
            throw Unavailable(name_ + " has faces with " + std::to_string(lists) +
                              " lists called vertex_indices or vertex_index instead of one");
    }

    void vertices(const PlyElement& element)
    {
        file_.has_doubles =
            std::ranges::any_of(element.properties, [](const PlyProperty& property) {
                return property.name.size() == 1 && property.type != PlyType::float32;
            });
        file_.mesh.points.reserve(element.count);
        for (std::uint64_t k = 0; k < element.count; ++k) {
            values_.at(k);
            FileNumber x, y, z;
            for (const PlyProperty& property : element.properties)
                if (property.is_list || property.name.size() != 1)
                    values_.skip(property);
                else if (property.name == "x")
                    x = values_.number(property.type);
                else if (property.name == "y")
                    y = values_.number(property.type);
                else if (property.name == "z")
                    z = values_.number(property.type);
                else
                    values_.skip(property);
            file_.add({x, y, z});
        }
    }

    void faces(const PlyElement& element)
    {
        file_.mesh.faces.reserve(element.count);
        for (std::uint64_t k = 0; k < element.count; ++k) {
            values_.at(k);
            std::optional<std::int64_t> object;
            for (const PlyProperty& property : element.properties)
                if (is_corner_list(property))
                    corners(property);
                else if (property.name == "object_id" && !property.is_list &&
                         is_integer(property.type))
                    object = values_.integer(property.type);
                else
                    values_.skip(property);
            add_fan(file_.mesh.faces, corners_);
            if (object)
                ids_.resize(file_.mesh.faces.size(), *object);
        }
    }

    void corners(const PlyProperty& property)
    {
        if (!is_integer(property.type))
            values_.refuse("its corners are not integers");
        const std::int64_t count = values_.integer(property.count_type);
        if (count < 3)
            values_.refuse("a face takes three corners, and there are " + std::to_string(count));
        corners_.clear();
        for (std::int64_t k = 0; k < count; ++k) {
            const std::int64_t index = values_.integer(property.type);
            if (index < 0 || static_cast<std::uint64_t>(index) >= vertex_count_)
                values_.refuse("it names vertex " + std::to_string(index) + " of " +
                               std::to_string(vertex_count_));
            corners_.push_back(static_cast<uint>(index));
        }
    }

    void make_objects()
    {
        std::vector<std::int64_t> known = ids_;
        std::ranges::sort(known);
        known.erase(std::unique(known.begin(), known.end()), known.end());
        if (known.front() != 0 || known.back() + 1 != static_cast<std::int64_t>(known.size()))
            file_.object_ids = known;
        if (known.size() == 1)
            return;  // all triangles are one object
        file_.object_of_face.reserve(ids_.size());
        for (const std::int64_t id : ids_)
            file_.object_of_face.push_back(
                static_cast<uint>(std::ranges::lower_bound(known, id) - known.begin()));
        for (const std::int64_t id : known)
            file_.objects.push_back({"object " + std::to_string(id), 0, 0});
    }

    void skip(const PlyElement& element)
    {
        for (std::uint64_t k = 0; k < element.count; ++k) {
            values_.at(k);
            for (const PlyProperty& property : element.properties)
                values_.skip(property);
        }
    }

    const std::string& name_;
    PlyHeader header_;
    PlyValues values_;
    FileMesh file_;
    std::vector<uint> corners_;
    std::vector<std::int64_t> ids_;  ///< object_id of each triangle; empty: the file has none
    std::uint64_t vertex_count_ = 0;
};

}  // namespace

FileMesh read_ply(std::string_view bytes, const std::string& name)
{
    return PlyReader(bytes, name).read();
}

}  // namespace bvhbench
