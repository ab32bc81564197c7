// SPDX-License-Identifier: MIT
#include "scenes/generated.h"

#include <string>

#include "geometry/error.h"
#include "geometry/names.h"
#include "scenes/counts.h"
#include "scenes/formats/text.h"
#include "scenes/generate/generators.h"

namespace bvhbench {
namespace {

/// Makes the scene of a generator. `rest` is "N", or "N:F" for moving scenes.
Scene made(std::string_view text, const Generator& generator, std::string_view rest)
{
    const std::size_t colon = generator.moves ? rest.find(':') : rest.npos;
    const uint count = triangle_count(text, rest.substr(0, colon), generator.most);
    if (count < generator.least)
        throw BadUsage("scene " + in_quotes(text) + " has too few triangles: there must be " +
                       std::to_string(generator.least) + " at least, one for each object");
    const uint frames = colon == rest.npos ? generator.usual_frames
                                           : count_in(text, rest.substr(colon + 1),
                                                      "number of frames", generator.most_frames);
    const std::uint64_t bytes_each =
        generator.bytes_a_triangle + std::uint64_t{generator.bytes_a_frame} * frames;
    require_memory(text, count * bytes_each);
    Scene scene = generator.make(count, frames);
    scene.has_meshes = generator.moves;
    return scene;
}

/// The counts in the name of a crowd, "W:B" or "W:B:F".
struct CrowdCounts {
    uint objects, each, frames;
};

CrowdCounts crowd_counts(std::string_view text, std::string_view rest)
{
    const NameParts first(rest), second(first.rest);
    const auto count = [&](std::string_view number, const char* what) {
        return count_in(text, number, what, CrowdGenerator::most_triangles);
    };
    const CrowdCounts counts = {
        count(first.head, "number of objects"), count(second.head, "number of triangles an object"),
        second.head.size() == first.rest.size()
            ? 1
            : count_in(text, second.rest, "number of frames", Generator::most_frames)};
    if (std::uint64_t{counts.objects} * counts.each > CrowdGenerator::most_triangles)
        throw BadUsage("scene " + in_quotes(text) + " has more than " +
                       std::to_string(CrowdGenerator::most_triangles) + " triangles");
    return counts;
}

Scene made(std::string_view text, const CrowdGenerator& generator, std::string_view rest)
{
    const auto [objects, each, frames] = crowd_counts(text, rest);
    const std::uint64_t bytes_each =
        generator.bytes_a_triangle + std::uint64_t{generator.bytes_a_frame} * frames;
    require_memory(text, std::uint64_t{objects} * each * bytes_each);
    Scene scene = generator.make(objects, each, frames);
    scene.has_meshes = true;
    return scene;
}

}  // namespace

bool is_generated(std::string_view text)
{
    const std::string_view name = NameParts(text).head;
    return generator_called(name) != nullptr || crowd_generator_called(name) != nullptr;
}

std::optional<Scene> generated(std::string_view text)
{
    const NameParts parts(text);
    if (const Generator* const generator = generator_called(parts.head))
        return made(text, *generator, parts.rest);
    if (const CrowdGenerator* const generator = crowd_generator_called(parts.head))
        return made(text, *generator, parts.rest);
    return std::nullopt;
}

std::optional<std::size_t> generated_triangles(std::string_view text)
{
    const NameParts parts(text);
    if (const Generator* const generator = generator_called(parts.head)) {
        const std::size_t colon = generator->moves ? parts.rest.find(':') : parts.rest.npos;
        return triangle_count(text, parts.rest.substr(0, colon), generator->most);
    }
    if (crowd_generator_called(parts.head) == nullptr)
        return std::nullopt;
    const CrowdCounts counts = crowd_counts(text, parts.rest);
    return std::size_t{counts.objects} * counts.each;
}

}  // namespace bvhbench
