// SPDX-License-Identifier: MIT
#include "harness/record/pairs_file.h"

#include <algorithm>
#include <charconv>
#include <iterator>

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

PairsFile::PairsFile(const Output& output, bool is_swept, bool has_times)
    : is_csv_(output.path().extension() == ".csv"), is_swept_(is_swept), has_times_(has_times)
{
    if (output.is_nowhere())
        return;
    writer_.emplace(output);
    if (is_csv_)
        writer_->append(!is_swept    ? "frame,object_a,object_b,a,b\n"
                        : !has_times ? "frame,a,b\n"
                                     : "frame,a,b,time\n");
}

std::string PairsFile::lines(std::span<const Pair> pairs, std::span<const float> times,
                             std::size_t frame) const
{
    std::string text;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const Pair pair = pairs[k];
        text += std::to_string(frame) + ',';
        if (!is_swept_)
            text += std::to_string(objects_[pair.a]) + ',' + std::to_string(objects_[pair.b]) + ',';
        text += std::to_string(pair.a) + ',' + std::to_string(pair.b);
        if (has_times_) {
            char digits[32];  // the shortest that are read as the same float
            text += ',';
            text.append(digits, std::to_chars(digits, std::end(digits), times[k]).ptr);
        }
        text += '\n';
    }
    return text;
}

void PairsFile::add(const PairList& pairs, std::size_t frame, const Scene& scene,
                    std::span<const float> times)
{
    if (!writer_)
        return;
    if (!is_csv_) {
        writer_->append(
            {reinterpret_cast<const char*>(pairs.pairs().data()), pairs.pairs().size_bytes()});
        return;
    }
    if (objects_.empty() && !is_swept_)
        objects_ = objects_in_file(scene);
    constexpr std::size_t at_once = 1 << 16;  // about 2 MB of text
    for (std::size_t k = 0; k < pairs.size(); k += at_once) {
        const std::size_t count = std::min(at_once, pairs.size() - k);
        writer_->append(lines(pairs.pairs().subspan(k, count),
                              has_times_ ? times.subspan(k, count) : times, frame));
    }
}

void PairsFile::finish()
{
    if (writer_)
        writer_->finish();
}

}  // namespace bvhbench
