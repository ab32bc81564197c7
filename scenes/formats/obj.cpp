// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "geometry/error.h"
#include "scenes/formats/line_reader.h"

namespace bvhbench {
namespace {

/// Statements that a backslash continues on the next line. In others it is part of a name, as in "usemtl C:\\paints\\".
constexpr std::array<std::string_view, 7> continued = {"v", "vt", "vn", "vp", "f", "l", "p"};

/// Statements without triangles: materials, smoothing, lines, points and what belongs to corners.
constexpr std::array<std::string_view, 18> harmless = {
    "vt",     "vn",     "vp",  "l",   "p",     "s",        "mg",       "usemtl",     "mtllib",
    "usemap", "maplib", "deg", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"};

/// Statements of curves and surfaces, and of other files to read, which would add triangles.
constexpr std::array<std::string_view, 12> refused = {
    "cstype", "bmat", "curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp", "res", "call", "csh"};

class ObjReader : LineReader {
public:
    using LineReader::LineReader;

    FileMesh read()
    {
        while (const auto line = lines_.next())
            statement(*line);
        end_object();
        end_group();
        if (!has_groups_) {
            file_.groups.clear();
            file_.group_of_face.clear();
        }
        list_ignored(ignored_, "line", file_.reading);
        note_unknown();
        return result();
    }

private:
    void statement(std::string_view line)
    {
        line = without_comment(line);
        std::string_view words = line;
        std::string_view keyword = next_word(words);
        if (keyword.size() > 1 && keyword.ends_with('\\'))  // "f\" goes on in the next line
            keyword.remove_suffix(1);
        std::string joined;
        if (std::ranges::find(continued, keyword) != continued.end()) {
            while (!line.empty() && line.back() == '\\') {
                joined.assign(line.substr(0, line.size() - 1)).push_back(' ');
                const auto more = lines_.next();
                line = joined += without_comment(more.value_or(""));
            }
            words = line;
            next_word(words);
        }
        if (keyword == "v") {
            add_vertex(words);
        } else if (keyword == "f" || keyword == "fo") {
            face(words);
        } else if (keyword == "o") {
            end_object();
            object_name_ = next_word(words);
        } else if (keyword == "g") {
            begin_group(words);
        } else if (std::ranges::find(refused, keyword) != refused.end()) {
            refuse(in_quotes(keyword) +
                   " is not read, only vertices and faces are: export it as triangles");
        } else if (!keyword.empty()) {
            ++ignored_[std::string(keyword.substr(0, 20))];
        }
    }

    /// Notes lines that begin with no word of the format.
    void note_unknown()
    {
        std::size_t lines = 0;
        std::string first;
        for (const auto& [word, count] : ignored_)
            if (std::ranges::find(harmless, word) == harmless.end()) {
                lines += count;
                first = first.empty() ? word : first;
            }
        if (lines > 0)
            file_.reading.surprises.push_back(
                std::to_string(lines) + (lines == 1 ? " line is" : " lines are") +
                " not read, with " + in_quotes(first) + " where a word of OBJ goes");
    }

    /// Returns a line up to a '#' that begins a word.
    static std::string_view without_comment(std::string_view line)
    {
        for (std::size_t at = line.find('#'); at != line.npos; at = line.find('#', at + 1))
            if (at == 0 || line[at - 1] == ' ' || line[at - 1] == '\t')
                return line.substr(0, at);
        return line;
    }

    void face(std::string_view words)
    {
        corners_.clear();
        for (auto word = next_word(words); !word.empty(); word = next_word(words))
            corners_.push_back(corner(word));
        if (corners_.size() < 3)
            refuse("a face takes three corners, and there are " + std::to_string(corners_.size()));
        file_.add_polygon(corners_);
    }

    /// Parses "7", "7/1", "7//1" or "7/1/1". Negative numbers count back from the last vertex so far.
    uint corner(std::string_view word) const
    {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto index = parse_integer(word.substr(0, slash));
        if (!index || word.find_first_not_of("0123456789/-", slash) != word.npos)
            refuse("a corner of a face is no number: " + in_quotes(word));
        const auto seen = static_cast<std::int64_t>(file_.mesh.points.size());
        const std::int64_t absolute = *index < 0 ? seen + *index : *index - 1;
        if (*index == 0 || absolute < 0 || absolute > 0xfffffffe)
            refuse("a face names vertex " + std::to_string(*index) + ", and there are " +
                   std::to_string(seen) + " so far");
        return static_cast<uint>(absolute);
    }

    void end_object()
    {
        file_.add_object(object_name_, first_face_);
        first_face_ = file_.mesh.faces.size();
    }

    /// Begins the group of all names in the line, or goes on with it.
    void begin_group(std::string_view words)
    {
        end_group();
        has_groups_ = true;
        group_name_.clear();
        for (auto word = next_word(words); !word.empty(); word = next_word(words))
            group_name_.append(group_name_.empty() ? "" : " ").append(word);
    }

    /// Puts the faces since the last "g" into its group; those before the first one into "default", as the format says.
    void end_group()
    {
        if (file_.group_of_face.size() == file_.mesh.faces.size())
            return;
        if (group_name_.empty())
            group_name_ = "default";
        const auto [group, is_new] =
            group_numbers_.try_emplace(group_name_, static_cast<uint>(file_.groups.size()));
        if (is_new)
            file_.groups.push_back(group_name_);
        file_.group_of_face.resize(file_.mesh.faces.size(), group->second);
    }

    std::string object_name_, group_name_;
    bool has_groups_ = false;
    std::map<std::string, uint> group_numbers_;
    std::map<std::string, std::size_t> ignored_;  ///< number of lines by their first word
};

}  // namespace

FileMesh read_obj(std::string_view bytes, const std::string& name)
{
    return ObjReader(without_mark(bytes, name), name).read();
}

}  // namespace bvhbench
