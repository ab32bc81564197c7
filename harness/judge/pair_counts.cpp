// SPDX-License-Identifier: MIT
#include "harness/judge/pair_counts.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "geometry/hash.h"

namespace bvhbench {
namespace {

constexpr std::size_t most_shown = 3;

/// Returns the first pairs of `one` that `other` lacks, at most as many as are shown.
std::vector<Pair> first_only_in(const PairList& one, const PairList& other)
{
    std::vector<Pair> found;
    std::ranges::copy_if(one.pairs(), std::back_inserter(found), [&](Pair pair) {
        return found.size() < most_shown && !std::ranges::binary_search(other.pairs(), pair);
    });
    return found;
}

void put_triangle(std::ostream& text, uint face, const Input& input,
                  std::span<const uint> file_faces)
{
    const auto object = std::ranges::upper_bound(input.objects, face, {}, &FaceRange::first);
    const Aabb box = leaf_box(input, input.faces[face]);
    text << (file_faces.empty() ? face : file_faces[face]) << " (object "
         << object - input.objects.begin() - 1 << ", box " << box.min_x << ' ' << box.min_y << ' '
         << box.min_z << " to " << box.max_x << ' ' << box.max_y << ' ' << box.max_z << ')';
}

}  // namespace

std::string facts_text(const PairFacts& facts)
{
    return std::to_string(facts.count) + " pairs of the hash " + hex(facts.high) + hex(facts.low);
}

std::vector<Pair> doubled_pairs(std::vector<Pair>& found)
{
    for (Pair& pair : found)
        if (pair.b < pair.a)
            std::swap(pair.a, pair.b);
    std::ranges::sort(found);
    std::vector<Pair> doubled;
    for (auto at = found.begin(); doubled.size() < most_shown;) {
        at = std::adjacent_find(at, found.end());
        if (at == found.end())
            break;
        doubled.push_back(*at);
        at = std::upper_bound(at, found.end(), *at);
    }
    return doubled;
}

std::string examples(const PairList& found, const PairList& right, std::span<const Pair> doubled,
                     const Input& input, std::span<const uint> file_faces)
{
    const Differences wrong = differences(found, right);
    std::ostringstream text;
    text.precision(9);
    const auto put = [&](const char* kind, std::uint64_t count, std::span<const Pair> some) {
        if (count == 0)
            return;
        text << "; " << count << ' ' << kind;
        for (std::size_t k = 0; k < some.size(); ++k) {
            text << (k == 0 ? ": " : ", ");
            put_triangle(text, some[k].a, input, file_faces);
            text << " and ";
            put_triangle(text, some[k].b, input, file_faces);
        }
    };
    put("missing", wrong.missed, first_only_in(right, found));
    put("extra", wrong.false_ones - found.surplus(), first_only_in(found, right));
    put("found twice", found.surplus(), doubled);
    return text.str();
}

Differences differences(const PairList& found, const PairList& right)
{
    std::uint64_t both = 0;
    auto other = right.pairs().begin();
    for (const Pair pair : found.pairs()) {
        other = std::find_if(other, right.pairs().end(), [&](Pair one) { return one >= pair; });
        both += other != right.pairs().end() && *other == pair ? 1 : 0;
    }
    return {right.size() - both, found.size() - both + found.surplus()};
}

void add_moved_bytes(std::vector<StageTime>& stages, std::string_view stage, std::int64_t bytes)
{
    for (StageTime& time : stages)
        if (time.stage == stage && time.launches > 0)
            time.moved_bytes += bytes;
}

}  // namespace bvhbench
