/* SPDX-License-Identifier: 0BSD */
/* What changed between two frames in one buffer, the rectangles made of it, and backdrops. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "random_scene.h"

enum { WIDTH = 131, HEIGHT = 70, FACES = 40, PRICE = 8 };

static uint16_t before[HEIGHT][WIDTH + 1];
static uint16_t pixels[HEIGHT][WIDTH + 1];
static uint32_t memory[2048];
static const struct ow_change_costs costs = { PRICE * 16, 16, 1, 1 };

static enum ow_status draw(struct random_scene *scene, const struct ow_view *view,
                           const struct ow_look *look, struct ow_changes *changes, uint32_t lines)
{
    const struct ow_workspace_config config = { .parts = &ow_parts_all,
                                                .width = WIDTH,
                                                .lines = HEIGHT,
                                                .listed_faces = FACES,
                                                .height = HEIGHT };
    random_scene_place(scene, &config);
    enum ow_status status = ow_draw_begin(&scene->tree, view, look, &scene->workspace);
    for (uint32_t line = 0; line < HEIGHT && status == OW_OK; line += lines) {
        struct ow_target target = {
            .pixels = (uint8_t *)pixels[line],
            .stride = sizeof pixels[0],
            .first_line = (uint16_t)line,
            .line_count = (uint16_t)(HEIGHT - line < lines ? HEIGHT - line : lines),
            .format = &ow_format_rgb565,
            .changes = changes,
        };
        status = ow_draw_band(&scene->workspace, &target, NULL);
    }
    return status;
}

static bool is_marked(const struct ow_changes *changes, uint32_t x, uint32_t y)
{
    return changes->bits[y * changes->words_in_line + x / 32] >> (x % 32) & 1;
}

/* The rectangles hold every marked pixel; returns what sending them costs, in pixels. */
static uint32_t check_rectangles(struct ow_changes *changes)
{
    static bool marked[HEIGHT][WIDTH];
    static bool held[HEIGHT][WIDTH];
    uint32_t cost = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            marked[y][x] = is_marked(changes, x, y);
            held[y][x] = false;
        }
    }
    uint32_t count = ow_changes_list(changes, &costs);
    uint32_t top = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct ow_change c = changes->list[i];
        assert_true(c.left < c.right && c.right <= WIDTH && c.top < c.bottom && c.bottom <= HEIGHT);
        assert_true(c.top >= top);
        top = c.top;
        cost += (uint32_t)(c.right - c.left) * (uint32_t)(c.bottom - c.top) + PRICE;
        for (uint32_t y = c.top; y < c.bottom; y++) {
            for (uint32_t x = c.left; x < c.right; x++) {
                held[y][x] = true;
            }
        }
    }
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            assert_true(held[y][x] || !marked[y][x]);
        }
    }
    return cost;
}

/* One rectangle for each run of a line. */
static uint32_t cost_of_runs(const struct ow_changes *changes)
{
    uint32_t cost = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++) {
            bool begins = is_marked(changes, x, y) && (x == 0 || !is_marked(changes, x - 1, y));
            cost += is_marked(changes, x, y) + (begins ? PRICE : 0u);
        }
    }
    return cost;
}

static void marks_are_the_differences(void **state)
{
    (void)state;
    static const enum ow_shade shades[] = { OW_SHADE_FLAT, OW_SHADE_PHONG };
    struct random_scene scene;
    struct ow_changes changes;
    random_scene_make(&scene, FACES, true);
    assert_true(ow_changes_bytes_needed(WIDTH, HEIGHT) <= sizeof memory);
    ow_changes_place(&changes, WIDTH, HEIGHT, memory);
    for (uint32_t i = 0; i < 48; i++) {
        struct ow_look look = random_scene_look(shades[i % 2]);
        look.order = i % 3 ? OW_FRONT_TO_BACK : OW_SCAN_LINE;
        look.dither = i % 5 == 0;
        struct ow_view view = random_scene_view(&scene, i / 2, WIDTH, HEIGHT);
        ow_changes_begin(&changes, i > 0); /* each frame is drawn over the last one */
        memcpy(before, pixels, sizeof before);
        assert_int_equal(draw(&scene, &view, &look, &changes, i % 4 ? HEIGHT : 9), OW_OK);
        for (uint32_t y = 0; y < HEIGHT; y++) {
            for (uint32_t x = 0; x < WIDTH; x++) {
                bool differs = before[y][x] != pixels[y][x];
                assert_int_equal(is_marked(&changes, x, y), i == 0 || differs);
            }
        }
        uint32_t apart = cost_of_runs(&changes);
        assert_true(check_rectangles(&changes) <= apart);
    }
    random_scene_free(&scene);
}

