// SPDX-License-Identifier: MIT
#include "scenes/generate/film.h"

#include <algorithm>

#include "scenes/generate/generators.h"

namespace bvhbench {

void Film::add(std::string name, Mesh mesh, Place place)
{
    actors_.push_back({std::move(name), std::move(mesh), std::move(place)});
}

Scene Film::shoot(uint frames, uint steps, const std::function<void(uint step)>& advance) const
{
    Scene scene;
    Mesh all;
    for (const Actor& actor : actors_) {
        scene.objects.push_back({actor.name, static_cast<uint>(all.faces.size()),
                                 static_cast<uint>(actor.mesh.faces.size())});
        append(all, actor.mesh);
    }
    scene.faces = std::move(all.faces);
    uint made = 0;
    for (std::uint64_t frame = 1; frame <= frames; ++frame) {
        for (const std::uint64_t until = steps * frame / frames; made < until; ++made)
            advance(made);
        std::vector<Point>& now = scene.frames.emplace_back();
        now.reserve(all.points.size());
        for (const Actor& actor : actors_)
            for (const Point& point : actor.mesh.points)
                now.push_back(rounded(actor.place(point)));
    }
    scene.source = "generated";
    return scene;
}

std::vector<uint> even_shares(uint total, uint parts)
{
    const uint unit = total / 2 >= parts ? 2 : 1;
    std::vector<uint> shares(parts);
    std::uint64_t given = 0;
    for (uint k = 0; k < parts; ++k) {
        const std::uint64_t until = std::uint64_t{total / unit} * (k + 1) / parts * unit;
        shares[k] = static_cast<uint>(until - given);
        given = until;
    }
    shares.back() += static_cast<uint>(total - given);
    return shares;
}

uint even_part(uint total, double share, uint rest)
{
    const auto wanted = static_cast<uint>(total * share / 2) * 2;
    return std::clamp<uint>(wanted, 1, total - rest);
}

}  // namespace bvhbench
