/* SPDX-License-Identifier: 0BSD */
/* Displays by DRM: which screen, flips, other masters, a card that goes; each call failing once. */
#ifdef OLDWELL_DRM
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "hal/linux/drm.h"

enum { FD = 77, BEFORE = 500, FLIP_US = 5000, PITCH = 320 * 4 + 64, BYTES = PITCH * 240 };

/* A card with two connectors, HDMI-A-1 without a screen and HDMI-A-2 with one of two modes. */
static struct {
    bool screen_is_there;
    bool dumb;
    bool master_is_free;
    bool flips_never_end;
    uint32_t pitch;
    uint32_t fail_at;
    int fail_errno;
    /* What happened. */
    uint32_t calls;
    uint32_t failed;
    uint32_t objects; /* made and not given back, allocated or mapped */
    uint32_t dumbs;
    uint32_t buffers;
    uint32_t shown; /* frame buffer on the screen */
    uint32_t modes_set;
    uint32_t flips;
    void *flip_context; /* of the flip under way */
    uint64_t flip_us;   /* when it began */
    uint64_t now_us;
    uint8_t *memory[2];
} card;

static bool fails(void)
{
    if (++card.calls == card.fail_at) {
        card.failed++;
        errno = card.fail_errno;
        return true;
    }
    return false;
}

static int result(void)
{
    return fails() ? -card.fail_errno : 0;
}

static int get_cap(int fd, uint64_t capability, uint64_t *value)
{
    (void)fd;
    *value = capability == DRM_CAP_DUMB_BUFFER && card.dumb;
    return result();
}

static int is_master(int fd)
{
    (void)fd;
    return card.master_is_free;
}

static int set_master(int fd)
{
    (void)fd;
    errno = EACCES;
    return card.master_is_free ? 0 : -1;
}

static int drop_master(int fd)
{
    (void)fd;
    return 0;
}

static uint32_t connectors[2] = { 31, 32 };
static uint32_t crtcs[2] = { 41, 42 };
static uint32_t encoders[1] = { 51 };
static drmModeModeInfo modes[2];

static drmModeResPtr get_resources(int fd)
{
    (void)fd;
    if (fails()) {
        return NULL;
    }
    drmModeResPtr r = calloc(1, sizeof *r);
    r->count_connectors = 2;
    r->connectors = connectors;
    r->count_crtcs = 2;
    r->crtcs = crtcs;
    card.objects++;
    return r;
}

static void free_resources(drmModeResPtr resources)
{
    free(resources);
    card.objects--;
}

static drmModeConnectorPtr get_connector(int fd, uint32_t id)
{
    (void)fd;
    if (fails()) {
        return NULL;
    }
    drmModeConnectorPtr c = calloc(1, sizeof *c);
    c->connector_id = id;
    c->connector_type = DRM_MODE_CONNECTOR_HDMIA;
    c->connector_type_id = id - 30;
    c->connection = id == 32 && card.screen_is_there ? DRM_MODE_CONNECTED : DRM_MODE_DISCONNECTED;
    c->count_modes = c->connection == DRM_MODE_CONNECTED ? 2 : 0;
    c->modes = modes;
    c->count_encoders = 1;
    c->encoders = encoders;
    card.objects++;
    return c;
}

static drmModeConnectorPtr get_connector_current(int fd, uint32_t id)
{
    return get_connector(fd, id);
}

static void free_connector(drmModeConnectorPtr connector)
{
    free(connector);
    card.objects--;
}

static drmModeEncoderPtr get_encoder(int fd, uint32_t id)
{
    (void)fd;
    (void)id;
    if (fails()) {
        return NULL;
    }
    drmModeEncoderPtr e = calloc(1, sizeof *e);
    e->possible_crtcs = 2; /* the second only */
    card.objects++;
    return e;
}

static void free_encoder(drmModeEncoderPtr encoder)
{
    free(encoder);
    card.objects--;
}

static drmModeCrtcPtr get_crtc(int fd, uint32_t id)
{
    (void)fd;
    if (fails()) {
        return NULL;
    }
    drmModeCrtcPtr c = calloc(1, sizeof *c);
    c->crtc_id = id;
    c->buffer_id = BEFORE;
    c->mode_valid = 1;
    card.objects++;
    return c;
}

static void free_crtc(drmModeCrtcPtr crtc)
{
    free(crtc);
    card.objects--;
}

