// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <algorithm>
#include <iostream>

#include "collide/best_pipeline.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "harness/base/python.h"
#include "harness/base/terminal.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/judge/containment.h"
#include "harness/measure/run.h"
#include "harness/record/pairs_file.h"
#include "process/watchdog.h"

namespace bvhbench {
namespace {

class Collide final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        choice_.collider.trees = TreeOver::automatic;
        names_.add_to(app);
        app.add_option("--scene", scenes_, "scenes, data sets, mesh files or folders")->required();
        add_choices(app, choice_, [](const Choice& option) {
            // --group-size sets the collider's
            return option.of != Choice::Of::builder ||
                   (option.key != "order" && option.key != "group_size");
        });
        adjacent_ = app.get_option("--adjacent");
        leaves_ = app.get_option("--leaves");
        app.add_flag("--skips", skips_,
                     "measure each rule of `list skips` switched off as well, and what it saves");
        add_sampling(app, samples_, "timed builds and queries", sampling_);
        app.add_option("--json", json_, "write the result file");
        app.add_option("--pairs", pairs_,
                       "write the pairs of every frame: .csv, or of one frame .bin of 32-bit ids");
        app.add_option(
            "--contacts", contacts_,
            "the same of the pairs that intersect; with --within, how far apart and where");
        app.add_flag("--containment", containment_,
                     "say which objects lie wholly inside a closed object, without a contact");
    }

    int run(const Invocation& invocation) override
    {
        const SeveralNames asked = names_;
        take_best({});
        task();  // reports wrong options before opening the device, which is to be known
        const CommonOptions& common = invocation.common;
        Session session(common);
        names_ = asked;
        const std::string chosen = take_best(best_pipeline(session.device()));
        CollideTask task = this->task();
        const OutputRules rules = result_rules(common.force, files_of(scenes_, session.scenes()));
        const Output pairs(pairs_, "--pairs", rules), contacts(contacts_, "--contacts", rules);
        Output json(json_, "--json", rules);
        ResultFile results(std::move(json), common.force, measured_facts(session, invocation.words),
                           watchdog::run_id());
        PairsFile pairs_file(pairs, task.has_features());
        PairsFile contacts_file(contacts, task.has_features(),
                                task.swept                     ? PairsFile::With::times
                                : choice_.collider.is_within() ? PairsFile::With::distances
                                                               : PairsFile::With::nothing);
        watchdog::resume_after_crash(results.run_id());
        collide(session, task, results, pairs_file, contacts_file);
        results.finish(session.end_of_run());
        std::cout << (common.quiet ? "" : chosen) << std::flush;
        print_tables(results.text(), common);
        for (const std::string& line : contained_)
            std::cout << line << '\n';
        const int code = results.exit_code();
        pairs_file.finish();
        contacts_file.finish();
        return code;
    }

private:
    /// Names what nobody named. Returns a line about it.
    std::string take_best(BestPipeline best)
    {
        if (choice_.collider.first)
            best.collider = "leaf";
        const bool sorted = choice_.builder.sorted_leaves;
        const std::string chosen = names_.take_best(best, choice_.builder);
        if (leaves_->count() > 0)
            choice_.builder.sorted_leaves = sorted;
        return chosen;
    }

    /// Throws BadUsage if --pairs or --contacts cannot be written or the collider finds no such list.
    void check_lists(const FrameRange& frames) const
    {
        for (const std::string& path : {pairs_, contacts_})
            if (!path.empty()) {
                check_pairs_path(path, frames);
                if (scenes_.size() > 1)
                    throw BadUsage(
                        "--pairs and --contacts write those of one scene, and there are " +
                        std::to_string(scenes_.size()));
            }
        const bool is_within = choice_.collider.is_within();
        if (!pairs_.empty() && (is_within || choice_.collider.separation != "none"))
            throw BadUsage(
                (is_within ? "--within finds pairs of triangles" : "--separation finds contacts") +
                std::string(" and none of boxes: --contacts, not --pairs"));
        for (const std::string& name : names_.colliders) {
            const bool finds_contacts =
                find_collider(name).finds_contacts || choice_.collider.first || is_within;
            if (!pairs_.empty() && finds_contacts)
                throw BadUsage("collider " + name +
                               " finds contacts and no pairs of boxes: --contacts, not --pairs");
            if (!contacts_.empty() && !finds_contacts && choice_.collider.narrow == "none")
                throw BadUsage("--contacts needs a narrow phase: --narrow exact");
        }
    }

    /// Throws BadUsage if what is found cannot tell which objects are inside others.
    void check_containment() const
    {
        if (containment_ &&
            (choice_.scene.has_features() || !choice_.scene.exclude.empty() ||
             choice_.collider.first || choice_.collider.is_within() ||
             choice_.collider.narrow != "exact" || choice_.collider.among == Among::within_objects))
            throw BadUsage(
                "--containment needs all exact contacts between objects: --narrow exact, without "
                "--swept, --exclude, --first, --within and --pairs-of within");
    }

