/* SPDX-License-Identifier: MIT
 *
 * A plug-in for tests: a tree that halves the triangles in their given order, all pairs by comparing every two boxes, of a frame, of a step
 * or within a distance, which is right if it is that of the boxes, a narrow phase to which all candidates meet, and queries of moving points
 * all of which are said to touch at the start, so that it misses none. It is right, unless its file is called fault-NAME.so, where
 * NAME is a way in which it is to be wrong. Its methods are then called halves-NAME, every-two-NAME and at-the-start-NAME.
 */
#include <bvhbench/plugin.h>

#include <dlfcn.h>
#include <float.h>
#include <math.h>
#include <signal.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

typedef struct State {
    bvhbench_mesh mesh;
    const float *points, *end_points; /* the same, but in a step */
    bvhbench_node *nodes;
    uint64_t node_count;
    uint32_t *entries;
    uint64_t entry_count;
    uint32_t *pairs;
    uint64_t pair_count, pair_room;
    const uint32_t *candidates;
    uint64_t candidate_count;
    double *times;
    uint64_t time_count;
    const char *error;
} State;

static char planted[32]; /* empty if it is right */

static int is(const char *fault) { return strcmp(planted, fault) == 0; }

static void find_fault(void)
{
    Dl_info own;
    const char *name = dladdr(planted, &own) ? strrchr(own.dli_fname, '/') : NULL;
    if (name != NULL && sscanf(name, "/fault-%31[^.]", planted) == 1)
        return;
    planted[0] = '\0';
}

static uint64_t now_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

static void begin(bvhbench_stages *stages, const char *name)
{
    bvhbench_stage *stage = &stages->stage[stages->count++];
    stage->name = name;
    stage->on_device = is("on-device");
    stage->begin_ns = now_ns();
}

static void end(bvhbench_stages *stages)
{
    bvhbench_stage *stage = &stages->stage[stages->count - 1];
    stage->end_ns = now_ns() + (is("leak") ? 1000000000000u : 0u) /* far longer than the call */;
    if (is("microseconds")) {
        stage->begin_ns /= 1000;
        stage->end_ns /= 1000;
    }
}

static void *create(char *why)
{
    if (is("create")) {
        snprintf(why, 256, "there is no device for it");
        return NULL;
    }
    return calloc(1, sizeof(State));
}

static int prepare(void *state, const bvhbench_mesh *mesh)
{
    State *s = state;
    if (is("fails")) {
        s->error = "it does not like this mesh";
        return 1;
    }
    s->mesh = *mesh;
    s->nodes = malloc(2 * mesh->triangles * sizeof *s->nodes);
    s->entries = malloc(4 * mesh->triangles * sizeof *s->entries);
    if (is("memory")) { /* shared memory, which no limit of allocations counts */
        const size_t bytes = (size_t)600 << 20;
        char *much = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        for (size_t k = 0; much != MAP_FAILED && k < bytes; k += 4096)
            much[k] = 1;
        for (;;)
            pause();
    }
    return s->nodes == NULL || s->entries == NULL;
}

static int load(void *state, const float *points)
{
    if (is("writes-points"))
        for (int axis = 0; axis < 3; ++axis)
            ((float *)points)[axis] = 1e30f;
    ((State *)state)->points = ((State *)state)->end_points = points;
    return 0;
}

static int load_step(void *state, const float *start, const float *end)
{
    load(state, start);
    ((State *)state)->end_points = end;
    return 0;
}

static void box_of(const State *s, uint32_t triangle, float *low, float *high)
{
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = FLT_MAX;
        high[axis] = -FLT_MAX;
        for (int corner = 0; corner < 6; ++corner) {
            const float *const points = corner < 3 ? s->points : s->end_points;
            const float x = points[3 * s->mesh.faces[3 * triangle + corner % 3] + axis];
            low[axis] = x < low[axis] ? x : low[axis];
            high[axis] = x > high[axis] ? x : high[axis];
        }
    }
}

/* Makes the boxes of all nodes, whose children come after them. */
static void refresh(State *s)
{
    for (uint64_t k = s->node_count; k-- > 0;) {
        bvhbench_node *node = &s->nodes[k];
        for (uint32_t e = 0; e < node->count; ++e) {
            const uint32_t entry = s->entries[node->first + e];
            float low[3], high[3];
            if (node->is_leaf) {
                box_of(s, entry, low, high);
            } else {
                memcpy(low, s->nodes[entry].low, sizeof low);
                memcpy(high, s->nodes[entry].high, sizeof high);
            }
            for (int axis = 0; axis < 3; ++axis) {
                if (e == 0 || low[axis] < node->low[axis])
                    node->low[axis] = low[axis];
                if (e == 0 || high[axis] > node->high[axis])
                    node->high[axis] = high[axis];
            }
        }
    }
}

