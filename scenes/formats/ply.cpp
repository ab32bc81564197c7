// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/error.h"
#include "scenes/formats/formats.h"
#include "scenes/formats/ply_header.h"

namespace bvhbench {
namespace {

/// Reads the values after a header in sequence, in any of the formats. Throws Unavailable if the file ends too soon or holds
/// something that is not a number.
class Values {
public:
    Values(const PlyHeader& header, const std::string& name)
        : rest_(header.data), format_(header.format), name_(name)
    {}

    /// Starts reading `element`. Throws if the rest of the file cannot hold as many as the header says.
    void begin(const PlyElement& element)
    {
        element_ = &element;
        const std::uint64_t least = element.least_size(format_);
        if (least != 0 && element.count > rest_.size() / least)
            throw Unavailable(name_ + " ends too soon: its header says " +
                              std::to_string(element.count) + " of element " +
                              in_quotes(element.name) + ", and " + std::to_string(rest_.size()) +
                              " bytes are left for them");
    }

    /// Calls `read` once for each instance of the element.
    template <class Read>
    void each(const Read& read)
    {
        for (index_ = 0; index_ < element_->count; ++index_)
            read();
    }

    /// A number beyond the range of floats becomes infinity, and its vertex is refused later. Floats hold a text whose type is
    /// float, regardless of its number of digits.
    FileNumber number(const PlyType& type)
    {
        if (format_ == PlyFormat::ascii && !type.is_integer) {
            const std::string_view text = word();
            const auto value = parse_number(text);
            if (!value)
                refuse("not a number: " + in_quotes(text));
            if (type.name == "float")
                return {value->rounded, value->rounded, true};
            return *value;
        }
        const double value =
            type.is_integer ? static_cast<double>(integer(type)) : binary_value(type);
        constexpr double largest = std::numeric_limits<float>::max();
        if (value > largest || value < -largest)
            return {value, std::numeric_limits<float>::infinity(), std::isinf(value)};
        const auto rounded = static_cast<float>(value);
        return {value, rounded, double{rounded} == value || std::isnan(value)};
    }

    std::int64_t integer(const PlyType& type)
    {
        if (format_ != PlyFormat::ascii)
            return static_cast<std::int64_t>(binary_value(type));
        const std::string_view text = word();
        const auto value = parse_integer(text);
        if (!value)
            refuse("not an integer: " + in_quotes(text));
        return *value;
    }

    void skip(const PlyProperty& property)
    {
        const std::int64_t count = property.count_type ? integer(*property.count_type) : 1;
        if (count < 0)
            refuse("a list of length " + std::to_string(count));
        if (format_ != PlyFormat::ascii)
            bytes(static_cast<std::uint64_t>(count) * property.type->size);
        else
            for (std::int64_t k = 0; k < count; ++k)
                word();
    }

    /// Called after the last element. Throws if anything but white space remains.
    void end() const
    {
        std::string_view rest = rest_;
        if (!next_word(rest).empty())
            throw Unavailable(name_ + " has " + std::to_string(rest_.size()) +
                              " bytes more than its header says");
    }

    [[noreturn]] void refuse(const std::string& what) const
    {
        throw Unavailable(name_ + ", " + element_->name + " " + std::to_string(index_) + " of " +
                          std::to_string(element_->count) + ": " + what);
    }

private:
    std::string_view word()
    {
        const std::string_view result = next_word(rest_);
        if (result.empty())
            refuse("the file ends too soon");
        return result;
    }

    std::string_view bytes(std::uint64_t count)
    {
        if (count > rest_.size())
            refuse("the file ends too soon");
        const std::string_view result = rest_.substr(0, count);
        rest_.remove_prefix(count);
        return result;
    }

    double binary_value(const PlyType& type)
    {
        const std::string_view raw = bytes(type.size);
        if (format_ == PlyFormat::binary_little_endian)
            return type.value(raw.data());
        char swapped[8];
        std::reverse_copy(raw.begin(), raw.end(), swapped);
        return type.value(swapped);
    }

    std::string_view rest_;
    PlyFormat format_;
    const std::string& name_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};

class PlyReader {
public:
    PlyReader(std::string_view bytes, const std::string& name)
        : name_(name), header_(read_ply_header(bytes, name)), values_(header_, name)
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
            else if (element.name == "face" || element.name == "tristrips")
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

