// SPDX-License-Identifier: MIT
//
// Evaluates the shared layout headers on the device. For tests; no builder uses it.
#include "oibvh/layout_probe.h"

/// Writes the answers to `binary` and `kary`, one question per work-item; `binary` only for questions of arity 2.
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
