/* SPDX-License-Identifier: 0BSD */
/*
 * The feudal priority tree. A group is what a connecting node has still to
 * place. Polygons of one plane share one row of the table of one-way
 * priorities: those that look against the plane read it with front and back
 * exchanged. So the paper's copying of rows costs nothing, and a million
 * coplanar polygons have one row.
 */
#include "feudal.h"

#include <stdlib.h>
#include <string.h>

#include "map64.h"
#include "tools/common/fail.h"
#include "tools/common/xalloc.h"

/* A table of more bytes than this is refused. */
#define MOST_TABLE_BYTES ((uint64_t)2 << 30)

enum fate {
    STAYS,
    TO_FRONT, /* polygons that look along the plane's normal go to the front bunch */
    TO_BACK   /* they go to the back bunch; those that look against it always to the other */
};

struct row {
    uint32_t plane;
    uint32_t members;   /* polygons in this plane that are left */
    uint8_t *sides;     /* enum split_side of each member of the group; NULL: not known yet */
    uint32_t counts[4]; /* members that are left, by side; those in the plane itself are ON */
    enum fate fate;
};

struct member {
    uint32_t polygon;
    uint32_t row;
    bool gone;
};

struct group {
    uint32_t node;
    bool dynamic;
    struct member *members;
    uint32_t count;
    uint32_t left;
    struct row *rows; /* in the order in which their first members come */
    uint32_t row_count;
};

struct maker {
    struct feudal *feudal;
    const struct feudal_source *source;
    struct progress *progress;
    struct group *tasks;
    size_t task_count;
    size_t task_capacity;
    uint64_t table_bytes;
    uint64_t placed;
    uint64_t waiting;
};

/* ---- rows ---- */

static void check_room(const struct maker *m, uint64_t more)
{
    if (m->table_bytes + more > MOST_TABLE_BYTES) {
        fail(FAIL_INPUT, NULL, 0,
             "the table of one-way priorities needs more than %llu bytes, use another --method",
             (unsigned long long)MOST_TABLE_BYTES);
    }
}

static uint8_t *new_sides(struct maker *m, uint32_t count)
{
    check_room(m, count);
    m->table_bytes += count;
    return xalloc(count, 1);
}

static void free_sides(struct maker *m, struct row *row, uint32_t count)
{
    if (row->sides != NULL) {
        m->table_bytes -= count;
        free(row->sides);
        row->sides = NULL;
    }
}

static void compute_row(struct maker *m, struct group *g, uint32_t number)
{
    struct row *row = &g->rows[number];
    row->sides = new_sides(m, g->count);
    memset(row->counts, 0, sizeof row->counts);
    for (uint32_t i = 0; i < g->count; i++) {
        const struct member *member = &g->members[i];
        if (member->gone) {
            continue;
        }
        enum split_side side = SPLIT_ON;
        if (member->row != number) {
            side = m->source->side(m->source->context, member->polygon, row->plane);
        }
        row->sides[i] = (uint8_t)side;
        row->counts[side]++;
    }
    m->feudal->relations += g->left - 1;
}

/* Gives every member its row; the rows' sides are not known yet. */
static void find_rows(struct maker *m, struct group *g)
{
    struct map64 numbers = { 0 };
    g->rows = xalloc(g->count, sizeof *g->rows);
    g->row_count = 0;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t plane = m->source->plane(m->source->context, g->members[i].polygon);
        uint32_t row = map64_put(&numbers, plane, g->row_count);
        if (row == g->row_count) {
            g->rows[g->row_count++] = (struct row){ .plane = plane };
        }
        g->members[i].row = row;
        g->rows[row].members++;
    }
    map64_free(&numbers);
    g->rows = xresize(g->rows, g->row_count, sizeof *g->rows);
}

/* ---- absolute priority ---- */

