// SPDX-License-Identifier: MIT
// check: -DDIGIT_BITS=10u -DBUCKET_DIGIT_BITS=11u -DCODE_WORDS=1u
// check: -DDIGIT_BITS=8u -DBUCKET_DIGIT_BITS=11u -DCODE_WORDS=2u
//
// A stable radix sort of (code, id) pairs on a few fast cores. Three kernels move pairs by a digit:
//
//     count_chunks    counts[c][d]  occurrences of digit d in chunk c
//     scan_chunks     counts[c][d]  destination of the first pair with digit d of chunk c
//     scatter_chunks  moves the pairs
//
// Few pairs, which fit a cache, are moved by each digit, the lowest first. Many are moved to buckets by the highest digit, and then
// sort_buckets sorts each bucket in a cache, by the lower digits. If the largest bucket holds too many pairs for one work-item, the three
// kernels split it once more, by the next digit.
#include "builders/stages/chunk.clh"
#include "builders/stages/code.clh"

#define MORE_DIGITS (1u << (DIGIT_BITS > BUCKET_DIGIT_BITS ? DIGIT_BITS : BUCKET_DIGIT_BITS))
#define BUCKET_DIGITS (1u << BUCKET_DIGIT_BITS)
#define FEW 32u  // pairs that are sorted by insertion

/// Returns this work-item's share of a range.
static inline Chunk own_share(const Chunk range)
{
    const Chunk own = own_chunk(range.end - range.first);
    const Chunk share = {range.first + own.first, range.first + own.end};
    return share;
}

/// Returns what a launch splits: all pairs, or the largest bucket.
static inline Chunk split_range(global const Chunk* largest, const uint count, const uint is_second)
{
    const Chunk all = {0u, count};
    return is_second != 0u ? *largest : all;
}

/// Writes counts[c][d] of this work-item's chunk c. `mask` is the largest digit.
kernel void count_chunks(global const Code* restrict codes, global uint* restrict counts,
                         global const Chunk* restrict largest, const uint count, const uint shift,
                         const uint mask, const uint is_second)
{
    const Chunk range = split_range(largest, count, is_second);
    if (range.first == range.end)
        return;
    uint histogram[MORE_DIGITS];
    for (uint digit = 0u; digit <= mask; ++digit)
        histogram[digit] = 0u;
    const Chunk chunk = own_share(range);
    for (uint k = chunk.first; k < chunk.end; ++k)
        ++histogram[digit_of(codes[k], shift, mask)];
    global uint* own = counts + get_global_id(0) * (mask + 1u);
    for (uint digit = 0u; digit <= mask; ++digit)
        own[digit] = histogram[digit];
}

/// Computes the exclusive prefix sums of the counts of `chunks` chunks, by one work-item. The first time it writes the largest bucket
/// to `largest`, or an empty one if that has at most `most` pairs.
kernel void scan_chunks(global uint* restrict counts, global Chunk* restrict largest,
                        const uint chunks, const uint mask, const uint most, const uint is_second)
{
    if (is_second != 0u && largest->first == largest->end)
        return;
    uint before = is_second != 0u ? largest->first : 0u;
    Chunk found = {0u, 0u};
    for (uint digit = 0u; digit <= mask; ++digit) {
        const uint first = before;
        for (uint chunk = 0u; chunk < chunks; ++chunk) {
            const uint own = counts[chunk * (mask + 1u) + digit];
            counts[chunk * (mask + 1u) + digit] = before;
            before += own;
        }
        if (before - first > found.end - found.first) {
            found.first = first;
            found.end = before;
        }
    }
    if (is_second != 0u)
        return;
    const uint is_large = found.end - found.first > most ? 1u : 0u;
    largest->first = is_large * found.first;
    largest->end = is_large * found.end;
}

/// Moves every pair to its destination. In the first pass, ids are the pairs' positions and `ids_in` is not read.
kernel void scatter_chunks(global const Code* restrict codes_in, global const uint* restrict ids_in,
                           global Code* restrict codes_out, global uint* restrict ids_out,
                           global const uint* restrict counts, global const Chunk* restrict largest,
                           const uint count, const uint shift, const uint mask,
                           const uint is_second, const uint is_first_pass)
{
    const Chunk range = split_range(largest, count, is_second);
    if (range.first == range.end)
        return;
    uint places[MORE_DIGITS];
    for (uint digit = 0u; digit <= mask; ++digit)
        places[digit] = counts[get_global_id(0) * (mask + 1u) + digit];
    const Chunk chunk = own_share(range);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Code code = codes_in[k];
        const uint to = places[digit_of(code, shift, mask)]++;
        codes_out[to] = code;
        ids_out[to] = is_first_pass != 0u ? k : ids_in[k];
    }
}

