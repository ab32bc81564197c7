// SPDX-License-Identifier: MIT
#include "builders/stages/sort/word_passes.h"

namespace bvhbench {
namespace {

using enum WordPass::IfRuns;
using Reads = WordPass::Reads;
using Writes = WordPass::Writes;

}  // namespace

std::vector<WordPass> narrowing_passes(uint bits, uint digit_bits, uint id_bits)
{
    const uint passes = divided_up(bits, digit_bits);
    uint narrow = 1;
    while (narrow < passes && bits - narrow * digit_bits + id_bits > 32)
        ++narrow;
    const auto size = [&](uint pass) { return pass == 0 || pass >= narrow ? 1u : 2u; };
    std::vector<WordPass> list;
    for (uint pass = 0; pass < passes; ++pass) {
        const bool ends = pass + 1 == passes, is_narrow = pass >= narrow;
        list.push_back({pass, is_narrow ? narrow : 0, pass == 0 ? Reads::codes : Reads::words,
                        ends                 ? Writes::ids
                        : pass + 1 == narrow ? Writes::narrowed_words
                                             : Writes::words,
                        are_of_any_length, is_narrow, size(pass) + (ends ? 1 : size(pass + 1))});
    }
    return list;
}

std::vector<WordPass> passes_of_parts(uint passes)
{
    const uint low = passes - high_passes;
    std::vector<WordPass> list;
    for (uint pass = low; pass < passes; ++pass)
        list.push_back({pass, low, pass == low ? Reads::high_parts : Reads::words, Writes::words,
                        are_short, false, 4});
    for (uint pass = 0; pass < passes; ++pass)
        list.push_back({pass, pass < low ? 0 : low, pass == 0 ? Reads::low_parts : Reads::words,
                        pass + 1 == passes ? Writes::ids
                        : pass + 1 == low  ? Writes::high_parts
                                           : Writes::words,
                        are_long, false, 0});
    return list;
}

}  // namespace bvhbench
