// SPDX-License-Identifier: MIT
//
// Asks the device what it makes of the shared headers. For tests; no builder runs it.
#include "geometry/triangle.h"
#include "oibvh/layout_probe.h"

/// One work-item a question. `binary` and `kary` hold its answers afterwards.
kernel void probe_layout(global const LayoutQuestion* questions, const uint count,
                         global LayoutAnswers* binary, global LayoutAnswers* kary)
{
    const uint q = get_global_id(0);
    if (q >= count)
        return;
    if (questions[q].arity == 2u)
        binary[q] = oi_answers(questions[q]);
    kary[q] = kary_answers(questions[q]);
}

/// `sizes` holds the bytes of each struct both sides share: Aabb, Point, Face, OiShape, KaryShape,
/// LayoutQuestion, LayoutAnswers.
kernel void probe_sizes(global uint* sizes)
{
    if (get_global_id(0) != 0u)
        return;
    sizes[0] = sizeof(Aabb);
    sizes[1] = sizeof(Point);
    sizes[2] = sizeof(Face);
    sizes[3] = sizeof(OiShape);
    sizes[4] = sizeof(KaryShape);
    sizes[5] = sizeof(LayoutQuestion);
    sizes[6] = sizeof(LayoutAnswers);
}
