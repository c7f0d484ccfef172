/* SPDX-License-Identifier: 0BSD */
/*
 * Choosing the plane of a switch. Candidates are polygons' own planes, planes
 * through an edge and a vertex, and planes swept through the gaps along some
 * directions. A candidate's worth is what it cuts for each bit of order that
 * it brings: n faces that hang together lack n log n bits. First all faces
 * across a plane count as cut; then, of the best, those that cannot stay
 * whole; then, in small sets, the bits are those of the components that are
 * left. All this in floating point; what the chosen plane really does is
 * decided exactly.
 */
#include "obstruction_plane.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "obstruction_ahead.h"
#include "obstruction_boxes.h"
#include "obstruction_whole.h"
#include "tools/common/xalloc.h"

/* ---- candidates ---- */

struct candidate {
    double normal[3]; /* unit */
    double offset;
    int32_t n[3];
    int64_t d;
    uint32_t record;          /* MESH_NONE: a new plane */
    double score;             /* the less, the better */
    uint32_t cuts;            /* faces that cannot stay whole */
    const double *through[3]; /* points that it goes through, or NULL */
};

struct chooser {
    struct obstruction_set *set;
    struct planes *planes;
    const struct obstruction_effort *effort;
    struct random *random;
    struct candidate *best; /* finalists, the best first */
    uint32_t best_count;
    struct obstruction_boxes boxes;
    struct keeper keeper;
    uint8_t *places;
    uint32_t *cut; /* faces that the candidate judged last cuts */
    uint32_t cut_count;
    uint32_t *targets; /* faces that the plane being improved cuts */
    uint32_t target_count;
};

static double bits(double n)
{
    return n > 1 ? n * log2(n) : 0;
}

static double score_of(const struct chooser *c, double cuts, double bits_left)
{
    double gain = bits(c->set->count) - bits_left;
    return gain > 0 ? (cuts + c->effort->price) / gain : INFINITY;
}

/* The least and the greatest height of a face's corners above n.x + offset = 0. */
static void heights_of(const struct obstruction_set *set, const struct obstruction_face *face,
                       const double normal[3], double offset, double range[2])
{
    const double(*points)[3] = (const double(*)[3])set->points + face->first;
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (uint32_t i = 0; i < face->count; i++) {
        double height =
            normal[0] * points[i][0] + normal[1] * points[i][1] + normal[2] * points[i][2] + offset;
        range[0] = height < range[0] ? height : range[0];
        range[1] = height > range[1] ? height : range[1];
    }
}

/* Where a candidate puts a face. */
static enum obstruction_place candidate_place(const struct chooser *c,
                                              const struct candidate *candidate, uint32_t number)
{
    const struct obstruction_face *face = &c->set->faces[number];
    double height = candidate->normal[0] * face->centre[0] +
                    candidate->normal[1] * face->centre[1] +
                    candidate->normal[2] * face->centre[2] + candidate->offset;
    if (face->plane == candidate->record) {
        return OBSTRUCTION_ON;
    }
    double step = c->set->step;
    double slack = c->set->slack;
    if (fabs(height) > face->radius + step) {
        return height > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
    }
    double range[2];
    heights_of(c->set, face, candidate->normal, candidate->offset, range);
    if (range[1] > slack && range[0] < -slack) {
        return OBSTRUCTION_ACROSS;
    }
    if (range[1] <= step && range[0] >= -step) {
        return OBSTRUCTION_ON;
    }
    return range[1] > -range[0] ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
}

