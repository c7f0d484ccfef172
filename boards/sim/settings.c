/* SPDX-License-Identifier: 0BSD */
/* owsim's command line. */
#include "settings.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench.h"
#include "output.h"
#include "ow_surface.h"
#include "sim/image.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"

enum { ONE_Q8 = 256, ELEVATION_MAX = 89, ORBIT_MAX = 100000, OPTIONS_MOST = 64 };

/* Names in the order of the core's enums where there is one; the rest is not there yet. */
static const char *const orders[] = { "back-to-front", "front-to-back", "scanline", "auto", NULL };
static const char *const shades[] = { "id", "flat", "gouraud", "phong", "lines", NULL };
static const char *const culls[] = { "auto", "back", "none", NULL };
static const char *const maps[] = { "none", "heat", "cool", "spectrum", NULL };
static const char *const coverages[] = { "none", "4x4", NULL };
static const char *const unlits[] = { "bits", "segments", NULL };
static const char *const panels[] = { "lend", "write", NULL };
enum { ORDER_AUTO = 3, FORMATS_MOST = 31 };

static const enum sim_panel_kind panel_kinds[] = { SIM_PANEL_LENDS, SIM_PANEL_TAKES };

static const char usage[] = "TREE.owt [view] [look] [-o PATTERN] [--sheet FILE] [--gif FILE]\n"
                            "TREE.owt [view] [look] --bench | --compare DIR | --dump-views FILE";
static const char about[] =
    "Draws a compiled tree as the firmware would, on a simulated panel. TREE.owt may be -.\n"
    "Right-handed axes, y up; polygons are seen from the side where they go counter-clockwise.";
static const char notes[] =
    "A view is --eye (with --at and --up), a file of --views, or the orbit's first one.\n"
    "-o out-%04d.ppm (or .png) numbers the frames from 0; -o - writes PPMs to standard output.\n"
    "--order auto is front-to-back until there is something to choose by.\n"
    "--views: nine numbers a line, eye, at, up, separated by blanks or commas; # is a comment.\n"
    "--script: one event a line, TIME CONTROL press|release|turn N|axis N; TIME in microseconds;\n"
    "  CONTROL left, right, up, down, in, out, select, knob1, knob2, knob3, axis-x, ...\n"
    "--light x,y,z,SHARE or at:x,y,z,SHARE gives a light's own share; at: is a point in model\n"
    "  units, from the eye or, with --light-in-model, in the model, as bright far away as near.\n"
    "--bench prints one line of JSON: times of drawing alone, counts summed over the frames.\n"
    "--compare: exit status 1 if a frame differs; writes NAME-actual and NAME-diff pictures.\n"
    "--planes: xrgb8888 has the tree in its spare byte; rgb565 in a third byte of each pixel. The\n"
    "  picture is as large as the planes.\n"
    "--dump-views: the exact integers that each view is drawn by, as JSON; 64-bit ones as text.\n";

/* What the options leave before they are put together. */
struct raw {
    int order;
    int shade;
    int cull;
    int format;
    int coverage;
    int map;
    int unlit;
    int panel;
    uint64_t threads;
    const char *background;
    const char *foreground;
    const char *depth_cue;
    bool dither;
    double ambient;
    double highlight;
    uint64_t shininess;
    uint64_t budget;
    const char *cut;
    const char *cap;
    struct option_list lights;
    bool light_in_model;
    bool has_orbit;
    bool has_up;
    bool has_fov;
    bool has_parallel;
    bool has_near;
    bool has_elevation;
    bool has_interval;
};

static const struct option_table *the_table; /* for settings_wrong */

void settings_wrong(const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    options_wrong(the_table, "%s", text);
}

const char *order_name(enum ow_order order)
{
    return orders[order];
}

const char *shade_name(enum ow_shade shade)
{
    return shades[shade];
}

/* ---- checks ---- */

static uint32_t read_colour(const char *option, const char *text)
{
    char *end;
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6) {
        settings_wrong("--%s takes six hexadecimal digits RRGGBB, not '%s'", option, text);
    }
    return (uint32_t)strtoul(text, &end, 16);
}

