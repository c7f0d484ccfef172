/* SPDX-License-Identifier: 0BSD */
/* oldwell's options; a board file sets the same ones. */
#include "settings.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "board_file.h"
#include "hal/camera.h"
#include "hal/panel.h"
#include "hal/panel/controller.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"

#ifndef OLDWELL_DATA_DIR
#define OLDWELL_DATA_DIR "/usr/local/share/oldwell"
#endif

enum {
    ONE_Q8 = 256,
    ONE_Q14 = 1 << 14,
    FORMATS_MOST = 31,
    OPTIONS_MOST = 80,
    PANELS_MOST = 31,
    PATH_BYTES = 4096
};

static const char *panels[PANELS_MOST + 1] = { "fbdev", "drm", "v4l2", "file" };
static const char *const buses[] = { "spi", "i2c", NULL };
static const char *const inverts[] = { "auto", "yes", "no", NULL };
static const char *const orders[] = { "back-to-front", "front-to-back", NULL };
static const char *const shades[] = { "id", "flat", "gouraud", "phong", "lines", NULL };
static const char *const coverages[] = { "none", "4x4", NULL };
static const char *const video_formats[] = { "RGBP", "XR24", "YUYV", "NV12", NULL };
static const uint32_t video_codes[] = { OW_VIDEO_RGB565, OW_VIDEO_XRGB8888, OW_VIDEO_YUYV,
                                        OW_VIDEO_NV12 };
static const char *formats[FORMATS_MOST + 1];

static const char usage[] = "[--board NAME] [options] TREE.owt\n"
                            "doctor [--board NAME] [options]";
static const char about[] =
    "Shows a compiled tree on a display of this machine, turning until a button is pressed.\n"
    "doctor checks devices and permissions and draws a test pattern.";
static const char notes[] =
    "--board takes a folder or file of settings, or the name of one that is installed; a setting\n"
    "  is a line `name = value`, the names are those of the options: see oldwell-board(5).\n"
    "SIGHUP, or a new file in the tree's place, loads it anew; a bad one is told and not taken.\n"
    "Exit status: 0; 1 bad input; 2 usage; 3 device absent or busy; 4 permission; 5 the device\n"
    "  failed after retries; 6 it did not answer in time.\n";

/* What the options leave before they are put together. */
struct raw {
    int order;
    int shade;
    int coverage;
    int format;
    int pixels;
    int bus;
    const char *i2c_address;
    const char *offset;
    bool dither;
    const char *background;
    const char *foreground;
    double ambient;
    double highlight;
    uint64_t shininess;
    double light[3];
};

static struct option_spec specs[OPTIONS_MOST];
static struct option_table table;

const char *panel_kind_name(int kind)
{
    return panels[kind];
}

/* ---- the table ---- */

static size_t add_panel(struct option_spec *to, struct oldwell_settings *s, struct raw *raw)
{
    const struct option_spec these[] = {
        { "board", 0, OPTION_STRING, &s->board, "NAME", .help = "settings of a board" },
        { "tree", 0, OPTION_STRING, &s->tree, "FILE",
          .help = "what to show, if no argument says so" },
        { "panel", 0, OPTION_CHOICE, &s->panel, NULL, "the kind of display", .choices = panels },
        { "device", 0, OPTION_STRING, &s->device, "PATH", .help = "the display (the usual one)" },
        { "size", 0, OPTION_SIZE, s->size, "WxH", "pixels, where the display leaves a choice",
          .max = OW_PANEL_SIZE_MAX, .given = &s->has_size },
        { "format", 0, OPTION_CHOICE, &raw->format, NULL, "file: of the pixels",
          .choices = formats },
        { "depth", 0, OPTION_UNSIGNED, &s->depth, "BITS", "fbdev: 16 or 32 (as it is)", .min = 16,
          .max = 32, .no_default = true },
        { "one-page", 0, OPTION_FLAG, &s->one_page, NULL,
          .help = "fbdev: copy what changed, do not pan" },
        { "connector", 0, OPTION_STRING, &s->connector, "NAME",
          .help = "drm: HDMI-A-1 for example (the first with a screen)" },
        { "mode", 0, OPTION_STRING, &s->mode, "WxH[@HZ]", .help = "drm: (the screen's own)" },
        { "pixels", 0, OPTION_CHOICE, &raw->pixels, NULL, "v4l2: the format (what the device has)",
          .choices = video_formats },
        { "rotate", 0, OPTION_UNSIGNED, &s->rotate, "DEG",
          "the picture, clockwise: 0, 90, 180 or 270", .max = 270 },
        { "console", 0, OPTION_STRING, &s->console, "DEV",
          .help = "terminal to keep off the screen; none" },
        { "camera", 0, OPTION_STRING, &s->camera, "PATH",
          .help = "a V4L2 camera's picture behind the model" },
        { "camera-size", 0, OPTION_SIZE, s->camera_size, "WxH", "of the camera (its own)",
          .max = OW_PANEL_SIZE_MAX, .given = &s->has_camera_size, .no_default = true },
    };
    memcpy(to, these, sizeof these);
    return sizeof these / sizeof these[0];
}