static int set_crtc(int fd, uint32_t crtc, uint32_t buffer, uint32_t x, uint32_t y, uint32_t *ids,
                    int count, drmModeModeInfoPtr mode)
{
    (void)fd;
    (void)x;
    (void)y;
    (void)mode;
    assert_int_equal(crtc, 42);
    assert_int_equal(count, 1);
    assert_int_equal(ids[0], 32);
    if (fails() || !card.master_is_free) {
        errno = card.master_is_free ? card.fail_errno : EACCES;
        return -1;
    }
    card.shown = buffer;
    card.modes_set++;
    return 0;
}

static int create_dumb(int fd, uint32_t width, uint32_t height, uint32_t bits, uint32_t flags,
                       uint32_t *handle, uint32_t *pitch, uint64_t *size)
{
    (void)fd;
    (void)flags;
    (void)bits;
    assert_int_equal(width, 320);
    assert_int_equal(height, 240);
    if (fails()) {
        return -1;
    }
    *handle = ++card.dumbs;
    *pitch = card.pitch;
    *size = BYTES;
    card.objects++;
    return 0;
}

static int destroy_dumb(int fd, uint32_t handle)
{
    (void)fd;
    (void)handle;
    card.objects--;
    return 0;
}

static int map_dumb(int fd, uint32_t handle, uint64_t *offset)
{
    (void)fd;
    *offset = handle - 1;
    return fails() ? -1 : 0;
}

static int add_fb2(int fd, uint32_t width, uint32_t height, uint32_t format,
                   const uint32_t handles[4], const uint32_t pitches[4], const uint32_t offsets[4],
                   uint32_t *buffer, uint32_t flags)
{
    (void)fd;
    (void)width;
    (void)height;
    (void)format;
    (void)offsets;
    (void)flags;
    assert_int_equal(pitches[0], card.pitch);
    if (fails()) {
        return -1;
    }
    *buffer = 100 + handles[0];
    card.objects++;
    return 0;
}

static int rm_fb(int fd, uint32_t buffer)
{
    (void)fd;
    (void)buffer;
    card.objects--;
    return 0;
}

static int page_flip(int fd, uint32_t crtc, uint32_t buffer, uint32_t flags, void *context)
{
    (void)fd;
    (void)crtc;
    assert_int_equal(flags, DRM_MODE_PAGE_FLIP_EVENT);
    assert_null(card.flip_context); /* one at a time */
    if (fails() || !card.master_is_free) {
        errno = card.master_is_free ? card.fail_errno : EACCES;
        return -1;
    }
    card.shown = buffer;
    card.flips++;
    card.flip_us = card.now_us;
    card.flip_context = context;
    return 0;
}

static int handle_event(int fd, drmEventContextPtr context)
{
    void *flip = card.flip_context;
    card.flip_context = NULL;
    context->page_flip_handler(fd, 0, 0, 0, flip);
    return 0;
}

static const struct linux_drm_calls calls = {
    .get_cap = get_cap,
    .is_master = is_master,
    .set_master = set_master,
    .drop_master = drop_master,
    .get_resources = get_resources,
    .free_resources = free_resources,
    .get_connector = get_connector,
    .get_connector_current = get_connector_current,
    .free_connector = free_connector,
    .get_encoder = get_encoder,
    .free_encoder = free_encoder,
    .get_crtc = get_crtc,
    .free_crtc = free_crtc,
    .set_crtc = set_crtc,
    .create_dumb = create_dumb,
    .destroy_dumb = destroy_dumb,
    .map_dumb = map_dumb,
    .add_fb2 = add_fb2,
    .rm_fb = rm_fb,
    .page_flip = page_flip,
    .handle_event = handle_event,
};

static int card_open(const char *path, int flags)
{
    (void)path;
    (void)flags;
    if (fails()) {
        return -1;
    }
    card.objects++;
    return FD;
}

static int card_close(int fd)
{
    assert_int_equal(fd, FD);
    card.objects--;
    card.flip_context = NULL;
    return 0;
}

static void *card_mmap(size_t bytes, int fd, uint64_t offset)
{
    (void)fd;
    assert_int_equal(bytes, BYTES);
    if (fails()) {
        return (void *)-1;
    }
    card.objects++;
    return card.memory[offset % 2];
}

static int card_munmap(void *memory, size_t bytes)
{
    (void)memory;
    (void)bytes;
    card.objects--;
    return 0;
}

