// SPDX-License-Identifier: MIT
#include "harness/pairs_file.h"

#include "geometry/error.h"

namespace bvhbench {

void check_pairs_path(const std::filesystem::path& path)
{
    if (path.extension() != ".csv" && path.extension() != ".bin")
        throw BadUsage("pairs are written to .csv or .bin, not to '" + path.string() + "'");
}

void write_pairs(const Output& output, const PairList& pairs)
{
    std::string text;
    if (output.path().extension() == ".bin") {
        text.assign(reinterpret_cast<const char*>(pairs.pairs().data()),
                    pairs.pairs().size_bytes());
    } else {
        text = "a,b\n";
        for (const Pair pair : pairs.pairs())
            text += std::to_string(pair.a) + ',' + std::to_string(pair.b) + '\n';
    }
    output.replace(text);
}

}  // namespace bvhbench
