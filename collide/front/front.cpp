// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>

#include "collide/colliders.h"
#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/parameters.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

/// To look whether parents are apart costs more tests than all else of a frame. So entries climb only in a frame that
/// comes to a front grown past this multiple of what was left when they last did, and once in so many frames besides, as
/// what parts does not grow; until then a front is right but deeper than it need be.
constexpr double growth_to_climb = 1.5;
constexpr uint frames_to_climb = 16;

/// Boxes that are only refitted grow loose, and the front grows with them: where entries have climbed and still leave a
/// front past this multiple of what the last build left, the tree is built anew and the front starts from the roots.
/// Contacts make it grow as well; then what the new build leaves is the new measure, so that they cost a few builds and
/// not one a frame.
constexpr double growth_to_restart = 2;

constexpr std::uint64_t most_entries = std::numeric_limits<uint>::max();

/// Entries, 128 MiB of them, from which on room is given sparingly: repeating a query costs less than what it would take.
constexpr std::size_t many = std::size_t{1} << 24;

/// The front that stands is never written to: a query goes from it to another, and the next frame exchanges them. So a
/// query that lacked room, or is timed, can be repeated.
class Front final : public DeviceCollider {
public:
    Front(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(
              programs,
              {"front", "Front tracking over refitted boxes [Lauterbach2010], [Wang2018]"}, options,
              bvtt_group_size)
    {
        if (options.jump > 1 || options.start_level > 0)
            throw BadUsage("front descends a level after the other and starts where it stands");
    }

    std::string refusal(const Tree& tree) const override
    {
        const auto* on_device = dynamic_cast<const DeviceTree*>(&tree);
        if (on_device != nullptr && label_bits(*on_device) < 32 &&
            label_bits(*on_device) + ceil_log2(static_cast<uint>(on_device->objects.size())) > 32)
            return "front names an object and its node in 32 bits, too few for " +
                   std::to_string(on_device->objects.size()) + " objects with trees of up to " +
                   std::to_string(on_device->most_levels()) + " levels";
        return DeviceCollider::refusal(tree);
    }

    bool keeps_tree() const override { return true; }

    TreeUpdate next_frame() override
    {
        const bool from_roots = !standing_, is_highest = from_roots || climbs_;
        standing_ = last_front_;
        last_front_.reset();
        if (!standing_)
            return TreeUpdate::rebuild;
        std::swap(fronts_[0], fronts_[1]);
        const double size = *standing_;
        if (from_roots)
            after_build_ = size;
        if (is_highest) {
            after_climb_ = size;
            since_climb_ = 0;
        }
        climbs_ = size > growth_to_climb * after_climb_ || ++since_climb_ == frames_to_climb;
        if (!is_highest || size <= growth_to_restart * after_build_)
            return TreeUpdate::refit;
        standing_.reset();
        ++restarts_;
        return TreeUpdate::rebuild;
    }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        counts.tasks.reset();
        const std::vector<std::uint64_t> all = counters(queue);
        const auto queues = all.begin() + FRONT_QUEUES_COUNT / 2 + 1;
        const std::uint64_t front = all[FRONT_COUNT / 2];
        counts.bvtt_peak = std::max(
            {front, std::uint64_t{standing_.value_or(0)}, *std::max_element(queues, all.end())});
        counts.more = {{"front_count", front},
                       {"sprouts_count", std::accumulate(queues, all.end(), std::uint64_t{0})},
                       {"prunes_count", all[PRUNES_COUNT / 2]},
                       {"restarts_count", restarts_}};
        return counts;
    }

private:
    bool needs_ropes() const override { return false; }

    /// Entries of a work-item's own, of the form for few cores, for each of three lists.
    uint block_pairs() const { return device().tuned(bvtt_block_pairs); }
    /// Tasks a work-item has a turn, of the form for many lanes.
    uint items() const { return device().tuned(bvtt_items); }

    /// Of a node in an entry; the object is in the rest.
    static uint label_bits(const DeviceTree& tree)
    {
        return tree.objects.size() > 1 && tree.is_implicit() ? tree.label_bits() : 32;
    }

    /// Entries of the front that tracking begins with.
    std::uint64_t root_count(const DeviceTree& tree) const
    {
        const std::uint64_t objects = tree.objects.size();
        return (within() ? objects : 0) + (between(tree) ? objects * (objects - 1) / 2 : 0);
    }