static size_t add_bus(struct option_spec *to, struct oldwell_settings *s, struct raw *raw)
{
    const struct option_spec these[] = {
        { "bus", 0, OPTION_CHOICE, &raw->bus, NULL, "of a panel with a controller",
          .choices = buses },
        { "spi-hz", 0, OPTION_UNSIGNED, &s->spi_hz, "HZ", "clock (the controller's highest)",
          .min = 1000, .max = 2e8, .no_default = true },
        { "spi-mode", 0, OPTION_UNSIGNED, &s->spi_mode, "N", "clock polarity and phase", .max = 3 },
        { "i2c-address", 0, OPTION_STRING, &raw->i2c_address, "HEX", .help = "7 bits" },
        { "dc", 0, OPTION_STRING, &s->dc, "[CHIP:]LINE",
          .help = "D/C; lines by name or number, ! before one turns its level round" },
        { "reset", 0, OPTION_STRING, &s->reset, "[CHIP:]LINE", .help = "RESET, active low" },
        { "backlight", 0, OPTION_STRING, &s->backlight, "[CHIP:]LINE", .help = "active high" },
        { "offset", 0, OPTION_STRING, &raw->offset, "X,Y",
          .help = "of the glass in the controller's memory" },
        { "bgr", 0, OPTION_FLAG, &s->bgr, NULL, .help = "red and blue are exchanged" },
        { "invert", 0, OPTION_CHOICE, &s->invert, NULL, "auto: as the usual glass needs it",
          .choices = inverts },
        { "mirror-x", 0, OPTION_FLAG, &s->mirror_x, NULL, .help = "left and right" },
        { "mirror-y", 0, OPTION_FLAG, &s->mirror_y, NULL, .help = "top and bottom" },
    };
    memcpy(to, these, sizeof these);
    return sizeof these / sizeof these[0];
}

static size_t add_input(struct option_spec *to, struct oldwell_settings *s)
{
    const struct option_spec these[] = {
        { "buttons", 0, OPTION_STRING, &s->buttons, "CONTROL=LINE,...",
          .help = "GPIO lines that are low when pressed (! turns it round): left=23,right=24" },
        { "knobs", 0, OPTION_STRING, &s->knobs, "CONTROL=A+B,...",
          .help = "rotary encoders of two lines: knob1=5+6" },
        { "input", 0, OPTION_STRING, &s->input, "DEV,...",
          .help = "keys and joysticks, by path (/dev/input/event0) or name" },
        { "grab", 0, OPTION_FLAG, &s->grab, NULL, .help = "nobody else sees their events" },
    };
    memcpy(to, these, sizeof these);
    return sizeof these / sizeof these[0];
}

