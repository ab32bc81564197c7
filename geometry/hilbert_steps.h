// SPDX-License-Identifier: MIT
//
// The Hilbert curve of geometry/hilbert.h by look-ups, octant by octant from the largest down. Mirrored and with axes exchanged,
// the curve inside an octant is one of 24. State 0 is the whole curve; the octant of a cell gives the next digit of its code and
// the state inside.
#ifndef BVHBENCH_GEOMETRY_HILBERT_STEPS_H
#define BVHBENCH_GEOMETRY_HILBERT_STEPS_H

#include "geometry/dialect.h"

SHARED_BEGIN

#define HILBERT_STATES 24u
#ifdef __OPENCL_C_VERSION__
#define HILBERT_STEPS constant
#else
#define HILBERT_STEPS constexpr
#endif

/// Byte x << 2 | y << 1 | z of a state's word is that octant's step: the next state << 3 | the digit.
HILBERT_STEPS ulong hilbert_steps[HILBERT_STATES] = {
    0x05342e27021b1108ul, 0x0d0a145b56494738ul, 0x150c12736e670130ul, 0x038c504f1a1d817eul,
    0x514e807f22252b94ul, 0x69a0061f2a232d9cul, 0x35324639048b5748ul, 0x3d663a314c6fab00ul,
    0x61423645b8538fb4ul, 0x4d263c2f4a097b10ul, 0x215290430e555f84ul, 0x0b5a745d60b9378eul,
    0x413e6265b0af6bbcul, 0x29986a6316776da4ul, 0x135c7275403fb1aeul, 0x4b68ac077aa17d1eul,
    0xbf5488b3a6851982ul, 0x338a20911c8d0f5eul, 0xa7be188924959b92ul, 0x8778b6a92c939d9aul,
    0xb7a86cbb8679a5a2ul, 0x3b28aa997c17ad76ul, 0x97449eb5588371b2ul, 0x9f9664bd7059a3baul};

/// Returns the step of an octant.
SHARED_FN uint hilbert_step(uint state, uint octant)
{
    return (uint)(hilbert_steps[state] >> 8u * octant) & 0xffu;
}

/// Returns the step of two octants of three bits each, the larger first: the next state << 6 | two digits.
SHARED_FN uint hilbert_two_steps(uint state, uint octants)
{
    const uint first = hilbert_step(state, octants >> 3u);
    const uint second = hilbert_step(first >> 3u, octants & 7u);
    return second >> 3u << 6u | (first & 7u) << 3u | (second & 7u);
}

/// Returns the state that two steps at a time begin in. With an odd number of bits per axis the first octant is 0 and leads to state
/// 0 with digit 0.
SHARED_FN uint hilbert_first_state(uint axis_bits) { return axis_bits % 2u == 0u ? 0u : 7u; }

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(bvhbench::hilbert_step(bvhbench::hilbert_first_state(1), 0) == 0);
#endif
#endif