    void compile(const DeviceTree& tree) override
    {
        const std::uint64_t roots = root_count(tree);
        if (roots > most_entries)
            throw Unavailable(std::to_string(roots) + " pairs of objects: a front holds at most " +
                              std::to_string(most_entries));
        const Define label{"LABEL_BITS", label_bits(tree)};
        advance_ = by_groups() ? kernel(tree, "collide/front/front_groups.cl", "advance",
                                        {{"GROUP_SIZE", group_size_}, {"ITEMS", items()}, label})
                               : kernel(tree, "collide/front/front_chunks.cl", "advance",
                                        {{"SINK_BLOCK", block_pairs()}, label});
        roots_ = kernel(tree, "collide/front/front_roots.cl", "list_roots", {label});
        if (!tree.is_implicit()) {
            list_parents_ = kernel(tree, "collide/front/front_parents.cl", "list_parents", {});
            cut_off_roots_ = kernel(tree, "collide/front/front_parents.cl", "cut_off_roots", {});
            list_depths_ = kernel(tree, "collide/front/front_parents.cl", "list_depths", {});
        }
        const std::size_t leaves = tree.leaf_count();
        const std::size_t guess =
            options_.capacity != 0
                ? options_.capacity
                : device().room_for(
                      std::clamp<std::size_t>(8 * leaves, 1024, std::max(leaves, many)),
                      sizeof(Pair));
        queue_capacity_ = guess;
        front_capacity_ = std::max(guess, static_cast<std::size_t>(roots));
        standing_.reset();
        last_front_.reset();
        climbs_ = false;
        restarts_ = 0;
    }

    void plan(Arena& arena, const DeviceTree& tree) override
    {
        for (Buffer<Pair>& front : fronts_)
            front = arena.take<Pair>(front_capacity_, Use::scratch);
        for (Buffer<Pair>& queue : queues_)
            queue = arena.take<Pair>(queue_capacity_, Use::scratch);
        parents_ = arena.take<Pair>(tree.is_implicit() ? 1 : 2 * std::size_t{tree.leaf_count()} - 1,
                                    Use::scratch);
        blocks_ = arena.take<Pair>(by_groups() ? 1 : 3 * block_pairs() * chunks_, Use::scratch);
    }

