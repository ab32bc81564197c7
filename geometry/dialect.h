// SPDX-License-Identifier: MIT
//
// Common subset of C++20 and OpenCL C 1.2.
//
// A header that includes this one is compiled twice: as constexpr C++ by the host compiler, and as OpenCL C by the device
// compiler. It may use uint, ulong, floats, plain structs passed by value, and the names below. It may not use pointers,
// references, overloads or templates. Doubles are allowed behind #if HAS_DOUBLES, because not every device has them.
// SHARED_FN_INLINED is for short functions that run for every item: drivers need not inline others, and PoCL does not.
#ifndef BVHBENCH_GEOMETRY_DIALECT_H
#define BVHBENCH_GEOMETRY_DIALECT_H

#ifdef __OPENCL_C_VERSION__

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FN static inline __attribute__((unused))
#define SHARED_FN_INLINED static inline __attribute__((unused, always_inline))

// A fused multiply-add rounds once where the host rounds twice. Boxes and codes are compared bit for bit.
#pragma OPENCL FP_CONTRACT OFF

#ifdef cl_khr_fp64
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
#define HAS_DOUBLES 1
#else
#define HAS_DOUBLES 0
#endif

#else

#define HAS_DOUBLES 1

#include <bit>
#include <cstdint>

#define SHARED_BEGIN namespace bvhbench {
#define SHARED_END }
#define SHARED_FN constexpr
#define SHARED_FN_INLINED constexpr

SHARED_BEGIN
using uint = std::uint32_t;
using ulong = std::uint64_t;
constexpr uint popcount(uint x) { return static_cast<uint>(std::popcount(x)); }
constexpr uint clz(uint x) { return static_cast<uint>(std::countl_zero(x)); }
constexpr uint as_uint(float x) { return std::bit_cast<uint>(x); }
constexpr float as_float(uint x) { return std::bit_cast<float>(x); }
constexpr ulong as_ulong(double x) { return std::bit_cast<ulong>(x); }
constexpr double as_double(ulong x) { return std::bit_cast<double>(x); }

/// OpenCL's fmin and fmax: if one argument is NaN, they return the other. The result for -0 and +0 is unspecified on every
/// device, so boxes are made from coordinates without -0 (see triangle_box).
constexpr float fmin(float a, float b) { return b < a || a != a ? b : a; }
constexpr float fmax(float a, float b) { return a < b || a != a ? b : a; }
constexpr double fmax(double a, double b) { return a < b || a != a ? b : a; }
constexpr double fmin(double a, double b) { return b < a || a != a ? b : a; }
constexpr float fabs(float x) { return x < 0 ? -x : x; }
constexpr double fabs(double x) { return x < 0 ? -x : x; }
SHARED_END

#endif
#endif
