/* SPDX-License-Identifier: 0BSD */
/*
 * The oracle's command line, and the rule by which it judges.
 *
 *   oracle MODEL TREE.owt --views views.json --frames 'frame-%04d.ppm' [--sides one|two]
 *          [--diff DIR] [--caps CAP,BACKGROUND]
 *   oracle MODEL TREE.owt --near-views N      prints eyes for owsim --views
 *   oracle --self-test
 *
 * The oracle reads the source MODEL itself, rounds its corners to the lattice of
 * the tree's header, takes owsim's quantised cameras (owsim --dump-views) and
 * draws each view with a z-buffer in double precision: polygons whole, coverage
 * by the winding number at the point, depth by the polygon's plane, clipped by
 * the near plane, backs left out where the tree is one-sided. A cutting plane is
 * taken from the views and clips alike. Nothing of the core's rounding is imitated.
 *
 * Each pixel of a frame of `owsim --shade id` is judged at its centre c:
 *
 * - It shows the polygon that the oracle shows at c: right.
 * - It shows polygon s. It is right if there is a witness: a point q of s's
 *   outline or inside it with |q - c| <= 1 pixel, or, where a lattice step is
 *   larger on the screen than a pixel, |q - c| <= the lattice step projected at
 *   s's depth at q; and no polygon that covers q is nearer than s there by more
 *   than the bound. The bound is two lattice steps or twice the tree's tolerance,
 *   whichever is more, and the corners' own distance from a common plane, which
 *   is 0 for triangles. "Nearer by" is measured along the view (counted as tie),
 *   else along the normal of one of the two polygons (counted as slant). s must
 *   face the eye, unless its outline is so thin that rounding to 1/256 pixel could
 *   turn it round. Points are tried on a grid over the part of s in the window
 *   and along its outline, 25, then 289, then 4225 of them. A pixel is never
 *   called right without a witness; it is called wrong when none was found.
 * - It shows background where the oracle shows the model at c. It is right if the
 *   oracle shows background at one of the eight neighbours' centres or at one of
 *   33 x 33 points between them, or, where a lattice step is larger than a pixel,
 *   at a point within the projected step. Otherwise it is a hole.
 *
 * With --caps (two colours RRGGBB) the frames show materials in full (--ambient 1),
 * and the cap of a closed model that is cut open in its own colour: where the
 * oracle shows the back of some polygon. Each pixel is judged by the same rules,
 * its polygon being `some front` or `some back`.
 *
 * Two kinds of pixels fail this and are right all the same; they are counted apart:
 *
 * - rim: outlines are rounded to 1/256 pixel, and corners that the compiler made
 *   by cutting to a lattice step. Where two drawn polygons share an edge, that
 *   moves both alike. A rim is an edge that no other drawn polygon has (a
 *   silhouette, a border, the near plane's cut): there a polygon hides nothing
 *   for certain within 1/64 pixel and a projected lattice step. With rims so
 *   blurred the rules above are tried again. A back may show by its own outline's
 *   rounding, within the same distance of it.
 * - strip: a plane of the model is seen edge-on, the polygon shown and all that
 *   hide it there come to that plane within the tolerance or 1/64 pixel. Then the
 *   eye lies in the plane, and neither side of it hides the other; rounding
 *   decides. More than 8 and 1 in 20,000 of the model's pixels fail the picture.
 *
 * One line a view: pixels of the model, wrong pixels, holes, and how many were
 * right by an edge within one pixel, by the near-view rule, a tie, a slant, a rim, a strip;
 * then the first wrong pixels. After 200 wrong pixels a view is judged coarsely.
 * Exit status: 0 all right, 1 wrong pixels or holes, 2 usage or unreadable input.
 */
#include "tests/oracle/oracle.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void stop(const char *file, const char *what)
{
    fprintf(stderr, "oracle: %s: %s\n", file, what);
    exit(2);
}

void *need(size_t count, size_t size)
{
    void *block = calloc(count ? count : 1, size);
    if (!block) {
        stop("memory", "not enough");
    }
    return block;
}

/* Room for count items, in powers of two: growing one by one stays cheap. */
void *more(void *block, size_t count, size_t size)
{
    size_t room = 64;
    while (room < count) {
        room *= 2;
    }
    block = realloc(block, room * size);
    if (!block) {
        stop("memory", "not enough");
    }
    return block;
}

struct request {
    const char *model, *tree, *views, *frames, *diff;
    uint32_t near_views;
    int sides; /* 0 as the tree, 1, 2 */
    enum tells tells;
    uint32_t cap, background; /* TELLS_SIDE: 0x00RRGGBB */
};

static _Noreturn void usage(void)
{
    fputs("usage: oracle MODEL TREE.owt --views FILE --frames PATTERN [--sides one|two] "
          "[--diff DIR] [--caps CAP,BACKGROUND]\n       oracle MODEL TREE.owt --near-views N\n     "
          "  oracle --self-test\n",
          stderr);
    exit(2);
}

