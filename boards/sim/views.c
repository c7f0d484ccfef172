/* SPDX-License-Identifier: 0BSD */
/* Views in model units become cameras in lattice units. */
#include "views.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"

enum {
    ONE_Q8 = 256,
    UP_LENGTH = 1 << 28, /* of an up vector: only its direction counts */
    VIEW_NUMBERS = 9,
    FILE_BYTES_MAX = 1 << 26
};

struct model_view {
    double eye[3];
    double at[3];
    double up[3];
};

/* ---- conversion ---- */

ow_q8 length_q8(double length, const struct tree_file *tree)
{
    double value = round(length / tree->step * ONE_Q8);
    return value >= 1 && value <= INT32_MAX ? (ow_q8)value : 0;
}

static bool point_q8(ow_q8 point[3], const double model[3], const struct tree_file *tree)
{
    for (int i = 0; i < 3; i++) {
        double value = round((model[i] - tree->origin[i]) / tree->step * ONE_Q8);
        if (!(fabs(value) <= OW_EYE_MAX)) {
            return false;
        }
        point[i] = (ow_q8)value;
    }
    return true;
}

static void up_q8(ow_q8 up[3], const double model[3])
{
    double largest = fmax(fabs(model[0]), fmax(fabs(model[1]), fabs(model[2])));
    for (int i = 0; i < 3; i++) {
        up[i] = largest > 0 ? (ow_q8)lround(model[i] / largest * UP_LENGTH) : 0;
    }
}

/* Why a view cannot be made; NULL if it can. */
static const char *convert(struct ow_camera *camera, const struct model_view *model,
                           const struct tree_file *tree)
{
    struct ow_view view;
    if (!point_q8(camera->eye, model->eye, tree) || !point_q8(camera->at, model->at, tree)) {
        return "the eye or what it looks at is farther away than 32 times the model's size";
    }
    up_q8(camera->up, model->up);
    if (memcmp(camera->eye, camera->at, sizeof camera->eye) == 0) {
        return "the eye is where it looks at, move one of them";
    }
    camera->width_pixels = 1;
    camera->height_pixels = 1;
    if (ow_view_make(&view, camera) != OW_OK) {
        return "up is zero or parallel to the view, choose another direction";
    }
    return NULL;
}

static void make_lens(struct views *views, const struct settings *settings,
                      const struct tree_file *tree)
{
    struct ow_camera *lens = &views->lens;
    *lens = (struct ow_camera){ .projection = OW_PERSPECTIVE };
    if (settings->parallel > 0) {
        lens->projection = OW_PARALLEL;
        lens->height = length_q8(settings->parallel, tree);
        if (lens->height == 0) {
            settings_wrong("--parallel %g does not suit the model's size", settings->parallel);
        }
        return;
    }
    lens->fov = (ow_turn)llround(settings->fov / 360 * 4294967296.0);
    if (settings->near > 0) {
        lens->near = length_q8(settings->near, tree);
        if (lens->near == 0) {
            settings_wrong("--near %g does not suit the model's size", settings->near);
        }
    }
}

static void *need(void *memory)
{
    if (memory == NULL) {
        fail(FAIL_INPUT, NULL, 0, "not enough memory for the views");
    }
    return memory;
}

/* ---- one view from the command line ---- */

static void make_single(struct views *views, const struct settings *settings,
                        const struct tree_file *tree)
{
    struct model_view model;
    for (int i = 0; i < 3; i++) {
        double middle = (tree->tree.box_min[i] + tree->tree.box_max[i]) / 2.0;
        model.eye[i] = settings->eye[i];
        model.at[i] = settings->has_at ? settings->at[i] : tree->origin[i] + middle * tree->step;
        model.up[i] = settings->up[i];
    }
    views->list = need(malloc(sizeof *views->list));
    views->count = 1;
    views->list[0] = views->lens;
    const char *why = convert(&views->list[0], &model, tree);
    if (why != NULL) {
        settings_wrong("this view cannot be drawn: %s", why);
    }
}

/* ---- views from a file ---- */

/* Reads the numbers of a line; their count, or -1 where something else stands. */
static int read_numbers(char *line, double numbers[VIEW_NUMBERS])
{
    int count = 0;
    line[strcspn(line, "#")] = '\0';
    for (char *word = strtok(line, " ,\t\r"); word != NULL; word = strtok(NULL, " ,\t\r")) {
        char *end;
        double number = strtod(word, &end);
        if (*end != '\0' || !isfinite(number)) {
            return -1;
        }
        if (count < VIEW_NUMBERS) {
            numbers[count] = number;
        }
        count++;
    }
    return count;
}

