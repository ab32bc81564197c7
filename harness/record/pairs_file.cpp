// SPDX-License-Identifier: MIT
#include "harness/record/pairs_file.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <utility>
#include <vector>

#include "collide/narrow/narrow.h"
#include "collide/within/closest.h"
#include "geometry/cores.h"
#include "geometry/error.h"
#include "scenes/face_order.h"

namespace bvhbench {

void check_pairs_path(const std::filesystem::path& path, const FrameRange& frames)
{
    if (path.extension() != ".csv" && path.extension() != ".bin")
        throw BadUsage("pairs are written to .csv or .bin, not to '" + path.string() + "'");
    if (path.extension() == ".bin" && frames.end != frames.first + 1)
        throw BadUsage("'" + path.string() +
                       "' would hold the pairs of several frames: choose one by --frames, or .csv");
}

PairsFile::PairsFile(const Output& output, bool of_features, With with)
    : is_csv_(output.path().extension() == ".csv"), of_features_(of_features), with_(with)
{
    if (output.is_nowhere())
        return;
    writer_.emplace(output);
    if (!is_csv_)
        return;
    writer_->append(of_features ? "frame,a,b" : "frame,object_a,object_b,a,b");
    writer_->append(with == With::times       ? ",time\n"
                    : with == With::distances ? ",distance,ax,ay,az,bx,by,bz\n"
                                              : "\n");
}

std::string PairsFile::lines(std::span<const Pair> pairs, std::span<const float> times,
                             std::span<const Point> points, std::size_t frame) const
{
    std::string text;
    const auto put = [&text](auto number) {
        char digits[32];  // the shortest that are read as the same number
        text += ',';
        text.append(digits, std::to_chars(digits, std::end(digits), number).ptr);
    };
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const Pair pair = pairs[k];
        text += std::to_string(frame);
        if (!of_features_) {
            put(objects_[pair.a]);
            put(objects_[pair.b]);
        }
        put(pair.a);
        put(pair.b);
        if (with_ == With::times)
            put(times[k]);
        if (with_ == With::distances) {
            const Closest closest = closest_points(corners_of(points, faces_[pair.a]),
                                                   corners_of(points, faces_[pair.b]));
            put(closest.distance);
            for (const Vector at : {closest.a, closest.b})
                for (const double coordinate : {at.x, at.y, at.z})
                    put(coordinate);
        }
        text += '\n';
    }
    return text;
}

void PairsFile::add(const PairList& pairs, std::size_t frame, const Scene& scene,
                    std::span<const float> times, std::span<const Face> features)
{
    if (!writer_)
        return;
    if (!is_csv_) {
        writer_->append(
            {reinterpret_cast<const char*>(pairs.pairs().data()), pairs.pairs().size_bytes()});
        return;
    }
    if (std::exchange(scene_, &scene) != &scene) {
        if (!of_features_)
            objects_ = objects_in_file(scene);
        if (with_ == With::distances)
            faces_ =
                of_features_ ? std::vector(features.begin(), features.end()) : faces_in_file(scene);
    }
    std::span<const Point> points;
    if (with_ == With::distances)
        points = scene.frames[scene.frames.size() > 1 ? frame : 0];
    constexpr std::size_t of_part = 1 << 12, parts_at_once = 16;  // about 2 MB of text, or 10
    for (std::size_t first = 0; first < pairs.size(); first += of_part * parts_at_once) {
        std::vector<std::string> parts(parts_at_once);
        on_all_cores(parts.size(), [&](std::size_t part) {
            const std::size_t begin = std::min(pairs.size(), first + part * of_part);
            const std::size_t count = std::min(of_part, pairs.size() - begin);
            parts[part] =
                lines(pairs.pairs().subspan(begin, count),
                      with_ == With::times ? times.subspan(begin, count) : times, points, frame);
        });
        for (const std::string& part : parts)
            writer_->append(part);
    }
}

void PairsFile::finish()
{
    if (writer_)
        writer_->finish();
}

}  // namespace bvhbench
