/* SPDX-License-Identifier: 0BSD */
/*
 * The run around the viewer on a made-up frame buffer, in made-up time: displays that fail, go and
 * come back, cameras likewise, the exit status of each kind of failure.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "boards/linux/run.h"
#include "tests/unit/child.h"
#include "tests/unit/fake_linux.h"
#include "tests/unit/sim_scene.h"

static char folder[CHILD_PATH];
static char tree[CHILD_PATH];
static struct linux_system system_calls;

/* ---- what happens while it runs ---- */

static struct {
    uint64_t stop_us;    /* SIGTERM comes */
    uint64_t gone_us;    /* the display goes: every call fails */
    uint64_t back_us;    /* and comes back */
    uint32_t attempts;   /* to open it while it was away */
    uint64_t last_us;    /* of the last of them */
    uint64_t longest_us; /* between two of them */
} story;

static bool is_away(void)
{
    return fake.now_us >= story.gone_us && fake.now_us < story.back_us;
}

static int story_open(const char *path, int flags)
{
    if (strcmp(path, "/dev/fb0") == 0 && is_away()) {
        uint64_t pause_us = fake.now_us - story.last_us;
        if (story.attempts++ > 0 && pause_us > story.longest_us) {
            story.longest_us = pause_us;
        }
        story.last_us = fake.now_us;
        errno = ENODEV;
        return -1;
    }
    return fake_linux.open(path, flags);
}

static int story_ioctl(int fd, unsigned long request, void *argument)
{
    if (is_away()) {
        errno = ENODEV;
        return -1;
    }
    return fake_linux.ioctl(fd, request, argument);
}

/* Time passes only here; real descriptors (signals) are looked at. */
static int story_poll(struct pollfd *fds, size_t count, const struct timespec *timeout)
{
    const struct timespec at_once = { 0 };
    const struct timespec at_most = { .tv_nsec = 20 * 1000 * 1000 };
    bool longer = timeout == NULL || timeout->tv_sec > 0 || timeout->tv_nsec > at_most.tv_nsec;
    (void)fake_linux.poll(fds, count, longer ? &at_most : timeout);
    if (fake.now_us >= story.stop_us) {
        kill(getpid(), SIGTERM);
    }
    for (size_t i = 0; i < count; i++) {
        fds[i].revents = 0;
        if (fds[i].fd >= FAKE_FIRST_FD) {
            fake.taken = 1; /* a camera has a picture each time */
            fds[i].fd = -1;
        }
    }
    return linux_system.poll(fds, count, &at_once);
}

static struct oldwell_settings settings_of(void)
{
    return (struct oldwell_settings){
        .tree = tree,
        .panel = PANEL_FBDEV,
        .device = "/dev/fb0",
        .console = "none",
        .look = { .order = OW_FRONT_TO_BACK, .shade = OW_SHADE_FLAT, .ambient_q8 = 256 },
        .fov = 45,
        .orbit = 64,
        .fps = 20,
        .retry_s = 30,
    };
}

/* Runs to its end; what it says on standard error is in text. */
struct told {
    const struct oldwell_settings *settings;
    struct run run;
};

static void run_in_child(void *context)
{
    struct told *told = context;
    int status = run_main(&told->run, told->settings, &system_calls);
    printf("%u frames, %u attempts, %llu us, %u open\n", (unsigned)fake.pans, story.attempts,
           (unsigned long long)story.longest_us, fake.open_fds + fake.mapped);
    fflush(stdout);
    _exit(status);
}

static struct child_result run_story(const struct oldwell_settings *settings)
{
    static struct told told;
    told.settings = settings;
    return child_run(run_in_child, &told);
}

static int reset(void **state)
{
    (void)state;
    fake_reset();
    fake_set_mode(320, 240, 16, true, 672, 2); /* each frame is a pan */
    memset(&story, 0, sizeof story);
    story.stop_us = fake.now_us + 20000000;
    story.gone_us = UINT64_MAX;
    system_calls = fake_linux;
    system_calls.open = story_open;
    system_calls.ioctl = story_ioctl;
    system_calls.poll = story_poll;
    return 0;
}

static void assert_says(const struct child_result *result, const char *text)
{
    if (strstr(result->err, text) == NULL) {
        fail_msg("'%s' is not in: %s", text, result->err);
    }
}

/* ---- the tests ---- */

static void it_draws_until_it_is_told(void **state)
{
    struct oldwell_settings settings = settings_of();
    unsigned frames;
    unsigned attempts;
    unsigned left;
    unsigned long long longest;
    (void)state;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err, "");
    assert_int_equal(sscanf(result.out, "%u frames, %u attempts, %llu us, %u open", &frames,
                            &attempts, &longest, &left),
                     4);
    assert_true(frames > 300 && frames <= 410); /* 20 s at 20 a second, and what opening takes */
    assert_int_equal(left, 0);
}

