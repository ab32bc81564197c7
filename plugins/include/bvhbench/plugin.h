/* SPDX-License-Identifier: MIT
 *
 * A builder, a collider or continuous collision detection from outside, as a shared library: `bvhbench --plugin ./libmine.so ...`. docs/plugins.md is a tutorial.
 *
 * The library exports one symbol, `bvhbench_plugin_entry`. bvhbench loads it in a process of its own and calls all functions from
 * one thread. For a method it calls
 *
 *     create, prepare, load, then any number of build, refit, query, pairs and tree, with a load before every new frame, destroy
 *
 * with load_step in place of load for `collide --swept`, and query_within in place of query for `collide --within`; or, for a method that
 * answers single queries of moving points, `accuracy --axis queries`,
 *
 *     create, load_queries, then any number of answer and times, destroy
 *
 * or, for a narrow phase, `accuracy --axis narrow`,
 *
 *     create, prepare, load, load_candidates, then any number of narrow and pairs, destroy
 *
 * Only build, refit, query, query_within, answer and narrow are timed: their stages by the plug-in, and each whole call by bvhbench. Both times
 * are shown. Inputs are in host memory. Uploads belong into prepare and the loads, which are not timed, as bvhbench's own uploads are not.
 *
 * A function that returns int returns 0, or anything else if it failed; `error` then says why in one sentence. Arrays that the
 * plug-in gives are the plug-in's and stay valid until the next call; faces stay valid until `destroy`, points and queries until the
 * next load.
 *
 * Every method has create, error and destroy, and what it can be judged by: prepare, load and `build` with `tree`, or `query` with `pairs`,
 * or both; or load_queries and `answer` with `times`; or prepare, load, load_candidates and `narrow` with `pairs`.
 */
#ifndef BVHBENCH_PLUGIN_H
#define BVHBENCH_PLUGIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Version of this interface. A plug-in of version 2, whose methods end at `times`, is served as well; one of another version is refused. */
#define BVHBENCH_PLUGIN_ABI 3u

/* The mesh of all frames. All objects are one set of triangles, and pairs are sought among all of them; from a method with load_step, those
 * that the last two members leave. A step has two meshes: vertices, which are triangles of three equal corners, and behind them the faces;
 * and edges, whose last two corners are equal. */
typedef struct bvhbench_mesh {
    uint64_t vertices;
    uint64_t triangles;    /* 1 or more */
    const uint32_t *faces; /* three vertices a triangle */
    /* If not 0: only pairs of one of the first triangles, as many as this, and one of the others. */
    uint64_t first;
    uint32_t drops_adjacent; /* 1: no pairs that share a vertex */
} bvhbench_mesh;

/* A part of a timed call: bounds, codes, sort, order, gather, hierarchy, refit, broad or narrow, or `build` for all up to a tree.
 * Stages are in order and do not overlap; all together they last no longer than the call. */
typedef struct bvhbench_stage {
    const char *name;
    uint64_t begin_ns; /* since a moment that is the same for all stages of a call */
    uint64_t end_ns;
    uint32_t on_device; /* 1: by the device's events; 0: by the host's clock */
} bvhbench_stage;

#define BVHBENCH_MOST_STAGES 16u

typedef struct bvhbench_stages {
    uint32_t count;
    bvhbench_stage stage[BVHBENCH_MOST_STAGES];
} bvhbench_stages;

/* A node of a tree. Its entries are nodes, or triangles in a leaf: entry[first] to entry[first + count - 1], 1 to 8 of them. */
typedef struct bvhbench_node {
    float low[3], high[3];
    uint32_t first;
    uint32_t count;
    uint32_t is_leaf;
} bvhbench_node;

/* A tree over all triangles. node[0] is the root; a node comes before its children. */
typedef struct bvhbench_tree {
    uint64_t nodes;
    const bvhbench_node *node;
    uint64_t entries;
    const uint32_t *entry;
} bvhbench_tree;