static void take_line(struct views *views, char *line, long number, const struct settings *settings,
                      const struct tree_file *tree)
{
    double numbers[VIEW_NUMBERS];
    int count = read_numbers(line, numbers);
    if (count == 0) {
        return;
    }
    if (count != VIEW_NUMBERS) {
        fail(FAIL_INPUT, settings->views, number, "a view is nine numbers: eye, at, up");
    }
    struct model_view model;
    memcpy(model.eye, numbers, sizeof model.eye);
    memcpy(model.at, numbers + 3, sizeof model.at);
    memcpy(model.up, numbers + 6, sizeof model.up);
    struct ow_camera *camera = &views->list[views->count];
    *camera = views->lens;
    const char *why = convert(camera, &model, tree);
    if (why != NULL) {
        fail(FAIL_INPUT, settings->views, number, "this view cannot be drawn: %s", why);
    }
    views->count++;
}

static void make_list(struct views *views, const struct settings *settings,
                      const struct tree_file *tree)
{
    size_t bytes;
    char *text = read_whole_file(settings->views, settings->views, FILE_BYTES_MAX, &bytes);
    char *lines = need(malloc(bytes + 1));
    size_t line_count = 1;
    for (size_t i = 0; i < bytes; i++) {
        line_count += text[i] == '\n';
    }
    views->list = need(calloc(line_count, sizeof *views->list));
    memcpy(lines, text, bytes);
    lines[bytes] = '\0';
    free(text);
    long number = 1;
    for (char *line = lines; line < lines + bytes; number++) {
        char *end = memchr(line, '\n', (size_t)(lines + bytes - line));
        end = end != NULL ? end : lines + bytes;
        *end = '\0';
        take_line(views, line, number, settings, tree);
        line = end + 1;
    }
    free(lines);
    if (views->count == 0) {
        fail(FAIL_INPUT, settings->views, 0, "there is no view in the file");
    }
}

void views_make(struct views *views, const struct settings *settings, const struct tree_file *tree)
{
    *views = (struct views){ .count = (uint32_t)settings->orbit };
    make_lens(views, settings, tree);
    if (settings->views != NULL) {
        views->count = 0;
        make_list(views, settings, tree);
    } else if (settings->has_eye) {
        make_single(views, settings, tree);
    }
}

void views_free(struct views *views)
{
    free(views->list);
    *views = (struct views){ 0 };
}

int views_give(void *context, uint32_t number, struct ow_camera *camera)
{
    const struct views *views = context;
    uint16_t width = camera->width_pixels;
    uint16_t height = camera->height_pixels;
    *camera = views->list[number];
    camera->width_pixels = width;
    camera->height_pixels = height;
    return OW_OK;
}

/* ---- the dump ---- */

static void dump_vector(FILE *stream, const char *name, const int32_t v[3])
{
    fprintf(stream, "\"%s\":[%" PRId32 ",%" PRId32 ",%" PRId32 "],", name, v[0], v[1], v[2]);
}

void views_dump(FILE *stream, uint32_t frame, const struct ow_view *view)
{
    fprintf(stream, "{\"frame\":%" PRIu32 ",", frame);
    dump_vector(stream, "eye", view->eye);
    dump_vector(stream, "right", view->right);
    dump_vector(stream, "up", view->up);
    dump_vector(stream, "forward", view->forward);
    fprintf(stream, "\"offset\":[\"%" PRId64 "\",\"%" PRId64 "\",\"%" PRId64 "\"],",
            view->offset[0], view->offset[1], view->offset[2]);
    fprintf(stream, "\"near_z\":%" PRId32 ",\"limit\":%" PRId32 ",", view->near_z, view->limit);
    fprintf(stream, "\"scale_mantissa\":%" PRIu32 ",\"scale_exponent\":%" PRId32 ",",
            view->scale.mantissa, view->scale.exponent);
    if (view->cuts) {
        dump_vector(stream, "cut_q20", view->cut_q20);
        fprintf(stream, "\"cut_offset\":\"%" PRId64 "\",", view->cut_offset);
    }
    fprintf(stream, "\"width\":%u,\"height\":%u,\"camera_shift\":%u,\"projection\":\"%s\"}",
            view->width, view->height, view->camera_shift,
            view->projection == OW_PARALLEL ? "parallel" : "perspective");
}
