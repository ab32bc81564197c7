// SPDX-License-Identifier: MIT
//
// Random models whose triangles are known, and files of every kind that say the same model in other words. Coordinates are multiples
// of 1/4 up to 16, so that floats, decimals and quantised integers hold them.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <string>
#include <vector>

namespace bvhbench {

/// Appends the bytes of a number, in the order of this machine or swapped.
template <class T>
void append(std::string& bytes, T value, bool swapped = false)
{
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (swapped)
        std::reverse(std::begin(raw), std::end(raw));
    bytes.append(raw, sizeof raw);
}

struct Model {
    struct Part {
        std::vector<std::array<double, 3>> points;
        std::vector<std::array<unsigned, 3>> faces;
    };
    std::vector<Part> parts;  ///< objects, which share no vertices
};

/// Random numbers. If it is plain, the first choice is always taken: the spelling that every reader knows.
struct Chance {
    std::mt19937 numbers;
    bool is_plain = false;
};
unsigned below(Chance& chance, unsigned end);

/// Returns a model of one to three parts, each some connected triangles.
Model random_model(Chance& chance);

/// A way to write a model. Every file of a kind is right; `chance` chooses between spellings.
struct Kind {
    const char* name;    ///< ends in the extension
    bool keeps_objects;  ///< whether parts become objects
    bool keeps_sharing;  ///< whether triangles share their vertices as in the model
    bool assimp_reads;   ///< whether assimp reads all of it too
    std::string (*write)(const Model& model, Chance& chance);
};

const std::vector<Kind>& kinds();

}  // namespace bvhbench
