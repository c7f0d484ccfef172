/* SPDX-License-Identifier: 0BSD */
/* Video outputs and cameras: formats bit for bit, queues, every call failing once. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <errno.h>
#include <string.h>

#include "hal/linux/v4l2_camera.h"
#include "hal/linux/v4l2_out.h"
#include "tests/unit/fake_linux.h"

enum { WIDTH = 64, HEIGHT = 48 };

static struct linux_v4l2_out out;
static struct linux_v4l2_camera camera;
static const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };

static int reset(void **state)
{
    (void)state;
    fake_reset();
    return 0;
}

static struct linux_v4l2_config config(const char *device, uint32_t width, uint32_t pixels)
{
    return (struct linux_v4l2_config){ &fake_linux, device, width, HEIGHT, pixels };
}

static int open_out(uint32_t pixels)
{
    const struct linux_v4l2_config c = config("/dev/video1", WIDTH, pixels);
    return linux_v4l2_out_open(&out, &c);
}

/* A picture with all channels different, and different in every pixel of a pair. */
static uint32_t colour(uint32_t x, uint32_t y)
{
    return (x * 4 & 0xFF) << 16 | (y * 5 & 0xFF) << 8 | ((x * 3 + y * 7) & 0xFF);
}

static int show(uint32_t shift)
{
    struct ow_panel_buffer buffer;
    int status = linux_v4l2_out_ops.lend(&out, &buffer);
    for (uint32_t y = 0; y < HEIGHT && status == OW_OK; y++) {
        uint32_t line[WIDTH];
        for (uint32_t x = 0; x < WIDTH; x++) {
            line[x] = colour(x + shift, y);
        }
        out.format->store(buffer.pixels + (size_t)y * buffer.stride, 0, WIDTH, line);
    }
    return status < 0 ? status : linux_v4l2_out_ops.show(&out, &whole, 1);
}

/* BT.601 in double precision, limited range: Y, Cb, Cr. */
static void reference(uint32_t rgb, double yuv[3])
{
    double r = rgb >> 16 & 0xFF;
    double g = rgb >> 8 & 0xFF;
    double b = rgb & 0xFF;
    yuv[0] = 16 + (65.481 * r + 128.553 * g + 24.966 * b) / 255;
    yuv[1] = 128 + (-37.797 * r - 74.203 * g + 112.0 * b) / 255;
    yuv[2] = 128 + (112.0 * r - 93.786 * g - 18.214 * b) / 255;
}

static void assert_near(uint8_t value, double expected)
{
    if (value > expected + 1.6 || value < expected - 1.6) {
        fail_msg("%u is not near %.2f", value, expected);
    }
}

static void rgb_goes_out_as_it_is(void **state)
{
    (void)state;
    assert_int_equal(open_out(OW_VIDEO_XRGB8888), OW_OK);
    assert_int_equal(show(0), OW_OK);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            const uint8_t *at = fake.buffers[0] + (size_t)y * out.video.stride + (size_t)4 * x;
            assert_int_equal(at[0] | at[1] << 8 | at[2] << 16, colour(x, y));
        }
    }
    linux_v4l2_out_close(&out);
    assert_int_equal(open_out(OW_VIDEO_RGB565), OW_OK);
    assert_int_equal(show(0), OW_OK);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            const uint8_t *at = fake.buffers[0] + (size_t)y * out.video.stride + (size_t)2 * x;
            assert_int_equal(at[0] | at[1] << 8, ow_format_rgb565.pack(colour(x, y)));
        }
    }
    linux_v4l2_out_close(&out);
}

static void yuyv_is_bt601(void **state)
{
    double left[3];
    double right[3];
    (void)state;
    assert_int_equal(open_out(OW_VIDEO_YUYV), OW_OK);
    assert_int_equal(show(0), OW_OK);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        const uint8_t *at = fake.buffers[0] + (size_t)y * out.video.stride;
        for (uint32_t x = 0; x < WIDTH; x += 2, at += 4) {
            reference(colour(x, y), left);
            reference(colour(x + 1, y), right);
            assert_near(at[0], left[0]);
            assert_near(at[2], right[0]);
            assert_near(at[1], (left[1] + right[1]) / 2);
            assert_near(at[3], (left[2] + right[2]) / 2);
        }
    }
    linux_v4l2_out_close(&out);
}

