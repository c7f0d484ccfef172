/* SPDX-License-Identifier: 0BSD */
/* Guardian and child. */
#define _GNU_SOURCE /* prctl's neighbours */
#include "guardian.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/common/fail.h"

enum { PATIENCE_S = 5, SIGNAL_BASE = 128, TEXT_BYTES = 600 };

static const int forwarded[] = { SIGINT, SIGTERM, SIGQUIT, SIGHUP };

static void add_forwarded(sigset_t *set)
{
    for (size_t i = 0; i < sizeof forwarded / sizeof forwarded[0]; i++) {
        sigaddset(set, forwarded[i]);
    }
}

/* Only once somebody is there to give it back. */
static void take(struct linux_console *console)
{
    char text[TEXT_BYTES];
    if (linux_console_take(console) < 0) {
        linux_fault_text(&console->fault, text, sizeof text);
        warn_line(NULL, 0, "%s; text may be drawn over the picture", text);
    }
}

/* The child's side. The work ends in order when the guardian dies: it gets SIGTERM then. */
static _Noreturn void be_child(struct linux_console *console, int (*work)(void *context),
                               void *context, pid_t guardian, const sigset_t *mask)
{
    sigprocmask(SIG_SETMASK, mask, NULL);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    int status = EXIT_FAILURE;
    if (getppid() == guardian) {
        take(console);
        status = work(context);
    }
    if (getppid() != guardian) {
        linux_console_give_back(console);
    }
    exit(status);
}

/* Waits for the child and passes signals on. Returns what waitpid says of it. */
static int watch(pid_t child, const sigset_t *set)
{
    const struct timespec patience = { PATIENCE_S, 0 };
    bool ending = false;
    int state;
    for (;;) {
        siginfo_t info;
        int number = ending ? sigtimedwait(set, &info, &patience) : sigwaitinfo(set, &info);
        if (waitpid(child, &state, WNOHANG) == child) {
            return state;
        }
        if (number < 0 && ending && errno == EAGAIN) {
            kill(child, SIGKILL);
            ending = false;
        } else if (number > 0 && number != SIGCHLD) {
            kill(child, number);
            ending = ending || number != SIGHUP;
        }
    }
}

int guardian_run(struct linux_console *console, int (*work)(void *context), void *context,
                 int *ended_by)
{
    sigset_t set;
    sigset_t before;
    pid_t guardian = getpid();
    *ended_by = 0;
    sigemptyset(&set);
    add_forwarded(&set);
    sigaddset(&set, SIGCHLD);
    sigprocmask(SIG_BLOCK, &set, &before);
    fflush(NULL);
    pid_t child = fork();
    if (child < 0) {
        warn_line(NULL, 0, "fork: no process can be made, the console may stay without text");
        sigprocmask(SIG_SETMASK, &before, NULL);
        take(console);
        int status = work(context);
        linux_console_give_back(console);
        return status;
    }
    if (child == 0) {
        be_child(console, work, context, guardian, &before);
    }
    int state = watch(child, &set);
    linux_console_give_back(console);
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (WIFSIGNALED(state)) {
        *ended_by = WTERMSIG(state);
        return SIGNAL_BASE + *ended_by;
    }
    return WEXITSTATUS(state);
}
