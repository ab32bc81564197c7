// SPDX-License-Identifier: MIT
#include "scenes/moving_queries.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "geometry/error.h"
#include "geometry/triangle.h"
#include "scenes/formats/text.h"
#include "scenes/mesh_file.h"

namespace bvhbench {
namespace {

constexpr std::string_view vertex_face = "vertex-face", edge_edge = "edge-edge";

/// Returns the double that a whole number is exactly.
std::optional<double> whole(std::string_view word)
{
    const auto number = parse_number(word);
    std::array<char, 400> digits{};
    if (!number || !std::isfinite(number->wide))
        return std::nullopt;
    const auto printed = std::to_chars(digits.data(), digits.data() + digits.size(), number->wide,
                                       std::chars_format::fixed, 0);
    const std::string_view again(digits.data(),
                                 static_cast<std::size_t>(printed.ptr - digits.data()));
    return again == word ? std::optional(number->wide) : std::nullopt;
}

/// Returns the double that the quotient of a whole number and a power of two is exactly.
std::optional<double> quotient(std::string_view numerator, std::string_view denominator)
{
    const auto n = whole(numerator), d = whole(denominator);
    int exponent = 0;
    if (!n || !d || std::frexp(*d, &exponent) != 0.5)
        return std::nullopt;
    const double q = *n / *d;
    return q * *d == *n ? std::optional(q) : std::nullopt;
}

/// Returns the kind of a file's queries; empty if its name says none.
std::string_view kind_of(const std::filesystem::path& path)
{
    const std::string folder = path.parent_path().filename().string(), stem = path.stem().string();
    const auto ends_in = [&](std::string_view two) {
        return stem.ends_with(two) &&
               (stem.size() == 2 ||
                std::isalpha(static_cast<unsigned char>(stem[stem.size() - 3])) == 0);
    };
    if (folder == edge_edge || ends_in("ee"))
        return edge_edge;
    return folder == vertex_face || ends_in("vf") ? vertex_face : "";
}

/// Returns the name of a file's queries without their kind: of its folder, or the file's.
std::string name_of(const std::filesystem::path& path)
{
    const std::filesystem::path folder = path.parent_path();
    if (folder.filename() == kind_of(path))
        return folder.parent_path().filename().string();
    std::string name = path.stem().string();
    name.resize(name.size() - 2);
    if (const std::size_t at = name.find("_queries_"); at != name.npos)
        name.replace(at, 9, " ");
    return name;
}

/// Reads the lines of one file.
class QueryLines {
public:
    explicit QueryLines(const std::filesystem::path& path)
        : path_(path), bytes_(file_bytes(path, 4)), lines_(bytes_)
    {}

    void read(std::vector<MovingQuery>& queries, std::vector<char>& published)
    {
        const bool of_edges = kind_of(path_) == edge_edge;
        std::vector<std::string_view> eight;
        while (const auto line = lines_.next()) {
            eight.push_back(*line);
            const std::size_t k = eight.size() - 1;
            if (k == 0)
                queries.push_back({.from = {}, .to = {}, .of_edges = of_edges});
            const std::optional<bool> touches =
                take(*line, (k < 4 ? queries.back().from : queries.back().to).at(k % 4));
            if (touches && k == 0)
                published.push_back(*touches ? 1 : 0);
            if (touches && *touches != (published.back() != 0))
                refuse("the seventh number is another than in the query's first line");
            if (k == 7)
                eight.clear();
        }
        if (!eight.empty())
            refuse("the last query has " + std::to_string(eight.size()) + " of 8 lines");
    }

private:
    /// Returns the seventh number, if there is one.
    std::optional<bool> take(std::string_view line, WidePoint& point)
    {
        std::vector<std::string_view> words;
        for (std::size_t begin = 0, end = 0; end != line.npos; begin = end + 1) {
            end = line.find(',', begin);
            words.push_back(line.substr(begin, end - begin));
        }
        if (words.size() != 6 && words.size() != 7)
            refuse("there are " + std::to_string(words.size()) + " numbers, not 6 or 7");
        if (numbers_ == 0)
            numbers_ = words.size();
        if (words.size() != numbers_)
            refuse("there are " + std::to_string(words.size()) + " numbers, and " +
                   std::to_string(numbers_) + " in the lines before");
        double* const coordinates[] = {&point.x, &point.y, &point.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto value = quotient(words[2 * axis], words[2 * axis + 1]);
            if (!value)
                refuse(in_quotes(std::string(words[2 * axis]) + '/' +
                                 std::string(words[2 * axis + 1])) +
                       " is no double: a whole number divided by a power of two");
            *coordinates[axis] = *value;
        }
        if (words.size() == 6)
            return std::nullopt;
        if (words[6] != "0" && words[6] != "1")
            refuse("the seventh number is " + in_quotes(words[6]) + ", not 0 or 1");
        return words[6] == "1";
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw Unavailable(path_.string() + " line " + std::to_string(lines_.number()) + ": " + why);
    }