static size_t add_look(struct option_spec *to, struct oldwell_settings *s, struct raw *raw)
{
    const struct option_spec these[] = {
        { "order", 0, OPTION_CHOICE, &raw->order, NULL, "the surface", .choices = orders },
        { "shade", 0, OPTION_CHOICE, &raw->shade, NULL, "id: the source polygon's number",
          .choices = shades },
        { "aa", 0, OPTION_CHOICE, &raw->coverage, NULL, "4x4: 16 samples a pixel",
          .choices = coverages },
        { "dither", 0, OPTION_FLAG, &raw->dither, NULL,
          .help = "ordered, in formats of few levels" },
        { "background", 0, OPTION_STRING, &raw->background, "RRGGBB",
          .help = "colour behind the model" },
        { "foreground", 0, OPTION_STRING, &raw->foreground, "RRGGBB",
          .help = "colour of --shade lines" },
        { "ambient", 0, OPTION_DOUBLE, &raw->ambient, "A",
          "share of the light from everywhere, the rest is directional", .min = 0, .max = 1 },
        { "highlight", 0, OPTION_DOUBLE, &raw->highlight, "A",
          "phong: share of white in its middle", .min = 0, .max = 1 },
        { "shininess", 0, OPTION_UNSIGNED, &raw->shininess, "N",
          "phong: the highlight's exponent is 2^N", .min = 0, .max = 7 },
        { "light", 0, OPTION_VECTOR, raw->light, "x,y,z",
          .help = "towards the light: right, up, to the viewer" },
        { "fov", 0, OPTION_DOUBLE, &s->fov, "DEG", "vertical field of view", .min = 1, .max = 170 },
        { "elevation", 0, OPTION_DOUBLE, &s->elevation, "DEG", "the orbit's height", .min = -89,
          .max = 89 },
        { "orbit", 0, OPTION_UNSIGNED, &s->orbit, "N", "views of one turn around the model",
          .min = 1, .max = 100000 },
        { "first", 0, OPTION_UNSIGNED, &s->first, "K", "view to begin with", .max = 99999 },
        { "still", 0, OPTION_FLAG, &s->still, NULL, .help = "do not turn until a button says so" },
    };
    memcpy(to, these, sizeof these);
    return sizeof these / sizeof these[0];
}

static size_t add_run(struct option_spec *to, struct oldwell_settings *s)
{
    const struct option_spec these[] = {
        { "fps", 0, OPTION_UNSIGNED, &s->fps, "N", "most frames a second", .min = 1, .max = 1000 },
        { "once", 0, OPTION_FLAG, &s->once, NULL, .help = "draw one frame and leave" },
        { "stats", 0, OPTION_FLAG, &s->stats, NULL,
          .help = "one line of JSON a second on standard error" },
        { "no-watch", 0, OPTION_FLAG, &s->no_watch, NULL,
          .help = "a changed tree is loaded at SIGHUP only" },
        { "seconds", 0, OPTION_UNSIGNED, &s->seconds, "S",
          "doctor: how long its picture stays; 0: not shown", .max = 1e9 },
        { "retry", 0, OPTION_UNSIGNED, &s->retry_s, "S",
          "seconds to try again for when a device fails", .max = 1e9 },
        { "wait", 0, OPTION_UNSIGNED, &s->wait_s, "S", "seconds to wait for a device at the start",
          .max = 1e9 },
    };
    memcpy(to, these, sizeof these);
    return sizeof these / sizeof these[0];
}

static void set_defaults(struct oldwell_settings *s, struct raw *raw)
{
    *s = (struct oldwell_settings){
        .size = { 320, 240 },
        .console = "auto",
        .fov = 45,
        .elevation = 15,
        .orbit = 360,
        .fps = 30,
        .retry_s = 30,
        .seconds = 10,
    };
    *raw = (struct raw){
        .order = OW_FRONT_TO_BACK,
        .shade = OW_SHADE_FLAT,
        .pixels = -1,
        .i2c_address = "0x3c",
        .background = "20242c",
        .foreground = "f0f0f0",
        .ambient = 0.3,
        .highlight = 0.4,
        .shininess = 4,
        .light = { -0.4, 0.6, 0.7 },
    };
    for (uint32_t i = 0; i < ow_format_count && i < FORMATS_MOST; i++) {
        formats[i] = ow_formats[i]->name;
        raw->format = ow_formats[i] == &ow_format_xrgb8888 ? (int)i : raw->format;
    }
    for (uint32_t i = 0; i < ow_controller_count && PANEL_COMMAND + i < PANELS_MOST; i++) {
        panels[PANEL_COMMAND + i] = ow_controllers[i]->name;
    }
    size_t count = add_panel(specs, s, raw);
    count += add_bus(specs + count, s, raw);
    count += add_input(specs + count, s);
    count += add_look(specs + count, s, raw);
    count += add_run(specs + count, s);
    table = (struct option_table){ usage, about, specs, count, 0, 2, notes };
}