/* NEAR,FAR: two distances, 0 <= NEAR < FAR. */
static void read_depth_cue(double depth[2], const char *text)
{
    char *comma;
    char *end;
    depth[0] = strtod(text, &comma);
    depth[1] = *comma == ',' ? strtod(comma + 1, &end) : 0;
    if (*comma != ',' || *end != '\0' || !(depth[0] >= 0) || !(depth[1] > depth[0]) ||
        !isfinite(depth[1])) {
        settings_wrong("--depth-cue takes two distances NEAR,FAR, from 0 upwards, not '%s'", text);
    }
}

static void read_cut(double cut[4], const char *text)
{
    const char *at = text;
    char *end = NULL;
    for (int i = 0; i < 4; i++) {
        cut[i] = strtod(at, &end);
        if (end == at || *end != (i < 3 ? ',' : '\0') || !isfinite(cut[i])) {
            settings_wrong("--cut takes four numbers A,B,C,D, not '%s'", text);
        }
        at = end + 1;
    }
    if (cut[0] == 0 && cut[1] == 0 && cut[2] == 0) {
        settings_wrong("--cut needs a direction: A, B and C are all 0");
    }
}

/* What excludes what. */
static void check_look(const struct settings *settings, const struct raw *raw)
{
    const struct ow_look *look = &settings->look;
    if (look->shade == OW_SHADE_ID && settings->format != &ow_format_xrgb8888) {
        settings_wrong("--shade id needs --format xrgb8888: numbers have 24 bits");
    }
    if (settings->planes && settings->format != &ow_format_xrgb8888 &&
        settings->format != &ow_format_rgb565) {
        settings_wrong("--planes leaves room for a tree beside --format xrgb8888 and rgb565");
    }
    if (settings->planes && settings->panel != SIM_PANEL_LENDS) {
        settings_wrong("--planes are in the panel's own memory, leave out --panel write");
    }
    if (look->coverage && (look->shade == OW_SHADE_ID || look->shade == OW_SHADE_LINES)) {
        settings_wrong("--aa 4x4 mixes colours, it does not go with --shade %s",
                       shades[look->shade]);
    }
    if (look->coverage && raw->order != OW_FRONT_TO_BACK && raw->order != ORDER_AUTO) {
        settings_wrong("--aa 4x4 draws front to back, leave out --order");
    }
}

static void read_look(struct settings *settings, const struct raw *raw)
{
    settings->threads = (uint32_t)raw->threads;
    struct ow_look *look = &settings->look;
    look->order = raw->order == ORDER_AUTO ? OW_FRONT_TO_BACK : (enum ow_order)raw->order;
    look->shade = (enum ow_shade)raw->shade;
    look->cull = (enum ow_cull)raw->cull;
    look->background = look->shade == OW_SHADE_ID ? 0 : read_colour("background", raw->background);
    look->foreground = read_colour("foreground", raw->foreground);
    look->dither = raw->dither;
    look->map = (enum ow_map)raw->map;
    look->coverage = raw->coverage != 0;
    if (raw->depth_cue != NULL) {
        read_depth_cue(settings->depth_cue, raw->depth_cue);
    }
    look->ambient_q8 = (uint16_t)lround(raw->ambient * ONE_Q8);
    look->specular_q8 = (uint16_t)lround(raw->highlight * ONE_Q8);
    look->shininess = (uint8_t)raw->shininess;
    look->budget = (uint32_t)raw->budget;
    if (look->budget > 0 && look->order != OW_FRONT_TO_BACK) {
        settings_wrong("--budget needs --order front-to-back: what is near must come first");
    }
    if (raw->cut != NULL) {
        settings->cuts = true;
        read_cut(settings->cut, raw->cut);
    }
    look->caps = strcmp(raw->cap, "none") != 0;
    look->cap = look->caps ? read_colour("cap", raw->cap) : 0;
    lights_read(look, &settings->light_places, &raw->lights, 1 - raw->ambient, raw->light_in_model);
    settings->format = ow_formats[raw->format];
    settings->segments = raw->unlit != 0;
    settings->panel = panel_kinds[raw->panel];
    check_look(settings, raw);
}