static void nothing_changed_is_nothing_to_send(void **state)
{
    (void)state;
    struct random_scene scene;
    struct ow_changes changes;
    struct ow_change change;
    random_scene_make(&scene, FACES, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_FLAT);
    look.order = OW_FRONT_TO_BACK;
    ow_changes_place(&changes, WIDTH, HEIGHT, memory);
    assert_int_equal(draw(&scene, &view, &look, &changes, HEIGHT), OW_OK);
    assert_int_equal(ow_changes_list(&changes, &costs), 1); /* the first frame: all at once */
    change = changes.list[0];
    assert_int_equal(change.bottom - change.top, HEIGHT);
    assert_int_equal(change.right - change.left, WIDTH);
    ow_changes_begin(&changes, true);
    assert_int_equal(draw(&scene, &view, &look, &changes, HEIGHT), OW_OK);
    assert_int_equal(ow_changes_list(&changes, &costs), 0);
    /* Back to front writes pixels more than once and cannot tell. */
    look.order = OW_BACK_TO_FRONT;
    assert_int_equal(draw(&scene, &view, &look, &changes, HEIGHT), OW_OK);
    assert_true(ow_changes_list(&changes, &costs) > 0);
    changes.width--;
    assert_int_equal(draw(&scene, &view, &look, &changes, HEIGHT), OW_ARGUMENT);
    random_scene_free(&scene);
}

/* Blots, slanted edges and noise: what all rectangles together must be. */
static void scatter(struct ow_changes *changes, uint32_t kind)
{
    uint32_t count = kind == 2 ? WIDTH * HEIGHT / 5 : 1 + random_below(12);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t x = random_below(WIDTH);
        uint32_t y = random_below(HEIGHT);
        uint32_t width = kind == 2 ? 1 : 1 + random_below(kind == 1 ? 4 : 40);
        uint32_t height = kind == 2 ? 1 : 1 + random_below(30);
        for (uint32_t k = 0; k < height && y + k < HEIGHT; k++) {
            uint32_t first = kind == 1 ? (x + k) % WIDTH : x;
            uint32_t end = first + width < WIDTH ? first + width : WIDTH;
            ow_changes_mark(changes, y + k, first, end);
        }
    }
}

static void rectangles_hold_every_mark_and_cost_no_more_than_runs(void **state)
{
    struct ow_changes changes;
    (void)state;
    ow_changes_place(&changes, WIDTH, HEIGHT, memory);
    uint32_t sum = 0;
    uint32_t sum_apart = 0;
    for (uint32_t i = 0; i < 300; i++) {
        ow_changes_begin(&changes, true);
        scatter(&changes, i % 3);
        uint32_t apart = cost_of_runs(&changes);
        uint32_t cost = check_rectangles(&changes);
        assert_true(cost <= apart || changes.listed == changes.listed_max);
        sum += cost;
        sum_apart += apart;
    }
    print_message("# %u of %u\n", (unsigned)sum, (unsigned)sum_apart);
    assert_true(sum < sum_apart / 5 * 4);
}

/* Where a line has more runs, or the frame more rectangles, than there is room for. */
static void what_does_not_fit_is_joined(void **state)
{
    struct ow_changes changes;
    (void)state;
    ow_changes_place(&changes, WIDTH, HEIGHT, memory);
    const struct ow_change_costs nothing = { 0, 16, 1, 1 }; /* nothing is joined by itself */
    ow_changes_begin(&changes, true);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = y % 2; x < WIDTH; x += 2) {
            ow_changes_mark(&changes, y, x, x + 1);
        }
    }
    uint32_t count = ow_changes_list(&changes, &nothing);
    assert_true(count <= changes.listed_max);
    assert_int_equal(changes.list[0].right - changes.list[0].left, 1);
    assert_int_equal(changes.list[changes.runs_max - 1].right, WIDTH); /* its line's others */
    struct ow_change last = changes.list[count - 1];
    assert_true(last.left <= 1 && last.right == WIDTH && last.bottom == HEIGHT);
    assert_int_equal(last.top, changes.list[count - 2].bottom);
}