/* The first of a row's members that is left decides where all are alone in their plane. */
static void find_fate(struct maker *m, const struct group *g, uint32_t number)
{
    struct row *row = &g->rows[number];
    row->fate = STAYS;
    if (row->counts[SPLIT_ACROSS] > 0) {
        return;
    }
    if (row->counts[SPLIT_FRONT] > 0 || row->counts[SPLIT_BACK] > 0) {
        row->fate = row->counts[SPLIT_FRONT] == 0  ? TO_FRONT
                    : row->counts[SPLIT_BACK] == 0 ? TO_BACK
                                                   : STAYS;
        return;
    }
    uint32_t i = 0;
    while (g->members[i].gone || g->members[i].row != number) {
        i++;
    }
    bool reversed = m->source->reversed(m->source->context, g->members[i].polygon);
    row->fate = reversed ? TO_FRONT : TO_BACK; /* the paper asks for back priority first */
}

static void put_polygon(struct maker *m, struct feudal_bunch *bunch, uint32_t polygon)
{
    struct feudal *f = m->feudal;
    f->polygons =
        xgrow(f->polygons, &f->polygon_capacity, f->polygon_count + 1, sizeof *f->polygons);
    f->polygons[f->polygon_count++] = polygon;
    bunch->count++;
    m->placed++;
    m->waiting--;
}

static struct feudal_bunch gather(struct maker *m, const struct group *g, bool front)
{
    struct feudal_bunch bunch = { m->feudal->polygon_count, 0 };
    for (uint32_t i = 0; i < g->count; i++) {
        const struct member *member = &g->members[i];
        if (member->gone || g->rows[member->row].fate == STAYS) {
            continue;
        }
        bool reversed = m->source->reversed(m->source->context, member->polygon);
        if ((g->rows[member->row].fate == TO_FRONT) != reversed ? front : !front) {
            put_polygon(m, &bunch, member->polygon);
        }
    }
    return bunch;
}

/* Takes away members that have a fate. */
static void delete_taken(struct maker *m, struct group *g)
{
    uint32_t *taken = xalloc(g->left, sizeof *taken);
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->count; i++) {
        struct member *member = &g->members[i];
        if (!member->gone && g->rows[member->row].fate != STAYS) {
            member->gone = true;
            taken[count++] = i;
        }
    }
    g->left -= count;
    for (uint32_t r = 0; r < g->row_count; r++) {
        struct row *row = &g->rows[r];
        if (row->fate != STAYS) {
            free_sides(m, row, g->count);
            row->members = 0;
            row->fate = STAYS;
        }
        for (uint32_t i = 0; row->sides != NULL && i < count; i++) {
            row->counts[row->sides[taken[i]]]--;
        }
    }
    free(taken);
}

/* One more level of the group's connecting node, of the members that have a fate. */
static void take_level(struct maker *m, struct group *g)
{
    struct feudal *f = m->feudal;
    struct feudal_level level;
    level.back = gather(m, g, false);
    level.front = gather(m, g, true);
    delete_taken(m, g);
    f->levels = xgrow(f->levels, &f->level_capacity, f->level_count + 1, sizeof *f->levels);
    f->levels[f->level_count++] = level;
    f->nodes[g->node].level_count++;
}

/* ---- switches ---- */

static uint32_t add_node(struct feudal *f)
{
    f->nodes = xgrow(f->nodes, &f->node_capacity, (size_t)f->node_count + 1, sizeof *f->nodes);
    f->nodes[f->node_count] = (struct feudal_node){
        .plane = FEUDAL_NONE, .polygon = FEUDAL_NONE, .front = FEUDAL_NONE, .back = FEUDAL_NONE
    };
    return f->node_count++;
}

/* What becomes of one side of a divided group. */
struct half {
    struct group group;
    uint32_t *from; /* each member's number in the divided group */
    bool *is_part;
};

static void half_begin(struct half *half, const struct group *g)
{
    uint32_t room = g->left;
    *half = (struct half){ .group = { .dynamic = g->dynamic } };
    half->group.members = xalloc(room, sizeof *half->group.members);
    half->from = xalloc(room, sizeof *half->from);
    half->is_part = xalloc(room, sizeof *half->is_part);
}

