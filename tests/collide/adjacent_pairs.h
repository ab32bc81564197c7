// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <utility>

#include "scenes/generate/pair_classes.h"

namespace bvhbench {

/// Pairs of a class, with one to three indices of each second face, at any corners, those of the first; now and then an
/// index twice in a face.
inline Mesh adjacent_pairs(const PairClass& of, uint count)
{
    Mesh mesh = apart_pairs(of, count, count);
    Dice dice(count + 1);
    for (uint k = 0; k < count; ++k) {
        const uint place = 6 * k;
        std::array<uint, 3> first = {place, place + 1, place + 2};
        std::array<uint, 3> second = {place + 3, place + 4, place + 5};
        const uint shared = dice.below(8) == 0 ? 3 : 1 + dice.below(2), turn = dice.below(3);
        for (uint s = 0; s < shared; ++s)
            second[(s + turn) % 3] = first[s];
        if (dice.below(2) == 0)
            std::swap(second[0], second[1]);
        if (dice.below(16) == 0)
            first[dice.below(3)] = first[dice.below(3)];
        if (dice.below(16) == 0)
            second[dice.below(3)] = second[dice.below(3)];
        std::swap(first[0], first[dice.below(3)]);
        mesh.faces[2 * k] = {first[0], first[1], first[2]};
        mesh.faces[2 * k + 1] = {second[0], second[1], second[2]};
    }
    return mesh;
}

}  // namespace bvhbench
