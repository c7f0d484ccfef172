/* SPDX-License-Identifier: 0BSD */
/* The host programs' helpers: error lines, output files that are whole or absent, options. */
#define _XOPEN_SOURCE 700 /* symlink, lstat, setrlimit */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#undef fail /* the helpers have a function of this name */

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/child.h"
#include "tools/common/fail.h"
#include "tools/common/options.h"
#include "tools/common/outfile.h"
#include "tools/common/version.h"

#define COUNT(array) (sizeof(array) / sizeof(array)[0])

/* A test's folder and the file it writes there. */
struct place {
    char folder[CHILD_PATH];
    char file[CHILD_PATH];
    int signal;
};

static void place_begin(struct place *place)
{
    folder_make(place->folder);
    folder_path(place->file, place->folder, "out.txt");
}

static void write_file(const char *path, const char *text)
{
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    assert_true(fputs(text, stream) >= 0);
    assert_int_equal(fclose(stream), 0);
}

static void assert_content(const char *path, const char *text)
{
    char read[256] = "";
    FILE *stream = fopen(path, "r");
    assert_non_null(stream);
    size_t length = fread(read, 1, sizeof read - 1, stream);
    fclose(stream);
    read[length] = '\0';
    assert_string_equal(read, text);
}

/* ---- error lines ---- */

static void say_all(void *context)
{
    (void)context;
    fail_set_program("prog");
    warn_line("a.obj", 7, "number %d", 3);
    warn_line("a.obj", 0, "no line");
    warn_line(NULL, 0, "bare");
    fail(5, NULL, 0, "bad\nname\x1b[0m");
}

static void test_lines(void **state)
{
    (void)state;
    struct child_result result = child_run(say_all, NULL);
    assert_int_equal(result.status, 5);
    assert_string_equal(result.out, "");
    assert_string_equal(result.err, "prog: a.obj:7: number 3\nprog: a.obj: no line\n"
                                    "prog: bare\nprog: bad?name?[0m\n");
}

static void say_long(void *context)
{
    static char text[20000];
    (void)context;
    memset(text, 'x', sizeof text - 1);
    fail(1, text, 1, "%s", text);
}

static void test_long_line(void **state)
{
    (void)state;
    struct child_result result = child_run(say_long, NULL);
    assert_int_equal(result.status, 1);
    assert_int_equal(child_lines(result.err), 1);
}

/* ---- output files ---- */

static void write_and_commit(void *context)
{
    struct place *place = context;
    umask(027);
    struct outfile *out = outfile_open(place->file);
    fprintf(outfile_stream(out), "hello");
    /* Until the commit the target does not exist. */
    if (folder_has(place->folder, "out.txt") || folder_entries(place->folder) != 1) {
        exit(9);
    }
    outfile_commit(out);
}