/* ---- the board file ---- */

/* The file that --board means: itself, board.conf in it, or an installed one. */
static FILE *open_board(const char *name, char *path, size_t bytes)
{
    static const char *const places[] = { "%s/board.conf", "%s",
                                          OLDWELL_DATA_DIR "/boards/%s/board.conf" };
    struct stat info;
    size_t count = strchr(name, '/') != NULL ? 2 : 3;
    for (size_t i = 0; i < count; i++) {
        const char *mark = strstr(places[i], "%s");
        int length =
            snprintf(path, bytes, "%.*s%s%s", (int)(mark - places[i]), places[i], name, mark + 2);
        if (length > 0 && (size_t)length < bytes && stat(path, &info) == 0 &&
            !S_ISDIR(info.st_mode)) {
            return fopen(path, "rb");
        }
    }
    snprintf(path, bytes, "%s", name);
    errno = ENOENT;
    return NULL;
}

/* Its text lives as long as the program: settings point into it. */
static const char *read_board(const char *name)
{
    static char path[PATH_BYTES];
    static char text[BOARD_FILE_BYTES_MAX + 1];
    FILE *stream = open_board(name, path, sizeof path);
    if (stream == NULL) {
        fail(FAIL_INPUT, path, 0, "cannot read the board's settings: %s", strerror(errno));
    }
    size_t bytes = fread(text, 1, sizeof text, stream);
    bool bad = ferror(stream) != 0;
    fclose(stream);
    if (bad || bytes > BOARD_FILE_BYTES_MAX) {
        fail(FAIL_INPUT, path, 0, "%s",
             bad ? "cannot read the board's settings" : "a board file has at most 64 KB");
    }
    size_t at = 0;
    long line = 0;
    struct board_setting setting;
    const char *wrong;
    while (board_file_next(text, bytes, &at, &line, &setting, &wrong)) {
        if (strcmp(setting.name, "board") == 0) {
            fail(FAIL_INPUT, path, line, "a board file cannot name another one");
        }
        options_take(&table, path, setting.line, setting.name, setting.value);
    }
    if (wrong != NULL) {
        fail(FAIL_INPUT, path, line, "%s", wrong);
    }
    return path;
}

/* --board is looked for first: the file's settings come before the command line's. */
static const char *find_board(int argc, char **argv)
{
    static const char option[] = "--board";
    const char *board = NULL;
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        if (strncmp(argv[i], option, sizeof option - 1) != 0) {
            continue;
        }
        const char *rest = argv[i] + sizeof option - 1;
        if (*rest == '=') {
            board = rest + 1;
        } else if (*rest == '\0' && i + 1 < argc) {
            board = argv[++i];
        }
    }
    return board;
}

/* ---- checks ---- */

static uint32_t read_colour(const char *option, const char *text)
{
    if (strlen(text) != 6 || strspn(text, "0123456789abcdefABCDEF") != 6) {
        options_wrong(&table, "--%s takes six hexadecimal digits RRGGBB, not '%s'", option, text);
    }
    return (uint32_t)strtoul(text, NULL, 16);
}

static void read_light(struct ow_light *light, const struct raw *raw)
{
    double length = sqrt(raw->light[0] * raw->light[0] + raw->light[1] * raw->light[1] +
                         raw->light[2] * raw->light[2]);
    if (!(length > 0) || !isfinite(length)) {
        options_wrong(&table, "--light takes the direction towards the light, not the zero vector");
    }
    for (int i = 0; i < 3; i++) {
        light->direction_q14[i] = (int16_t)lround(raw->light[i] / length * ONE_Q14);
    }
    light->intensity_q8 = (uint16_t)lround((1 - raw->ambient) * ONE_Q8);
}

