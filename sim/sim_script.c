/* SPDX-License-Identifier: 0BSD */
/* Scripted input: the parser, and the events as an input and a waiting device. */
#include "sim_script.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS = 4, LINE_BYTES = 256, STEPS_MAX = 1000, POSITION_MAX = 32767 };

static const char *const control_names[OW_CONTROL_NAMED] = {
    [OW_CONTROL_LEFT] = "left",     [OW_CONTROL_RIGHT] = "right",   [OW_CONTROL_UP] = "up",
    [OW_CONTROL_DOWN] = "down",     [OW_CONTROL_IN] = "in",         [OW_CONTROL_OUT] = "out",
    [OW_CONTROL_SELECT] = "select", [OW_CONTROL_BACK] = "back",     [OW_CONTROL_KNOB_1] = "knob1",
    [OW_CONTROL_KNOB_2] = "knob2",  [OW_CONTROL_KNOB_3] = "knob3",  [OW_CONTROL_AXIS_X] = "axis-x",
    [OW_CONTROL_AXIS_Y] = "axis-y", [OW_CONTROL_AXIS_Z] = "axis-z",
};

static const struct kind {
    const char *name;
    enum ow_input_kind kind;
    int32_t limit; /* of the value's magnitude; 0: it takes none */
} kinds[] = {
    { "press", OW_INPUT_PRESS, 0 },
    { "release", OW_INPUT_RELEASE, 0 },
    { "turn", OW_INPUT_TURN, STEPS_MAX },
    { "axis", OW_INPUT_AXIS, POSITION_MAX },
};

static bool wrong(struct sim_script_error *error, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static bool wrong(struct sim_script_error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->text, sizeof error->text, format, arguments);
    va_end(arguments);
    return false;
}

/* ---- one line ---- */

/* Cuts a line into words; one more than WORDS are counted, not kept. */
static size_t split(char *line, char *words[WORDS])
{
    size_t count = 0;
    line[strcspn(line, "#")] = '\0';
    for (char *word = strtok(line, " \t\r"); word != NULL; word = strtok(NULL, " \t\r")) {
        if (count < WORDS) {
            words[count] = word;
        }
        count++;
    }
    return count;
}

static bool read_whole(const char *word, long long min, long long max, long long *value)
{
    char *end;
    if (strchr("+-0123456789", word[0]) == NULL) {
        return false;
    }
    errno = 0;
    *value = strtoll(word, &end, 10);
    return end != word && *end == '\0' && errno == 0 && *value >= min && *value <= max;
}

static bool read_control(const char *word, uint16_t *control)
{
    long long number;
    for (int i = 0; i < OW_CONTROL_NAMED; i++) {
        if (strcmp(word, control_names[i]) == 0) {
            *control = (uint16_t)i;
            return true;
        }
    }
    if (!read_whole(word, 0, OW_CONTROL_LIMIT - 1, &number)) {
        return false;
    }
    *control = (uint16_t)number;
    return true;
}

static const struct kind *find_kind(const char *word)
{
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (strcmp(word, kinds[i].name) == 0) {
            return &kinds[i];
        }
    }
    return NULL;
}

