// SPDX-License-Identifier: MIT
#include "scenes/ground_truth.h"

#include <algorithm>
#include <functional>

#include "geometry/error.h"
#include "scenes/face_order.h"
#include "scenes/formats/text.h"
#include "scenes/sequence.h"

namespace bvhbench {
namespace {

/// A file of lines of comma-separated whole numbers from 0. The last number of a line is 0 or 1.
class PairLines {
public:
    /// One of the numbers before the last: what it is an index of, and its exclusive upper limit.
    struct Column {
        const char* of;
        std::size_t end;
    };

    PairLines(const std::filesystem::path& path, std::vector<Column> columns)
        : path_(path), columns_(std::move(columns))
    {}

    std::uint64_t listed() const { return listed_; }
    std::uint64_t colliding() const { return colliding_; }

    /// Adds to `all` the pair that `pair` makes of the numbers of each line, and to `touching` if it collides. A missing file has
    /// no lines.
    void read(const std::function<std::array<uint, 2>(std::span<const uint>)>& pair,
              GroundTruth::Pairs& all, GroundTruth::Pairs& touching)
    {
        if (!std::filesystem::exists(path_))
            return;
        const std::string bytes = file_bytes(path_);
        Lines lines(bytes);
        std::vector<uint> numbers(columns_.size());
        while (const auto line = lines.next()) {
            line_ = lines.number();
            const bool collides = parse(*line, numbers);
            all.push_back(pair(numbers));
            if (collides)
                touching.push_back(all.back());
        }
    }

    /// Throws Unavailable if a count of meta.json differs from the count found.
    void expect(const char* what, std::optional<std::uint64_t> said, std::uint64_t found) const
    {
        if (said && *said != found)
            throw Unavailable(path_.string() + " has " + std::to_string(found) + ' ' + what +
                              ", and meta.json beside it says " + std::to_string(*said));
    }

    [[noreturn]] void refuse(const std::string& why) const
    {
        throw Unavailable(path_.string() + " line " + std::to_string(line_) + ": " + why);
    }

private:
    /// Returns whether the pair collides.
    bool parse(std::string_view line, std::vector<uint>& numbers)
    {
        const auto fields = 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
        if (fields != columns_.size() + 1)
            refuse("there are " + std::to_string(fields) + " numbers where " +
                   std::to_string(columns_.size() + 1) + " go: " + in_quotes(line));
        const auto next = [&](const char* of, std::size_t end) {
            const std::size_t comma = std::min(line.find(','), line.size());
            const std::string_view word = line.substr(0, comma);
            line.remove_prefix(std::min(comma + 1, line.size()));
            const auto number = parse_integer(word);
            if (!number || *number < 0 || static_cast<std::uint64_t>(*number) >= end)
                refuse(in_quotes(word) + " is no " + of + ", which are 0 to " +
                       std::to_string(end - 1));
            return static_cast<uint>(*number);
        };
        for (std::size_t k = 0; k < columns_.size(); ++k)
            numbers[k] = next(columns_[k].of, columns_[k].end);
        ++listed_;
        const bool collides = next("verdict on a collision", 2) == 1;
        colliding_ += collides ? 1 : 0;
        return collides;
    }