static void a_display_comes_back(void **state)
{
    struct oldwell_settings settings = settings_of();
    unsigned frames;
    unsigned attempts;
    unsigned left;
    unsigned long long longest;
    (void)state;
    story.gone_us = fake.now_us + 3000000;
    story.back_us = fake.now_us + 15000000;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 0);
    assert_says(&result, "/dev/fb0: FBIOPAN_DISPLAY: No such device; ");
    assert_says(&result, "; trying again for 30 s\n");
    assert_says(&result, "the display is back\n");
    assert_int_equal(child_lines(result.err), 2);
    assert_int_equal(sscanf(result.out, "%u frames, %u attempts, %llu us, %u open", &frames,
                            &attempts, &longest, &left),
                     4);
    assert_in_range(attempts, 5, 12); /* slower and slower, and 5 s at most */
    assert_in_range(longest, 3000000, 5100000);
    assert_int_equal(left, 0);
}

static void a_display_that_stays_away_ends_it(void **state)
{
    struct oldwell_settings settings = settings_of();
    (void)state;
    settings.retry_s = 4;
    story.gone_us = fake.now_us + 3000000;
    story.back_us = UINT64_MAX;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 3);
    assert_says(&result, "; giving up\n");
    assert_int_equal(child_lines(result.err), 2);
}

static void without_retry_it_ends_at_once(void **state)
{
    struct oldwell_settings settings = settings_of();
    (void)state;
    settings.retry_s = 0;
    story.gone_us = fake.now_us + 3000000;
    story.back_us = UINT64_MAX;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 3);
    assert_int_equal(child_lines(result.err), 1);
}

static void sigterm_ends_the_waiting_too(void **state)
{
    struct oldwell_settings settings = settings_of();
    (void)state;
    settings.retry_s = 3600;
    story.gone_us = fake.now_us + 3000000;
    story.back_us = UINT64_MAX;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 0);
    settings.wait_s = 3600;
    story.gone_us = 0;
    result = run_story(&settings);
    assert_int_equal(result.status, 0);
}

/* Each n-th call fails: it goes on, or ends with the status of its kind; nothing stays open. */
static void calls_that_fail_now_and_then(void **state)
{
    static const struct {
        int number;
        int status;
    } kinds[] = { { EIO, 5 }, { ENODEV, 3 }, { EBUSY, 3 }, { EACCES, 4 }, { ETIMEDOUT, 6 } };
    struct oldwell_settings settings = settings_of();
    (void)state;
    settings.retry_s = 2;
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        for (uint32_t every = 2; every < 60; every += 7) {
            reset(NULL);
            fake.fail_every = every;
            fake.fail_errno = kinds[i].number;
            struct child_result result = run_story(&settings);
            assert_int_equal(result.signal, 0);
            assert_true(result.status == 0 || result.status == kinds[i].status);
            assert_non_null(strstr(result.out, " us, 0 open"));
        }
    }
}

static void a_camera_may_go(void **state)
{
    struct oldwell_settings settings = settings_of();
    (void)state;
    settings.camera = "/dev/video0";
    settings.orbit = 1;
    struct child_result result = run_story(&settings);
    assert_int_equal(result.status, 0);
    assert_string_equal(result.err, "");
    unsigned frames = 0;
    assert_int_equal(sscanf(result.out, "%u frames", &frames), 1);
    /* The model stands still, the picture behind it moves, and no faster than it may. */
    assert_in_range(frames, 100, 410);
}

static int make_tree(void **state)
{
    uint32_t size;
    uint8_t *blob = scene_cube(&size);
    (void)state;
    folder_make(folder);
    folder_path(tree, folder, "tree.owt");
    FILE *stream = fopen(tree, "wb");
    size_t written = stream != NULL ? fwrite(blob, 1, size, stream) : 0;
    bool good = stream != NULL && fclose(stream) == 0 && written == size;
    free(blob);
    return good ? 0 : -1;
}

static int remove_tree(void **state)
{
    (void)state;
    folder_remove(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(it_draws_until_it_is_told, reset),
        cmocka_unit_test_setup(a_display_comes_back, reset),
        cmocka_unit_test_setup(a_display_that_stays_away_ends_it, reset),
        cmocka_unit_test_setup(without_retry_it_ends_at_once, reset),
        cmocka_unit_test_setup(sigterm_ends_the_waiting_too, reset),
        cmocka_unit_test_setup(calls_that_fail_now_and_then, reset),
        cmocka_unit_test_setup(a_camera_may_go, reset),
    };
    return cmocka_run_group_tests(tests, make_tree, remove_tree);
}
