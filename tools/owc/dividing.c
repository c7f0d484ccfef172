/* SPDX-License-Identifier: 0BSD */
/* Dividing planes: read from a text, or found in gaps along the axes. */
#include "dividing.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/xalloc.h"

enum { NORMAL_LIMIT = (1 << NORMAL_BITS) - 1 };

/* ---- the user's planes ---- */

/* The next number and what follows it; false: there is none. */
static bool read_number(const char **text, double *value)
{
    char *end;
    *value = strtod(*text, &end);
    bool fine = end != *text && isfinite(*value);
    *text = end + strspn(end, " \t\r");
    return fine;
}

/* One line. False: it is not four numbers, or the first three are zero. */
static bool read_plane(const char *text, double plane[4])
{
    for (int i = 0; i < 4; i++) {
        if (!read_number(&text, &plane[i]) || *text != (i < 3 ? ',' : '\0')) {
            return false;
        }
        text++;
    }
    return plane[0] != 0 || plane[1] != 0 || plane[2] != 0;
}

/* Copies a line without what follows a #; false: it is longer than the room. */
static bool copy_line(const char *from, char *line, size_t room)
{
    size_t length = strcspn(from, "#\n");
    if (length >= room) {
        return false;
    }
    memcpy(line, from, length);
    line[length] = '\0';
    return true;
}

bool user_planes_read(struct user_planes *planes, const char *text, struct problem *problem)
{
    char line[256];
    *planes = (struct user_planes){ 0 };
    for (long number = 1; *text != '\0'; number++) {
        double plane[4];
        if (!copy_line(text, line, sizeof line)) {
            return problem_set(problem, number, "the line is longer than %zu bytes",
                               sizeof line - 1);
        }
        const char *begin = line + strspn(line, " \t\r");
        if (*begin != '\0') {
            if (!read_plane(begin, plane)) {
                return problem_set(problem, number,
                                   "is no plane, write a,b,c,d for ax + by + cz + d = 0");
            }
            planes->all =
                xgrow(planes->all, &planes->capacity, planes->count + 1, sizeof *planes->all);
            memcpy(planes->all[planes->count++], plane, sizeof plane);
        }
        text += strcspn(text, "\n");
        text += *text == '\n';
    }
    return true;
}

bool user_planes_read_file(struct user_planes *planes, const char *path, struct problem *problem)
{
    char *text = NULL;
    size_t capacity = 0;
    size_t used = 0;
    size_t got;
    *planes = (struct user_planes){ 0 };
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        return problem_set(problem, 0, "cannot be read: %s", strerror(errno));
    }
    do {
        text = xgrow(text, &capacity, used + 4096, 1);
        got = fread(text + used, 1, capacity - used - 1, file);
        used += got;
    } while (got > 0);
    text[used] = '\0';
    bool fine = !ferror(file) || problem_set(problem, 0, "cannot be read: %s", strerror(errno));
    fclose(file);
    fine = fine && user_planes_read(planes, text, problem);
    free(text);
    return fine;
}

void user_planes_free(struct user_planes *planes)
{
    free(planes->all);
    *planes = (struct user_planes){ 0 };
}

uint32_t user_planes_add(const struct user_planes *from, const struct lattice *lattice,
                         struct planes *planes, uint32_t *numbers)
{
    uint32_t count = 0;
    for (size_t i = 0; i < from->count; i++) {
        const double *plane = from->all[i];
        double greatest = fmax(fabs(plane[0]), fmax(fabs(plane[1]), fabs(plane[2])));
        double d = plane[3] / greatest / lattice->step;
        int32_t n[3];
        for (int k = 0; k < 3; k++) {
            d += plane[k] / greatest * (lattice->origin[k] / lattice->step);
            n[k] = (int32_t)floor(plane[k] / greatest * NORMAL_LIMIT + 0.5);
        }
        if (fabs(d) <= 3.0 * OW_LATTICE_MAX) { /* beyond, it meets nothing */
            numbers[count++] = plane_add(planes, n, (int64_t)floor(d * NORMAL_LIMIT + 0.5), 0);
        }
    }
    return count;
}

/* ---- gaps along the axes ---- */

struct extent {
    double low;
    double high;
};

struct gap {
    uint32_t emptier; /* pieces on the side with fewer */
    double width;
    double middle;
    int axis;
};

static int compare_extents(const void *left, const void *right)
{
    const struct extent *a = left;
    const struct extent *b = right;
    return a->low != b->low ? (a->low > b->low) - (a->low < b->low)
                            : (a->high > b->high) - (a->high < b->high);
}

static void find_extents(const struct arrangement *arrangement, const struct pieces *pieces,
                         const uint32_t *list, uint32_t count, int axis, struct extent *extents)
{
    for (uint32_t i = 0; i < count; i++) {
        const struct piece *piece = &pieces->all[list[i]];
        extents[i] = (struct extent){ INFINITY, -INFINITY };
        for (uint32_t k = 0; k < piece->count; k++) {
            double at = arrangement->at[pieces->vertices[piece->first + k]][axis];
            extents[i].low = fmin(extents[i].low, at);
            extents[i].high = fmax(extents[i].high, at);
        }
    }
    qsort(extents, count, sizeof *extents, compare_extents);
}

/* The plane stands on a lattice step: only gaps that hold one count. */
static void look_along(int axis, const struct extent *extents, uint32_t count, struct gap *best)
{
    double reached = extents[0].high;
    for (uint32_t i = 1; i < count; i++) {
        double width = extents[i].low - reached;
        double middle = floor((extents[i].low + reached) / 2 + 0.5);
        uint32_t emptier = i < count - i ? i : count - i;
        bool better = emptier > best->emptier || (emptier == best->emptier && width > best->width);
        if (width > 0 && middle >= reached && middle <= extents[i].low && better) {
            *best = (struct gap){ emptier, width, middle, axis };
        }
        reached = fmax(reached, extents[i].high);
    }
}

uint32_t dividing_axis_plane(const struct arrangement *arrangement, const struct pieces *pieces,
                             const uint32_t *list, uint32_t count, struct planes *planes)
{
    struct gap best = { 0, 0, 0, 0 };
    struct extent *extents = xalloc(count, sizeof *extents);
    for (int axis = 0; axis < 3 && count > 1; axis++) {
        find_extents(arrangement, pieces, list, count, axis, extents);
        look_along(axis, extents, count, &best);
    }
    free(extents);
    if (best.emptier == 0) {
        return MESH_NONE;
    }
    int32_t n[3] = { 0, 0, 0 };
    n[best.axis] = NORMAL_LIMIT;
    return plane_add(planes, n, -(int64_t)best.middle * NORMAL_LIMIT, 0);
}