static void half_add(struct half *half, uint32_t polygon, uint32_t from, bool is_part)
{
    if (polygon == FEUDAL_NONE) {
        return;
    }
    uint32_t at = half->group.count++;
    half->group.members[at] = (struct member){ .polygon = polygon };
    half->from[at] = from;
    half->is_part[at] = is_part;
}

/* The side of a member in a known row of the divided group: a part of what is cut is looked at. */
static uint8_t side_of_member(struct maker *m, const struct half *half, uint32_t i,
                              const struct row *old, uint32_t row)
{
    const struct member *member = &half->group.members[i];
    uint8_t side = old->sides[half->from[i]];
    if (member->row == row || !half->is_part[i] || side != SPLIT_ACROSS) {
        return side;
    }
    m->feudal->relations++;
    return (uint8_t)m->source->side(m->source->context, member->polygon, old->plane);
}

/* The divided group's known rows, cut down to this half. */
static void inherit_rows(struct maker *m, struct half *half, const struct group *g)
{
    struct group *h = &half->group;
    bool *done = xalloc_zero(h->row_count, sizeof *done);
    for (uint32_t i = 0; i < h->count; i++) {
        uint32_t number = h->members[i].row;
        struct row *row = &h->rows[number];
        const struct row *old = &g->rows[g->members[half->from[i]].row];
        if (done[number] || old->sides == NULL) {
            continue;
        }
        done[number] = true;
        row->sides = new_sides(m, h->count);
        for (uint32_t k = 0; k < h->count; k++) {
            row->sides[k] = side_of_member(m, half, k, old, number);
            row->counts[row->sides[k]]++;
        }
    }
    free(done);
}

static uint32_t half_end(struct maker *m, struct half *half, const struct group *g)
{
    struct group *h = &half->group;
    uint32_t node = FEUDAL_NONE;
    if (h->count > 0) {
        h->members = xresize(h->members, h->count, sizeof *h->members);
        h->left = h->count;
        h->node = node = add_node(m->feudal);
        find_rows(m, h);
        inherit_rows(m, half, g);
        m->tasks = xgrow(m->tasks, &m->task_capacity, m->task_count + 1, sizeof *m->tasks);
        m->tasks[m->task_count++] = *h;
    } else {
        free(h->members);
    }
    free(half->from);
    free(half->is_part);
    return node;
}

/* One more column in a row, for a part of a member. */
static void add_column(struct maker *m, struct group *g, uint32_t r, uint32_t from, uint32_t at)
{
    struct row *row = &g->rows[r];
    const struct member *part = &g->members[at];
    uint8_t side = row->sides[from];
    if (side == SPLIT_ACROSS && part->row != r) {
        m->feudal->relations++;
        side = (uint8_t)m->source->side(m->source->context, part->polygon, row->plane);
    }
    row->sides[at] = side;
    row->counts[side]++;
}

/* Members that are not in the half are gone; its parts are put at the end. */
static void keep_members(const struct half *half, struct group *g, uint32_t *taken,
                         uint32_t *taken_count)
{
    const struct group *h = &half->group;
    uint32_t old = g->count;
    uint32_t next = 0; /* of the half */
    g->members = xresize(g->members, (size_t)old + h->count, sizeof *g->members);
    for (uint32_t i = 0; i < old; i++) {
        bool stays = next < h->count && half->from[next] == i && !half->is_part[next];
        if (next < h->count && half->from[next] == i) {
            if (half->is_part[next]) {
                struct member part = { .polygon = h->members[next].polygon,
                                       .row = g->members[i].row };
                g->rows[part.row].members++;
                g->members[g->count++] = part;
            }
            next++;
        }
        if (!stays && !g->members[i].gone) {
            g->members[i].gone = true;
            g->rows[g->members[i].row].members--;
            taken[(*taken_count)++] = i;
        }
    }
}

/*
 * The half with most members takes over the divided group's table: what is gone
 * is counted off, parts become new columns. So a switch costs as much as it takes away.
 */