    /// Records which objects of a frame are inside others in its cells.
    void add_containment(std::vector<Cell>& cells, const Found& found)
    {
        if (std::ranges::none_of(
                cells, [](const Cell& cell) { return cell.check.contacts_hash.has_value(); }))
            return;  // no pipeline found the contacts
        const auto frame = static_cast<std::size_t>(cells.front().scene.frame);
        const Containment inside = containment(
            *found.scene, found.scene->frames.size() > 1 ? frame : 0, found.contacts.pairs());
        const std::string where = cells.front().scene.name + ", frame " + std::to_string(frame);
        std::vector<std::pair<std::string, std::string>> names;
        for (const auto& [object, of] : inside.found) {
            const auto& [inner, outer] = names.emplace_back(found.scene->objects[object].name,
                                                            found.scene->objects[of].name);
            contained_.push_back(where + ": object '" + inner + "' lies wholly inside '" + outer +
                                 "', without a contact");
        }
        for (Cell& cell : cells)
            if (cell.status == Cell::Status::measured) {
                cell.counters["contained_count"] = static_cast<double>(names.size());
                cell.contained = names;
            }
        if (inside.found.empty())
            contained_.push_back(where + ": no object lies wholly inside a closed one");
        if (inside.open_objects > 0)
            contained_.push_back(where + ": " + std::to_string(inside.open_objects) +
                                 " of its objects are not closed, so nothing is inside of them; "
                                 "`bvhbench scene` counts open edges, --weld may close them");
    }

    /// Throws BadUsage for words that are invalid with features.
    void check_feature_words() const
    {
        const std::string what = choice_.scene.swept ? "--swept" : "--features";
        if (adjacent_->count() > 0 && choice_.collider.keep_adjacent)
            throw BadUsage(what +
                           " leaves out pairs that share a vertex, which always touch: there are "
                           "none for --adjacent keep");
        if (!(pairs_.empty() && contacts_.empty()) && choice_.collider.among == Among::all)
            throw BadUsage("--pairs and --contacts write one list each, and " + what +
                           " finds two: choose by --pairs-of between, of vertices and faces, or "
                           "within, of edges");
    }

    CollideTask task() const
    {
        check_narrow_of(choice_.collider.narrow, choice_.collider.question(choice_.scene.swept));
        const std::vector<CellChoice> choices = names_.combined_with(choice_);
        CollideTask task;
        static_cast<SceneChoice&>(task) = choice_.scene;
        check_lists(task.frames);
        check_containment();
        for (const CellChoice& choice : choices)
            task.pipelines.push_back({choice.builder, choice.collider});
        if (skips_)
            task.pipelines = with_each_rule_off(task.pipelines);
        task.needs_scene = scenes_.size() == 1;
        task.samples = samples_;
        task.wants_lists = !pairs_.empty() || !contacts_.empty() || containment_;
        sampling_.apply(task.sampling);
        check_features(task);
        if (task.has_features()) {
            check_feature_words();
            for (PipelineChoice& pipeline : task.pipelines)
                pipeline.collider.keep_adjacent = false;
        }
        return task;
    }

    void collide(Session& session, CollideTask& task, ResultFile& results, PairsFile& pairs,
                 PairsFile& contacts)
    {
        int order = results.next_order();
        Progress progress(scenes_.size());
        task.note = [&](const std::string& what, double share) {
            progress.note(task.scene + ", " + what, share);
        };
        for (std::size_t i = 0; i < scenes_.size(); ++i) {
            task.scene = scene_name(scenes_[i]);
            task.number = std::to_string(i);
            progress.step(task.scene);
            collide_frames(
                session, task, order,
                [&](std::vector<Cell>&& cells, const Found& found) {
                    if (containment_ && found.scene != nullptr)
                        add_containment(cells, found);
                    for (const Cell& cell : cells)
                        results.add(cell);
                    if (found.scene == nullptr)
                        return;
                    const auto frame = static_cast<std::size_t>(cells.front().scene.frame);
                    pairs.add(found.pairs, frame, *found.scene);
                    contacts.add(found.contacts, frame, *found.scene, found.times, found.features);
                },
                [&](std::size_t cells) { return results.pass(cells); });
        }
    }

    SeveralNames names_;
    CellChoice choice_;
    std::vector<std::string> scenes_;
    const CLI::Option *adjacent_ = nullptr, *leaves_ = nullptr;
    bool skips_ = false, containment_ = false;
    std::vector<std::string> contained_;  ///< lines about objects inside others
    int samples_ = 20;
    SamplingWords sampling_;
    std::string json_, pairs_, contacts_;
};

}  // namespace

extern const CommandEntry collide_command = {
    "collide",
    measuring,
    "Find the pairs of triangles that overlap or intersect, frame by frame, check them and time "
    "the stages",
    "A frame is timed whole: vertices to tree to pairs, and with --narrow exact to triangles that "
    "intersect. Each frame's pairs are compared with an oracle's. Buffers that overflow are grown "
    "and the frame is done again; the table says so.",
    {{"bvhbench collide --scene bunny.obj --pairs pairs.csv", "a mesh with itself"},
     {"bvhbench collide --builder oibvh-single,karras --collider leaf,block --scene torus:100k",
      "four pipelines, sampled in turn"},
     {"bvhbench collide --collider group --scene cloth-ball:20000 --frames 0: --adjacent drop "
      "--narrow exact",
      "an animation, to exact contacts"},
     {"bvhbench collide --collider bvtt --scene n-body:61000 --frames 0:4 --pairs-of between "
      "--skips",
      "between objects, and what leaving work out saves"},
     {"bvhbench collide --collider leaf --scene cloth-ball:20000 --adjacent drop --first",
      "whether anything intersects"},
     {"bvhbench collide --collider leaf --scene cloth-ball:20000 --adjacent drop --within 0.5%",
      "what is at most half a percent of the scene's diagonal apart"},
     {"bvhbench collide --collider block --scene cloth-ball:20000 --within 1e-3 --features",
      "the same of vertices against faces and edges against edges, as IPC asks"},
     {"bvhbench collide --collider block --scene cloth-ball:20000:20 --swept",
      "what may meet between frames"},
     {"bvhbench collide --collider block --scene cloth-ball:20000:20 --swept --narrow ccd-1e-4",
      "and what does, and when"}},
    "docs/collisions.md",
    make_command<Collide>};

}  // namespace bvhbench