    const std::filesystem::path& path_;
    std::string bytes_;
    Lines lines_;
    std::size_t numbers_ = 0;  ///< of each line; 0: none was read
};

/// Returns what the folder `truth` beside the file says of its queries; nothing if there is no such file.
std::vector<char> published_beside(const std::filesystem::path& path, std::size_t count)
{
    std::string name = path.stem().string();
    if (const std::size_t at = name.find("_queries"); at != name.npos)
        name.erase(at, 8);
    const std::filesystem::path truth = path.parent_path() / "truth" / (name + ".json");
    if (!std::filesystem::exists(truth))
        return {};
    const auto json = nlohmann::json::parse(file_bytes(truth), nullptr, false);
    const auto is_answer = [](const nlohmann::json& one) { return one.is_boolean(); };
    if (!json.is_array() || json.size() != count || !std::ranges::all_of(json, is_answer))
        throw Unavailable(truth.string() + ": this is no list of " + std::to_string(count) +
                          " times true or false");
    std::vector<char> published;
    for (const bool one : json)
        published.push_back(one ? 1 : 0);
    return published;
}

bool is_of_floats(const MovingQuery& query)
{
    return std::ranges::all_of(std::array{query.from, query.to}, [](const auto& points) {
        return std::ranges::all_of(points, [](const WidePoint& p) {
            const auto is_float = [](double x) { return double{static_cast<float>(x)} == x; };
            return is_float(p.x) && is_float(p.y) && is_float(p.z);
        });
    });
}

/// Returns the .csv files under a folder whose names say a kind, in order; of a file, that file.
std::vector<std::filesystem::path> files_under(const std::filesystem::path& path)
{
    if (!std::filesystem::is_directory(path)) {
        if (kind_of(path).empty())
            throw Unavailable(path.string() +
                              ": the name of a file of queries ends in vf.csv or ee.csv, or its "
                              "folder's is vertex-face or edge-edge");
        return {path};
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
        if (entry.path().extension() == ".csv" && !kind_of(entry.path()).empty())
            files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

}  // namespace

Aabb QuerySet::box() const
{
    Aabb around = empty_box();
    for (const MovingQuery& query : queries)
        for (const WidePoint& p : query.from) {
            const Point at = {static_cast<float>(p.x), static_cast<float>(p.y),
                              static_cast<float>(p.z)};
            around = merged(around, triangle_box(at, at, at));
        }
    return around;
}

std::vector<QuerySet> read_queries(const std::filesystem::path& path)
{
    std::map<std::string, QuerySet> sets;
    for (const std::filesystem::path& file : files_under(path)) {
        std::vector<MovingQuery> queries;
        std::vector<char> published;
        QueryLines(file).read(queries, published);
        if (published.empty())
            published = published_beside(file, queries.size());
        const std::string name = name_of(file) + '/' + std::string(kind_of(file));
        for (std::size_t k = 0; k < queries.size(); ++k) {
            const std::string own = name + (is_of_floats(queries[k]) ? " floats" : "");
            QuerySet& set = sets.try_emplace(own, QuerySet{own, {}, {}}).first->second;
            if (!published.empty() && set.published.size() == set.queries.size())
                set.published.push_back(published[k]);
            set.queries.push_back(queries[k]);
        }
    }
    std::vector<QuerySet> all;
    for (auto& [name, set] : sets) {
        if (set.published.size() != set.queries.size())
            set.published.clear();
        all.push_back(std::move(set));
    }
    if (all.empty())
        throw Unavailable(path.string() + ": there are no files of queries");
    return all;
}

}  // namespace bvhbench
