/* SPDX-License-Identifier: 0BSD */
/* The simulator's panel: what it shows, how old its buffers are, and what it refuses. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <string.h>

#include "ow_tree.h"
#include "sim/sim_panel.h"

enum { WIDTH = 8, HEIGHT = 4 };

static void open_panel(struct sim_panel *panel, struct sim_panel_config config)
{
    config.width = WIDTH;
    config.height = HEIGHT;
    config.format = config.format == NULL ? &ow_format_rgb565 : config.format;
    assert_true(sim_panel_open(panel, &config));
}

static uint32_t seen(const struct sim_panel *panel, uint32_t x, uint32_t y)
{
    return panel->config.format->get(panel->screen + y * panel->row_bytes, x);
}

static void a_written_rectangle_is_seen_where_it_belongs(void **state)
{
    struct sim_panel panel;
    uint32_t pixels[2 * 4]; /* two lines of 16 bytes, three pixels used */
    struct ow_panel_rect rect = { 2, 1, 3, 2 };
    (void)state;
    open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_TAKES });
    const struct ow_panel_ops *ops = panel.panel.ops;
    for (uint32_t y = 0; y < 2; y++) {
        for (uint32_t x = 0; x < 8; x++) {
            panel.config.format->fill((uint8_t *)(pixels + 4 * y), x, x + 1, 100 * y + x);
        }
    }
    uint32_t outside = seen(&panel, 1, 1);
    assert_int_equal(ops->write(&panel, &rect, pixels, 16, false), OW_OK);
    assert_int_equal(panel.frames, 0);
    assert_int_equal(seen(&panel, 2, 1), 0);
    assert_int_equal(seen(&panel, 4, 1), 2);
    assert_int_equal(seen(&panel, 2, 2), 100);
    assert_int_equal(seen(&panel, 4, 2), 102);
    assert_int_equal(seen(&panel, 1, 1), outside);
    assert_int_equal(seen(&panel, 5, 2), outside);
    assert_int_equal(seen(&panel, 2, 3), outside);
    assert_int_equal(ops->write(&panel, &rect, pixels, 16, true), OW_OK);
    assert_int_equal(panel.frames, 1);
    assert_null(panel.wrong);
    sim_panel_close(&panel);
}

static void only_changed_rectangles_are_shown(void **state)
{
    struct sim_panel panel;
    struct ow_panel_buffer buffer;
    const struct ow_panel_rect rects[] = { { 0, 0, 2, 2 }, { 7, 3, 1, 1 } };
    (void)state;
    open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_LENDS });
    assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        panel.config.format->fill(buffer.pixels + y * buffer.stride, 0, WIDTH, 7);
    }
    uint32_t before = seen(&panel, 3, 0);
    assert_int_equal(panel.panel.ops->show(&panel, rects, 2), OW_OK);
    assert_int_equal(seen(&panel, 1, 1), 7);
    assert_int_equal(seen(&panel, 7, 3), 7);
    assert_int_equal(seen(&panel, 2, 1), before);
    assert_int_equal(seen(&panel, 6, 3), before);
    sim_panel_close(&panel);
}

static void buffers_say_how_old_their_content_is(void **state)
{
    (void)state;
    for (uint32_t buffers = 1; buffers <= SIM_PANEL_BUFFERS; buffers++) {
        struct sim_panel panel;
        struct ow_panel_buffer buffer;
        const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
        open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_LENDS,
                                                      .buffers = (uint16_t)buffers });
        for (uint32_t frame = 0; frame < 7; frame++) {
            assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
            assert_int_equal(buffer.age, frame < buffers ? 0 : buffers);
            if (buffer.age != 0) { /* and it really is that frame */
                assert_int_equal(panel.config.format->get(buffer.pixels, 3), frame - buffers);
            }
            panel.config.format->fill(buffer.pixels, 0, WIDTH, frame);
            assert_int_equal(panel.panel.ops->show(&panel, &whole, 1), OW_OK);
        }
        assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
        assert_int_equal(panel.panel.ops->show(&panel, NULL, 0), OW_OK); /* drawing failed */
        assert_int_equal(panel.frames, 7);
        assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
        assert_int_equal(buffer.age, 0);
        sim_panel_close(&panel);
    }
}

static void a_slow_write_reads_the_pixels_late(void **state)
{
    struct sim_panel panel;
    uint32_t pixels[WIDTH * HEIGHT / 2] = { 0 };
    const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
    (void)state;
    open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_TAKES, .delay = 2 });
    assert_int_equal(panel.panel.ops->write(&panel, &whole, pixels, 16, true), OW_OK);
    memset(pixels, 0xFF, sizeof pixels); /* what a careless user does */
    assert_int_equal(panel.panel.ops->done(&panel, 1), OW_OK);
    assert_int_equal(panel.frames, 0);
    assert_int_equal(panel.panel.ops->done(&panel, 0), OW_AGAIN);
    assert_int_equal(panel.panel.ops->done(&panel, 0), OW_OK);
    assert_int_equal(panel.frames, 1);
    assert_int_equal(seen(&panel, 0, 0), 0xFFFF);
    sim_panel_close(&panel);
}

