// SPDX-License-Identifier: MIT
//
// Asks the device what it makes of the shared headers. For tests; no builder runs it.
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
