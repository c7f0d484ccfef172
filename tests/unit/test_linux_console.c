/* SPDX-License-Identifier: 0BSD */
/* The console comes back on every way out: orders, crashes, SIGKILL of either process. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <linux/kd.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "boards/linux/guardian.h"
#include "hal/linux/console.h"
#include "tests/unit/fake_linux.h"

/* What both processes and the test see. */
struct shared {
    volatile int mode;
    volatile int hidden;
    volatile pid_t child;
    volatile int finished; /* the guardian's caller has its status */
    volatile int status;
};

static struct shared *shared;

static int shared_open(const char *path, int flags)
{
    (void)flags;
    assert_string_equal(path, "/dev/tty0");
    return 900;
}

static int shared_ioctl(int fd, unsigned long request, void *argument)
{
    if (fd != 900) {
        errno = ENOTTY; /* standard input is no console here */
        return -1;
    }
    if (request == KDGETMODE) {
        *(int *)argument = shared->mode;
    } else {
        shared->mode = (int)(intptr_t)argument;
    }
    return 0;
}

static ssize_t shared_write(int fd, const void *bytes, size_t count)
{
    (void)fd;
    shared->hidden = memcmp(bytes, "\033[?25l", count) == 0;
    return (ssize_t)count;
}

static const struct linux_system system_calls = {
    .open = shared_open,
    .ioctl = shared_ioctl,
    .write = shared_write,
};

/* ---- the work ---- */

static int end_well(void *context)
{
    (void)context;
    shared->child = getpid();
    return shared->mode == KD_GRAPHICS && shared->hidden ? 42 : 1;
}

static int crash(void *context)
{
    (void)context;
    signal(SIGSEGV, SIG_DFL); /* a sanitizer would make an exit of it */
    raise(SIGSEGV);
    return 0;
}

static volatile sig_atomic_t told;

static void on_signal(int number)
{
    told = number;
}

static int run_until_told(void *context)
{
    sigset_t none;
    (void)context;
    signal(SIGTERM, on_signal);
    signal(SIGINT, on_signal);
    shared->child = getpid();
    sigemptyset(&none);
    while (told == 0) {
        usleep(1000);
    }
    return told == SIGTERM ? 7 : 8;
}

static int run_for_ever(void *context)
{
    (void)context;
    shared->child = getpid();
    while (pause() != 0) {
    }
    return 0;
}

/* ---- the guardian in a process of its own ---- */

static pid_t start(int (*work)(void *context))
{
    shared->mode = KD_TEXT;
    shared->hidden = 0;
    shared->child = 0;
    shared->finished = 0;
    pid_t guardian = fork();
    assert_true(guardian >= 0);
    if (guardian == 0) {
        struct linux_console console;
        int number;
        if (linux_console_open(&console, &system_calls, "auto") != OW_OK) {
            _exit(99);
        }
        shared->status = guardian_run(&console, work, NULL, &number);
        shared->finished = 1;
        _exit(0);
    }
    return guardian;
}

static bool soon(bool (*is_so)(void))
{
    for (int i = 0; i < 3000 && !is_so(); i++) {
        usleep(1000);
    }
    return is_so();
}

static bool child_is_there(void)
{
    return shared->child != 0;
}

static bool text_is_back(void)
{
    return shared->mode == KD_TEXT && !shared->hidden;
}

static void assert_ends(pid_t guardian, int status)
{
    int state;
    assert_int_equal(waitpid(guardian, &state, 0), guardian);
    assert_true(WIFEXITED(state));
    assert_int_equal(WEXITSTATUS(state), 0);
    assert_int_equal(shared->finished, 1);
    assert_int_equal(shared->status, status);
    assert_true(text_is_back());
}

static void work_that_ends(void **state)
{
    (void)state;
    assert_ends(start(end_well), 42);
}

static void work_that_crashes(void **state)
{
    (void)state;
    assert_ends(start(crash), 128 + SIGSEGV);
}

static void orders_go_on_to_the_child(void **state)
{
    (void)state;
    pid_t guardian = start(run_until_told);
    assert_true(soon(child_is_there));
    kill(guardian, SIGTERM);
    assert_ends(guardian, 7);
    guardian = start(run_until_told);
    assert_true(soon(child_is_there));
    kill(guardian, SIGINT);
    assert_ends(guardian, 8);
}

static void a_killed_child(void **state)
{
    (void)state;
    pid_t guardian = start(run_for_ever);
    assert_true(soon(child_is_there));
    assert_int_equal(shared->mode, KD_GRAPHICS);
    kill(shared->child, SIGKILL);
    assert_ends(guardian, 128 + SIGKILL);
}

static void a_killed_guardian(void **state)
{
    int status;
    (void)state;
    pid_t guardian = start(run_until_told);
    assert_true(soon(child_is_there));
    kill(guardian, SIGKILL);
    assert_int_equal(waitpid(guardian, &status, 0), guardian);
    assert_true(soon(text_is_back));
}

static void an_open_console_is_as_it_was(void **state)
{
    struct linux_console console;
    (void)state;
    fake_reset();
    assert_int_equal(linux_console_open(&console, &fake_linux, "/dev/tty0"), OW_OK);
    assert_int_equal(fake.console_mode, KD_TEXT);
    assert_int_equal(linux_console_take(&console), OW_OK);
    assert_int_equal(fake.console_mode, KD_GRAPHICS);
    linux_console_give_back(&console);
    assert_int_equal(fake.console_mode, KD_TEXT);
}

/* ---- taking ---- */

static int open_and_take(struct linux_console *console, const char *path)
{
    int status = linux_console_open(console, &fake_linux, path);
    return status == OW_OK && console->fd >= 0 ? linux_console_take(console) : status;
}

static void without_a_console_there_is_nothing_to_do(void **state)
{
    struct linux_console console;
    (void)state;
    fake_reset();
    assert_int_equal(open_and_take(&console, "none"), OW_OK);
    assert_int_equal(console.fd, -1);
    assert_int_equal(open_and_take(&console, "/dev/null"), OW_UNSUPPORTED);
    assert_int_equal(open_and_take(&console, "/dev/tty99"), OW_GONE);
    for (uint32_t n = 1; n <= 3; n++) {
        static const int numbers[] = { ENOENT, ENOTTY, EPERM };
        for (size_t e = 0; e < 3; e++) {
            fake_reset();
            fake.fail_at = n;
            fake.fail_errno = numbers[e];
            int status = open_and_take(&console, "/dev/tty0");
            assert_int_equal(status, linux_status_of(numbers[e]));
            assert_int_equal(console.fd, -1);
            assert_int_equal(fake.open_fds, 0);
            assert_int_equal(fake.console_mode, KD_TEXT);
            linux_console_give_back(&console);
        }
    }
}

static int set_up(void **state)
{
    (void)state;
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return shared == MAP_FAILED;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(work_that_ends),
        cmocka_unit_test(work_that_crashes),
        cmocka_unit_test(orders_go_on_to_the_child),
        cmocka_unit_test(a_killed_child),
        cmocka_unit_test(a_killed_guardian),
        cmocka_unit_test(an_open_console_is_as_it_was),
        cmocka_unit_test(without_a_console_there_is_nothing_to_do),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