static uint32_t half_take_over(struct maker *m, struct half *half, struct group *g)
{
    uint32_t old = g->count;
    uint32_t taken_count = 0;
    uint32_t *taken = xalloc(g->left, sizeof *taken);
    keep_members(half, g, taken, &taken_count);
    for (uint32_t r = 0; r < g->row_count; r++) {
        struct row *row = &g->rows[r];
        if (row->members == 0) {
            free_sides(m, row, old);
        }
        if (row->sides == NULL) {
            continue;
        }
        for (uint32_t i = 0; i < taken_count; i++) {
            row->counts[row->sides[taken[i]]]--;
        }
        row->sides = xresize(row->sides, g->count, 1);
        m->table_bytes += g->count - old;
        for (uint32_t i = 0, at = old; at < g->count; i++) {
            if (half->is_part[i]) {
                add_column(m, g, r, half->from[i], at++);
            }
        }
    }
    g->left = half->group.count;
    g->node = add_node(m->feudal);
    m->tasks = xgrow(m->tasks, &m->task_capacity, m->task_count + 1, sizeof *m->tasks);
    m->tasks[m->task_count++] = *g;
    uint32_t node = g->node;
    *g = (struct group){ 0 }; /* the task has it all */
    free(taken);
    free(half->group.members);
    free(half->from);
    free(half->is_part);
    return node;
}

/* What lies in the row's plane; the rest goes to the halves, in front and behind. */
static void sort_out(struct maker *m, const struct group *g, uint32_t number,
                     struct feudal_node *node, struct half halves[2])
{
    const struct row *row = &g->rows[number];
    const struct feudal_source *source = m->source;
    for (uint32_t i = 0; i < g->count; i++) {
        uint32_t parts[2];
        uint32_t polygon = g->members[i].polygon;
        if (g->members[i].gone) {
            continue;
        }
        switch ((enum split_side)row->sides[i]) {
        case SPLIT_ON:
            if (g->members[i].row == number && node->polygon == FEUDAL_NONE) {
                node->polygon = polygon;
            }
            put_polygon(m, &node->on, polygon);
            break;
        case SPLIT_FRONT:
            half_add(&halves[0], polygon, i, false);
            break;
        case SPLIT_BACK:
            half_add(&halves[1], polygon, i, false);
            break;
        case SPLIT_ACROSS:
            source->split(source->context, polygon, row->plane, parts);
            half_add(&halves[0], parts[0], i, true);
            half_add(&halves[1], parts[1], i, true);
            m->waiting += parts[0] != FEUDAL_NONE && parts[1] != FEUDAL_NONE;
            break;
        }
    }
}

/* Makes the row's plane the switch; what is left goes to its two sides. */
static void divide(struct maker *m, struct group *g, uint32_t number)
{
    struct feudal_node node = m->feudal->nodes[g->node];
    uint32_t place = g->node;
    uint32_t children[2];
    struct half halves[2]; /* in front, behind */
    node.plane = g->rows[number].plane;
    node.on.first = m->feudal->polygon_count;
    half_begin(&halves[0], g);
    half_begin(&halves[1], g);
    sort_out(m, g, number, &node, halves);
    int larger = halves[0].group.count < halves[1].group.count;
    children[1 - larger] = half_end(m, &halves[1 - larger], g);
    if (halves[larger].group.count > g->count / 2) {
        children[larger] = half_take_over(m, &halves[larger], g);
    } else {
        children[larger] = half_end(m, &halves[larger], g);
    }
    node.front = children[0];
    node.back = children[1];
    m->feudal->nodes[place] = node;
    g->left = 0;
}

/* ---- the two versions ---- */

static bool take_all_absolute(struct maker *m, struct group *g)
{
    bool found = false;
    for (uint32_t r = 0; r < g->row_count; r++) {
        if (g->rows[r].members > 0) {
            find_fate(m, g, r);
            found = found || g->rows[r].fate != STAYS;
        }
    }
    if (found) {
        take_level(m, g);
    }
    return found;
}

