// SPDX-License-Identifier: MIT
#include "harness/base/python.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/judge/check.h"
#include "harness/measure/run.h"
#include "process/watchdog.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

/// Returns a tree as JSON: root first, -1 for no child or primitive, and numbers that read back as the same bits:
/// {"nodes":[{"box":{"min":[x,y,z],"max":[x,y,z]},"child":[a,b],"primitive":k}]}
std::string dump_text(const HostTree& tree)
{
    std::string text = "{\"nodes\":[";
    for (const auto& [box, child, primitive] : tree.nodes) {
        const FloatJson node = {{"box",
                                 {{"min", {box.min_x, box.min_y, box.min_z}},
                                  {"max", {box.max_x, box.max_y, box.max_z}}}},
                                {"child", child},
                                {"primitive", primitive}};
        text += (text.back() == '[' ? "\n" : ",\n") + node.dump();
    }
    return text + "\n]}\n";
}

class Build final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        add_names(app, "--builder", names_.builders, "names of `list builders`")->required();
        app.add_option("--scene", scene_, "a scene, data set or mesh file")->required();
        add_names(app, "--order", names_.orders, "names of `list orders`")
            ->default_str(names_.orders.front());
        add_choices(app, choice_, [](const Choice& option) {
            return option.of == Choice::Of::builder && option.key != "order";
        });
        add_sampling(app, samples_, "timed builds", sampling_);
        add_quality(app, quality_, costs_);
        app.add_option("--json", json_, "write the result file");
        app.add_option("--dump", dump_, "write the tree, spelled out, as JSON; of one builder");
    }

    int run(const Invocation& invocation) override
    {
        const std::vector<CellChoice> choices = names_.combined_with(choice_);
        if (!dump_.empty() && choices.size() > 1)
            throw BadUsage("--dump writes one tree, and there are " +
                           std::to_string(choices.size()) + " builders and orders");
        const CommonOptions& common = invocation.common;
        Session session(common);
        const auto rules = result_rules(common.force, scene_files(scene_, session.scenes()));
        const Output dumped(dump_, "--dump", rules);
        ResultFile results(Output(json_, "--json", rules), common.force,
                           measured_facts(session, invocation.words, costs_), watchdog::run_id());
        watchdog::resume_after_crash(results.run_id());
        Run(session, results, costs_).experiment(experiment(choices));
        results.finish(session.end_of_run());
        const int code = results.exit_code();
        print_tables(results.text(), common);
        if (!dumped.is_nowhere())
            dump(session, choices.front().builder, dumped);
        return code;
    }

private:
    Experiment experiment(const std::vector<CellChoice>& choices) const
    {
        Experiment experiment;
        experiment.name = "build";
        experiment.scenes = {scene_name(scene_)};
        for (const CellChoice& choice : choices)
            experiment.builders.push_back(choice.builder);
        experiment.samples = samples_;
        experiment.quality = quality_;
        experiment.may_stand_in = false;  // the user named this mesh, so no other is used
        experiment.needs_scene = true;
        sampling_.apply(experiment.sampling);
        return experiment;
    }

    /// Builds once more and writes the tree. The scene is loaded again, because measuring has freed its own copy.
    void dump(Session& session, const BuilderChoice& choice, const Output& output) const
    {
        const Scene scene = in_file_order(load_scene(scene_, session.scenes()));
        const Input input =
            upload(session.device(), session.queue(), scene.frames.front(), scene.faces);
        output.replace(dump_text(built_tree(session, choice, input).to_host_tree()));
    }

    SeveralNames names_{.orders = {std::string(SeveralNames::paper_order)}};
    CellChoice choice_;
    std::string scene_;
    int samples_ = 20;
    SamplingWords sampling_;
    bool quality_ = false;
    NodeCosts costs_;
    std::string json_, dump_;
};

}  // namespace

extern const CommandEntry build_command = {
    "build",
    measuring,
    "Build a tree with each of the builders, check it and time its stages",
    "The tree is compared with the builder's oracle, bit for bit, before samples count. Times are "
    "of stages on the device's clock, from first start to last end. The table has the median, "
    "percentiles, and the share of the device's copy rate that a stage reaches.",
    {{"bvhbench build --builder oibvh-multi --scene torus:100000",
      "a generated scene of 100,000 triangles"},
     {"bvhbench build --builder karras,oibvh-single --order morton30,hilbert30 --scene bunny.ply "
      "--json mine.json",
      "four cells over a mesh file, sampled in turn, samples kept"},
     {"bvhbench build --builder oibvh-multi --scene bunny --until 2% --caches cold",
      "until steady, from empty caches"}},
    "docs/measuring.md",
    make_command<Build>};

}  // namespace bvhbench