static void check_views(struct settings *settings, const struct raw *raw)
{
    if (settings->has_eye + raw->has_orbit + (settings->views != NULL) > 1) {
        settings_wrong("--eye, --views and --orbit exclude each other");
    }
    if ((settings->has_at || raw->has_up) && !settings->has_eye) {
        settings_wrong("--at and --up need --eye");
    }
    bool list = settings->has_eye || settings->views != NULL;
    if (raw->has_elevation && list) {
        settings_wrong("--elevation belongs to the orbit, leave out --eye and --views");
    }
    if (settings->script != NULL && list) {
        settings_wrong("--script moves the eye on the orbit, leave out --eye and --views");
    }
    if (raw->has_parallel && (raw->has_fov || raw->has_near)) {
        settings_wrong("--fov and --near belong to perspective, leave out --parallel");
    }
    if (raw->has_parallel && !(settings->parallel > 0)) {
        settings_wrong("--parallel takes a height above 0");
    }
    if (raw->has_near && !(settings->near > 0)) {
        settings_wrong("--near takes a distance above 0");
    }
}

static bool is_stdout(const char *file)
{
    return file != NULL && strcmp(file, "-") == 0;
}

static void check_outputs(const struct settings *settings)
{
    bool anything = settings->output != NULL || settings->sheet != NULL || settings->gif != NULL ||
                    settings->stats || settings->bench || settings->compare != NULL ||
                    settings->dump_views != NULL;
    int on_stdout = is_stdout(settings->output) + is_stdout(settings->sheet) +
                    is_stdout(settings->gif) + is_stdout(settings->dump_views) + settings->bench +
                    (settings->compare != NULL);
    if (!anything) {
        settings_wrong("nothing to do: give -o, --sheet, --gif, --stats, --bench or --compare");
    }
    if (on_stdout > 1) {
        settings_wrong("only one output can go to standard output");
    }
    if (settings->bench && settings->script != NULL) {
        settings_wrong("--bench measures views, leave out --script");
    }
    if (settings->passes != 0 && !settings->bench) {
        settings_wrong("--passes needs --bench");
    }
    if (settings->diff_dir != NULL && settings->compare == NULL) {
        settings_wrong("--diff-dir needs --compare");
    }
    if (settings->columns != 0 && settings->sheet == NULL) {
        settings_wrong("--columns needs --sheet");
    }
    struct image_error error;
    if (settings->gif != NULL && !image_has_gif()) {
        settings_wrong("GIF is not built into this program");
    }
    if (settings->sheet != NULL && !is_stdout(settings->sheet) &&
        image_format_of(settings->sheet, &error) == NULL) {
        settings_wrong("--sheet %s: %s", settings->sheet, error.text);
    }
    struct pattern pattern;
    if (settings->output != NULL && !is_stdout(settings->output) &&
        (!pattern_read(&pattern, settings->output, &error) ||
         image_format_of(settings->output, &error) == NULL)) {
        settings_wrong("-o %s: %s", settings->output, error.text);
    }
}

static void set_defaults(struct settings *settings, struct raw *raw)
{
    *settings = (struct settings){
        .size = { 320, 240 },
        .up = { 0, 1, 0 },
        .fov = 45,
        .orbit = 1,
        .elevation = 15,
        .interval_ms = 50,
    };
    *raw = (struct raw){
        .order = OW_FRONT_TO_BACK,
        .shade = OW_SHADE_FLAT,
        .threads = 1,
        .background = "20242c",
        .foreground = "f0f0f0",
        .ambient = 0.3,
        .highlight = 0.4,
        .cap = "c05040",
        .shininess = 4,
    };
}

