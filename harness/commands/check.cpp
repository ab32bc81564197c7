// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/base/table.h"
#include "harness/base/terminal.h"
#include "harness/choice/outside.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/judge/check.h"
#include "harness/judge/hard_inputs.h"
#include "harness/measure/run.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

std::vector<BuilderChoice> chosen_builders(const std::string& name)
{
    if (!name.empty() && !find_builder(name).absent.empty())
        throw Unavailable(std::string(find_builder(name).absent));
    std::vector<BuilderChoice> builders;
    for (const BuilderEntry& entry : builder_catalog())
        if ((name.empty() || name == entry.name) && entry.is_there())
            builders.push_back({.name = std::string(entry.name)});
    return builders;
}

/// Results of one builder over several inputs, or of all builders.
struct Tally {
    std::size_t checked = 0, broken = 0, refused = 0;
    std::string first;    ///< first broken invariant
    std::string refusal;  ///< reason of the first refusal

    void add(const Tally& other)
    {
        checked += other.checked;
        broken += other.broken;
        refused += other.refused;
        first = first.empty() ? other.first : first;
        refusal = refusal.empty() ? other.refusal : refusal;
    }

    std::string verdict() const
    {
        return broken > 0    ? std::to_string(broken) + " broken"
               : refused > 0 ? "refuses " + std::to_string(refused)
                             : "met";
    }
};

class Checker {
public:
    Checker(Session& session, std::vector<BuilderChoice> builders)
        : session_(session), builders_(std::move(builders)), tallies_(builders_.size())
    {}

    /// Checks every builder's invariants over one mesh of the current input.
    void over(std::span<const Point> points, std::span<const Face> faces)
    {
        const Input input = upload(session_.device(), session_.queue(), points, faces);
        Oracle oracle(session_, input);
        for (std::size_t i = 0; i < builders_.size(); ++i)
            tallies_[i].add(checked(builders_[i], input, oracle));
    }

    /// Adds the rows of the current input to the table. What is checked next is of another input.
    void report(const std::string& input)
    {
        for (std::size_t i = 0; i < builders_.size(); ++i) {
            const Tally tally = std::exchange(tallies_[i], {});
            table_.row({builders_[i].name, input, std::to_string(tally.checked), tally.verdict(),
                        tally.broken == 0 ? tally.refusal : tally.first});
            all_.add(tally);
        }
    }

    int verdict() const
    {
        std::cout << table_.text();
        if (all_.refused == all_.checked)
            throw NothingMeasured("nothing was checked: " + all_.refusal);
        std::cout << all_.checked << " checks, "
                  << (all_.broken == 0 ? "no violation\n"
                                       : std::to_string(all_.broken) + " with a violation\n");
        return all_.broken == 0 ? 0 : 1;
    }

private:
    /// Checks one builder once. A failure counts as a broken invariant.
    Tally checked(const BuilderChoice& builder, const Input& input, Oracle& oracle)
    {
        std::string wrong, refusal;
        try {
            bool refused = false;
            wrong = contract_violation(session_, builder, input, oracle, &refused);
            if (refused)
                refusal = find_builder(builder.name).may_refuse;
        } catch (const std::exception& error) {
            const bool refuses = dynamic_cast<const BadUsage*>(&error) != nullptr ||
                                 dynamic_cast<const Unavailable*>(&error) != nullptr;
            (refuses ? refusal : wrong) = sentence_of(error);
        }
        if (!wrong.empty() || !refusal.empty())
            session_.renew_queue();
        if (!wrong.empty())
            wrong = std::to_string(input.triangle_count()) + " triangles: " + wrong;
        return {1, wrong.empty() ? 0u : 1u, refusal.empty() ? 0u : 1u, wrong, refusal};
    }

    Session& session_;
    std::vector<BuilderChoice> builders_;
    std::vector<Tally> tallies_;  ///< of each builder over the current input
    Table table_{{"<builder", "<input", "checks", "<contract", "<"}};
    Tally all_;
};

void check_hard_inputs(Checker& checker)
{
    Progress progress(hard_inputs().size() * critical_sizes().size());
    for (const HardInput& input : hard_inputs()) {
        for (const std::size_t size : critical_sizes()) {
            progress.step(std::string(input.name) + ", " + std::to_string(size) + " triangles");
            const Mesh mesh = input.make(size);
            checker.over(mesh.points, mesh.faces);
        }
        checker.report(std::string(input.name));
    }
}

class CheckBuilders final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("--builder", builder_, "only this one");
        app.add_option("--scene", scene_, "over this instead of the hard inputs");
        app.add_flag("--portable", portable_,
                     "instead: the device, and a verdict on each builder, collider and narrow "
                     "phase, to be sent")
            ->excludes("--builder")
            ->excludes("--scene");
    }

    int run(const Invocation& invocation) override
    {
        if (portable_) {
            refuse_outside(invocation.common, "check --portable");
            Session session(invocation.common);
            return check_portable(session, invocation.words);
        }
        if (find_name(builder_catalog(), builder_) == nullptr && outside_library(builder_))
            throw BadUsage("'check' judges builders, and " + builder_ +
                           ", from outside, is none: `smoke` and `run agreement` judge it");
        std::vector<BuilderChoice> builders = chosen_builders(builder_);
        const auto is_outside = [](const auto& one) {
            return find_builder(one.name).outside != nullptr;
        };
        if (std::ranges::none_of(builders, is_outside))
            refuse_outside(invocation.common, "check");
        else if (std::ranges::any_of(collider_catalog(), &ColliderEntry::outside))
            std::cerr << "colliders from outside take no part in `check`: `smoke` and `run "
                         "agreement` judge them\n";
        Session session(invocation.common);
        Checker checker(session, std::move(builders));
        if (scene_.empty()) {
            check_hard_inputs(checker);
        } else {
            const Scene scene = in_file_order(load_scene(scene_, session.scenes()));
            for (const std::vector<Point>& points : scene.frames)
                checker.over(points, scene.faces);
            checker.report(scene.name);
        }
        return checker.verdict();
    }

private:
    std::string builder_;  ///< empty: all builders
    std::string scene_;    ///< empty: the hard inputs
    bool portable_ = false;
};

}  // namespace

extern const CommandEntry check_command = {
    "check",
    checking,
    "Check every contract of every builder, without timing",
    "The contract of builders/builder.h, over inputs that are hard on builders.",
    {{"bvhbench check", "all builders"},
     {"bvhbench check --builder oibvh-single --scene bunny", "one, over a scene"},
     {"bvhbench check --portable --device 1", "what works on a device that nobody has tried"}},
    "docs/reliability.md",
    make_command<CheckBuilders>};

}  // namespace bvhbench