static void nv12_is_bt601(void **state)
{
    (void)state;
    assert_int_equal(open_out(OW_VIDEO_NV12), OW_OK);
    assert_int_equal(show(0), OW_OK);
    const uint8_t *chroma = fake.buffers[0] + (size_t)HEIGHT * out.video.stride;
    for (uint32_t y = 0; y < HEIGHT; y += 2) {
        for (uint32_t x = 0; x < WIDTH; x += 2) {
            double sum[3] = { 0, 0, 0 };
            for (uint32_t i = 0; i < 4; i++) {
                double one[3];
                reference(colour(x + i % 2, y + i / 2), one);
                assert_near(fake.buffers[0][(y + i / 2) * out.video.stride + x + i % 2], one[0]);
                sum[1] += one[1];
                sum[2] += one[2];
            }
            assert_near(chroma[y / 2 * out.video.stride + x], sum[1] / 4);
            assert_near(chroma[y / 2 * out.video.stride + x + 1], sum[2] / 4);
        }
    }
    linux_v4l2_out_close(&out);
}

/* Back to RGB by the backdrop's integers, white stays white and black black. */
static void ends_of_the_range_are_exact(void **state)
{
    static const uint32_t ends[] = { 0x000000, 0xFFFFFF };
    static const uint8_t luma[] = { 16, 235 };
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct ow_panel_buffer buffer;
        assert_int_equal(open_out(OW_VIDEO_YUYV), OW_OK);
        assert_int_equal(linux_v4l2_out_ops.lend(&out, &buffer), OW_OK);
        for (uint32_t y = 0; y < HEIGHT; y++) {
            out.format->fill(buffer.pixels + (size_t)y * buffer.stride, 0, WIDTH, ends[i]);
        }
        assert_int_equal(linux_v4l2_out_ops.show(&out, &whole, 1), OW_OK);
        assert_int_equal(fake.buffers[0][0], luma[i]);
        assert_int_equal(fake.buffers[0][1], 128);
        assert_int_equal(fake.buffers[0][3], 128);
        linux_v4l2_out_close(&out);
    }
}