static int card_poll(struct pollfd *fds, size_t count, const struct timespec *timeout)
{
    (void)count;
    card.now_us += (uint64_t)timeout->tv_nsec / 1000;
    bool ready =
        card.flip_context != NULL && !card.flips_never_end && card.now_us - card.flip_us > FLIP_US;
    fds[0].revents = ready ? POLLIN : 0;
    return ready;
}

static int card_now(struct timespec *now)
{
    card.now_us += 100;
    *now = (struct timespec){ .tv_sec = (time_t)(card.now_us / 1000000),
                              .tv_nsec = (long)(card.now_us % 1000000) * 1000 };
    return 0;
}

static const struct linux_system system_calls = {
    .open = card_open,
    .close = card_close,
    .mmap = card_mmap,
    .munmap = card_munmap,
    .poll = card_poll,
    .now = card_now,
};

/* ---- the tests ---- */

static struct linux_drm drm;

static int reset(void **state)
{
    uint8_t *kept[2] = { card.memory[0], card.memory[1] };
    (void)state;
    memset(&card, 0, sizeof card);
    for (int i = 0; i < 2; i++) {
        card.memory[i] = kept[i] != NULL ? kept[i] : malloc(BYTES);
        memset(card.memory[i], 0x5A, BYTES);
    }
    card.screen_is_there = card.dumb = card.master_is_free = true;
    card.pitch = PITCH;
    card.fail_errno = EIO;
    modes[0] = (drmModeModeInfo){ .hdisplay = 640, .vdisplay = 480, .vrefresh = 60 };
    modes[1] = (drmModeModeInfo){
        .hdisplay = 320, .vdisplay = 240, .vrefresh = 50, .type = DRM_MODE_TYPE_PREFERRED
    };
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    free(card.memory[0]);
    free(card.memory[1]);
    return 0;
}

static int open_drm(const char *connector, const char *mode)
{
    const struct linux_drm_config config = { &system_calls, &calls, "/dev/dri/card0",
                                             connector,     mode,   32 };
    return linux_drm_open(&drm, &config);
}

static int show(uint32_t rgb, uint32_t *age)
{
    const struct ow_panel_rect whole = { 0, 0, 320, 240 };
    struct ow_panel_buffer buffer;
    int status;
    while ((status = linux_drm_ops.lend(&drm, &buffer)) == OW_AGAIN) {
        linux_drm_finish(&drm);
    }
    if (status < 0) {
        return status;
    }
    *age = buffer.age;
    for (uint32_t y = 0; y < 240; y++) {
        ow_format_xrgb8888.fill(buffer.pixels + (size_t)y * buffer.stride, 0, 320, rgb);
    }
    return linux_drm_ops.show(&drm, &whole, 1);
}

static void frames_flip_between_two_buffers(void **state)
{
    uint32_t age;
    (void)state;
    assert_int_equal(open_drm(NULL, NULL), OW_OK);
    assert_int_equal(card.modes_set, 0); /* no blank frame before the first */
    for (uint32_t i = 0; i < 10; i++) {
        assert_int_equal(show(i * 3, &age), OW_OK);
        assert_int_equal(age, i < 2 ? 0 : 2);
        assert_int_equal(card.shown, 101 + (i + 1) % 2);
        const uint8_t *memory = card.memory[(i + 1) % 2];
        assert_int_equal(memory[239 * PITCH + 319 * 4], i * 3);
        assert_int_equal(memory[239 * PITCH + 320 * 4], 0x5A); /* the pitch is honoured */
    }
    assert_int_equal(card.modes_set, 1);
    assert_int_equal(card.flips, 9);
    linux_drm_close(&drm);
    assert_int_equal(card.shown, BEFORE);
    assert_int_equal(card.objects, 0);
}

static void screens_are_chosen(void **state)
{
    (void)state;
    assert_int_equal(open_drm("HDMI-A-2", "320x240@50"), OW_OK);
    linux_drm_close(&drm);
    assert_int_equal(open_drm("HDMI-A-1", NULL), OW_GONE);
    assert_non_null(strstr(drm.fault.remedy, "HDMI-A-1 without a screen, HDMI-A-2"));
    assert_int_equal(open_drm(NULL, "320x240@60"), OW_UNSUPPORTED);
    assert_non_null(strstr(drm.fault.remedy, "one of 640x480@60, 320x240@50"));
    assert_int_equal(open_drm(NULL, "320"), OW_UNSUPPORTED);
    assert_int_equal(open_drm(NULL, "320x240x"), OW_UNSUPPORTED);
    card.screen_is_there = false;
    assert_int_equal(open_drm(NULL, NULL), OW_GONE);
    reset(NULL);
    card.dumb = false;
    assert_int_equal(open_drm(NULL, NULL), OW_UNSUPPORTED);
    assert_int_equal(card.objects, 0);
}

