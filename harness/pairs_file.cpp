// SPDX-License-Identifier: MIT
#include "harness/pairs_file.h"

#include "geometry/error.h"
#include "harness/result_file.h"

namespace bvhbench {

void check_pairs_path(const std::filesystem::path& path)
{
    if (path.extension() != ".csv" && path.extension() != ".bin")
        throw BadUsage("pairs are written to .csv or .bin, not to '" + path.string() + "'");
}

void write_pairs(const std::filesystem::path& path, const PairList& pairs)
{
    check_pairs_path(path);
    std::string text;
    if (path.extension() == ".bin") {
        text.assign(reinterpret_cast<const char*>(pairs.pairs().data()),
                    pairs.pairs().size_bytes());
    } else {
        text = "a,b\n";
        for (const Pair pair : pairs.pairs())
            text += std::to_string(pair.a) + ',' + std::to_string(pair.b) + '\n';
    }
    write_atomically(path, text);
}

}  // namespace bvhbench