static void misuse_is_noticed(void **state)
{
    static const struct ow_panel_rect bad[] = {
        { 0, 0, 0, 1 }, { 0, 0, 1, 0 }, { 0, 0, WIDTH + 1, 1 }, { 7, 0, 2, 1 },
        { 0, 4, 1, 1 }, { 1, 0, 2, 2 }, { 0, 0, 3, 2 },         { 0, 1, 2, 1 },
    };
    struct sim_panel panel;
    struct ow_panel_buffer buffer;
    uint32_t pixels[WIDTH * HEIGHT] = { 0 };
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        open_panel(&panel,
                   (struct sim_panel_config){ .kind = SIM_PANEL_BOTH, .align_x = 2, .align_y = 2 });
        assert_int_equal(panel.panel.ops->write(&panel, &bad[i], pixels, 16, true), OW_ARGUMENT);
        assert_non_null(panel.wrong);
        sim_panel_close(&panel);
    }
    const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
    open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_BOTH });
    const struct ow_panel_ops *ops = panel.panel.ops;
    assert_int_equal(ops->show(&panel, &whole, 1), OW_ARGUMENT);
    assert_int_equal(ops->lend(&panel, &buffer), OW_OK);
    assert_int_equal(ops->lend(&panel, &buffer), OW_ARGUMENT);
    assert_int_equal(ops->write(&panel, &whole, (uint8_t *)pixels + 2, 16, true), OW_ARGUMENT);
    assert_int_equal(ops->write(&panel, &whole, pixels, 18, true), OW_ARGUMENT);
    sim_panel_close(&panel);
}

static void the_checksum_is_of_packed_rows_without_spare_bits(void **state)
{
    struct sim_panel panel;
    uint8_t pixels[WIDTH * HEIGHT * 4];
    const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
    (void)state;
    open_panel(&panel,
               (struct sim_panel_config){ .kind = SIM_PANEL_TAKES, .format = &ow_format_xrgb8888 });
    for (size_t i = 0; i < sizeof pixels; i++) {
        pixels[i] = (uint8_t)(i * 37);
    }
    uint32_t aligned[WIDTH * HEIGHT];
    memcpy(aligned, pixels, sizeof aligned);
    assert_int_equal(panel.panel.ops->write(&panel, &whole, aligned, 4 * WIDTH, true), OW_OK);
    for (size_t i = 3; i < sizeof pixels; i += 4) {
        pixels[i] = 0;
    }
    assert_int_equal(sim_panel_crc(&panel, 5), ow_crc32(5, pixels, sizeof pixels));
    sim_panel_close(&panel);
}

static void the_picture_has_the_formats_colours(void **state)
{
    struct sim_panel panel;
    struct image image;
    struct image_error error;
    struct ow_panel_buffer buffer;
    const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
    (void)state;
    open_panel(&panel, (struct sim_panel_config){ .kind = SIM_PANEL_LENDS });
    const struct ow_pixel_format *format = panel.config.format;
    assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        format->fill(buffer.pixels + y * buffer.stride, 0, WIDTH, format->pack(0xFF0000));
        format->fill(buffer.pixels + y * buffer.stride, y, y + 1, format->pack(0x00FF00));
    }
    assert_int_equal(panel.panel.ops->show(&panel, &whole, 1), OW_OK);
    assert_true(sim_panel_image(&panel, &image, &error));
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            assert_int_equal(image_pixel(&image, x, y), x == y ? 0x00FF00 : 0xFF0000);
        }
    }
    image_free(&image);
    sim_panel_close(&panel);
}

static int refuse_frame(void *context, const struct sim_panel *panel)
{
    (void)panel;
    ++*(int *)context;
    return OW_FULL;
}

static void the_frame_callback_is_asked_once_a_frame(void **state)
{
    struct sim_panel panel;
    struct ow_panel_buffer buffer;
    int calls = 0;
    const struct ow_panel_rect whole = { 0, 0, WIDTH, HEIGHT };
    (void)state;
    open_panel(&panel, (struct sim_panel_config){
                           .kind = SIM_PANEL_LENDS, .frame = refuse_frame, .context = &calls });
    assert_int_equal(panel.panel.ops->lend(&panel, &buffer), OW_OK);
    assert_int_equal(panel.panel.ops->show(&panel, &whole, 1), OW_FULL);
    assert_int_equal(calls, 1);
    sim_panel_close(&panel);
}

static void sizes_out_of_range_are_refused(void **state)
{
    struct sim_panel panel;
    (void)state;
    struct sim_panel_config config = { .format = &ow_format_rgb565, .height = 1 };
    assert_false(sim_panel_open(&panel, &config));
    config.width = OW_PANEL_SIZE_MAX + 1;
    assert_false(sim_panel_open(&panel, &config));
    config.width = 1;
    config.buffers = SIM_PANEL_BUFFERS + 1;
    assert_false(sim_panel_open(&panel, &config));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_written_rectangle_is_seen_where_it_belongs),
        cmocka_unit_test(only_changed_rectangles_are_shown),
        cmocka_unit_test(buffers_say_how_old_their_content_is),
        cmocka_unit_test(a_slow_write_reads_the_pixels_late),
        cmocka_unit_test(misuse_is_noticed),
        cmocka_unit_test(the_checksum_is_of_packed_rows_without_spare_bits),
        cmocka_unit_test(the_picture_has_the_formats_colours),
        cmocka_unit_test(the_frame_callback_is_asked_once_a_frame),
        cmocka_unit_test(sizes_out_of_range_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