static void read_look(struct oldwell_settings *s, const struct raw *raw)
{
    struct ow_look *look = &s->look;
    look->order = (enum ow_order)raw->order;
    look->shade = (enum ow_shade)raw->shade;
    look->coverage = raw->coverage != 0;
    look->dither = raw->dither;
    look->background = look->shade == OW_SHADE_ID ? 0 : read_colour("background", raw->background);
    look->foreground = read_colour("foreground", raw->foreground);
    look->ambient_q8 = (uint16_t)lround(raw->ambient * ONE_Q8);
    look->specular_q8 = (uint16_t)lround(raw->highlight * ONE_Q8);
    look->shininess = (uint8_t)raw->shininess;
    read_light(&look->lights[0], raw);
    look->light_count = 1;
    s->format = ow_formats[raw->format];
    s->pixels = raw->pixels < 0 ? 0 : video_codes[raw->pixels];
    if (look->coverage && (look->shade == OW_SHADE_ID || look->shade == OW_SHADE_LINES ||
                           look->order != OW_FRONT_TO_BACK)) {
        options_wrong(&table, "--aa 4x4 goes with --order front-to-back and a shade of faces");
    }
    if (look->coverage && s->camera != NULL) {
        options_wrong(&table, "--aa 4x4 does not go with --camera");
    }
}

static void read_bus(struct oldwell_settings *s, const struct raw *raw)
{
    char *end;
    unsigned long address = strtoul(raw->i2c_address, &end, 16);
    unsigned x;
    unsigned y;
    char rest;
    s->on_i2c = raw->bus == 1;
    if (s->panel >= PANEL_COMMAND && s->device == NULL) {
        s->device = s->on_i2c ? "/dev/i2c-1" : "/dev/spidev0.0";
    }
    if (s->panel >= PANEL_COMMAND && !s->on_i2c && s->dc == NULL) {
        options_wrong(&table, "--panel %s on SPI needs its D/C line: --dc gpiochip0:25, say",
                      panel_kind_name(s->panel));
    }
    if (*end != '\0' || address < 0x08 || address > 0x77) {
        options_wrong(&table, "--i2c-address takes 0x08 to 0x77, not '%s'", raw->i2c_address);
    }
    s->i2c_address = (uint8_t)address;
    s->has_offset = raw->offset != NULL;
    if (s->has_offset) {
        if (sscanf(raw->offset, "%u,%u%c", &x, &y, &rest) != 2 || x > OW_PANEL_SIZE_MAX ||
            y > OW_PANEL_SIZE_MAX) {
            options_wrong(&table, "--offset takes two whole numbers X,Y, not '%s'", raw->offset);
        }
        s->offset[0] = (uint16_t)x;
        s->offset[1] = (uint16_t)y;
    }
}

static void check_panel(const struct oldwell_settings *s)
{
    if (s->rotate % 90 != 0) {
        options_wrong(&table, "--rotate takes 0, 90, 180 or 270, not %u", (unsigned)s->rotate);
    }
    if (s->depth != 0 && s->depth != 16 && s->depth != 32) {
        options_wrong(&table, "--depth takes 16 or 32, not %u", (unsigned)s->depth);
    }
    if (s->panel == PANEL_FILE && s->device == NULL) {
        options_wrong(&table, "--panel file needs --device FILE");
    }
    if (s->first >= s->orbit) {
        options_wrong(&table, "--first counts from 0 and is below --orbit %u", (unsigned)s->orbit);
    }
}

static void read_operands(struct oldwell_settings *s, const char **operands, size_t count)
{
    size_t at = 0;
    if (count > 0 && strcmp(operands[0], "doctor") == 0) {
        s->doctor = true;
        at = 1;
    }
    if (count > at + 1) {
        options_wrong(&table, "unexpected argument '%s'", operands[at + 1]);
    }
    s->tree = count > at ? operands[at] : s->tree;
    if (s->tree == NULL && !s->doctor) {
        options_wrong(&table, "name the tree to show");
    }
    if (s->tree != NULL && strcmp(s->tree, "-") == 0) {
        options_wrong(&table, "the tree is read again when it changes, it cannot be '-'");
    }
}

void oldwell_settings_read(struct oldwell_settings *settings, int argc, char **argv)
{
    struct raw raw;
    const char *operands[2];
    set_defaults(settings, &raw);
    const char *board = find_board(argc, argv);
    const char *path = board != NULL ? read_board(board) : NULL;
    size_t count = options_parse(&table, argc, argv, operands);
    settings->board = path;
    read_operands(settings, operands, count);
    read_look(settings, &raw);
    read_bus(settings, &raw);
    check_panel(settings);
}
