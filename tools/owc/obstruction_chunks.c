/* SPDX-License-Identifier: 0BSD */
/*
 * Chunks. A run of faces is taken window by window. In a window the relation
 * between all pairs is known, so a face is free to come next when all faces
 * that it can obstruct have come. A chunk begins with the first free face and
 * goes on with that free face which is nearest to what the chunk has so far.
 */
#include "obstruction_chunks.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

enum { WINDOW = 256 };

/* What a unit of normal weighs, in lattice steps. */
#define NORMAL_WEIGHT 20000.0
/* A chunk that has the least number of faces ends where the next face is this far off. */
#define FAR_OFF 12000.0

struct window {
    struct obstruction_set *set;
    uint32_t *faces;
    uint32_t count;
    uint32_t *order;   /* places in the window */
    uint32_t *waiting; /* faces that must come before this one and have not */
    uint8_t *before;   /* before[i * WINDOW + k]: place i must come before place k */
};

static bool must_precede(const struct window *w, uint32_t i, uint32_t k)
{
    const struct obstruction_face *first = &w->set->faces[w->faces[i]];
    const struct obstruction_face *second = &w->set->faces[w->faces[k]];
    if (first->plane == second->plane) {
        return first->sign == second->sign && obstruction_overlap(w->set, first, second);
    }
    return obstruction_holds(w->set, second, first);
}

static void relate(struct window *w)
{
    memset(w->waiting, 0, WINDOW * sizeof *w->waiting);
    for (uint32_t i = 0; i < w->count; i++) {
        for (uint32_t k = i + 1; k < w->count; k++) {
            bool before = must_precede(w, i, k);
            w->before[i * WINDOW + k] = before;
            w->waiting[k] += before;
        }
    }
}

static void place_of(const struct window *w, uint32_t place, double at[6])
{
    const struct obstruction_face *face = &w->set->faces[w->faces[place]];
    for (int k = 0; k < 3; k++) {
        at[k] = face->centre[k];
        at[k + 3] = NORMAL_WEIGHT * face->normal[k];
    }
}

/* The free face nearest to a middle, or the first one if that is NULL. */
static uint32_t nearest_free(const struct window *w, const double *middle, double *distance)
{
    uint32_t best = WINDOW;
    *distance = INFINITY;
    for (uint32_t i = 0; i < w->count; i++) {
        if (w->waiting[i] != 0) {
            continue;
        }
        if (middle == NULL) {
            return i;
        }
        double at[6];
        double square = 0;
        place_of(w, i, at);
        for (int k = 0; k < 6; k++) {
            square += (at[k] - middle[k]) * (at[k] - middle[k]);
        }
        if (square < *distance) {
            *distance = square;
            best = i;
        }
    }
    *distance = sqrt(*distance);
    return best;
}

static void take(struct window *w, uint32_t place)
{
    w->waiting[place] = UINT32_MAX; /* it has come */
    for (uint32_t k = place + 1; k < w->count; k++) {
        w->waiting[k] -= w->before[place * WINDOW + k];
    }
}

/* Orders the window; adds the ends of its chunks. */
static uint32_t divide(struct window *w, uint32_t *ends)
{
    uint32_t chunks = 0;
    uint32_t size = 0;
    double sum[6];
    for (uint32_t n = 0; n < w->count; n++) {
        double middle[6];
        double distance;
        for (int k = 0; k < 6; k++) {
            middle[k] = size > 0 ? sum[k] / size : 0;
        }
        uint32_t next = nearest_free(w, size > 0 ? middle : NULL, &distance);
        bool far_off = size >= CHUNK_LEAST && distance > FAR_OFF && w->count - n >= CHUNK_LEAST;
        if (size == 0 || size == CHUNK_MOST || far_off) {
            if (size > 0) {
                ends[chunks++] = n;
            }
            memset(sum, 0, sizeof sum);
            size = 0;
        }
        double at[6];
        place_of(w, next, at);
        for (int k = 0; k < 6; k++) {
            sum[k] += at[k];
        }
        size++;
        w->order[n] = w->faces[next];
        take(w, next);
    }
    ends[chunks++] = w->count;
    memcpy(w->faces, w->order, w->count * sizeof *w->faces);
    return chunks;
}

uint32_t obstruction_chunks(struct obstruction_set *set, uint32_t *faces, uint32_t count,
                            uint32_t *ends)
{
    struct window w = { .set = set };
    uint32_t chunks = 0;
    w.order = xalloc(WINDOW, sizeof *w.order);
    w.waiting = xalloc(WINDOW, sizeof *w.waiting);
    w.before = xalloc(WINDOW * WINDOW, 1);
    for (uint32_t at = 0; at < count; at += w.count) {
        w.faces = faces + at;
        w.count = count - at < WINDOW + CHUNK_LEAST ? count - at : WINDOW;
        w.count = w.count > WINDOW ? WINDOW / 2 : w.count;
        relate(&w);
        uint32_t more = divide(&w, ends + chunks);
        for (uint32_t i = chunks; i < chunks + more; i++) {
            ends[i] += at;
        }
        chunks += more;
    }
    free(w.order);
    free(w.waiting);
    free(w.before);
    return chunks;
}
