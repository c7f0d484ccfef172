/* SPDX-License-Identifier: 0BSD */
/* Output files that are whole or absent: a temporary beside the target, then rename. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "tools/common/outfile.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tools/common/fail.h"

enum { PATH_BYTES = PATH_MAX + 64 };

/* A place in the fixed table: the signal handler may read it at any moment. */
struct outfile {
    FILE *stream;
    bool used;
    bool direct; /* no temporary, no rename */
    volatile sig_atomic_t temporary_exists;
    pid_t owner;           /* a forked child must leave its parent's files alone */
    char name[PATH_BYTES]; /* as given, for messages */
    char target[PATH_BYTES];
    char temporary[PATH_BYTES];
};

static struct outfile table[OUTFILE_LIMIT];

static const int ending_signals[] = { SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ };
enum { ENDING_SIGNALS = sizeof ending_signals / sizeof ending_signals[0] };

/* Async-signal-safe: reads the table, calls getpid and unlink. */
static void remove_temporaries(void)
{
    pid_t self = getpid();
    for (int i = 0; i < OUTFILE_LIMIT; i++) {
        if (table[i].temporary_exists && table[i].owner == self) {
            unlink(table[i].temporary);
            table[i].temporary_exists = 0;
        }
    }
}

/* The signal stays blocked until the handler returns; then the raised one ends the program. */
static void on_signal(int number)
{
    int saved = errno;
    remove_temporaries();
    signal(number, SIG_DFL);
    raise(number);
    errno = saved;
}

static void signals_block(sigset_t *before)
{
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < ENDING_SIGNALS; i++) {
        sigaddset(&set, ending_signals[i]);
    }
    sigprocmask(SIG_BLOCK, &set, before);
}

static void signals_restore(const sigset_t *before)
{
    sigprocmask(SIG_SETMASK, before, NULL);
}

/* Once: handlers for the signals that nobody ignores (nohup) or handles, and for exit(). */
static void install_handlers(void)
{
    static bool installed;
    if (installed) {
        return;
    }
    installed = true;
    for (int i = 0; i < ENDING_SIGNALS; i++) {
        struct sigaction old;
        if (sigaction(ending_signals[i], NULL, &old) == 0 && old.sa_handler == SIG_DFL) {
            struct sigaction new = { .sa_handler = on_signal };
            sigemptyset(&new.sa_mask);
            sigaction(ending_signals[i], &new, NULL);
        }
    }
    atexit(outfile_discard_all);
}

static struct outfile *take_place(const char *path)
{
    for (int i = 0; i < OUTFILE_LIMIT; i++) {
        if (!table[i].used) {
            struct outfile *out = &table[i];
            memset(out, 0, sizeof *out);
            out->used = true;
            out->owner = getpid();
            strcpy(out->name, path);
            return out;
        }
    }
    fail(FAIL_INPUT, path, 0, "cannot open: %d output files are open already", OUTFILE_LIMIT);
}

/* The temporary's name: the target's folder, then a name of our own (never too long). */
static void name_temporary(struct outfile *out)
{
    static unsigned serial;
    const char *slash = strrchr(out->target, '/');
    size_t folder = slash == NULL ? 0 : (size_t)(slash - out->target) + 1;
    memcpy(out->temporary, out->target, folder);
    snprintf(out->temporary + folder, PATH_BYTES - folder, ".oldwell-%ld-%u.tmp", (long)getpid(),
             serial++);
}

static _Noreturn void fail_to_open(const struct outfile *out, int error)
{
    if (error == ENOENT || error == ENOTDIR) {
        fail(FAIL_INPUT, out->name, 0, "the output folder does not exist, create it first");
    }
    fail(FAIL_INPUT, out->name, 0, "cannot write: %s", strerror(error));
}