/* Counts faces by place, notes those across, and the places of all if asked to. */
static void place_faces(struct chooser *c, const struct candidate *candidate, uint8_t *places,
                        uint32_t most, uint32_t counts[4])
{
    memset(counts, 0, 4 * sizeof counts[0]);
    c->cut_count = 0;
    for (uint32_t i = 0; i < c->boxes.count && c->cut_count <= most;) {
        const struct obstruction_box *box = &c->boxes.all[i];
        const uint32_t *faces = c->boxes.faces + box->first;
        double reach;
        double height = obstruction_box_height(box, candidate->normal, candidate->offset, &reach);
        if (fabs(height) > reach + c->set->step) {
            uint8_t side = height > 0 ? OBSTRUCTION_FRONT : OBSTRUCTION_BACK;
            counts[side] += box->count;
            for (uint32_t k = 0; places != NULL && k < box->count; k++) {
                places[faces[k]] = side;
            }
            i = box->next;
            continue;
        }
        for (uint32_t k = 0; box->count <= OBSTRUCTION_LEAF && k < box->count; k++) {
            enum obstruction_place place = candidate_place(c, candidate, faces[k]);
            counts[place]++;
            if (place == OBSTRUCTION_ACROSS) {
                c->cut[c->cut_count++] = faces[k];
            }
            if (places != NULL) {
                places[faces[k]] = (uint8_t)place;
            }
        }
        i++;
    }
}

/* Judges a candidate. Infinite: it takes us no further, or is worse than limit. */
static double judge(struct chooser *c, const struct candidate *candidate, double limit)
{
    uint32_t counts[4];
    double most = 2 * limit * c->set->count + 8;
    place_faces(c, candidate, NULL, most < UINT32_MAX ? (uint32_t)most : UINT32_MAX, counts);
    double cuts = counts[OBSTRUCTION_ACROSS];
    double front = counts[OBSTRUCTION_FRONT];
    double back = counts[OBSTRUCTION_BACK];
    bool further = counts[OBSTRUCTION_ON] > 0 || (front > 0 && back > 0);
    return further && cuts <= most ? score_of(c, cuts, bits(front + cuts) + bits(back + cuts))
                                   : INFINITY;
}

/* Judges a candidate by what cannot stay whole; fills places. */
static double judge_whole(struct chooser *c, const struct candidate *candidate, double limit)
{
    uint32_t counts[4];
    place_faces(c, candidate, c->places, UINT32_MAX, counts);
    double most = smaller(2 * limit * c->set->count + 8, UINT32_MAX);
    double cuts =
        keeper_keep(&c->keeper, candidate->normal, candidate->offset, c->places, (uint32_t)most);
    if (cuts > most) {
        return INFINITY;
    }
    uint32_t left = 0;
    for (uint32_t i = 0; i < c->cut_count; i++) {
        uint8_t place = c->places[c->cut[i]];
        counts[place] += place != OBSTRUCTION_ACROSS;
        c->cut[left] = c->cut[i];
        left += place == OBSTRUCTION_ACROSS;
    }
    c->cut_count = left;
    double front = counts[OBSTRUCTION_FRONT];
    double back = counts[OBSTRUCTION_BACK];
    bool further = counts[OBSTRUCTION_ON] > 0 || (front > 0 && back > 0);
    return further ? score_of(c, cuts, bits(front + cuts) + bits(back + cuts)) : INFINITY;
}

/* Takes a candidate among the finalists if it is good enough. */
static void enter(struct chooser *c, struct candidate *candidate)
{
    uint32_t most = c->effort->finalists;
    double limit = c->best_count < most ? INFINITY : c->best[most - 1].score;
    candidate->score = judge(c, candidate, limit);
    if (!(candidate->score < limit)) {
        return;
    }
    uint32_t at = c->best_count < most ? c->best_count++ : most - 1;
    while (at > 0 && c->best[at - 1].score > candidate->score) {
        c->best[at] = c->best[at - 1];
        at--;
    }
    c->best[at] = *candidate;
}

static void set_unit(struct candidate *candidate)
{
    double n[3] = { candidate->n[0], candidate->n[1], candidate->n[2] };
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) {
        candidate->normal[k] = n[k] / length;
    }
    candidate->offset = (double)candidate->d / length;
}

static void enter_own(struct chooser *c, uint32_t record)
{
    const struct plane *plane = &c->planes->all[record];
    struct candidate candidate = { .d = plane->d, .record = record };
    memcpy(candidate.n, plane->n, sizeof candidate.n);
    set_unit(&candidate);
    enter(c, &candidate);
}