static void rectangles_keep_to_the_alignment(void **state)
{
    static const uint16_t aligns[][2] = { { 2, 1 }, { 4, 1 }, { 8, 8 }, { 8, 1 }, { 1, 8 } };
    struct ow_changes changes;
    (void)state;
    ow_changes_place(&changes, WIDTH, HEIGHT, memory);
    for (uint32_t i = 0; i < 100; i++) {
        const struct ow_change_costs aligned = { 48, 1 + i % 4, aligns[i % 5][0],
                                                 aligns[i % 5][1] };
        static bool held[HEIGHT][WIDTH];
        static uint32_t marks[HEIGHT * ((WIDTH + 31) / 32)];
        ow_changes_begin(&changes, true);
        scatter(&changes, i % 2);
        memcpy(marks, changes.bits, sizeof marks);
        memset(held, 0, sizeof held);
        uint32_t count = ow_changes_list(&changes, &aligned);
        for (uint32_t k = 0; k < count; k++) {
            struct ow_change c = changes.list[k];
            assert_true(c.left % aligned.align_x == 0 && c.top % aligned.align_y == 0);
            assert_true(c.right % aligned.align_x == 0 || c.right == WIDTH);
            assert_true(c.bottom % aligned.align_y == 0 || c.bottom == HEIGHT);
            for (uint32_t y = c.top; y < c.bottom; y++) {
                memset(held[y] + c.left, 1, (size_t)(c.right - c.left));
            }
        }
        memcpy(changes.bits, marks, sizeof marks);
        for (uint32_t y = 0; y < HEIGHT; y++) {
            for (uint32_t x = 0; x < WIDTH; x++) {
                assert_true(held[y][x] || !is_marked(&changes, x, y));
            }
        }
    }
}

struct canvas {
    uint8_t asked[HEIGHT][WIDTH];
};

static void fill_canvas(void *context, const struct ow_pixel_format *format, uint8_t *row,
                        uint32_t line, uint32_t first, uint32_t end)
{
    struct canvas *canvas = context;
    for (uint32_t x = first; x < end; x++) {
        uint32_t rgb = (x * 8 & 255) << 16 | (line * 4 & 255);
        canvas->asked[line][x]++;
        format->store(row, x, x + 1, &rgb);
    }
}

/* Front to back asks the backdrop for the unlit pixels only, and for each of them once. */
static void a_backdrop_fills_what_is_unlit(void **state)
{
    (void)state;
    static struct canvas canvas;
    static struct canvas ignored;
    struct random_scene scene;
    random_scene_make(&scene, FACES, false);
    struct ow_view view = random_scene_view(&scene, 0, WIDTH, HEIGHT);
    struct ow_look look = random_scene_look(OW_SHADE_FLAT);
    const struct ow_backdrop full = { fill_canvas, &ignored };
    const struct ow_backdrop exact = { fill_canvas, &canvas };
    look.order = OW_BACK_TO_FRONT;
    look.backdrop = &full;
    assert_int_equal(draw(&scene, &view, &look, NULL, HEIGHT), OW_OK);
    memcpy(before, pixels, sizeof before);
    look.order = OW_FRONT_TO_BACK;
    look.backdrop = &exact;
    assert_int_equal(draw(&scene, &view, &look, NULL, 11), OW_OK);
    uint32_t asked = 0;
    for (uint32_t y = 0; y < HEIGHT; y++) {
        assert_memory_equal(before[y], pixels[y], WIDTH * sizeof(uint16_t));
        for (uint32_t x = 0; x < WIDTH; x++) {
            assert_true(canvas.asked[y][x] <= 1);
            asked += canvas.asked[y][x];
        }
    }
    assert_true(asked > 0 && asked < WIDTH * HEIGHT);
    look.coverage = true;
    assert_int_equal(draw(&scene, &view, &look, NULL, HEIGHT), OW_ARGUMENT);
    random_scene_free(&scene);
}

static void a_gradient_goes_from_top_to_bottom(void **state)
{
    (void)state;
    struct ow_gradient_backdrop gradient = { 0xFF0000, 0x0000FF, HEIGHT, false };
    struct ow_backdrop backdrop = ow_backdrop_of_gradient(&gradient);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        backdrop.fill(backdrop.context, &ow_format_rgb565, (uint8_t *)pixels[y], y, 0, WIDTH);
    }
    assert_int_equal(pixels[0][0], 0xF800);
    assert_int_equal(pixels[HEIGHT - 1][WIDTH - 1], 0x001F);
    assert_true(pixels[HEIGHT / 2][5] != pixels[0][5] && pixels[HEIGHT / 2][5] != pixels[9][5]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_are_the_differences),
        cmocka_unit_test(nothing_changed_is_nothing_to_send),
        cmocka_unit_test(rectangles_hold_every_mark_and_cost_no_more_than_runs),
        cmocka_unit_test(what_does_not_fit_is_joined),
        cmocka_unit_test(rectangles_keep_to_the_alignment),
        cmocka_unit_test(a_backdrop_fills_what_is_unlit),
        cmocka_unit_test(a_gradient_goes_from_top_to_bottom),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