static bool read_event(struct ow_input_event *event, char *words[WORDS], size_t count,
                       uint64_t after_us, struct sim_script_error *error)
{
    long long number;
    if (count < 3) {
        return wrong(error, "an event is `TIME CONTROL press|release|turn N|axis N`");
    }
    if (!read_whole(words[0], 0, (long long)SIM_SCRIPT_TIME_MAX, &number)) {
        return wrong(error, "'%s' is not a time in microseconds, at most a day", words[0]);
    }
    event->time_us = (uint64_t)number;
    if (event->time_us < after_us) {
        return wrong(error, "the time is before the line above, sort the events by time");
    }
    if (!read_control(words[1], &event->control)) {
        return wrong(error,
                     "'%s' is not a control: left, right, up, down, in, out, select, "
                     "back, knob1 ..., axis-x ... or 0 to 255",
                     words[1]);
    }
    const struct kind *kind = find_kind(words[2]);
    if (kind == NULL) {
        return wrong(error, "'%s' is not press, release, turn or axis", words[2]);
    }
    event->kind = (uint16_t)kind->kind;
    event->value = 0;
    if (count != (kind->limit != 0 ? 4u : 3u)) {
        return wrong(error, "%s takes %s", kind->name, kind->limit != 0 ? "one value" : "no value");
    }
    if (kind->limit != 0) {
        if (!read_whole(words[3], -kind->limit, kind->limit, &number)) {
            return wrong(error, "%s takes a whole number from -%ld to %ld, not '%s'", kind->name,
                         (long)kind->limit, (long)kind->limit, words[3]);
        }
        event->value = (int32_t)number;
    }
    return true;
}

/* ---- the file ---- */

/* Takes one line of the text; an empty one is fine. */
static bool take_line(struct sim_script *script, const char *text, size_t bytes,
                      struct sim_script_error *error)
{
    char line[LINE_BYTES];
    char *words[WORDS];
    if (bytes >= sizeof line) {
        return wrong(error, "the line is longer than %d bytes", LINE_BYTES - 1);
    }
    if (memchr(text, '\0', bytes) != NULL) {
        return wrong(error, "there is a zero byte: this is not a text file");
    }
    memcpy(line, text, bytes);
    line[bytes] = '\0';
    size_t count = split(line, words);
    if (count == 0) {
        return true;
    }
    uint64_t after_us = script->count > 0 ? script->events[script->count - 1].time_us : 0;
    if (!read_event(&script->events[script->count], words, count, after_us, error)) {
        return false;
    }
    script->count++;
    return true;
}

static size_t count_lines(const char *text, size_t bytes)
{
    size_t lines = 1;
    for (size_t i = 0; i < bytes; i++) {
        lines += text[i] == '\n';
    }
    return lines;
}

bool sim_script_parse(struct sim_script *script, const char *text, size_t bytes,
                      struct sim_script_error *error)
{
    *script = (struct sim_script){ 0 };
    *error = (struct sim_script_error){ 0 };
    script->events = calloc(count_lines(text, bytes), sizeof *script->events);
    if (script->events == NULL) {
        return wrong(error, "not enough memory for the script");
    }
    for (size_t at = 0; at < bytes;) {
        const char *end = memchr(text + at, '\n', bytes - at);
        size_t length = end != NULL ? (size_t)(end - (text + at)) : bytes - at;
        error->line++;
        if (!take_line(script, text + at, length, error)) {
            sim_script_free(script);
            return false;
        }
        at += length + 1;
    }
    return true;
}

void sim_script_free(struct sim_script *script)
{
    free(script->events);
    *script = (struct sim_script){ 0 };
}

/* ---- the devices ---- */

static int script_next(void *device, struct ow_input_event *event)
{
    struct sim_script *script = device;
    uint64_t now_us;
    if (script->next == script->count) {
        return OW_GONE;
    }
    int status = script->clock->ops->now(script->clock->device, &now_us);
    if (status < 0) {
        return status;
    }
    if (script->events[script->next].time_us > now_us) {
        return OW_AGAIN;
    }
    *event = script->events[script->next++];
    return OW_OK;
}

static int script_wait(void *device, uint64_t until_us)
{
    const struct sim_script *script = device;
    bool more = script->next < script->count;
    if (!more && until_us == OW_TIME_NEVER) {
        return OW_GONE;
    }
    bool event_first = more && script->events[script->next].time_us <= until_us;
    uint64_t wake_us = event_first ? script->events[script->next].time_us : until_us;
    int status = script->clock->ops->sleep(script->clock->device, wake_us);
    return status < 0 ? status : event_first;
}

const struct ow_input_ops sim_script_input_ops = { script_next };
const struct ow_wait_ops sim_script_wait_ops = { script_wait };
