/* SPDX-License-Identifier: 0BSD */
/*
 * Views: the core's quantised cameras as `owsim --dump-views` writes them,
 * and eyes very near the model's surface for `owsim --views`.
 */
#include "tests/oracle/oracle.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *file_text(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file) {
        stop(path, "cannot be opened");
    }
    char *text = NULL;
    size_t length = 0, got;
    do {
        text = more(text, length + 65536, 1);
        got = fread(text + length, 1, 65535, file);
        length += got;
    } while (got > 0);
    text[length] = '\0';
    fclose(file);
    return text;
}

static double number(const cJSON *object, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (!cJSON_IsNumber(item)) {
        stop(name, "this number is missing in the views file");
    }
    return item->valuedouble;
}

static struct vec vector(const cJSON *object, const char *name, double unit)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    if (cJSON_GetArraySize(item) != 3) {
        stop(name, "this vector is missing in the views file");
    }
    return (struct vec){ cJSON_GetArrayItem(item, 0)->valuedouble * unit,
                         cJSON_GetArrayItem(item, 1)->valuedouble * unit,
                         cJSON_GetArrayItem(item, 2)->valuedouble * unit };
}

static struct camera camera_of(const cJSON *v)
{
    struct camera c = { 0 };
    c.eye = vector(v, "eye", 1.0 / 256);
    c.axis[0] = vector(v, "right", ldexp(1, -30));
    c.axis[1] = vector(v, "up", ldexp(1, -30));
    c.axis[2] = vector(v, "forward", ldexp(1, -30));
    /* Lattice units in a camera unit. */
    double unit = ldexp(1, (int)number(v, "camera_shift") - 38);
    const cJSON *scale = cJSON_GetObjectItemCaseSensitive(v, "scale");
    double mantissa = number(scale ? scale : v, scale ? "mantissa" : "scale_mantissa");
    double exponent = number(scale ? scale : v, scale ? "exponent" : "scale_exponent");
    c.focal = ldexp(mantissa, -(int)exponent) / 256;
    c.near_z = number(v, "near_z") * unit;
    c.width = (uint32_t)number(v, "width");
    c.height = (uint32_t)number(v, "height");
    if (cJSON_GetObjectItemCaseSensitive(v, "cut_q20")) {
        const cJSON *offset = cJSON_GetObjectItemCaseSensitive(v, "cut_offset");
        if (!cJSON_IsString(offset)) {
            stop("cut_offset", "this number is missing in the views file");
        }
        c.cuts = true;
        c.cut = vector(v, "cut_q20", ldexp(1, -20));
        c.cut_offset = ldexp(strtod(offset->valuestring, NULL), -20) * unit;
    }
    const cJSON *projection = cJSON_GetObjectItemCaseSensitive(v, "projection");
    c.parallel = cJSON_IsString(projection) ? strcmp(projection->valuestring, "parallel") == 0
                                            : number(v, "projection") == 1;
    if (c.parallel) {
        c.focal /= unit;
        c.near_z = -INFINITY;
    }
    return c;
}

struct camera *cameras_read(const char *path, size_t *count)
{
    char *text = file_text(path);
    cJSON *root = cJSON_Parse(text);
    const cJSON *list =
        cJSON_IsObject(root) ? cJSON_GetObjectItemCaseSensitive(root, "views") : root;
    *count = (size_t)cJSON_GetArraySize(list);
    if (!cJSON_IsArray(list) || *count == 0) {
        stop(path, "no views in this file");
    }
    struct camera *cameras = need(*count, sizeof *cameras);
    for (size_t i = 0; i < *count; i++) {
        cameras[i] = camera_of(cJSON_GetArrayItem(list, (int)i));
    }
    cJSON_Delete(root);
    free(text);
    return cameras;
}

/* ---- eyes very near the surface ------------------------------------------------------------- */
static struct vec along(struct vec from, struct vec direction, double distance)
{
    return (struct vec){ from.x + direction.x * distance, from.y + direction.y * distance,
                         from.z + direction.z * distance };
}

static struct vec unit(struct vec v)
{
    double length = sqrt(vec_dot(v, v));
    return length > 0 ? along((struct vec){ 0, 0, 0 }, v, 1 / length) : (struct vec){ 0, 1, 0 };
}

static struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static void print_point(const struct lattice *l, struct vec v, const char *end)
{
    printf("%.9g,%.9g,%.9g%s", l->origin[0] + v.x * l->step, l->origin[1] + v.y * l->step,
           l->origin[2] + v.z * l->step, end);
}

/*
 * View k stands off a corner of some polygon by a few lattice steps up to 1% of
 * the size, every second one behind the surface, and looks along the surface,
 * inclined into it more and more.
 */
static void near_view(const struct model *m, const struct lattice *lattice, uint32_t k)
{
    static const double off[8] = { 3, 5, 9, 20, 60, 150, 320, 650 };
    static const double into[4] = { 0.0, 0.15, 0.5, 2.0 };
    const struct polygon *p =
        &m->polygons[(k * 2654435769u % 65521u * (uint64_t)m->polygon_count) / 65521u];
    struct vec a = m->points[m->corners[p->first]];
    struct vec b = m->points[m->corners[p->first + 1]];
    struct vec c = m->points[m->corners[p->first + 2]];
    struct vec n = unit(cross(vec_sub(b, a), vec_sub(c, a)));
    struct vec tangent = unit(vec_sub(c, b));
    double side = k % 2 ? -1 : 1;
    struct vec eye = along(a, n, side * off[k % 8]);
    struct vec at = along(along(eye, tangent, 6000), n, -side * 6000 * into[(k / 2) % 4]);
    struct vec up = unit(cross(n, tangent));
    print_point(lattice, eye, " ");
    print_point(lattice, at, " ");
    printf("%.9g,%.9g,%.9g\n", n.x + 0.3 * up.x, n.y + 0.3 * up.y, n.z + 0.3 * up.z);
}

int near_views_print(const struct model *model, const struct lattice *lattice, uint32_t count)
{
    for (uint32_t k = 0; k < count; k++) {
        near_view(model, lattice, k);
    }
    return fflush(stdout) == 0 ? 0 : 1;
}