static void open_temporary(struct outfile *out)
{
    sigset_t before;
    int descriptor;
    signals_block(&before);
    do {
        name_temporary(out);
        descriptor = open(out->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor < 0 && errno == EEXIST);
    int error = errno;
    out->temporary_exists = descriptor >= 0;
    signals_restore(&before);
    if (descriptor < 0) {
        fail_to_open(out, error);
    }
    out->stream = fdopen(descriptor, "w");
    if (out->stream == NULL) {
        fail_to_open(out, errno);
    }
}

/* An existing regular file: follow links to it, refuse if it is write protected, keep its mode. */
static void open_replacement(struct outfile *out, mode_t mode)
{
    char resolved[PATH_MAX];
    if (access(out->name, W_OK) != 0 || realpath(out->name, resolved) == NULL) {
        fail_to_open(out, errno);
    }
    strcpy(out->target, resolved);
    open_temporary(out);
    (void)fchmod(fileno(out->stream), mode & 0777);
}

struct outfile *outfile_open(const char *path)
{
    if (path[0] == '\0') {
        fail(FAIL_INPUT, NULL, 0, "the output file's name is empty");
    }
    if (strlen(path) >= PATH_MAX) {
        fail(FAIL_INPUT, NULL, 0, "the output file's name is too long");
    }
    struct outfile *out = take_place(path);
    install_handlers();
    if (strcmp(path, "-") == 0) {
        strcpy(out->name, "standard output");
        out->stream = stdout;
        out->direct = true;
        return out;
    }
    struct stat status;
    if (stat(path, &status) != 0) {
        strcpy(out->target, path);
        open_temporary(out);
    } else if (S_ISREG(status.st_mode)) {
        open_replacement(out, status.st_mode);
    } else if (S_ISDIR(status.st_mode)) {
        fail(FAIL_INPUT, path, 0, "is a folder, name a file");
    } else {
        out->direct = true;
        out->stream = fopen(path, "w");
        if (out->stream == NULL) {
            fail_to_open(out, errno);
        }
    }
    return out;
}

FILE *outfile_stream(struct outfile *out)
{
    return out->stream;
}

const char *outfile_name(const struct outfile *out)
{
    return out->name;
}

bool outfile_is_direct(const struct outfile *out)
{
    return out->direct;
}

/* Flushes and closes; all write errors since the opening end here. */
static void finish_stream(struct outfile *out)
{
    FILE *stream = out->stream;
    errno = 0;
    bool bad = fflush(stream) != 0;
    bad = ferror(stream) != 0 || bad;
    int error = errno;
    out->stream = NULL;
    if (stream != stdout && fclose(stream) != 0 && !bad) {
        bad = true;
        error = errno;
    }
    if (bad) {
        fail(FAIL_INPUT, out->name, 0, "cannot write: %s",
             error != 0 ? strerror(error) : "a write failed");
    }
}

void outfile_commit_all(struct outfile *const *outs, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        finish_stream(outs[i]);
    }
    sigset_t before;
    signals_block(&before);
    for (size_t i = 0; i < count; i++) {
        struct outfile *out = outs[i];
        if (!out->direct && rename(out->temporary, out->target) != 0) {
            int error = errno;
            for (size_t k = 0; k < i; k++) {
                if (!outs[k]->direct) {
                    unlink(outs[k]->target);
                }
            }
            fail(FAIL_INPUT, out->name, 0, "cannot write: %s", strerror(error));
        }
        out->temporary_exists = 0;
    }
    for (size_t i = 0; i < count; i++) {
        outs[i]->used = false;
    }
    signals_restore(&before);
}

void outfile_commit(struct outfile *out)
{
    outfile_commit_all(&out, 1);
}

void outfile_discard(struct outfile *out)
{
    sigset_t before;
    if (out->stream != NULL && out->stream != stdout) {
        fclose(out->stream);
    }
    signals_block(&before);
    if (out->temporary_exists && out->owner == getpid()) {
        unlink(out->temporary);
    }
    out->temporary_exists = 0;
    out->used = false;
    signals_restore(&before);
}

/* Streams stay open: a caller up the stack may still hold one, and the program ends anyway. */
void outfile_discard_all(void)
{
    remove_temporaries();
}