/// Sorts few pairs by insertion, from one pair of arrays to another or within one.
static inline void insert_pairs(global const Code* codes, global const uint* ids,
                                global Code* codes_out, global uint* ids_out, const Chunk bucket)
{
    for (uint k = bucket.first; k < bucket.end; ++k) {
        const Code code = codes[k];
        const uint id = ids[k];
        uint to = k;
        for (; to > bucket.first && codes_out[to - 1u] > code; --to) {
            codes_out[to] = codes_out[to - 1u];
            ids_out[to] = ids_out[to - 1u];
        }
        codes_out[to] = code;
        ids_out[to] = id;
    }
}

/// Moves the pairs of a bucket from one pair of arrays to the same range of another, by one digit.
static inline void move_by_digit(global const Code* restrict codes_in,
                                 global const uint* restrict ids_in,
                                 global Code* restrict codes_out, global uint* restrict ids_out,
                                 const Chunk bucket, const uint shift, const uint mask)
{
    uint places[BUCKET_DIGITS];
    for (uint digit = 0u; digit <= mask; ++digit)
        places[digit] = 0u;
    for (uint k = bucket.first; k < bucket.end; ++k)
        ++places[digit_of(codes_in[k], shift, mask)];
    for (uint digit = 0u, before = bucket.first; digit <= mask; ++digit) {
        const uint own = places[digit];
        places[digit] = before;
        before += own;
    }
    for (uint k = bucket.first; k < bucket.end; ++k) {
        const Code code = codes_in[k];
        const uint to = places[digit_of(code, shift, mask)]++;
        codes_out[to] = code;
        ids_out[to] = ids_in[k];
    }
}

/// Sorts a bucket by `passes` digits of `bits` bits, the lowest first. The arrays take turns; the bucket begins in the first.
static inline void sort_bucket(global Code* codes, global uint* ids, global Code* other_codes,
                               global uint* other_ids, const Chunk bucket, const uint passes,
                               const uint bits)
{
    const uint size = bucket.end - bucket.first;
    if (size <= FEW) {
        const uint moves = passes & 1u;
        insert_pairs(codes, ids, moves ? other_codes : codes, moves ? other_ids : ids, bucket);
        return;
    }
    for (uint pass = 0u; pass < passes; ++pass) {
        const uint back = pass & 1u;
        move_by_digit(back ? other_codes : codes, back ? other_ids : ids,
                      back ? codes : other_codes, back ? ids : other_ids, bucket, pass * bits,
                      (1u << bits) - 1u);
    }
}

/// Sorts the buckets of `count` pairs, which are in `codes` and `ids`, and those of the largest, which are in the other arrays.
/// `begins` and `more_begins` have the buckets' beginnings of each split, up to the digits `mask` and `more_mask`; below these digits
/// `passes` and `passes` - 1 digits of `bits` bits are left.
kernel void sort_buckets(global Code* codes, global uint* ids, global Code* other_codes,
                         global uint* other_ids, global const uint* restrict begins,
                         global const uint* restrict more_begins,
                         global const Chunk* restrict largest, const uint count, const uint mask,
                         const uint more_mask, const uint passes, const uint bits)
{
    const uint step = (uint)get_global_size(0);
    const Chunk large = *largest;
    for (uint digit = (uint)get_global_id(0); digit <= mask; digit += step) {
        const Chunk bucket = {begins[digit], digit < mask ? begins[digit + 1u] : count};
        if (bucket.end != large.end || bucket.first == bucket.end)
            sort_bucket(codes, ids, other_codes, other_ids, bucket, passes, bits);
    }
    if (large.first == large.end)
        return;
    for (uint digit = (uint)get_global_id(0); digit <= more_mask; digit += step) {
        const Chunk bucket = {more_begins[digit],
                              digit < more_mask ? more_begins[digit + 1u] : large.end};
        sort_bucket(other_codes, other_ids, codes, ids, bucket, passes - 1u, bits);
    }
}