static struct request parse(int argc, char **argv)
{
    struct request r = { 0 };
    for (int i = 1; i < argc; i++) {
        const char *a = argv[i], *value = i + 1 < argc ? argv[i + 1] : NULL;
        if (strncmp(a, "--", 2) != 0) {
            *(r.model ? &r.tree : &r.model) = a;
            continue;
        }
        if (!value) {
            usage();
        }
        i++;
        if (strcmp(a, "--views") == 0) {
            r.views = value;
        } else if (strcmp(a, "--frames") == 0) {
            r.frames = value;
        } else if (strcmp(a, "--diff") == 0) {
            r.diff = value;
        } else if (strcmp(a, "--near-views") == 0) {
            r.near_views = (uint32_t)strtoul(value, NULL, 10);
        } else if (strcmp(a, "--sides") == 0) {
            r.sides = strcmp(value, "two") == 0 ? 2 : 1;
        } else if (strcmp(a, "--caps") == 0 && strlen(value) == 13 && value[6] == ',') {
            r.tells = TELLS_SIDE;
            r.cap = (uint32_t)strtoul(value, NULL, 16);
            r.background = (uint32_t)strtoul(value + 7, NULL, 16);
        } else {
            usage();
        }
    }
    if (!r.model || !r.tree || (!r.near_views && (!r.views || !r.frames))) {
        usage();
    }
    return r;
}

/* Puts the number in the place of %d, %04d and the like; the pattern comes from a script. */
static void frame_name(char *name, size_t size, const char *pattern, size_t number)
{
    const char *mark = strchr(pattern, '%');
    const char *rest = mark ? strchr(mark, 'd') : NULL;
    if (!rest) {
        snprintf(name, size, "%s", pattern);
        return;
    }
    int digits = (int)strtol(mark + 1, NULL, 10);
    snprintf(name, size, "%.*s%0*zu%s", (int)(mark - pattern), pattern, digits, number, rest + 1);
}

static void print_verdict(const char *name, const struct verdict *v)
{
    printf("%s: %llu pixels model, %llu wrong, %llu holes; right by edge %llu, near step %llu, "
           "tie %llu, slant %llu, rim %llu, strip %llu\n",
           name, (unsigned long long)v->model, (unsigned long long)v->wrong,
           (unsigned long long)v->holes, (unsigned long long)v->edge, (unsigned long long)v->near,
           (unsigned long long)v->tie, (unsigned long long)v->slant, (unsigned long long)v->rim,
           (unsigned long long)v->strip);
}

static void print_examples(const struct verdict *v)
{
    for (uint64_t i = 0; i < EXAMPLES && i < v->wrong + v->holes; i++) {
        const struct example *e = &v->examples[i];
        printf("  pixel %u,%u shows %u, due is %u\n", e->x, e->y, e->shown, e->due);
    }
}

static void add_verdict(struct verdict *sum, const struct verdict *v)
{
    sum->model += v->model;
    sum->same += v->same;
    sum->edge += v->edge;
    sum->near += v->near;
    sum->tie += v->tie;
    sum->slant += v->slant;
    sum->rim += v->rim;
    sum->strip += v->strip;
    sum->wrong += v->wrong;
    sum->holes += v->holes;
}

static struct verdict judge_view(const struct request *r, const struct model *model,
                                 const struct lattice *lattice, const struct camera *camera,
                                 size_t number)
{
    char name[4096];
    uint32_t width = 0, height = 0;
    frame_name(name, sizeof name, r->frames, number);
    uint32_t *frame = ppm_read(name, &width, &height);
    if (width != camera->width || height != camera->height) {
        stop(name, "the frame is not of the view's size");
    }
    if (r->tells == TELLS_SIDE) {
        for (size_t i = 0; i < (size_t)width * height; i++) {
            frame[i] = frame[i] == r->background ? 0 : frame[i] == r->cap ? SIDE_BACK : SIDE_FRONT;
        }
    }
    struct scene scene;
    scene_make(&scene, model, camera, r->sides ? r->sides == 2 : lattice->two_sided, r->tells);
    uint8_t *difference = r->diff ? need((size_t)width * height, 3) : NULL;
    struct verdict verdict;
    judge(&scene, frame, fmax(2, 2 * lattice->tolerance), &verdict, difference);
    if (difference) {
        snprintf(name, sizeof name, "%s/difference-%04zu.ppm", r->diff, number);
        ppm_write(name, difference, width, height);
    }
    snprintf(name, sizeof name, "view %zu", number);
    print_verdict(name, &verdict);
    print_examples(&verdict);
    free(difference);
    free(frame);
    scene_free(&scene);
    return verdict;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--self-test") == 0) {
        return self_test();
    }
    struct request request = parse(argc, argv);
    struct lattice lattice;
    struct model model;
    lattice_read(&lattice, request.tree);
    model_read(&model, request.model, &lattice);
    if (request.near_views) {
        int status = near_views_print(&model, &lattice, request.near_views);
        model_free(&model);
        return status;
    }
    size_t count;
    struct camera *cameras = cameras_read(request.views, &count);
    struct verdict sum = { 0 };
    for (size_t i = 0; i < count; i++) {
        struct verdict verdict = judge_view(&request, &model, &lattice, &cameras[i], i);
        add_verdict(&sum, &verdict);
    }
    print_verdict("sum", &sum);
    free(cameras);
    model_free(&model);
    if (sum.model == 0) {
        stop(request.frames, "no view shows the model: nothing was judged");
    }
    if (sum.strip > 8 + sum.model / 20000) {
        printf("more pixels than chance explains are right by a strip alone\n");
        return 1;
    }
    return sum.wrong || sum.holes ? 1 : 0;
}