/* Queries of continuous collision detection: four points each, which move in straight lines from time 0 to time 1. */
typedef struct bvhbench_queries {
    uint64_t count; /* 1 or more */
    uint32_t
        of_edges; /* 1: the ends of the edges 0 1 and 2 3; 0: vertex 0 and the corners 1 2 3 of a face */
    const double *points; /* 24 a query: x, y, z of the four at time 0, then at time 1 */
} bvhbench_queries;

/* A way to build a tree, to find pairs, or both; or to answer queries. Functions that a method lacks are NULL. */
typedef struct bvhbench_method {
    const char *name;    /* as on the command line: small letters, digits and hyphens */
    const char *summary; /* one line, for `bvhbench list` */

    /* Makes a state; NULL if that is impossible, and `why` (256 bytes) then says why. */
    void *(*create)(char *why);
    /* Reserves memory for frames of this mesh and uploads its faces. Not timed. */
    int (*prepare)(void *state, const bvhbench_mesh *mesh);
    /* Takes the points of a frame, three floats a vertex. Not timed. */
    int (*load)(void *state, const float *points);

    /* From the frame's points to a tree, which is finished at return: a builder. NULL: `query` needs none. */
    int (*build)(void *state, bvhbench_stages *stages);
    /* New boxes for the tree of the last build, whose topology stays. */
    int (*refit)(void *state, bvhbench_stages *stages);
    /* From the tree to written pairs, which are finished at return: a collider. */
    int (*query)(void *state, bvhbench_stages *stages);

    /* Pairs of the last query, each once: two triangles, in any order. Not timed. Boxes are closed: those that touch overlap. */
    int (*pairs)(void *state, uint64_t *count, const uint32_t **two_each);
    /* 1 if `pairs` gives triangles that intersect, after load_step those that touch on the way; 0 if it gives triangles whose boxes overlap. */
    uint32_t finds_contacts;

    /* The last tree, to judge it by. Not timed. */
    int (*tree)(void *state, bvhbench_tree *tree);
    /* Bytes of device memory (or of host memory, for a method on the host) that the state holds at present. */
    uint64_t (*bytes)(void *state);

    /* Why the last call failed: one sentence. */
    const char *(*error)(void *state);
    void (*destroy)(void *state);

    /* Takes queries. Not timed. */
    int (*load_queries)(void *state, const bvhbench_queries *queries);
    /* From the queries to times, which are finished at return: the stage `narrow`. */
    int (*answer)(void *state, bvhbench_stages *stages);
    /* The last answers, one a query: a time from 0 to 1 before which the two do not touch, or one above 1 if they do not touch at all. Not
     * timed. */
    int (*times)(void *state, const double **times);

    /* Takes the points of a step in place of those of a frame, at its start and at its end, three floats a vertex each. A vertex moves in a
     * straight line, and a triangle's box is around it at both. Not timed. */
    int (*load_step)(void *state, const float *start, const float *end);
    /* As query, of triangles whose distance is at most `distance`, exactly, in the unit of the points. `pairs` gives them. */
    int (*query_within)(void *state, double distance, bvhbench_stages *stages);

    /* Takes pairs to be tested, two triangles each. They stay valid until the next load. Not timed. */
    int (*load_candidates)(void *state, uint64_t count, const uint32_t *two_each);
    /* From these to those that intersect, which `pairs` gives: the stage `narrow`. */
    int (*narrow)(void *state, bvhbench_stages *stages);

    /* 1 if boxes are rounded outward: pairs may be more than overlap, which are counted, and none may be missed. */
    uint32_t widens_boxes;
} bvhbench_method;

typedef struct bvhbench_plugin {
    uint32_t abi;        /* BVHBENCH_PLUGIN_ABI */
    const char *library; /* what is measured: "cuBQL" */
    const char *version; /* its release or commit */
    const char *licence; /* its licence: "Apache-2.0" */
    const char *device;  /* the device it runs on: "NVIDIA H200"; "host" */
    uint32_t method_count;
    const bvhbench_method *methods;
} bvhbench_plugin;

/* The symbol. Returns NULL if the plug-in cannot serve a host of interface `host_abi`. */
const bvhbench_plugin *bvhbench_plugin_entry(uint32_t host_abi);

#ifdef __cplusplus
}
#endif

#endif
