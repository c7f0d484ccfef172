/* SPDX-License-Identifier: 0BSD */
/* The frame buffer's driver: formats, rows, pages, drivers that lie, every call failing once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <string.h>

#include "hal/linux/fbdev.h"
#include "hal/linux/formats.h"
#include "tests/unit/fake_linux.h"

static struct linux_fbdev fbdev;
static const struct ow_panel_rect whole = { 0, 0, 320, 240 };

static int open_fb(uint32_t bits, bool one_page)
{
    const struct linux_fbdev_config config = { &fake_linux, "/dev/fb0", bits, one_page };
    return linux_fbdev_open(&fbdev, &config);
}

static int reset(void **state)
{
    (void)state;
    fake_reset();
    return 0;
}

/* Lends, sets all pixels to a colour, shows. */
static int show_colour(uint32_t rgb, const struct ow_panel_rect *rect, uint32_t *age)
{
    struct ow_panel_buffer buffer;
    struct ow_panel_info info;
    assert_int_equal(linux_fbdev_ops.info(&fbdev, &info), OW_OK);
    int status = linux_fbdev_ops.lend(&fbdev, &buffer);
    if (status < 0) {
        return status;
    }
    *age = buffer.age;
    for (uint32_t y = 0; y < info.height; y++) {
        info.format->fill(buffer.pixels + (size_t)y * buffer.stride, 0, info.width,
                          info.format->pack(rgb));
    }
    return linux_fbdev_ops.show(&fbdev, rect, 1);
}

static void every_channel_order_is_honoured(void **state)
{
    static const struct {
        uint32_t bits;
        bool red_is_high;
        uint8_t red[4];
    } cases[] = {
        { 16, true, { 0x00, 0xF8 } },
        { 16, false, { 0x1F, 0x00 } },
        { 32, true, { 0x00, 0x00, 0xFF, 0x00 } },
        { 32, false, { 0xFF, 0x00, 0x00, 0x00 } },
    };
    uint32_t age;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint32_t bytes = cases[i].bits / 8;
        uint32_t line = 320 * bytes + 32;
        fake_reset();
        fake_set_mode(320, 240, cases[i].bits, cases[i].red_is_high, line, 1);
        memset(fake.memory, 0x5A, (size_t)line * 240);
        assert_int_equal(open_fb(0, false), OW_OK);
        assert_int_equal(show_colour(0xFF0000, &whole, &age), OW_OK);
        for (uint32_t y = 0; y < 240; y++) {
            for (uint32_t x = 0; x < 320; x++) {
                assert_memory_equal(fake.memory + (size_t)y * line + (size_t)x * bytes,
                                    cases[i].red, bytes);
            }
            assert_int_equal(fake.memory[y * line + 320 * bytes], 0x5A); /* padding stays */
        }
        linux_fbdev_close(&fbdev);
        assert_int_equal(fake.open_fds + fake.mapped, 0);
    }
}

/* The exchanged formats are the core's for exchanged colours, dithered ones too. */
static void exchanged_formats_are_the_cores_exchanged(void **state)
{
    static const struct ow_pixel_format *const pairs[][2] = {
        { &linux_format_bgr565, &ow_format_rgb565 },
        { &linux_format_xbgr8888, &ow_format_xrgb8888 },
    };
    (void)state;
    for (uint32_t i = 0; i < 2; i++) {
        const struct ow_pixel_format *own = pairs[i][0];
        const struct ow_pixel_format *cores = pairs[i][1];
        assert_int_equal(own->bits, cores->bits);
        assert_int_equal(own->used, cores->used);
        for (uint32_t rgb = 0; rgb < 0x1000000; rgb += 4099) {
            uint32_t bgr = rgb >> 16 | (rgb & 0xFF00) | (rgb & 0xFF) << 16;
            _Alignas(4) uint8_t row[8] = { 0 };
            assert_int_equal(own->pack(rgb), cores->pack(bgr));
            uint32_t back = cores->unpack(cores->pack(bgr));
            assert_int_equal(own->unpack(own->pack(rgb)),
                             back >> 16 | (back & 0xFF00) | (back & 0xFF) << 16);
            if (cores->dither != NULL) {
                assert_int_equal(own->dither(rgb, rgb % 64), cores->dither(bgr, rgb % 64));
            }
            own->store(row, 1, 2, &rgb);
            assert_int_equal(own->get(row, 1), own->pack(rgb));
        }
    }
}