/* The plane with this normal, of any length, through a point. False: the normal is none. */
static bool make_plane(struct candidate *candidate, const double normal[3], const double point[3])
{
    const double limit = (1 << NORMAL_BITS) - 1;
    double greatest = larger(fabs(normal[0]), larger(fabs(normal[1]), fabs(normal[2])));
    if (!(greatest > 0)) {
        return false;
    }
    *candidate = (struct candidate){ .record = MESH_NONE };
    double d = 0;
    for (int k = 0; k < 3; k++) {
        candidate->n[k] = (int32_t)floor(normal[k] / greatest * limit + 0.5);
        d -= candidate->n[k] * point[k];
    }
    candidate->d = (int64_t)floor(d + 0.5);
    set_unit(candidate);
    return true;
}

static const struct obstruction_face *any_face(const struct chooser *c)
{
    return &c->set->faces[random_below(c->random, c->set->count)];
}

static void try_own_planes(struct chooser *c)
{
    bool all = c->set->count <= c->effort->own;
    uint32_t count = all ? c->set->count : c->effort->own;
    uint32_t before = MESH_NONE;
    for (uint32_t i = 0; i < count; i++) {
        const struct obstruction_face *face = all ? &c->set->faces[i] : any_face(c);
        if (face->plane != before) {
            enter_own(c, face->plane);
        }
        before = face->plane;
    }
}

static void cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void subtract(const double a[3], const double b[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = a[k] - b[k];
    }
}

static bool make_through(struct candidate *candidate, const double *a, const double *b,
                         const double *c)
{
    double ab[3];
    double ac[3];
    double normal[3];
    subtract(b, a, ab);
    subtract(c, a, ac);
    cross(ab, ac, normal);
    if (!make_plane(candidate, normal, a)) {
        return false;
    }
    candidate->through[0] = a;
    candidate->through[1] = b;
    candidate->through[2] = c;
    return true;
}

static const double *any_corner(const struct chooser *c, const struct obstruction_face *face)
{
    return c->set->points[face->first + random_below(c->random, face->count)];
}

/* Through an edge of a face: upright on the face, or to a corner of another. */
static void try_edge(struct chooser *c)
{
    const struct obstruction_face *face = any_face(c);
    const double(*points)[3] = (const double(*)[3])c->set->points + face->first;
    uint32_t corner = random_below(c->random, face->count);
    const double *from = points[corner];
    const double *to = points[corner + 1 < face->count ? corner + 1 : 0];
    struct candidate candidate;
    bool made;
    if (random_below(c->random, 4) == 0) {
        double edge[3];
        double normal[3];
        subtract(to, from, edge);
        cross(edge, face->normal, normal);
        made = make_plane(&candidate, normal, from);
    } else {
        made = make_through(&candidate, from, to, any_corner(c, any_face(c)));
    }
    if (made) {
        enter(c, &candidate);
    }
}

/* ---- climbing ---- */

/* A face that the plane being improved cuts. */
static const struct obstruction_face *any_target(const struct chooser *c)
{
    return c->target_count == 0
               ? any_face(c)
               : &c->set->faces[c->targets[random_below(c->random, c->target_count)]];
}

static void note_targets(struct chooser *c)
{
    uint32_t *swap = c->targets;
    c->targets = c->cut;
    c->cut = swap;
    c->target_count = c->cut_count;
}

/* Moves one of the three points to a corner of a face that is cut, as long as that helps. */
static void climb(struct chooser *c, struct candidate *candidate)
{
    if (candidate->through[0] == NULL || !(candidate->score < INFINITY)) {
        return;
    }
    judge(c, candidate, INFINITY);
    note_targets(c);
    for (uint32_t i = 0; i < c->effort->climbs && c->target_count > 0; i++) {
        const double *through[3];
        struct candidate next;
        memcpy(through, candidate->through, sizeof through);
        const double *corner = any_corner(c, any_target(c)); /* drawn first */
        through[random_below(c->random, 3)] = corner;
        if (!make_through(&next, through[0], through[1], through[2])) {
            continue;
        }
        next.score = judge(c, &next, candidate->score);
        if (next.score < candidate->score) {
            *candidate = next;
            note_targets(c);
        }
    }
}