    /// What the frame goes on from is all that more memory must not lose.
    void set_aside(const cl::CommandQueue& queue) override
    {
        set_aside_.resize(standing_.value_or(0));
        if (!set_aside_.empty())
            queue.enqueueReadBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                    set_aside_.data());
        parents_aside_ =
            standing_ && parents_.size() > 1 ? parents_.download(queue) : std::vector<Pair>{};
    }

    void prepare(const DeviceTree&, const cl::CommandQueue& queue) override
    {
        if (!set_aside_.empty())
            queue.enqueueWriteBuffer(fronts_[0].cl(), CL_TRUE, 0, set_aside_.size() * sizeof(Pair),
                                     set_aside_.data());
        if (!parents_aside_.empty())
            parents_.upload(queue, parents_aside_);
        set_aside_ = {};
        parents_aside_ = {};
        last_front_.reset();
    }

    /// Levels below the root: a step each, behind that of the front itself.
    static uint descents(const DeviceTree& tree) { return tree.most_levels() - 1; }

    /// Of the front, of prunes, one a descent, and what the last of them would leave.
    uint queue_count(const DeviceTree& tree) const override { return 3 + descents(tree); }

    bool make_room(std::uint64_t, const std::vector<std::uint64_t>& sizes) override
    {
        constexpr std::size_t queues = (FRONT_QUEUES_COUNT - QUEUES_COUNT) / 2 + 1;
        const std::uint64_t waiting = *std::max_element(sizes.begin() + queues, sizes.end());
        // Steps behind one that ran over have seen only some of their entries: they, and the front, will need more.
        const bool queues_had_room =
            had_room(queue_capacity_, waiting, waiting < many ? waiting : waiting / 16);
        const bool front_had_room = had_room(front_capacity_, sizes.front(),
                                             sizes.front() / (sizes.front() < many ? 4 : 16));
        if (queues_had_room && front_had_room)
            last_front_ = static_cast<uint>(sizes.front());
        return queues_had_room && front_had_room;
    }

    /// Whether `needed` entries had room; if not, they will, and `more` besides.
    bool had_room(std::size_t& capacity, std::uint64_t needed, std::uint64_t more) const
    {
        if (needed <= capacity)
            return true;
        if (needed > most_entries)
            throw Unavailable(std::to_string(needed) + " pairs of nodes or more: a front holds " +
                              std::to_string(most_entries));
        capacity = device().room_for(std::min(most_entries, needed + more), sizeof(Pair), needed);
        return false;
    }

    /// The front that stands. What of the tree it leads to depends on how it stands.
    std::int64_t reads_at_least(const DeviceTree&) const override
    {
        return std::int64_t{standing_.value_or(0)} * std::int64_t{sizeof(Pair)};
    }

    void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) override
    {
        if (!standing_)
            start_from_roots(tree, queue);
        const auto standing = standing_.value_or(static_cast<uint>(root_count(tree)));
        for (uint step = 0; step <= descents(tree); ++step) {
            const Buffer<Pair>& from = step == 0 ? fronts_[0] : queues_[step % 2];
            bind(advance_, tree, input, parents_, from, queues_[(step + 1) % 2],
                 static_cast<uint>(queue_capacity_), fronts_[1], static_cast<uint>(front_capacity_),
                 step, standing, climbs_ ? 1u : 0u, blocks_);
            if (by_groups())
                queue.launch(advance_, groups(standing, tree.child_bits() * step) * group_size_,
                             group_size_, 0);
            else
                queue.launch(advance_, chunks_, 1, 0);
        }
    }

    /// As many as have something to do, up to what fills the device: an entry has 4 children a level of binary trees.
    std::size_t groups(uint standing, uint levels) const
    {
        const std::size_t most = device().tuned(bvtt_groups_per_unit) *
                                 std::size_t{device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
        const std::size_t tasks = std::size_t{standing} << std::min(2 * levels, 30u);
        const std::size_t a_group = std::size_t{group_size_} * items();
        return std::clamp<std::size_t>((tasks + a_group - 1) / a_group, 1, most);
    }

    void start_from_roots(const DeviceTree& tree, Queue& queue)
    {
        constexpr std::size_t group = 64;
        const auto rounded = [](std::size_t count) { return (count + group - 1) / group * group; };
        const auto objects = static_cast<uint>(tree.objects.size());
        set_arguments_from(roots_, tree.bind(roots_, 0), objects, within() ? 1u : 0u,
                           between(tree) ? 1u : 0u, fronts_[0]);
        queue.launch(roots_, rounded(std::size_t{objects} * objects), group, 0);
        if (tree.is_implicit())
            return;
        const std::size_t lanes =
            by_groups() ? rounded(tree.leaf_count()) : (chunks_ + group - 1) / group * group;
        set_arguments_from(list_parents_, tree.bind(list_parents_, 0), parents_);
        queue.launch(list_parents_, lanes, group, 0);
        set_arguments_from(cut_off_roots_, tree.bind(cut_off_roots_, 0), parents_, objects);
        queue.launch(cut_off_roots_, rounded(objects), group, 0);
        set_arguments_from(list_depths_, tree.bind(list_depths_, 0), parents_);
        queue.launch(list_depths_, lanes, group, 0);
    }

    cl::Kernel advance_, roots_, list_parents_, cut_off_roots_, list_depths_;
    std::size_t queue_capacity_ = 0, front_capacity_ = 0;
    std::array<Buffer<Pair>, 2> fronts_;  ///< that stands, and that the query leaves
    std::array<Buffer<Pair>, 2>
        queues_;            ///< of nodes that sprout; a step goes from one to the other
    Buffer<Pair> parents_;  ///< front_parents.cl; one where there is arithmetic
    Buffer<Pair> blocks_;   ///< of the form for few cores
    std::vector<Pair> set_aside_, parents_aside_;

    std::optional<uint>
        standing_;  ///< entries of the front that stands; none: start from the roots
    std::optional<uint> last_front_;  ///< that the last query left, if it was complete
    bool climbs_ = false;             ///< whether entries of the front that stands may climb
    uint since_climb_ = 0;            ///< frames
    double after_build_ = 0;          ///< entries that the first frame after the last build left
    double after_climb_ = 0;          ///< the same of the last frame in which they climbed
    std::uint64_t restarts_ = 0;
};

}  // namespace

std::unique_ptr<Collider> make_front(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Front>(programs, options);
}

}  // namespace bvhbench