/* Adds the tree over the triangles first to first + count - 1, leaves of two at most, and returns its root. */
static uint32_t add(State *s, uint32_t first, uint32_t count)
{
    const uint32_t own = (uint32_t)s->node_count++;
    bvhbench_node *node = &s->nodes[own];
    node->is_leaf = count <= 2;
    node->count = count == 1 ? 1 : 2;
    node->first = (uint32_t)s->entry_count;
    s->entry_count += node->count;
    for (uint32_t half = 0; half < node->count; ++half) {
        const uint32_t at = s->nodes[own].first + half;
        if (s->nodes[own].is_leaf)
            s->entries[at] = first + half;
        else
            s->entries[at] =
                add(s, first + half * (count / 2), half ? count - count / 2 : count / 2);
    }
    return own;
}

static int build(void *state, bvhbench_stages *stages)
{
    State *s = state;
    if (is("crash"))
        raise(SIGSEGV);
    if (is("exit")) {
        fprintf(stderr, "CUDA error 700\n");
        exit(7);
    }
    if (is("hang")) {
        fclose(fopen("hangs", "w"));
        for (;;)
            pause();
    }
    if (is("chatty"))
        for (int k = 0; k < 5000; ++k)
            printf("a library that prints what it does, line %d\n", k);
    if (is("counted")) {
        FILE *file = fopen("builds", "a");
        fputc('x', file);
        fclose(file);
    }
    if (is("stopped"))
        raise(SIGSTOP);
    if (is("ends"))
        _exit(0);
    if (is("loud"))
        s->error = "\x1b[31mred\xc2\x9b\xff\nand two lines";
    if (is("loud") || is("silent"))
        return 1;
    if (is("stages")) {
        stages->count = 17;
        return 0;
    }
    if (is("all-ones")) {
        memset(stages, 0xff, sizeof *stages);
        return 0;
    }
    begin(stages, is("unknown-stage") ? "magic" : is("wild-name") ? (const char *)16 : "build");
    s->node_count = s->entry_count = 0;
    add(s, 0, (uint32_t)s->mesh.triangles);
    refresh(s);
    end(stages);
    return 0;
}

static int refit(void *state, bvhbench_stages *stages)
{
    begin(stages, "refit");
    refresh(state);
    end(stages);
    return 0;
}

static int is_sought(const State *s, uint32_t a, uint32_t b)
{
    int shared = 0;
    for (int k = 0; k < 9; ++k)
        shared |= s->mesh.faces[3 * a + k / 3] == s->mesh.faces[3 * b + k % 3];
    return !(shared && s->mesh.drops_adjacent) &&
           (s->mesh.first == 0 || (a < s->mesh.first && b >= s->mesh.first));
}

static int query_within(void *state, double distance, bvhbench_stages *stages)
{
    State *s = state;
    int added = !is("false-pair") && !is("wide");
    begin(stages, "broad");
    s->pair_count = 0;
    for (uint32_t a = 0; a < s->mesh.triangles; ++a) {
        float low[3], high[3];
        box_of(s, a, low, high);
        for (uint32_t b = a + 1; b < s->mesh.triangles; ++b) {
            float other_low[3], other_high[3];
            box_of(s, b, other_low, other_high);
            double gaps = 0; /* their squares */
            for (int axis = 0; axis < 3; ++axis) {
                const double gap = fmax(0, fmax((double)low[axis] - other_high[axis],
                                                (double)other_low[axis] - high[axis]));
                gaps += gap * gap;
            }
            const int meets = gaps <= distance * distance;
            if (!is_sought(s, a, b) || (!meets && added++))
                continue;
            if (s->pair_count == s->pair_room) {
                s->pair_room = 2 * s->pair_room + 64;
                s->pairs = realloc(s->pairs, 2 * s->pair_room * sizeof *s->pairs);
            }
            s->pairs[2 * s->pair_count] = b;
            s->pairs[2 * s->pair_count++ + 1] = a;
        }
    }
    end(stages);
    return 0;
}

static int query(void *state, bvhbench_stages *stages) { return query_within(state, 0, stages); }

static int load_candidates(void *state, uint64_t count, const uint32_t *two_each)
{
    State *s = state;
    s->candidates = two_each;
    s->candidate_count = count;
    s->pairs = realloc(s->pairs, 2 * count * sizeof *s->pairs);
    return 0;
}

static int narrow(void *state, bvhbench_stages *stages)
{
    State *s = state;
    begin(stages, "narrow");
    s->pair_count = s->candidate_count;
    memcpy(s->pairs, s->candidates, 2 * s->pair_count * sizeof *s->pairs);
    end(stages);
    return 0;
}