/* ---- planes swept through gaps ---- */

/* Where a face begins or ends along a direction. */
struct bound {
    double at;
    int step;
};

static int compare_bounds(const void *left, const void *right)
{
    const struct bound *a = left;
    const struct bound *b = right;
    return a->at != b->at ? (a->at > b->at ? 1 : -1) : a->step - b->step;
}

/* The best place between two bounds; false if there is none. */
static bool best_gap(const struct chooser *c, const struct bound *bounds, uint32_t count,
                     double *at)
{
    double best = INFINITY;
    uint32_t begun = 0;
    uint32_t ended = 0;
    for (uint32_t i = 0; i + 1 < 2 * count; i++) {
        begun += bounds[i].step > 0;
        ended += bounds[i].step < 0;
        if (ended == 0 || begun == count || !(bounds[i + 1].at > bounds[i].at)) {
            continue;
        }
        double gain = bits(count) - bits(begun) - bits(count - ended);
        double score = gain > 0 ? (begun - ended + c->effort->price) / gain : INFINITY;
        if (score < best) {
            best = score;
            *at = (bounds[i].at + bounds[i + 1].at) / 2;
        }
    }
    return best < INFINITY;
}

static void sweep(struct chooser *c, const double way[3], const uint32_t *sample, uint32_t count,
                  struct bound *bounds)
{
    double shrink = c->set->step;
    for (uint32_t i = 0; i < count; i++) {
        double range[2];
        heights_of(c->set, &c->set->faces[sample[i]], way, 0, range);
        double middle = (range[0] + range[1]) / 2; /* what reaches across less is not cut */
        bounds[2 * i] = (struct bound){ smaller(range[0] + shrink, middle), 1 };
        bounds[2 * i + 1] = (struct bound){ larger(range[1] - shrink, middle), -1 };
    }
    qsort(bounds, 2 * (size_t)count, sizeof *bounds, compare_bounds);
    double at = 0;
    if (best_gap(c, bounds, count, &at)) {
        double point[3] = { way[0] * at, way[1] * at, way[2] * at };
        struct candidate candidate;
        if (make_plane(&candidate, way, point)) {
            enter(c, &candidate);
        }
    }
}

static double random_unit(struct chooser *c)
{
    return (double)random_below(c->random, 1u << 30) / (1u << 29) - 1;
}

static void try_sweeps(struct chooser *c)
{
    uint32_t count = c->set->count < c->effort->sample ? c->set->count : c->effort->sample;
    uint32_t *sample = xalloc(count, sizeof *sample);
    struct bound *bounds = xalloc(2 * (size_t)count, sizeof *bounds);
    for (uint32_t i = 0; i < count; i++) {
        sample[i] = count < c->set->count ? random_below(c->random, c->set->count) : i;
    }
    for (uint32_t i = 0; i < c->effort->directions; i++) {
        double way[3] = { i == 0, i == 1, i == 2 };
        double length = 1;
        if (i > 2) {
            for (int k = 0; k < 3; k++) {
                way[k] = random_unit(c);
            }
            length = sqrt(way[0] * way[0] + way[1] * way[1] + way[2] * way[2]);
        }
        if (length > 0.01) {
            way[0] /= length;
            way[1] /= length;
            way[2] /= length;
            sweep(c, way, sample, count, bounds);
        }
    }
    free(sample);
    free(bounds);
}

/* ---- choosing ---- */

static int compare_candidates(const void *left, const void *right)
{
    double a = ((const struct candidate *)left)->score;
    double b = ((const struct candidate *)right)->score;
    return (a > b) - (a < b);
}