/* Adds the options that say what is seen. Returns their count. */
static size_t add_views(struct option_spec *to, struct settings *s, struct raw *raw)
{
    const struct option_spec specs[] = {
        { "size", 0, OPTION_SIZE, s->size, "WxH", "pixels", .max = OW_SCREEN_MAX,
          .given = &s->has_size },
        { "planes", 0, OPTION_FLAG, &s->planes, NULL,
          .help = "the tree lies in a plane image, and there it is read while the picture is "
                  "painted beside it" },
        { "eye", 0, OPTION_VECTOR, s->eye, "x,y,z", "where the eye is, in model units",
          .given = &s->has_eye, .no_default = true },
        { "at", 0, OPTION_VECTOR, s->at, "x,y,z", "what it looks at (the model's middle)",
          .given = &s->has_at, .no_default = true },
        { "up", 0, OPTION_VECTOR, s->up, "x,y,z", "what is up in the picture",
          .given = &raw->has_up },
        { "fov", 0, OPTION_DOUBLE, &s->fov, "DEG", "vertical field of view", .min = 1, .max = 170,
          .given = &raw->has_fov },
        { "parallel", 0, OPTION_DOUBLE, &s->parallel, "HEIGHT",
          "parallel projection, what the picture's height shows", .given = &raw->has_parallel,
          .no_default = true },
        { "near", 0, OPTION_DOUBLE, &s->near, "D", "distance of the near plane (16 lattice steps)",
          .given = &raw->has_near, .no_default = true },
        { "orbit", 0, OPTION_UNSIGNED, &s->orbit, "N", "N views of one turn around the model",
          .min = 1, .max = ORBIT_MAX, .given = &raw->has_orbit },
        { "elevation", 0, OPTION_DOUBLE, &s->elevation, "DEG", "the orbit's height",
          .min = -ELEVATION_MAX, .max = ELEVATION_MAX, .given = &raw->has_elevation },
        { "views", 0, OPTION_STRING, &s->views, "FILE", .help = "views, one a line" },
        { "script", 0, OPTION_STRING, &s->script, "FILE",
          .help = "input events that turn the model" },
    };
    memcpy(to, specs, sizeof specs);
    return sizeof specs / sizeof specs[0];
}

/* Adds those that say how it looks. Returns their count. */
static size_t add_look(struct option_spec *to, struct raw *raw, const char *const *formats)
{
    const struct option_spec specs[] = {
        { "order", 0, OPTION_CHOICE, &raw->order, NULL, "the surface", .choices = orders },
        { "unlit", 0, OPTION_CHOICE, &raw->unlit, NULL,
          "what front-to-back knows of unlit pixels: same pictures, other times",
          .choices = unlits },
        { "shade", 0, OPTION_CHOICE, &raw->shade, NULL, "id: the source polygon's number",
          .choices = shades },
        { "cull", 0, OPTION_CHOICE, &raw->cull, NULL, "auto: as the tree was built",
          .choices = culls },
        { "format", 0, OPTION_CHOICE, &raw->format, NULL, "the panel's pixels",
          .choices = formats },
        { "dither", 0, OPTION_FLAG, &raw->dither, NULL,
          .help = "ordered, in formats of few levels" },
        { "map", 0, OPTION_CHOICE, &raw->map, NULL, "intensity as a colour, not the material's",
          .choices = maps },
        { "depth-cue", 0, OPTION_STRING, &raw->depth_cue, "NEAR,FAR",
          .help = "colours fade to the background between these distances" },
        { "aa", 0, OPTION_CHOICE, &raw->coverage, NULL, "4x4: 16 samples a pixel",
          .choices = coverages },
        { "threads", 0, OPTION_UNSIGNED, &raw->threads, "N", "bands drawn at a time", .min = 1,
          .max = 64 },
        { "background", 0, OPTION_STRING, &raw->background, "RRGGBB",
          .help = "colour behind the model" },
        { "foreground", 0, OPTION_STRING, &raw->foreground, "RRGGBB",
          .help = "colour of --shade lines" },
        { "ambient", 0, OPTION_DOUBLE, &raw->ambient, "A",
          "share of the light from everywhere; each --light has the rest", .min = 0, .max = 1 },
        { "highlight", 0, OPTION_DOUBLE, &raw->highlight, "A",
          "phong: share of white in its middle", .min = 0, .max = 1 },
        { "shininess", 0, OPTION_UNSIGNED, &raw->shininess, "N",
          "phong: the highlight's exponent is 2^N", .min = 0, .max = 7 },
        { "cut", 0, OPTION_STRING, &raw->cut, "A,B,C,D",
          .help = "keeps only where A x + B y + C z >= D; needs --sides two in owc" },
        { "cap", 0, OPTION_STRING, &raw->cap, "RRGGBB",
          .help = "where a closed model is cut; none: its inside is seen" },
        { "budget", 0, OPTION_UNSIGNED, &raw->budget, "N",
          "work units a band may take: faces met and 16s of pixels; 0: no end (front-to-back)",
          .max = UINT32_MAX },
        { "light", 0, OPTION_LIST, &raw->lights, "x,y,z",
          "towards a light: right, up, to the viewer (-0.4,0.6,0.7), or at:x,y,z; up to 8",
          .max = OW_LIGHTS_MAX },
        { "light-in-model", 0, OPTION_FLAG, &raw->light_in_model, NULL,
          .help = "each --light is along the model's axes instead" },
    };
    memcpy(to, specs, sizeof specs);
    return sizeof specs / sizeof specs[0];
}

