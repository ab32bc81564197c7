// SPDX-License-Identifier: MIT
//
// A hash of a set of pairs that does not depend on their order, so that it needs no sort.
#ifndef BVHBENCH_COLLIDE_SET_HASH_H
#define BVHBENCH_COLLIDE_SET_HASH_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// Two independent 64-bit hashes of each pair, added up modulo 2^64. A pair that occurs twice counts twice.
typedef struct {
    ulong low, high;
} SetHash;

/// Mixes 64 bits, one to one; `first` and `second` are odd.
SHARED_FN_INLINED ulong mixed_word(ulong word, ulong first, ulong second)
{
    word = (word ^ (word >> 30u)) * first;
    word = (word ^ (word >> 27u)) * second;
    return word ^ (word >> 31u);
}

/// Returns the hash of a set with the pair a, b as well; either id may be the smaller one.
SHARED_FN_INLINED SetHash with_pair(SetHash set, uint a, uint b)
{
    const uint small = a < b ? a : b, large = a < b ? b : a;
    const ulong pair = ((ulong)small << 32u) | large;
    set.low += mixed_word(pair + 0x9e3779b97f4a7c15ul, 0xbf58476d1ce4e5b9ul, 0x94d049bb133111ebul);
    set.high += mixed_word(pair ^ 0xd1b54a32d192ed03ul, 0xff51afd7ed558ccdul, 0xc4ceb9fe1a85ec53ul);
    return set;
}

/// Returns the hash of two disjoint sets together.
SHARED_FN_INLINED SetHash both_sets(SetHash a, SetHash b)
{
    a.low += b.low;
    a.high += b.high;
    return a;
}

SHARED_END

#endif