    void skip(const PlyElement& element)
    {
        values_.each([&] {
            for (const PlyProperty& property : element.properties)
                values_.skip(property);
        });
        if (element.count > 0)
            file_.reading.ignored.push_back(std::to_string(element.count) + " of element " +
                                            in_quotes(element.name));
    }

    void check_header()
    {
        const PlyElement* const vertex = element_called("vertex");
        const PlyElement* const face = element_called("face");
        const PlyElement* const strips = element_called("tristrips");
        const auto has_some = [](const PlyElement* element) {
            return element != nullptr && element->count > 0;
        };
        if (vertex == nullptr || (!has_some(face) && !has_some(strips)))
            throw Unavailable(name_ + " has no triangles");
        if (has_some(face) && has_some(strips))
            throw Unavailable(name_ + " has faces and tristrips, and one of the two is read");
        vertex_count_ = vertex->count;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (std::ranges::count(vertex->properties, axis, &PlyProperty::axis) != 1)
                throw Unavailable(name_ + " has vertices without one " + "xyz"[axis]);
        const PlyElement& faces = has_some(strips) ? *strips : *face;
        const auto lists = std::ranges::count(faces.properties, true, &PlyProperty::is_corner_list);
        if (lists != 1)
            throw Unavailable(name_ + " has " + (has_some(strips) ? "tristrips" : "faces") +
                              " with " + std::to_string(lists) +
                              " lists called vertex_indices or vertex_index instead of one");
    }

    void vertices(const PlyElement& element)
    {
        file_.has_doubles =
            std::ranges::any_of(element.properties, [](const PlyProperty& property) {
                return property.name.size() == 1 && property.type->name != "float";
            });
        file_.mesh.points.reserve(element.count);
        values_.each([&] {
            FileNumber at[3];
            for (const PlyProperty& property : element.properties)
                if (property.axis < 3)
                    at[property.axis] = values_.number(*property.type);
                else
                    values_.skip(property);
            file_.add_point(at[0], at[1], at[2]);
        });
    }

    /// Reads faces, or triangle strips, whose corners are all corners of triangles, apart from -1, which ends a strip.
    void faces(const PlyElement& element)
    {
        const bool are_strips = element.name == "tristrips";
        file_.mesh.faces.reserve(element.count);
        values_.each([&] {
            std::optional<std::int64_t> object;
            for (const PlyProperty& property : element.properties)
                if (property.is_corner_list())
                    corners(property, are_strips);
                else if (property.name == "object_id" && property.count_type == nullptr &&
                         property.type->is_integer)
                    object = values_.integer(*property.type);
                else
                    values_.skip(property);
            if (are_strips)
                add_strips();
            else
                file_.add_polygon(corners_);
            if (object)
                ids_.resize(file_.mesh.faces.size(), *object);
        });
    }

    /// Adds the triangles of strips. Every other one is turned round, so that all face the same side.
    void add_strips()
    {
        std::size_t first = 0;  // of the strip
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            if (corners_[k] == end_of_strip) {
                first = k + 1;
            } else if (k >= first + 2) {
                const bool turned = (k - first) % 2 == 1;
                file_.mesh.faces.push_back(
                    {corners_[k - (turned ? 1 : 2)], corners_[k - (turned ? 2 : 1)], corners_[k]});
            }
        }
    }

    void corners(const PlyProperty& property, bool are_strips)
    {
        if (!property.type->is_integer)
            values_.refuse("its corners are not integers");
        const std::int64_t count = values_.integer(*property.count_type);
        if (count < (are_strips ? 0 : 3))
            values_.refuse(are_strips ? "a list of length " + std::to_string(count)
                                      : "a face takes three corners, and there are " +
                                            std::to_string(count));
        corners_.clear();
        for (std::int64_t k = 0; k < count; ++k) {
            const std::int64_t index = values_.integer(*property.type);
            if (are_strips && (index == -1 || index == std::int64_t{end_of_strip})) {
                corners_.push_back(end_of_strip);
                continue;
            }
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

    const std::string& name_;
    PlyHeader header_;
    Values values_;
    FileMesh file_;
    std::vector<uint> corners_;
    std::vector<std::int64_t> ids_;  ///< object_id of each triangle; empty: the file has none
    std::uint64_t vertex_count_ = 0;
    static constexpr uint end_of_strip = 0xffffffffu;
};

}  // namespace

FileMesh read_ply(std::string_view bytes, const std::string& name)
{
    return PlyReader(without_mark(bytes, name), name).read();
}

}  // namespace bvhbench
