#!/bin/sh
# Usage: oclgrind.sh <log> <GoogleTest program> <filter>
#
# Run some tests on a simulated device that checks every access and barrier. oclgrind exits with 0 whatever
# it finds, so what counts is an empty log and the words of GoogleTest. It lacks a function that clang adds where it inlines one that
# returns a struct, so nothing is inlined.
set -eu
export BVHBENCH_TESTS="${BVHBENCH_TESTS:-few}"  # tests/all_cases.h
log=$1
rm -f "$log"
output=$(oclgrind --build-options "-fno-inline -Dalways_inline=unused" --log "$log" "$2" --gtest_filter="$3" 2>&1) || true
if [ -s "$log" ] || ! printf '%s' "$output" | grep -q 'PASSED  \] [1-9]' ||
    printf '%s' "$output" | grep -q 'FAILED'; then
    printf '%s\n' "$output"
    [ ! -f "$log" ] || cat "$log"
    exit 1
fi