/* Cuts nothing, or least; then most balanced; then first. */
static uint32_t choose_row(const struct group *g)
{
    uint32_t best = FEUDAL_NONE;
    uint64_t best_score = 0;
    for (uint32_t r = 0; r < g->row_count; r++) {
        const uint32_t *counts = g->rows[r].counts;
        uint32_t imbalance = counts[SPLIT_FRONT] > counts[SPLIT_BACK]
                                 ? counts[SPLIT_FRONT] - counts[SPLIT_BACK]
                                 : counts[SPLIT_BACK] - counts[SPLIT_FRONT];
        uint64_t score = (uint64_t)counts[SPLIT_ACROSS] << 32 | imbalance;
        if (g->rows[r].members > 0 && (best == FEUDAL_NONE || score < best_score)) {
            best = r;
            best_score = score;
        }
    }
    return best;
}

static void show(struct maker *m)
{
    if (m->progress != NULL) {
        progress_show(m->progress, "building", m->placed, m->placed + m->waiting);
    }
}

static void run_static(struct maker *m, struct group *g)
{
    uint64_t unknown = 0;
    for (uint32_t r = 0; r < g->row_count; r++) {
        unknown += g->rows[r].members > 0 && g->rows[r].sides == NULL;
    }
    check_room(m, unknown * g->count); /* before it takes long */
    for (uint32_t r = 0; r < g->row_count; r++) {
        if (g->rows[r].members > 0 && g->rows[r].sides == NULL) {
            compute_row(m, g, r);
            show(m);
        }
    }
    while (g->left > 0 && take_all_absolute(m, g)) {
        show(m);
    }
    if (g->left > 0) {
        g->dynamic = false; /* all rows are known */
        divide(m, g, choose_row(g));
    }
}

/* Looks at one row as soon as it is known. True: something was done. */
static bool act_on_row(struct maker *m, struct group *g, uint32_t r)
{
    if (g->rows[r].sides == NULL) {
        compute_row(m, g, r);
    }
    find_fate(m, g, r);
    if (g->rows[r].fate != STAYS) {
        take_level(m, g);
        return true;
    }
    if (g->rows[r].counts[SPLIT_ACROSS] == 0) {
        divide(m, g, r);
        return true;
    }
    return false;
}

static void run_dynamic(struct maker *m, struct group *g)
{
    uint32_t i = 0;
    while (g->left > 0 && i < g->count) {
        bool acted = !g->members[i].gone && act_on_row(m, g, g->members[i].row);
        i = acted ? 0 : i + 1; /* the earlier rows may have become absolute or separating */
        show(m);
    }
    if (g->left > 0) {
        run_static(m, g);
    }
}

static void group_free(struct maker *m, struct group *g)
{
    for (uint32_t r = 0; r < g->row_count; r++) {
        free_sides(m, &g->rows[r], g->count);
    }
    free(g->rows);
    free(g->members);
}

void feudal_make(struct feudal *feudal, const struct feudal_source *source,
                 const uint32_t *polygons, uint32_t count, bool dynamic, struct progress *progress)
{
    struct maker m = { .feudal = feudal, .source = source, .progress = progress, .waiting = count };
    struct group all = { .dynamic = dynamic, .count = count, .left = count };
    *feudal = (struct feudal){ 0 };
    all.node = add_node(feudal);
    all.members = xalloc(count, sizeof *all.members);
    for (uint32_t i = 0; i < count; i++) {
        all.members[i] = (struct member){ .polygon = polygons[i] };
    }
    find_rows(&m, &all);
    m.tasks = xgrow(m.tasks, &m.task_capacity, 1, sizeof *m.tasks);
    m.tasks[m.task_count++] = all;
    while (m.task_count > 0) {
        struct group group = m.tasks[--m.task_count];
        feudal->nodes[group.node].first_level = feudal->level_count;
        if (group.dynamic) {
            run_dynamic(&m, &group);
        } else {
            run_static(&m, &group);
        }
        group_free(&m, &group);
    }
    free(m.tasks);
}

void feudal_free(struct feudal *feudal)
{
    free(feudal->nodes);
    free(feudal->levels);
    free(feudal->polygons);
    *feudal = (struct feudal){ 0 };
}
