// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "geometry/error.h"
#include "harness/choice/distance_words.h"
#include "harness/measure/collide.h"
#include "scenes/ground_truth.h"

namespace bvhbench {
namespace {

/// One of the two queries of a step or frame: its primitives, the kind of pairs, and where the ground truth has its answers.
struct Question {
    const char* name;
    Among among;
    SweptParts parts;
    GroundTruth::Pairs GroundTruth::*listed;
    GroundTruth::Pairs GroundTruth::*touching;  ///< those of them that collide
    std::optional<std::uint64_t> GroundTruth::*counted;
    Input input = {};
    std::vector<PipelineState> pipelines = {};  ///< the pipelines that take part in it
    Contest contest = Contest();
};

/// Returns how many of the pairs `listed` are not in `found`.
std::uint64_t missed_of(const GroundTruth::Pairs& listed, const PairList& found)
{
    const auto is_missed = [&](const std::array<uint, 2>& one) {
        const Pair pair = {std::min(one[0], one[1]), std::max(one[0], one[1])};
        return !std::binary_search(found.pairs().begin(), found.pairs().end(), pair);
    };
    return static_cast<std::uint64_t>(std::count_if(listed.begin(), listed.end(), is_missed));
}

/// Checks what was found against the ground truth of this step: contacts, if there are any, must include what collides.
void judge_step(const Question& question, const GroundTruth& truth, const Found& found, Cell& cell)
{
    const bool has_pairs = !find_collider(cell.collider.name).finds_contacts;
    const bool has_contacts = !has_pairs || cell.collider.narrow != "none";
    const GroundTruth::Pairs& listed = truth.*(has_contacts ? question.touching : question.listed);
    const std::optional<std::uint64_t>& counted = truth.*question.counted;
    if (!listed.empty()) {
        const std::uint64_t missed = missed_of(listed, has_contacts ? found.contacts : found.pairs);
        cell.counters["ground_truth_pairs"] = static_cast<double>(listed.size());
        cell.counters["ground_truth_missed"] = static_cast<double>(missed);
        cell.check.against += ", ground truth";
        if (missed > 0)
            cell.check.find_wrong(std::to_string(missed) + " pairs of the ground truth are missed");
    }
    if (counted && has_pairs && !cell.separation) {  // else boxes are padded
        cell.counters["reference_pairs_count"] = static_cast<double>(*counted);
        cell.check.against += ", meta.json";
        const bool may_be_more =  // than boxes of the doubles that were counted, or equal ones
            widens_boxes(cell.builder, cell.collider) || question.input.is_wide();
        const std::size_t pairs = found.pairs.size();
        if (may_be_more ? pairs < *counted : pairs != *counted)
            cell.check.find_wrong("meta.json counts " + std::to_string(*counted) + " pairs");
    }
}

/// Moves both queries on to the next frame, or to the step from it. The end points of the last step become the start points without
/// another upload.
void advance(Question (&questions)[2], const Scene& scene, std::size_t frame, const Queue& queue)
{
    Input& first = questions[0].input;
    const bool is_swept = first.is_swept();
    if (is_swept)
        std::swap(first.device_points, first.device_end_points);
    (is_swept ? first.device_end_points : first.device_points)
        .upload(queue.cl(), scene.frames[is_swept ? frame + 1 : frame]);
    WideStep& wide = first.wide;
    if (first.is_wide()) {
        std::swap(wide.device_points, wide.device_end_points);
        wide.points = scene.wide[frame];
        wide.end_points = scene.wide[frame + 1];
        wide.device_end_points.upload(queue.cl(), wide.end_points);
    }
    for (Question& question : questions) {
        question.input.points = scene.frames[frame];
        if (is_swept)
            question.input.end_points = scene.frames[frame + 1];
        question.input.device_points = first.device_points;
        question.input.device_end_points = first.device_end_points;
        question.input.wide = wide;
    }
}

}  // namespace

void collide_features(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                      const PassCells& passes)
{
    check_features(task);
    const Scene scene = scene_of(task, session.scenes());
    if (task.swept && scene.frames.size() < 2)
        throw Unavailable("swept boxes need two frames, and scene '" + task.scene +
                          "' has one; bend:" + task.scene + " has two");
    const FrameRange steps = task.swept ? frames_of(task, scene.frames.size() - 1, "steps")
                                        : frames_of(task, scene.frames.size(), "frames");

    Question questions[] = {
        {"vertex-face", Among::between_objects, vertices_and_faces(scene),
         &GroundTruth::vertex_face, &GroundTruth::touching_vertex_face,
         &GroundTruth::swept_vertex_face},
        {"edge-edge", Among::within_objects, unique_edges(scene), &GroundTruth::edge_edge,
         &GroundTruth::touching_edge_edge, &GroundTruth::swept_edge_edge}};
    const Aabb around = box_around(scene.frames.front(), scene.faces);
    for (Question& question : questions) {
        question.contest = Contest(task.sampling.race);
        for (PipelineChoice pipeline : task.pipelines) {
            const Among among = std::exchange(pipeline.collider.among, question.among);
            pipeline.collider.keep_adjacent = false;
            ColliderChoice& asked = pipeline.collider;
            asked.distance = distance_of(task.swept ? asked.separation : asked.within, around);
            if (task.swept && asked.distance == 0.0)
                asked.distance.reset();
            if (pipeline.collider.trees == TreeOver::automatic)
                pipeline.collider.trees = TreeOver::object;
            if (among == Among::all || among == question.among)
                question.pipelines.push_back({std::move(pipeline)});
        }
    }
    const std::size_t cells_a_step = questions[0].pipelines.size() + questions[1].pipelines.size();
    if (passes && passes((steps.end - steps.first) * cells_a_step * task.sampling.caches.size()))
        return;
    std::optional<GroundTruth> truth;
    if (task.swept)
        truth = ground_truth_of(scene, questions[1].parts);
    Input& first = questions[0].input;
    first = upload(session.device(), session.queue(), scene.frames[steps.first],
                   questions[0].parts.faces, questions[0].parts.objects);
    if (task.swept)
        upload_end(first, session.device(), session.queue(), scene.frames[steps.first + 1]);
    if (task.swept && !scene.wide.empty())
        upload_wide(first, session.device(), session.queue(), scene.wide[steps.first],
                    scene.wide[steps.first + 1]);
    questions[1].input = upload_over(first, session.device(), session.queue(),
                                     questions[1].parts.faces, questions[1].parts.objects);

    for (std::size_t step = steps.first; step < steps.end; ++step) {
        if (step > steps.first)
            advance(questions, scene, step, session.queue());
        for (Question& question : questions) {
            if (question.pipelines.empty())
                continue;
            FrameOfPipelines now{
                .input = question.input,
                .contest = question.contest,
                .number = task.number + '/' + std::to_string(step) + '/' + question.name,
                .scene = facts_of(task, scene, step)};
            now.note = note_of(task, (task.swept ? "step " : "frame ") + std::to_string(step),
                               step - steps.first, steps.end - steps.first);
            now.features = {.pairs = question.name,
                            .to_frame = task.swept ? static_cast<std::int64_t>(step + 1) : 0,
                            .primitives = question.input.triangle_count()};
            now.wants_lists = task.wants_lists;
            if (truth && truth->from_frame == step) {
                now.wants_lists = true;
                now.judge_more = [&](const Found& found, Cell& cell) {
                    judge_step(question, *truth, found, cell);
                };
            }
            Found found{.scene = &scene};
            std::vector<Cell> cells =
                run_frame(session, task, question.pipelines, now, order, found);
            found.features = question.parts.faces;
            add(std::move(cells), found);
        }
    }
}

}  // namespace bvhbench