/* Adds those that say what becomes of it. Returns their count. */
static size_t add_outputs(struct option_spec *to, struct settings *s, struct raw *raw)
{
    const struct option_spec specs[] = {
        { "output", 'o', OPTION_STRING, &s->output, "PATTERN", .help = "a picture of each frame" },
        { "sheet", 0, OPTION_STRING, &s->sheet, "FILE", .help = "all frames on one picture" },
        { "columns", 0, OPTION_UNSIGNED, &s->columns, "N", "of the sheet (about square)", .min = 1,
          .max = 1000, .no_default = true },
        { "gif", 0, OPTION_STRING, &s->gif, "FILE", .help = "an animated picture" },
        { "interval", 0, OPTION_UNSIGNED, &s->interval_ms, "MS",
          "between two frames, of the GIF and of a turn under --script", .min = 10, .max = 60000 },
        { "stats", 0, OPTION_FLAG, &s->stats, NULL,
          .help = "one line of JSON a frame on standard error" },
        { "bench", 0, OPTION_FLAG, &s->bench, NULL, .help = "measure, print one line of JSON" },
        { "passes", 0, OPTION_UNSIGNED, &s->passes, "N",
          "of the bench over all views (as many as a second allows)", .min = 1,
          .max = BENCH_PASSES_MAX, .no_default = true },
        { "compare", 0, OPTION_STRING, &s->compare, "DIR",
          .help = "compare each frame with the picture of its name in DIR" },
        { "diff-dir", 0, OPTION_STRING, &s->diff_dir, "DIR",
          .help = "where --compare writes its pictures (beside -o, or here)" },
        { "dump-views", 0, OPTION_STRING, &s->dump_views, "FILE",
          .help = "the views' integers as JSON" },
        { "panel", 0, OPTION_CHOICE, &raw->panel, NULL, "it lends its memory, or takes bands",
          .choices = panels },
        { "band", 0, OPTION_UNSIGNED, &s->band_lines, "LINES", "drawn at a time (all)", .min = 1,
          .max = OW_SCREEN_MAX, .no_default = true },
    };
    memcpy(to, specs, sizeof specs);
    return sizeof specs / sizeof specs[0];
}

void settings_read(struct settings *s, int argc, char **argv)
{
    struct raw raw;
    const char *formats[FORMATS_MOST + 1] = { NULL };
    set_defaults(s, &raw);
    for (uint32_t i = 0; i < ow_format_count && i < FORMATS_MOST; i++) {
        formats[i] = ow_formats[i]->name;
    }
    static struct option_spec specs[OPTIONS_MOST];
    size_t count = add_views(specs, s, &raw);
    count += add_look(specs + count, &raw, formats);
    count += add_outputs(specs + count, s, &raw);
    static struct option_table table;
    table = (struct option_table){ usage, about, specs, count, 1, 1, notes };
    the_table = &table;
    options_parse(&table, argc, argv, &s->tree);
    read_look(s, &raw);
    check_views(s, &raw);
    check_outputs(s);
}