    std::filesystem::path path_;
    std::vector<Column> columns_;
    std::size_t line_ = 0;
    std::uint64_t listed_ = 0, colliding_ = 0;
};

/// Returns the only step of a scene of two frames. Without `ccd` in meta.json, only such a scene is unambiguous.
std::size_t only_step(const Scene& scene)
{
    if (scene.frames.size() != 2)
        throw Unavailable(scene.folder.string() +
                          " lists pairs that collide, and no 'ccd' in meta.json says between which "
                          "of its " +
                          std::to_string(scene.frames.size()) + " frames");
    return 0;
}

}  // namespace

SweptParts vertices_and_faces(const Scene& scene)
{
    const auto vertices = static_cast<uint>(scene.frames.front().size());
    SweptParts parts{{}, {{0, vertices}, {vertices, scene.triangle_count()}}};
    parts.faces.reserve(vertices + scene.faces.size());
    for (uint vertex = 0; vertex < vertices; ++vertex)
        parts.faces.push_back({vertex, vertex, vertex});
    const std::vector<Face> faces = faces_in_file(scene);
    parts.faces.insert(parts.faces.end(), faces.begin(), faces.end());
    return parts;
}

SweptParts unique_edges(const Scene& scene)
{
    std::vector<std::pair<uint, uint>> edges;  // larger vertex first, the order of sorting
    edges.reserve(3 * scene.faces.size());
    for (const Face& face : scene.faces)
        for (const auto& [a, b] :
             {std::pair(face.a, face.b), std::pair(face.b, face.c), std::pair(face.c, face.a)})
            if (a != b)
                edges.emplace_back(std::max(a, b), std::min(a, b));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    SweptParts parts;
    parts.faces.reserve(edges.size());
    for (const auto& [larger, smaller] : edges)
        parts.faces.push_back({smaller, larger, larger});
    parts.objects = {{0, static_cast<uint>(parts.faces.size())}};
    return parts;
}

std::optional<uint> place_of_edge(const SweptParts& unique_edges, uint a, uint b)
{
    const auto key = [](const Face& edge) { return std::pair(edge.b, edge.a); };
    const std::pair<uint, uint> wanted(std::max(a, b), std::min(a, b));
    const std::vector<Face>& edges = unique_edges.faces;
    const auto found = std::lower_bound(
        edges.begin(), edges.end(), wanted,
        [&](const Face& edge, const std::pair<uint, uint>& other) { return key(edge) < other; });
    if (found == edges.end() || key(*found) != wanted)
        return std::nullopt;
    return static_cast<uint>(found - edges.begin());
}

std::optional<GroundTruth> ground_truth_of(const Scene& scene, const SweptParts& edges)
{
    if (scene.folder.empty())
        return std::nullopt;
    const std::optional<StepFacts> said = step_facts(scene, scene.folder / "meta.json");
    const std::filesystem::path vf = scene.folder / "gt_vf.csv", ee = scene.folder / "gt_ee.csv";
    if (!said && !std::filesystem::exists(vf) && !std::filesystem::exists(ee))
        return std::nullopt;
    const StepFacts facts = said.value_or(StepFacts{});
    GroundTruth truth{.from_frame = said ? said->from_frame : only_step(scene),
                      .vertex_face = {},
                      .edge_edge = {},
                      .touching_vertex_face = {},
                      .touching_edge_edge = {},
                      .swept_vertex_face = facts.swept_vf,
                      .swept_edge_edge = facts.swept_ee};

    const std::size_t vertices = scene.frames.front().size();
    PairLines of_vertices(vf, {{"vertex", vertices}, {"face", scene.faces.size()}});
    of_vertices.read(
        [&](std::span<const uint> n) {
            return std::array{n[0], static_cast<uint>(vertices) + n[1]};
        },
        truth.vertex_face, truth.touching_vertex_face);
    of_vertices.expect("pairs", facts.vf_listed, of_vertices.listed());
    of_vertices.expect("pairs that collide", facts.vf_true, of_vertices.colliding());

    PairLines of_edges(ee, std::vector(4, PairLines::Column{"vertex", vertices}));
    const auto edge = [&](uint a, uint b) {
        const std::optional<uint> place = place_of_edge(edges, a, b);
        if (!place)
            of_edges.refuse("there is no edge from " + std::to_string(a) + " to " +
                            std::to_string(b));
        return *place;
    };
    of_edges.read(
        [&](std::span<const uint> n) {
            return std::array{edge(n[0], n[1]), edge(n[2], n[3])};
        },
        truth.edge_edge, truth.touching_edge_edge);
    of_edges.expect("pairs", facts.ee_listed, of_edges.listed());
    of_edges.expect("pairs that collide", facts.ee_true, of_edges.colliding());
    return truth;
}

}  // namespace bvhbench
