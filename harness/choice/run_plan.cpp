// SPDX-License-Identifier: MIT
#include "harness/choice/run_plan.h"

#include <re2/re2.h>

namespace bvhbench {
namespace {

RunPlan plan_of(const Json& json, bool quick)
{
    if (!json.is_object() || !json.contains("parts")) {
        const Experiment only = experiment_of(json, quick);
        return {.name = only.name, .parts = {only}};
    }
    refuse_unknown_keys(json, {"experiment", "question", "parts", "impossible"}, "a plan");
    RunPlan plan{.name = text_at(json, "experiment"), .has_parts = true};
    for (const Json& part : json["parts"]) {
        Json described = part;
        described["experiment"] = plan.name;
        plan.parts.push_back(experiment_of(described, quick));
    }
    plan.impossible = json.value("impossible", std::vector<Json>());
    return plan;
}

}  // namespace

RunPlan find_plan(const std::string& name_or_path, bool quick)
{
    return read_json(experiment_text(name_or_path), name_or_path,
                     [&](const Json& json) { return plan_of(json, quick); });
}

PlanShare share_called(const std::string& text)
{
    PlanShare share;
    if (!text.empty() && (!RE2::FullMatch(text, "(\\d{1,6})/(\\d{1,6})", &share.i, &share.n) ||
                          share.i < 1 || share.i > share.n))
        throw BadUsage("--only is i/n with i from 1 to n, not '" + text + "'");
    return share;
}

}  // namespace bvhbench