static void only_what_changed_is_copied(void **state)
{
    const struct ow_panel_rect rect = { 10, 20, 3, 2 };
    uint32_t age;
    uint32_t changed = 0;
    (void)state;
    assert_int_equal(open_fb(0, false), OW_OK);
    assert_int_equal(show_colour(0x0000FF, &whole, &age), OW_OK);
    assert_int_equal(age, 0);
    assert_int_equal(show_colour(0xFF0000, &rect, &age), OW_OK);
    assert_int_equal(age, 1);
    for (uint32_t y = 0; y < 240; y++) {
        for (uint32_t x = 0; x < 320; x++) {
            bool is_red = fake.memory[y * 672 + 2 * x + 1] == 0xF8;
            changed += is_red;
            assert_int_equal(is_red, x >= 10 && x < 13 && y >= 20 && y < 22);
        }
    }
    assert_int_equal(changed, 6);
    linux_fbdev_close(&fbdev);
}

static void two_pages_take_turns(void **state)
{
    uint32_t age;
    (void)state;
    fake_set_mode(320, 240, 16, true, 672, 2);
    assert_int_equal(open_fb(0, false), OW_OK);
    assert_int_equal(fake.mode.yoffset, 0);
    assert_int_equal(show_colour(0xFF0000, &whole, &age), OW_OK);
    assert_int_equal(fake.mode.yoffset, 240);
    assert_int_equal(show_colour(0x0000FF, &whole, &age), OW_OK);
    assert_int_equal(fake.mode.yoffset, 0);
    assert_int_equal(show_colour(0x00FF00, &whole, &age), OW_OK);
    assert_int_equal(age, 2);
    assert_int_equal(fake.memory[1], 0x00);
    assert_int_equal(fake.memory[240 * 672 + 1], 0x07);
    linux_fbdev_close(&fbdev); /* the last picture stays, where the console draws */
    assert_int_equal(fake.mode.yoffset, 0);
    assert_int_equal(fake.memory[1], 0x07);
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

/* A driver that says yes to panning and stays, or says no, has one page. */
static void panning_that_does_not_work_is_not_used(void **state)
{
    uint32_t age;
    (void)state;
    for (int i = 0; i < 3; i++) {
        fake_reset();
        fake_set_mode(320, 240, 16, true, 672, 2);
        fake.fb_pan_lies = i == 0;
        fake.fix.ypanstep = i == 1 ? 0 : 1;
        assert_int_equal(open_fb(0, i == 2), OW_OK);
        uint32_t pans = fake.pans;
        assert_int_equal(fbdev.info.buffers, 1);
        assert_int_equal(show_colour(0xFF0000, &whole, &age), OW_OK);
        assert_int_equal(fake.pans, pans);
        assert_int_equal(fake.memory[1], 0xF8);
        linux_fbdev_close(&fbdev);
    }
}

static void the_screens_start_is_waited_for_where_it_is_offered(void **state)
{
    uint32_t age;
    (void)state;
    fake.fb_has_vsync = true;
    assert_int_equal(open_fb(0, false), OW_OK);
    uint32_t before = fake.vsyncs;
    assert_int_equal(show_colour(0, &whole, &age), OW_OK);
    assert_int_equal(fake.vsyncs, before + 1);
    linux_fbdev_close(&fbdev);
}

static void the_depth_is_set_and_read_back(void **state)
{
    (void)state;
    assert_int_equal(open_fb(32, false), OW_OK);
    assert_ptr_equal(fbdev.info.format, &ow_format_xrgb8888);
    linux_fbdev_close(&fbdev);
    assert_int_equal(fake.mode.bits_per_pixel, 16); /* as it was */
    fake.fb_keeps_depth = true;
    assert_int_equal(open_fb(32, false), OW_UNSUPPORTED);
    assert_string_equal(fbdev.fault.why, "the driver says yes and keeps its depth");
    assert_non_null(strstr(fbdev.fault.remedy, "16 bits"));
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

static void modes_without_sense_are_refused(void **state)
{
    (void)state;
    fake.mode.bits_per_pixel = 8;
    assert_int_equal(open_fb(0, false), OW_UNSUPPORTED);
    fake_reset();
    fake.fix.line_length = 639;
    assert_int_equal(open_fb(0, false), OW_UNSUPPORTED);
    fake_reset();
    fake.fix.smem_len = 672 * 239;
    assert_int_equal(open_fb(0, false), OW_UNSUPPORTED);
    fake_reset();
    fake.mode.xres = OW_PANEL_SIZE_MAX + 1;
    assert_int_equal(open_fb(0, false), OW_UNSUPPORTED);
    fake_reset();
    fake.fix.type = FB_TYPE_PLANES;
    assert_int_equal(open_fb(0, false), OW_UNSUPPORTED);
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

static void errors_have_their_statuses(void **state)
{
    static const struct {
        int number;
        int status;
    } cases[] = {
        { ENOENT, OW_GONE }, { ENODEV, OW_GONE }, { EACCES, OW_DENIED },     { EPERM, OW_DENIED },
        { EBUSY, OW_BUSY },  { EIO, OW_BUS },     { ETIMEDOUT, OW_TIMEOUT },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[600];
        fake_reset();
        fake.fail_at = 1;
        fake.fail_errno = cases[i].number;
        assert_int_equal(open_fb(0, false), cases[i].status);
        assert_int_equal(fbdev.fault.status, cases[i].status);
        linux_fault_text(&fbdev.fault, text, sizeof text);
        assert_non_null(strstr(text, "/dev/fb0: open: "));
        assert_non_null(strstr(text, strerror(cases[i].number)));
        assert_true(strlen(fbdev.fault.remedy) > 10);
    }
}

/* Opens, shows three frames, closes. The first failure, or OW_OK. */
static int one_life(void)
{
    uint32_t age;
    int status = open_fb(0, false);
    for (uint32_t i = 0; i < 3 && status == OW_OK; i++) {
        status = show_colour(i * 0x111111, &whole, &age);
    }
    linux_fbdev_close(&fbdev);
    return status;
}

static void every_call_may_fail(void **state)
{
    (void)state;
    for (uint32_t pages = 1; pages <= 2; pages++) {
        uint32_t failed = 1;
        for (uint32_t n = 1; failed > 0; n++) {
            fake_reset();
            fake_set_mode(320, 240, 16, true, 672, pages);
            fake.fb_has_vsync = true;
            fake.fail_at = n;
            int status = one_life();
            failed = fake.failed;
            assert_true(status == OW_OK || status == fbdev.fault.status);
            assert_int_equal(fake.open_fds + fake.mapped, 0);
        }
    }
}

static void show_without_lend_is_refused(void **state)
{
    (void)state;
    assert_int_equal(open_fb(0, false), OW_OK);
    assert_int_equal(linux_fbdev_ops.show(&fbdev, &whole, 1), OW_ARGUMENT);
    linux_fbdev_close(&fbdev);
    linux_fbdev_close(&fbdev);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(every_channel_order_is_honoured, reset),
        cmocka_unit_test(exchanged_formats_are_the_cores_exchanged),
        cmocka_unit_test_setup(only_what_changed_is_copied, reset),
        cmocka_unit_test_setup(two_pages_take_turns, reset),
        cmocka_unit_test_setup(panning_that_does_not_work_is_not_used, reset),
        cmocka_unit_test_setup(the_screens_start_is_waited_for_where_it_is_offered, reset),
        cmocka_unit_test_setup(the_depth_is_set_and_read_back, reset),
        cmocka_unit_test_setup(modes_without_sense_are_refused, reset),
        cmocka_unit_test_setup(errors_have_their_statuses, reset),
        cmocka_unit_test_setup(every_call_may_fail, reset),
        cmocka_unit_test_setup(show_without_lend_is_refused, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