static void buffers_go_round(void **state)
{
    (void)state;
    assert_int_equal(open_out(0), OW_OK); /* GREY is offered first, and is not known here */
    assert_int_equal(out.video.pixels, OW_VIDEO_RGB565);
    for (uint32_t i = 0; i < 20; i++) {
        assert_int_equal(show(i), OW_OK);
        assert_true(fake.queued >= 1);
        uint32_t newest = fake.queue[fake.queued - 1];
        const uint8_t *at = fake.buffers[newest];
        assert_int_equal(at[0] | at[1] << 8, ow_format_rgb565.pack(colour(i, 0)));
    }
    assert_int_equal(linux_v4l2_out_finish(&out), OW_OK);
    assert_int_equal(fake.queued, 1);
    linux_v4l2_out_close(&out);
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

static void an_output_that_is_stuck_times_out(void **state)
{
    int status = OW_OK;
    (void)state;
    assert_int_equal(open_out(0), OW_OK);
    fake.video_is_stuck = true;
    for (int i = 0; i < 5 && status == OW_OK; i++) {
        status = show(0);
    }
    assert_int_equal(status, OW_TIMEOUT);
    assert_int_equal(out.video.fault.status, OW_TIMEOUT);
    linux_v4l2_out_close(&out);
}

static void devices_that_do_not_fit_are_refused(void **state)
{
    (void)state;
    fake.capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
    assert_int_equal(open_out(0), OW_UNSUPPORTED);
    fake_reset();
    fake.capabilities = V4L2_CAP_VIDEO_OUTPUT;
    assert_int_equal(open_out(0), OW_UNSUPPORTED);
    fake_reset();
    fake.offers[1] = 0;
    fake.format.pixelformat = V4L2_PIX_FMT_GREY;
    assert_int_equal(open_out(0), OW_UNSUPPORTED);
    fake_reset();
    fake.video_own_size = true;
    fake.format.width = 720;
    assert_int_equal(open_out(0), OW_UNSUPPORTED);
    assert_non_null(strstr(out.video.fault.why, "720x48, not 64x48"));
    fake_reset();
    const struct linux_v4l2_config odd = config("/dev/video1", 63, OW_VIDEO_YUYV);
    assert_int_equal(linux_v4l2_out_open(&out, &odd), OW_UNSUPPORTED);
    const struct linux_v4l2_config plain = config("/dev/null", 0, 0);
    assert_int_equal(linux_v4l2_out_open(&out, &plain), OW_UNSUPPORTED);
    assert_string_equal(out.video.fault.why, "this is no video device");
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

static int open_camera(void)
{
    const struct linux_v4l2_config c = config("/dev/video0", WIDTH, OW_VIDEO_RGB565);
    return linux_v4l2_camera_open(&camera, &c);
}

static void the_newest_picture_counts(void **state)
{
    struct ow_video_frame first;
    struct ow_video_frame second;
    struct ow_video_frame third;
    const struct ow_video_ops *ops = &linux_v4l2_camera_ops;
    (void)state;
    assert_int_equal(open_camera(), OW_OK);
    assert_int_equal(fake.queued, 4);
    assert_int_equal(ops->acquire(&camera, &first), OW_AGAIN);
    fake.taken = 2;
    assert_int_equal(ops->acquire(&camera, &first), OW_OK); /* two are full, one is dropped */
    assert_int_equal(first.planes[0][0], 2);
    assert_int_equal(fake.queued, 3);
    fake.taken = 1;
    assert_int_equal(ops->acquire(&camera, &second), OW_OK);
    assert_int_equal(second.planes[0][0], 3);
    assert_int_equal(first.planes[0][0], 2); /* it does not change until it is released */
    assert_int_equal(ops->acquire(&camera, &third), OW_CAPACITY);
    assert_int_equal(ops->release(&camera, first.number), OW_OK);
    assert_int_equal(ops->release(&camera, first.number), OW_ARGUMENT);
    assert_int_equal(ops->release(&camera, 99), OW_ARGUMENT);
    fake.taken = 1;
    assert_int_equal(ops->acquire(&camera, &third), OW_OK);
    linux_v4l2_camera_close(&camera);
    assert_int_equal(fake.open_fds + fake.mapped, 0);
}

static int out_life(void)
{
    int status = open_out(0);
    for (uint32_t i = 0; i < 6 && status == OW_OK; i++) {
        status = show(i);
    }
    linux_v4l2_out_close(&out);
    return status;
}

static int camera_life(void)
{
    struct ow_video_frame frame;
    int status = open_camera();
    for (uint32_t i = 0; i < 4 && status == OW_OK; i++) {
        fake.taken = 1 + i;
        status = linux_v4l2_camera_ops.acquire(&camera, &frame);
        if (status == OW_OK) {
            status = linux_v4l2_camera_ops.release(&camera, frame.number);
        }
    }
    linux_v4l2_camera_close(&camera);
    return status == OW_AGAIN ? OW_OK : status;
}

static void every_call_may_fail(void **state)
{
    static const int numbers[] = { EIO, ENODEV, EBUSY };
    (void)state;
    for (size_t e = 0; e < sizeof numbers / sizeof numbers[0]; e++) {
        for (int kind = 0; kind < 2; kind++) {
            uint32_t failed = 1;
            for (uint32_t n = 1; failed > 0; n++) {
                fake_reset();
                fake.fail_at = n;
                fake.fail_errno = numbers[e];
                int status = kind == 0 ? out_life() : camera_life();
                const struct linux_fault *fault =
                    kind == 0 ? &out.video.fault : &camera.video.fault;
                failed = fake.failed;
                assert_true(status == OW_OK || status == fault->status);
                assert_int_equal(fake.open_fds + fake.mapped, 0);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(rgb_goes_out_as_it_is, reset),
        cmocka_unit_test_setup(yuyv_is_bt601, reset),
        cmocka_unit_test_setup(nv12_is_bt601, reset),
        cmocka_unit_test_setup(ends_of_the_range_are_exact, reset),
        cmocka_unit_test_setup(buffers_go_round, reset),
        cmocka_unit_test_setup(an_output_that_is_stuck_times_out, reset),
        cmocka_unit_test_setup(devices_that_do_not_fit_are_refused, reset),
        cmocka_unit_test_setup(the_newest_picture_counts, reset),
        cmocka_unit_test_setup(every_call_may_fail, reset),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
