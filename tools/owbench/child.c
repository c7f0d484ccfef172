/* SPDX-License-Identifier: 0BSD */
/* Programs that are run for so many seconds at most. */
#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "tools/common/fail.h"

enum { MOST_ARGUMENTS = 32, NAP_MS = 5 };

static char folder[PATH_MAX] = ".";

void child_set_folder(const char *self)
{
    const char *slash = strrchr(self, '/');
    if (slash != NULL && (size_t)(slash - self) < sizeof folder) {
        memcpy(folder, self, (size_t)(slash - self));
        folder[slash - self] = '\0';
    }
}

static void start(const char *program, const char *const *arguments)
{
    char path[2 * PATH_MAX];
    char *words[MOST_ARGUMENTS + 2] = { path };
    int count = 1;
    snprintf(path, sizeof path, "%s/%s", folder, program);
    for (; *arguments != NULL && count <= MOST_ARGUMENTS; arguments++) {
        words[count++] = (char *)(size_t)*arguments; /* execv's type; it changes nothing */
    }
    int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) {
        dup2(nowhere, STDERR_FILENO);
    }
    execv(path, words);
    _exit(127);
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

bool child_run(const char *program, const char *const *arguments, double seconds)
{
    double end = now() + seconds;
    int status = 0;
    fflush(NULL);
    pid_t pid = fork();
    if (pid < 0) {
        fail(FAIL_INPUT, program, 0, "cannot be started: %s", strerror(errno));
    }
    if (pid == 0) {
        start(program, arguments);
    }
    for (;;) {
        pid_t done = waitpid(pid, &status, WNOHANG);
        if (done == pid) {
            break;
        }
        if (now() > end) {
            kill(pid, SIGKILL);
            waitpid(pid, &status, 0);
            return false;
        }
        nanosleep(&(struct timespec){ 0, NAP_MS * 1000000L }, NULL);
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
        fail(FAIL_INPUT, program, 0, "is not there: it is looked for in %s", folder);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