static void find_finalists(struct chooser *c)
{
    try_own_planes(c);
    for (uint32_t i = 0; i < c->effort->edges; i++) {
        try_edge(c);
    }
    try_sweeps(c);
    for (uint32_t i = 0; i < c->best_count && i < c->effort->climbers; i++) {
        climb(c, &c->best[i]);
    }
    for (uint32_t i = 0; i < c->best_count; i++) {
        c->best[i].score = judge_whole(c, &c->best[i], INFINITY);
        c->best[i].cuts = c->cut_count;
    }
    qsort(c->best, c->best_count, sizeof *c->best, compare_candidates);
}

/* Of those that cut as little as the best, the best by the components that they leave. */
static void look_ahead(struct chooser *c)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->best_count && count < c->effort->looks; i++) {
        struct candidate candidate = c->best[i];
        if (candidate.score < INFINITY && candidate.cuts <= c->best[0].cuts) {
            c->best[i] = c->best[count];
            judge_whole(c, &candidate, INFINITY);
            double left =
                obstruction_bits_ahead(c->set, candidate.normal, candidate.offset, c->places);
            candidate.score = score_of(c, candidate.cuts, left);
            c->best[count++] = candidate;
        }
    }
    qsort(c->best, count, sizeof *c->best, compare_candidates);
}

/* Where each face goes, exactly. False: all would go into one child. */
static bool find_places(struct chooser *c, uint32_t number, uint8_t *places)
{
    const struct plane *plane = &c->planes->all[number];
    double length = sqrt(plane->normal[0] * plane->normal[0] + plane->normal[1] * plane->normal[1] +
                         plane->normal[2] * plane->normal[2]);
    double normal[3] = { plane->normal[0] / length, plane->normal[1] / length,
                         plane->normal[2] / length };
    bool front = false; /* something is in front alone, or on the plane */
    bool back = false;
    for (uint32_t i = 0; i < c->set->count; i++) {
        places[i] = (uint8_t)split_side_of(c->set->arrangement, c->set->pieces,
                                           c->set->faces[i].piece, number);
        front |= places[i] == OBSTRUCTION_FRONT || places[i] == OBSTRUCTION_ON;
        back |= places[i] == OBSTRUCTION_BACK || places[i] == OBSTRUCTION_ON;
    }
    keeper_keep(&c->keeper, normal, plane->offset / length, places, UINT32_MAX);
    return front && back;
}

static void choose_best(struct chooser *c, struct obstruction_choice *choice, uint8_t *places,
                        uint32_t spare)
{
    for (uint32_t i = 0; i < c->best_count && c->best[i].score < INFINITY; i++) {
        const struct candidate *best = &c->best[i];
        choice->record = best->record;
        choice->d = best->d;
        memcpy(choice->n, best->n, sizeof choice->n);
        if (best->record == MESH_NONE) {
            plane_set(&c->planes->all[spare], best->n, best->d, 0, c->planes->tolerance_q8);
        }
        if (find_places(c, best->record != MESH_NONE ? best->record : spare, places) ||
            best->record != MESH_NONE) { /* its own faces lie on it */
            return;
        }
    }
    choice->record = c->set->faces[0].plane;
    find_places(c, choice->record, places);
}

void obstruction_choose(struct obstruction_choice *choice, uint8_t *places,
                        struct obstruction_set *set, struct planes *planes, uint32_t spare,
                        const struct obstruction_effort *effort, struct random *random)
{
    struct chooser c = { .set = set, .planes = planes, .effort = effort, .random = random };
    c.best = xalloc(effort->finalists, sizeof *c.best);
    c.places = xalloc(set->count, sizeof *c.places);
    c.cut = xalloc(set->count, sizeof *c.cut);
    c.targets = xalloc(set->count, sizeof *c.targets);
    obstruction_boxes_begin(&c.boxes, set);
    keeper_begin(&c.keeper, set);
    find_finalists(&c);
    if (set->count <= effort->ahead) {
        look_ahead(&c);
    }
    choose_best(&c, choice, places, spare);
    keeper_free(&c.keeper);
    obstruction_boxes_free(&c.boxes);
    free(c.best);
    free(c.places);
    free(c.cut);
    free(c.targets);
}
