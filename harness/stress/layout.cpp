// SPDX-License-Identifier: MIT
#include "harness/stress/parts.h"
#include "oibvh/layout_check.h"
#include "scenes/generate/random.h"

namespace bvhbench {

void stress_layout(const StressTask& task, const AddStressCell& add)
{
    StressCell cell;
    cell.family = "layout";
    cell.scene = "to 2^31 leaves";
    cell.system = "layout.h";
    cell.kind = StressCell::Kind::host;
    if (!task.wants(cell))
        return;
    Finding finding;
    const auto look_at = [&](uint leaves) {
        ++finding.checked;
        const std::string wrong = broken_layout(leaves);
        if (wrong.empty())
            return;
        if (finding.wrong++ == 0)
            finding.detail = wrong;
        finding.verdict = Finding::Verdict::broken;
    };
    for (uint leaves = 1; leaves <= (task.size.quick ? 10000u : 1000000u); ++leaves)
        look_at(leaves);
    for (uint k = 13; k <= 31; ++k)
        for (const uint leaves : {(1u << k) - 1, 1u << k, (1u << k) + 1})
            if (leaves <= 1u << 31)
                look_at(leaves);
    Random random(task.size.seed);
    for (int k = 0; k < (task.size.quick ? 10000 : 1000000); ++k)
        look_at(1 + static_cast<uint>(random.bits() % (1u << 31)));
    cell.findings[Invariant::layout] = finding;
    add(std::move(cell));
}

}  // namespace bvhbench
