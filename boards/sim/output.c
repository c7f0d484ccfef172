/* SPDX-License-Identifier: 0BSD */
/* Frames become files. */
#include "output.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "tools/common/fail.h"

enum { CENTISECOND_MS = 10 };

/* ---- names ---- */

/* Reads what follows a '%'; its length, or 0 if it is no conversion. */
static size_t read_conversion(struct pattern *pattern, const char *text)
{
    size_t at = 0;
    if (text[0] == '0') {
        uint32_t digits = 0;
        for (at = 1; text[at] >= '0' && text[at] <= '9' && at <= 2; at++) {
            digits = 10 * digits + (uint32_t)(text[at] - '0');
        }
        if (digits < 1 || digits > PATTERN_DIGITS_MAX) {
            return 0;
        }
        pattern->digits = digits;
    }
    return text[at] == 'd' ? at + 1 : 0;
}

bool pattern_read(struct pattern *pattern, const char *text, struct image_error *error)
{
    *pattern = (struct pattern){ .digits = 1 };
    if (strlen(text) >= PATTERN_BYTES) {
        return image_fail(error, "the name is too long");
    }
    char *part = pattern->before;
    for (size_t at = 0; text[at] != '\0'; at++) {
        if (text[at] != '%') {
            *part++ = text[at];
        } else if (text[at + 1] == '%') {
            *part++ = text[++at];
        } else {
            size_t length = read_conversion(pattern, text + at + 1);
            if (length == 0) {
                return image_fail(error,
                                  "the frame's number is %%d or %%0Nd, N 1 to %d, and a "
                                  "percent sign is %%%%",
                                  PATTERN_DIGITS_MAX);
            }
            if (pattern->numbered) {
                return image_fail(error, "the frame's number may stand in the name only once");
            }
            pattern->numbered = true;
            part = pattern->after;
            at += length;
        }
    }
    return true;
}

bool pattern_name(const struct pattern *pattern, uint32_t frame, char *name, size_t bytes)
{
    int length;
    if (pattern->numbered) {
        length = snprintf(name, bytes, "%s%0*" PRIu32 "%s", pattern->before, (int)pattern->digits,
                          frame, pattern->after);
    } else {
        length = snprintf(name, bytes, "%s", pattern->before);
    }
    return length >= 0 && (size_t)length < bytes;
}

/* ---- files ---- */

static void write_image(struct outfile *out, const struct image_format *format,
                        const struct image *image)
{
    struct image_error error;
    if (!format->write(outfile_stream(out), image, &error)) {
        fail(FAIL_INPUT, outfile_name(out), 0, "%s", error.text);
    }
}

void write_picture(const char *file, const struct image_format *format, const struct image *image)
{
    struct outfile *out = outfile_open(file);
    write_image(out, format, image);
    outfile_commit(out);
}

void output_begin(struct output *output, const struct settings *settings, uint32_t frames)
{
    static const char default_pattern[] = "out-%04d";
    struct image_error error;
    const char *text = settings->output;
    *output = (struct output){ .settings = settings };
    if (text != NULL && strcmp(text, "-") == 0) {
        output->stream = outfile_open("-");
        text = NULL;
    }
    output->format = text != NULL ? image_format_of(text, &error) : &image_ppm;
    if (!pattern_read(&output->pattern, text != NULL ? text : default_pattern, &error) ||
        output->format == NULL) {
        settings_wrong("-o %s: %s", text, error.text);
    }
    if (frames != 1 && !output->pattern.numbered) {
        settings_wrong("-o %s: several frames need a number in the name, %%04d for example", text);
    }
    if (settings->sheet != NULL) {
        output->sheet = outfile_open(settings->sheet);
    }
    if (settings->gif != NULL) {
        output->gif = outfile_open(settings->gif);
    }
}

static void keep(struct output *output, struct image *image)
{
    if (output->kept == output->room) {
        output->room = output->room == 0 ? 64 : 2 * output->room;
        struct image *larger = realloc(output->frames, output->room * sizeof *larger);
        if (larger == NULL) {
            fail(FAIL_INPUT, NULL, 0, "not enough memory to keep the frames");
        }
        output->frames = larger;
    }
    output->frames[output->kept++] = *image;
    *image = (struct image){ 0 };
}

static void use_picture(struct output *output, struct image *image, uint32_t frame)
{
    const struct settings *settings = output->settings;
    char name[PATTERN_BYTES + 16];
    if (!pattern_name(&output->pattern, frame, name, sizeof name)) {
        fail(FAIL_INPUT, settings->output, 0, "the file's name gets too long");
    }
    if (output->stream != NULL) {
        write_image(output->stream, &image_ppm, image);
    } else if (settings->output != NULL) {
        write_picture(name, output->format, image);
    }
    if (settings->compare != NULL && !compare_frame(settings, name, image)) {
        output->differ++;
    }
    if (output->sheet != NULL || output->gif != NULL) {
        keep(output, image);
    }
}

int output_frame(void *context, const struct sim_panel *panel)
{
    struct output *output = context;
    const struct settings *settings = output->settings;
    struct image_error error;
    struct image image;
    if (output->off) {
        return OW_OK;
    }
    uint32_t frame = output->count++;
    output->crc = sim_panel_crc(panel, output->crc);
    if (settings->output == NULL && settings->compare == NULL && output->sheet == NULL &&
        output->gif == NULL) {
        return OW_OK;
    }
    if (!sim_panel_image(panel, &image, &error)) {
        fail(FAIL_INPUT, NULL, 0, "%s", error.text);
    }
    use_picture(output, &image, frame);
    image_free(&image);
    return OW_OK;
}

static void end_sheet(struct output *output)
{
    struct image_error error;
    struct image sheet;
    const struct settings *settings = output->settings;
    const struct image_format *format =
        strcmp(settings->sheet, "-") == 0 ? &image_ppm : image_format_of(settings->sheet, &error);
    if (!image_sheet(&sheet, output->frames, output->kept, (uint32_t)settings->columns, &error)) {
        fail(FAIL_INPUT, settings->sheet, 0, "%s", error.text);
    }
    write_image(output->sheet, format, &sheet);
    image_free(&sheet);
    outfile_commit(output->sheet);
}

static void end_gif(struct output *output)
{
    struct image_error error;
    uint32_t delay_cs = (uint32_t)output->settings->interval_ms / CENTISECOND_MS;
    if (!image_write_gif(outfile_stream(output->gif), output->frames, output->kept, delay_cs,
                         &error)) {
        fail(FAIL_INPUT, outfile_name(output->gif), 0, "%s", error.text);
    }
    outfile_commit(output->gif);
}

void output_end(struct output *output)
{
    if (output->stream != NULL) {
        outfile_commit(output->stream);
    }
    if (output->sheet != NULL) {
        end_sheet(output);
    }
    if (output->gif != NULL) {
        end_gif(output);
    }
    for (uint32_t i = 0; i < output->kept; i++) {
        image_free(&output->frames[i]);
    }
    free(output->frames);
    output->frames = NULL;
}
