// SPDX-License-Identifier: MIT
//
// Number type of a tree's box sides: BOX_FORMAT, defined when a kernel over trees is compiled. The default is float.
//
// All formats but f32 and f64 are made from floats by outward rounding (geometry/box_cells.h), which keeps their order. Boxes
// of integers are therefore merged and compared as integers, and no builder or traversal converts a side back to a float. A
// half is stored as its index among all halves, so f16 and u16 share one definition.
#ifndef BVHBENCH_GEOMETRY_BOX_SIDE_H
#define BVHBENCH_GEOMETRY_BOX_SIDE_H

#include "geometry/dialect.h"

#define BOX_F32 0
#define BOX_F64 1
#define BOX_F16 2
#define BOX_U16 3
#define BOX_U8 4

#ifndef BOX_FORMAT
#define BOX_FORMAT BOX_F32
#endif

// BoxSide is one side; BoxWord, BoxFour and BoxEight are vectors of 2, 4 and 8 neighbouring sides. The empty box has MOST_SIDE
// as lower and LEAST_SIDE as upper sides. No box has the side NO_SIDE, and a box with six of them overlaps no box.
#if BOX_FORMAT == BOX_F32

#define SIDE_MIN fmin
#define SIDE_MAX fmax
#define MOST_SIDE 3.402823466e+38f
#define LEAST_SIDE -3.402823466e+38f
#define NO_SIDE as_float(0x7fc00000)
#ifdef __OPENCL_C_VERSION__
typedef float BoxSide;
typedef float2 BoxWord;
typedef float4 BoxFour;
typedef float8 BoxEight;
#else
SHARED_BEGIN
using BoxSide = float;
SHARED_END
#endif

#elif BOX_FORMAT == BOX_F64

#define SIDE_MIN fmin
#define SIDE_MAX fmax
#define MOST_SIDE 1.7976931348623157e+308
#define LEAST_SIDE -1.7976931348623157e+308
#define NO_SIDE ((double)as_float(0x7fc00000))
typedef double BoxSide;
typedef double2 BoxWord;
typedef double4 BoxFour;
typedef double8 BoxEight;

#elif BOX_FORMAT == BOX_U8

#define SIDE_MIN min
#define SIDE_MAX max
#define MOST_SIDE ((uchar)255)
#define LEAST_SIDE ((uchar)0)
#define NO_SIDE MOST_SIDE
typedef uchar BoxSide;
typedef uchar2 BoxWord;
typedef uchar4 BoxFour;
typedef uchar8 BoxEight;

#else

#define SIDE_MIN min
#define SIDE_MAX max
#define MOST_SIDE ((ushort)65535)
#define LEAST_SIDE ((ushort)0)
#define NO_SIDE MOST_SIDE
typedef ushort BoxSide;
typedef ushort2 BoxWord;
typedef ushort4 BoxFour;
typedef ushort8 BoxEight;

#endif
#endif