static void an_unplugged_screen_is_gone(void **state)
{
    (void)state;
    assert_int_equal(open_drm(NULL, NULL), OW_OK);
    assert_int_equal(linux_drm_look(&drm), OW_OK);
    card.screen_is_there = false;
    assert_int_equal(linux_drm_look(&drm), OW_GONE);
    assert_string_equal(drm.fault.why, "the screen was unplugged");
    card.fail_at = card.calls + 1;
    assert_int_equal(linux_drm_look(&drm), OW_BUS);
    linux_drm_close(&drm);
    assert_int_equal(card.objects, 0);
}

static void another_master_is_busy(void **state)
{
    uint32_t age;
    (void)state;
    card.master_is_free = false;
    assert_int_equal(open_drm(NULL, NULL), OW_BUSY);
    assert_int_equal(card.objects, 0);
    card.master_is_free = true;
    assert_int_equal(open_drm(NULL, NULL), OW_OK);
    assert_int_equal(show(1, &age), OW_OK);
    assert_int_equal(show(2, &age), OW_OK);
    card.master_is_free = false; /* somebody takes it */
    assert_int_equal(show(3, &age), OW_BUSY);
    assert_string_equal(drm.fault.why, "another program has taken the screen");
    linux_drm_close(&drm);
    assert_int_equal(card.objects, 0);
}

static void a_screen_that_never_flips_times_out(void **state)
{
    uint32_t age;
    (void)state;
    assert_int_equal(open_drm(NULL, NULL), OW_OK);
    assert_int_equal(show(1, &age), OW_OK);
    card.flips_never_end = true;
    assert_int_equal(show(2, &age), OW_OK);
    struct ow_panel_buffer buffer;
    assert_int_equal(linux_drm_ops.lend(&drm, &buffer), OW_AGAIN);
    card.now_us += 2000000;
    assert_int_equal(linux_drm_ops.lend(&drm, &buffer), OW_TIMEOUT);
    assert_int_equal(drm.fault.status, OW_TIMEOUT);
    linux_drm_close(&drm);
    assert_int_equal(card.objects, 0);
}

static void a_buffer_that_is_too_small_is_refused(void **state)
{
    (void)state;
    card.pitch = 320 * 4 - 4;
    assert_int_equal(open_drm(NULL, NULL), OW_UNSUPPORTED);
    card.pitch = PITCH + 4;
    assert_int_equal(open_drm(NULL, NULL), OW_UNSUPPORTED);
    assert_int_equal(card.objects, 0);
}

static void every_call_may_fail(void **state)
{
    static const int numbers[] = { EIO, ENODEV, EACCES, EINVAL };
    (void)state;
    for (size_t e = 0; e < sizeof numbers / sizeof numbers[0]; e++) {
        uint32_t failed = 1;
        for (uint32_t n = 1; failed > 0; n++) {
            uint32_t age;
            reset(NULL);
            card.fail_at = n;
            card.fail_errno = numbers[e];
            int status = open_drm(NULL, NULL);
            for (uint32_t i = 0; i < 5 && status == OW_OK; i++) {
                status = show(i, &age);
            }
            failed = card.failed;
            assert_true(status == OW_OK || status == drm.fault.status);
            linux_drm_close(&drm);
            assert_int_equal(card.objects, 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(frames_flip_between_two_buffers, reset),
        cmocka_unit_test_setup(screens_are_chosen, reset),
        cmocka_unit_test_setup(an_unplugged_screen_is_gone, reset),
        cmocka_unit_test_setup(another_master_is_busy, reset),
        cmocka_unit_test_setup(a_screen_that_never_flips_times_out, reset),
        cmocka_unit_test_setup(a_buffer_that_is_too_small_is_refused, reset),
        cmocka_unit_test_setup(every_call_may_fail, reset),
    };
    return cmocka_run_group_tests(tests, NULL, tear_down);
}
#else
#include <stdio.h>

int main(void)
{
    puts("ok 1 # SKIP built without libdrm");
    return 0;
}
#endif