static int pairs(void *state, uint64_t *count, const uint32_t **two_each)
{
    State *s = state;
    *count = s->pair_count;
    *two_each = s->pairs;
    if (is("missed-pair") && s->pair_count > 0)
        --*count;
    if (is("no-contacts"))
        *count = 0;
    if (is("false-triangle") && s->pair_count > 0)
        s->pairs[0] = (uint32_t)s->mesh.triangles;
    if (is("no-array")) {
        *count = (uint64_t)1 << 61;
        *two_each = NULL;
    }
    return 0;
}

static int tree(void *state, bvhbench_tree *out)
{
    State *s = state;
    out->nodes = s->node_count;
    out->node = s->nodes;
    out->entries = s->entry_count;
    out->entry = s->entries;
    if (is("small-box"))
        s->nodes[0].high[0] = s->nodes[0].low[0];
    if (is("lost-triangle"))
        s->entries[s->entry_count - 1] = s->entries[s->entry_count - 2];
    if (is("wild-entry"))
        s->nodes[0].first = 0xffffffffu;
    return 0;
}

static int load_queries(void *state, const bvhbench_queries *queries)
{
    State *s = state;
    s->times = calloc(queries->count, sizeof *s->times);
    s->time_count = queries->count;
    return 0;
}

static int answer(void *state, bvhbench_stages *stages)
{
    State *s = state;
    begin(stages, "narrow");
    for (uint64_t k = 0; k < s->time_count; ++k)
        s->times[k] = is("misses") && k == 0 ? 2 : 0;
    end(stages);
    return 0;
}

static int times(void *state, const double **out)
{
    *out = ((State *)state)->times;
    return 0;
}

static uint64_t bytes(void *state)
{
    const State *s = state;
    return is("device-memory") ? (uint64_t)1 << 50
                               : s->mesh.triangles * (2 * sizeof *s->nodes + 16);
}

static const char *error(void *state) { return ((State *)state)->error; }

static void destroy(void *state)
{
    State *s = state;
    free(s->nodes);
    free(s->entries);
    free(s->pairs);
    free(s->times);
    if (is("double-free"))
        abort(); /* as a C library does that notices it */
    free(s);
}

/* What both methods of pairs have. */
#define OF_PAIRS                                                                        \
    .create = create, .prepare = prepare, .load = load, .query = query, .pairs = pairs, \
    .bytes = bytes, .error = error, .destroy = destroy

const bvhbench_plugin *bvhbench_plugin_entry(uint32_t host_abi)
{
    static bvhbench_method methods[] = {
        {.name = "halves",
         .summary = "halves in the given order, and every two boxes",
         OF_PAIRS,
         .build = build,
         .refit = refit,
         .tree = tree},
        {.name = "every-two",
         .summary = "no tree: every two boxes",
         OF_PAIRS,
         .load_step = load_step,
         .query_within = query_within,
         .load_candidates = load_candidates,
         .narrow = narrow},
        {.name = "at-the-start",
         .summary = "all touch at the start",
         .create = create,
         .error = error,
         .destroy = destroy,
         .load_queries = load_queries,
         .answer = answer,
         .times = times}};
    static bvhbench_plugin plugin = {
        BVHBENCH_PLUGIN_ABI, "Halves", "1.0", "MIT", "host", 3, methods};
    static char names[3][64];
    find_fault();
    if (is("old-host") || (is("version-2") && host_abi != 2))
        return NULL;
    for (int k = 0; k < 3 && planted[0] != '\0'; ++k) {
        snprintf(names[k], sizeof names[k], "%s-%s", methods[k].name, planted);
        methods[k].name = names[k];
    }
    if (is("version-2")) { /* as it was compiled then */
        const size_t bytes = offsetof(bvhbench_method, load_step);
        for (size_t k = 0; k < 3; ++k)
            memmove((char *)methods + k * bytes, &methods[k], bytes);
        plugin.abi = 2;
        return &plugin;
    }
    methods[1].widens_boxes = is("wide");
    if (is("contacts") || is("no-contacts"))
        methods[1].finds_contacts = 1;
    if (is("abi"))
        plugin.abi = BVHBENCH_PLUGIN_ABI + 1;
    if (is("dies-at-start"))
        abort();
    if (is("hangs-at-start"))
        for (;;)
            pause();
    if (is("taken-name"))
        methods[0].name = "karras";
    if (is("bad-name"))
        methods[0].name = "Halves!";
    if (is("no-pairs"))
        methods[1].pairs = NULL;
    if (is("no-load"))
        methods[1].load = NULL;
    return &plugin;
}