static void test_commit(void **state)
{
    struct place place;
    struct stat status;
    (void)state;
    place_begin(&place);
    assert_int_equal(child_run(write_and_commit, &place).status, 0);
    assert_content(place.file, "hello");
    assert_int_equal(folder_entries(place.folder), 1);
    assert_int_equal(stat(place.file, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0640);
    folder_remove(place.folder);
}

static void replace_file(void *context)
{
    struct place *place = context;
    struct outfile *out = outfile_open(place->file);
    fprintf(outfile_stream(out), "new");
    outfile_commit(out);
}

/* A link stays a link; what it points to is replaced and keeps its mode. */
static void test_replace_through_link(void **state)
{
    struct place place;
    char real[CHILD_PATH];
    struct stat status;
    (void)state;
    place_begin(&place);
    folder_path(real, place.folder, "real.txt");
    write_file(real, "old");
    assert_int_equal(chmod(real, 0604), 0);
    assert_int_equal(symlink("real.txt", place.file), 0);
    assert_int_equal(child_run(replace_file, &place).status, 0);
    assert_content(real, "new");
    assert_int_equal(lstat(place.file, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(stat(real, &status), 0);
    assert_int_equal(status.st_mode & 0777, 0604);
    assert_int_equal(folder_entries(place.folder), 2);
    folder_remove(place.folder);
}

static void fail_half_way(void *context)
{
    struct place *place = context;
    struct outfile *out = outfile_open(place->file);
    fprintf(outfile_stream(out), "half");
    fflush(outfile_stream(out));
    fail(1, "in.obj", 12, "is wrong");
}

static void exit_half_way(void *context)
{
    struct place *place = context;
    fprintf(outfile_stream(outfile_open(place->file)), "half");
    exit(0);
}

static void discard_half_way(void *context)
{
    struct place *place = context;
    struct outfile *out = outfile_open(place->file);
    fprintf(outfile_stream(out), "half");
    outfile_discard(out);
    _exit(0); /* no help from exit() */
}

/* An old file stays as it was, and nothing is left beside it. */
static void test_nothing_partial(void **state)
{
    void (*const bodies[])(void *) = { fail_half_way, exit_half_way, discard_half_way };
    (void)state;
    for (size_t i = 0; i < COUNT(bodies); i++) {
        struct place place;
        place_begin(&place);
        struct child_result result = child_run(bodies[i], &place);
        assert_int_equal(result.status, i == 0 ? 1 : 0);
        assert_int_equal(folder_entries(place.folder), 0);
        write_file(place.file, "old");
        child_run(bodies[i], &place);
        assert_content(place.file, "old");
        assert_int_equal(folder_entries(place.folder), 1);
        folder_remove(place.folder);
    }
}

static void raise_half_way(void *context)
{
    struct place *place = context;
    struct outfile *out = outfile_open(place->file);
    fprintf(outfile_stream(out), "half");
    fflush(outfile_stream(out));
    raise(place->signal);
    _exit(0);
}

static void test_signals(void **state)
{
    const int signals[] = { SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT };
    (void)state;
    for (size_t i = 0; i < COUNT(signals); i++) {
        struct place place;
        place_begin(&place);
        place.signal = signals[i];
        struct child_result result = child_run(raise_half_way, &place);
        assert_int_equal(result.signal, signals[i]);
        assert_int_equal(folder_entries(place.folder), 0);
        folder_remove(place.folder);
    }
}

static void ignore_and_raise(void *context)
{
    struct place *place = context;
    signal(SIGHUP, SIG_IGN);
    struct outfile *out = outfile_open(place->file);
    raise(SIGHUP);
    outfile_commit(out);
}

/* nohup: an ignored signal stays ignored. */
static void test_ignored_signal(void **state)
{
    struct place place;
    (void)state;
    place_begin(&place);
    assert_int_equal(child_run(ignore_and_raise, &place).status, 0);
    assert_true(folder_has(place.folder, "out.txt"));
    folder_remove(place.folder);
}

static void fork_half_way(void *context)
{
    struct place *place = context;
    struct outfile *out = outfile_open(place->file);
    pid_t child = fork();
    if (child == 0) {
        exit(0); /* runs the clean-up that it inherited */
    }
    int status;
    waitpid(child, &status, 0);
    outfile_commit(out);
}

static void test_child_leaves_files_alone(void **state)
{
    struct place place;
    (void)state;
    place_begin(&place);
    assert_int_equal(child_run(fork_half_way, &place).status, 0);
    assert_true(folder_has(place.folder, "out.txt"));
    folder_remove(place.folder);
}

static void open_only(void *context)
{
    outfile_open(context);
}

/* A missing folder, a folder as target, an empty name: one line, status 1. */
static void test_bad_targets(void **state)
{
    char folder[CHILD_PATH];
    char paths[3][CHILD_PATH] = { "", "", "" };
    const char *const words[] = { "does not exist", "folder", "empty" };
    (void)state;
    folder_make(folder);
    folder_path(paths[0], folder, "missing/out.txt");
    folder_path(paths[1], folder, "");
    for (size_t i = 0; i < COUNT(paths); i++) {
        struct child_result result = child_run(open_only, paths[i]);
        assert_int_equal(result.status, 1);
        assert_int_equal(child_lines(result.err), 1);
        assert_non_null(strstr(result.err, words[i]));
        assert_int_equal(folder_entries(folder), 0);
    }
    folder_remove(folder);
}

static void write_bytes(const char *path, size_t count)
{
    struct outfile *out = outfile_open(path);
    for (size_t i = 0; i < count; i++) {
        fputc('x', outfile_stream(out));
    }
    outfile_commit(out);
}

static void write_few(void *context)
{
    write_bytes(context, 10);
}

static void write_many(void *context)
{
    write_bytes(context, 100000);
}

/* A full disk is an error whether it is met while writing or at the end. */
static void test_full_device(void **state)
{
    char full[] = "/dev/full";
    void (*const bodies[])(void *) = { write_few, write_many };
    struct stat status;
    (void)state;
    for (size_t i = 0; i < COUNT(bodies); i++) {
        struct child_result result = child_run(bodies[i], full);
        assert_int_equal(result.status, 1);
        assert_string_equal(result.err,
                            "oldwell: /dev/full: cannot write: No space left on device\n");
        assert_int_equal(stat(full, &status), 0);
        assert_true(S_ISCHR(status.st_mode));
    }
}

static void write_limited(void *context)
{
    struct place *place = context;
    const struct rlimit limit = { 4096, 4096 };
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    write_bytes(place->file, 100000);
}

/* The same for a regular file, which must then be gone. */
static void test_file_cannot_grow(void **state)
{
    struct place place;
    (void)state;
    place_begin(&place);
    struct child_result result = child_run(write_limited, &place);
    assert_int_equal(result.status, 1);
    assert_int_equal(child_lines(result.err), 1);
    assert_int_equal(folder_entries(place.folder), 0);
    folder_remove(place.folder);
}

static void write_stdout(void *context)
{
    const char *device = context;
    if (device != NULL && freopen(device, "w", stdout) == NULL) {
        exit(9);
    }
    struct outfile *out = outfile_open("-");
    if (!outfile_is_direct(out) || strcmp(outfile_name(out), "standard output") != 0) {
        exit(8);
    }
    fputs("hello", outfile_stream(out));
    outfile_commit(out);
}

static void test_standard_output(void **state)
{
    char full[] = "/dev/full";
    (void)state;
    struct child_result result = child_run(write_stdout, NULL);
    assert_int_equal(result.status, 0);
    assert_string_equal(result.out, "hello");
    result = child_run(write_stdout, full);
    assert_int_equal(result.status, 1);
    assert_string_equal(result.err,
                        "oldwell: standard output: cannot write: No space left on device\n");
}

/* The second target becomes a folder that is not empty, so its rename must fail. */
static void commit_pair(void *context)
{
    struct place *place = context;
    char second[CHILD_PATH];
    char inside[CHILD_PATH];
    folder_path(second, place->folder, "second");
    folder_path(inside, second, "inside");
    struct outfile *outs[2] = { outfile_open(place->file), outfile_open(second) };
    mkdir(second, 0777);
    mkdir(inside, 0777);
    outfile_commit_all(outs, 2);
}

static void test_pair_is_whole_or_absent(void **state)
{
    struct place place;
    char inside[CHILD_PATH];
    (void)state;
    place_begin(&place);
    struct child_result result = child_run(commit_pair, &place);
    assert_int_equal(result.status, 1);
    assert_int_equal(child_lines(result.err), 1);
    assert_int_equal(folder_entries(place.folder), 1);
    assert_true(folder_has(place.folder, "second"));
    folder_path(inside, place.folder, "second/inside");
    rmdir(inside);
    folder_remove(place.folder);
}

static void open_too_many(void *context)
{
    struct place *place = context;
    for (int i = 0; i <= OUTFILE_LIMIT; i++) {
        char name[16];
        char path[CHILD_PATH];
        snprintf(name, sizeof name, "%d", i);
        folder_path(path, place->folder, name);
        outfile_open(path);
    }
}

static void test_table_full(void **state)
{
    struct place place;
    (void)state;
    place_begin(&place);
    struct child_result result = child_run(open_too_many, &place);
    assert_int_equal(result.status, 1);
    assert_int_equal(child_lines(result.err), 1);
    assert_int_equal(folder_entries(place.folder), 0);
    folder_remove(place.folder);
}

/* ---- options ---- */

/* Everything that a table can hold; printed after parsing, so that a test can compare it. */
struct values {
    bool flag, given;
    const char *text;
    uint64_t count;
    double share;
    int method;
    double eye[3];
    uint32_t size[2];
};

static void parse_and_print(void *context)
{
    char **argv = context;
    static const char *const methods[] = { "first", "best", NULL };
    struct values v = { .text = "none",
                        .count = 5,
                        .share = 0.5,
                        .method = 1,
                        .eye = { 1, 2, 3 },
                        .size = { 320, 240 } };
    const struct option_spec specs[] = {
        { "flag", 'f', OPTION_FLAG, &v.flag, .help = "a flag" },
        { "output", 'o', OPTION_STRING, &v.text, "FILE", .help = "a file" },
        { "count", 0, OPTION_UNSIGNED, &v.count, "N", "a number", .min = 1, .max = 100,
          .given = &v.given },
        { "share", 0, OPTION_DOUBLE, &v.share, "T", "a share", .min = 0, .max = 1 },
        { "method", 0, OPTION_CHOICE, &v.method, .help = "a method", .choices = methods },
        { "eye", 0, OPTION_VECTOR, v.eye, "X,Y,Z", .help = "a place" },
        { "size", 0, OPTION_SIZE, v.size, "WxH", .help = "a size" },
    };
    const struct option_table table = {
        .usage = "MODEL [options]\n--other",
        .about = "About it.",
        .specs = specs,
        .count = COUNT(specs),
        .min_operands = 1,
        .max_operands = 2,
        .notes = "Notes.\n",
    };
    const char *operands[2] = { "-", "-" };
    int argc = 0;
    while (argv[argc] != NULL) {
        argc++;
    }
    fail_set_program("prog");
    size_t count = options_parse(&table, argc, argv, operands);
    printf("%d %s %d%d %g %d %g,%g,%g %dx%d %d: %s %s", v.flag, v.text, (int)v.count, v.given,
           v.share, v.method, v.eye[0], v.eye[1], v.eye[2], (int)v.size[0], (int)v.size[1],
           (int)count, operands[0], operands[1]);
}

enum { WORDS = 12 };

/* Splits a command line at spaces; '_' stands for an empty argument. */
static struct child_result parse_line(const char *line)
{
    static char words[256];
    char *argv[WORDS] = { "prog" };
    int count = 1;
    snprintf(words, sizeof words, "%s", line);
    for (char *word = strtok(words, " "); word != NULL; word = strtok(NULL, " ")) {
        assert_true(count < WORDS - 1);
        argv[count++] = strcmp(word, "_") == 0 ? "" : word;
    }
    return child_run(parse_and_print, argv);
}

static void test_options_taken(void **state)
{
    static const char *const cases[][2] = {
        { "m", "0 none 50 0.5 1 1,2,3 320x240 1: m -" },
        { "-f m --flag", "1 none 50 0.5 1 1,2,3 320x240 1: m -" },
        { "-o a m --count 7", "0 a 71 0.5 1 1,2,3 320x240 1: m -" },
        { "-oa m --output=b", "0 b 50 0.5 1 1,2,3 320x240 1: m -" },
        { "- -o - x", "0 - 50 0.5 1 1,2,3 320x240 2: - x" },
        { "-o -- -- -o", "0 -- 50 0.5 1 1,2,3 320x240 1: -o -" },
        { "m --eye -1,2.5,-3e1 --share 1", "0 none 50 1 1 -1,2.5,-30 320x240 1: m -" },
        { "m --method first --size 1x65535", "0 none 50 0.5 0 1,2,3 1x65535 1: m -" },
        { "m --count 100 --count 1", "0 none 11 0.5 1 1,2,3 320x240 1: m -" },
    };
    (void)state;
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct child_result result = parse_line(cases[i][0]);
        assert_string_equal(result.err, "");
        assert_string_equal(result.out, cases[i][1]);
        assert_int_equal(result.status, 0);
    }
}

static void test_options_refused(void **state)
{
    static const char *const cases[] = {
        "",
        "a b c",
        "m --unknown",
        "m -x",
        "m --coun 3",
        "m --count",
        "m --count 0",
        "m --count 101",
        "m --count -1",
        "m --count +1",
        "m --count 1x",
        "m --count _",
        "m --count 99999999999999999999999",
        "m --share 1.5",
        "m --share nan",
        "m --share inf",
        "m --share -0.1",
        "m --share _",
        "m --method worst",
        "m --method=_",
        "m --eye 1,2",
        "m --eye 1,2,3,4",
        "m --eye 1,2,inf",
        "m --eye 1e999,2,3",
        "m --size 320",
        "m --size 0x10",
        "m --size 320x",
        "m --size 320x240x1",
        "m --size 65536x1",
        "m --flag=1",
    };
    (void)state;
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct child_result result = parse_line(cases[i]);
        assert_int_equal(result.status, 2);
        assert_string_equal(result.out, "");
        assert_int_equal(strncmp(result.err, "prog: ", 6), 0);
        const char *second = strchr(result.err, '\n');
        assert_non_null(second);
        assert_int_equal(strncmp(second, "\nusage: prog MODEL [options]\n", 29), 0);
    }
}

static void test_help_and_version(void **state)
{
    static const char *const parts[] = {
        "usage: prog MODEL [options]\n       prog --other\n",
        "About it.",
        "-f, --flag",
        "-o, --output FILE",
        "a file (none)",
        "a number (5)",
        "a share (0.5)",
        "--method first|best",
        "a method (best)",
        "a place (1,2,3)",
        "a size (320x240)",
        "--help",
        "--version",
        "Notes.\n",
    };
    (void)state;
    struct child_result result = parse_line("--help");
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err, "");
    for (size_t i = 0; i < COUNT(parts); i++) {
        assert_non_null(strstr(result.out, parts[i]));
    }
    result = parse_line("--version");
    assert_int_equal(result.status, 0);
    assert_string_equal(result.out, "prog " OLDWELL_VERSION "\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_long_line),
        cmocka_unit_test(test_commit),
        cmocka_unit_test(test_replace_through_link),
        cmocka_unit_test(test_nothing_partial),
        cmocka_unit_test(test_signals),
        cmocka_unit_test(test_ignored_signal),
        cmocka_unit_test(test_child_leaves_files_alone),
        cmocka_unit_test(test_bad_targets),
        cmocka_unit_test(test_full_device),
        cmocka_unit_test(test_file_cannot_grow),
        cmocka_unit_test(test_standard_output),
        cmocka_unit_test(test_pair_is_whole_or_absent),
        cmocka_unit_test(test_table_full),
        cmocka_unit_test(test_options_taken),
        cmocka_unit_test(test_options_refused),
        cmocka_unit_test(test_help_and_version),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
