/* SPDX-License-Identifier: 0BSD */
/* Pictures: files there and back, palettes, sheets, differences, and owsim's file names. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gif_lib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "boards/sim/output.h"
#include "sim/image.h"

static uint32_t noise(uint32_t x, uint32_t y, uint32_t seed)
{
    uint32_t h = (x * 73856093u) ^ (y * 19349663u) ^ (seed * 83492791u);
    h ^= h >> 13;
    return h * 2654435761u >> 8;
}

static void make(struct image *image, uint32_t width, uint32_t height, uint32_t seed, uint32_t mask)
{
    struct image_error error = { "" };
    assert_true(image_make(image, width, height, &error));
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            image_set_pixel(image, x, y, noise(x, y, seed) & mask);
        }
    }
}

static void pictures_come_back_as_they_were_written(void **state)
{
    (void)state;
    for (uint32_t i = 0; image_format_at(i) != NULL; i++) {
        struct image written;
        struct image read;
        struct image_error error = { "" };
        FILE *file = tmpfile();
        make(&written, 37, 19, 1, 0xFFFFFF);
        assert_true(image_format_at(i)->write(file, &written, &error));
        rewind(file);
        assert_true(image_format_at(i)->read(file, &read, &error));
        assert_int_equal(read.width, 37);
        assert_int_equal(read.height, 19);
        assert_int_equal(image_count_differences(&written, &read), 0);
        image_free(&written);
        image_free(&read);
        fclose(file);
    }
}

static FILE *file_of(const void *bytes, size_t count)
{
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    rewind(file);
    return file;
}

static void broken_files_are_refused(void **state)
{
    static const char *const ppms[] = { "",
                                        "P5\n1 1\n255\nx",
                                        "P6\n0 1\n255\n",
                                        "P6\n1 1\n65535\nxxxxxx",
                                        "P6\n2 1\n255\nxxxxx",
                                        "P6\n99999999999 1\n255\n",
                                        "P6\nx 1\n255\nxxx",
                                        "P6\n1 1\n255" };
    (void)state;
    struct image image;
    struct image_error error = { "" };
    for (size_t i = 0; i < sizeof ppms / sizeof ppms[0]; i++) {
        FILE *file = file_of(ppms[i], strlen(ppms[i]));
        assert_false(image_ppm.read(file, &image, &error));
        assert_null(image.rgb);
        fclose(file);
    }
    /* A picture cut off anywhere, in every format. */
    for (uint32_t i = 0; image_format_at(i) != NULL; i++) {
        char bytes[8192];
        struct image written;
        FILE *file = tmpfile();
        make(&written, 9, 7, 3, 0xFFFFFF);
        assert_true(image_format_at(i)->write(file, &written, &error));
        rewind(file);
        size_t size = fread(bytes, 1, sizeof bytes, file);
        fclose(file);
        for (size_t cut = 0; cut < size - 20; cut++) {
            file = file_of(bytes, cut);
            assert_false(image_format_at(i)->read(file, &image, &error));
            assert_null(image.rgb);
            fclose(file);
        }
        image_free(&written);
    }
}

static void a_ppm_may_have_comments(void **state)
{
    static const char text[] = "P6 # by hand\n2 # wide\n# and\n1\n255\nabcdef";
    struct image image;
    struct image_error error = { "" };
    (void)state;
    FILE *file = file_of(text, strlen(text));
    assert_true(image_ppm.read(file, &image, &error));
    assert_int_equal(image_pixel(&image, 1, 0), 'd' << 16 | 'e' << 8 | 'f');
    image_free(&image);
    fclose(file);
}

static void few_colours_are_kept_exactly(void **state)
{
    struct image frames[2];
    struct palette palette;
    struct image_error error = { "" };
    (void)state;
    make(&frames[0], 40, 30, 1, 0xC0C0C0); /* 64 colours */
    make(&frames[1], 40, 30, 2, 0xE00000); /* 8 more, 4 of them known */
    assert_true(palette_make(&palette, frames, 2, &error));
    for (uint32_t f = 0; f < 2; f++) {
        for (uint32_t y = 0; y < 30; y++) {
            for (uint32_t x = 0; x < 40; x++) {
                uint32_t rgb = image_pixel(&frames[f], x, y);
                assert_int_equal(palette.rgb[palette_index(&palette, rgb)], rgb);
            }
        }
    }
    assert_int_equal(palette.count, 68);
    palette_free(&palette);
    image_free(&frames[0]);
    image_free(&frames[1]);
}

static void many_colours_become_at_most_255_near_ones(void **state)
{
    struct image frame;
    struct palette palette;
    struct image_error error = { "" };
    uint64_t squares = 0;
    (void)state;
    make(&frame, 200, 150, 5, 0xFFFFFF);
    assert_true(palette_make(&palette, &frame, 1, &error));
    assert_int_equal(palette.count, PALETTE_COLOURS);
    for (uint32_t y = 0; y < 150; y++) {
        for (uint32_t x = 0; x < 200; x++) {
            uint32_t rgb = image_pixel(&frame, x, y);
            uint32_t near = palette.rgb[palette_index(&palette, rgb)];
            for (uint32_t shift = 0; shift <= 16; shift += 8) {
                int difference = (int)(rgb >> shift & 255) - (int)(near >> shift & 255);
                squares += (uint64_t)(difference * difference);
            }
        }
    }
    /* An even cube of 255 colours would be off by 12 in the mean of each channel. */
    assert_true(squares < UINT64_C(200) * 150 * 3 * 16 * 16);
    palette_free(&palette);
    image_free(&frame);
}

static size_t gif_bytes(char *bytes, size_t room, const struct image *frames, uint32_t count)
{
    struct image_error error = { "" };
    FILE *file = tmpfile();
    assert_true(image_write_gif(file, frames, count, 5, &error));
    rewind(file);
    size_t size = fread(bytes, 1, room, file);
    fclose(file);
    return size;
}

static int take_bytes(GifFileType *gif, GifByteType *bytes, int count)
{
    return (int)fread(bytes, 1, (size_t)count, gif->UserData);
}

/* Lays one frame of a GIF over the picture so far. */
static void lay_over(struct image *canvas, GifFileType *gif, int number)
{
    GraphicsControlBlock control;
    const SavedImage *saved = &gif->SavedImages[number];
    const GifImageDesc *place = &saved->ImageDesc;
    assert_int_equal(DGifSavedExtensionToGCB(gif, number, &control), GIF_OK);
    assert_int_equal(control.DelayTime, 5);
    for (int y = 0; y < place->Height; y++) {
        for (int x = 0; x < place->Width; x++) {
            int index = saved->RasterBits[y * place->Width + x];
            if (index != control.TransparentColor) {
                GifColorType c = gif->SColorMap->Colors[index];
                image_set_pixel(canvas, (uint32_t)(place->Left + x), (uint32_t)(place->Top + y),
                                (uint32_t)c.Red << 16 | (uint32_t)c.Green << 8 | c.Blue);
            }
        }
    }
}

static void a_gif_shows_its_frames(void **state)
{
    struct image frames[4];
    struct image canvas;
    struct image_error error = { "" };
    int code = 0;
    (void)state;
    if (!image_has_gif()) {
        skip();
    }
    for (uint32_t i = 0; i < 4; i++) { /* 64 colours, and a corner that stays */
        make(&frames[i], 50, 40, i, 0xC0C0C0);
        for (uint32_t y = 20; y < 40; y++) {
            for (uint32_t x = 0; x < 30; x++) {
                image_set_pixel(&frames[i], x, y, 0x408000);
            }
        }
    }
    FILE *file = tmpfile();
    assert_true(image_write_gif(file, frames, 4, 5, &error));
    rewind(file);
    GifFileType *gif = DGifOpen(file, take_bytes, &code);
    assert_non_null(gif);
    assert_int_equal(DGifSlurp(gif), GIF_OK);
    assert_int_equal(gif->ImageCount, 4);
    assert_int_equal(gif->SWidth, 50);
    assert_true(image_make(&canvas, 50, 40, &error));
    for (int i = 0; i < 4; i++) {
        lay_over(&canvas, gif, i);
        assert_int_equal(image_count_differences(&canvas, &frames[i]), 0);
        image_free(&frames[i]);
    }
    image_free(&canvas);
    DGifCloseFile(gif, &code);
    fclose(file);
}

static void a_gif_is_the_same_each_time(void **state)
{
    static char first[1 << 17];
    static char second[1 << 17];
    struct image frames[3];
    struct image_error error = { "" };
    (void)state;
    if (!image_has_gif()) {
        skip();
    }
    make(&frames[0], 50, 40, 1, 0xF0F0F0);
    assert_true(image_copy(&frames[1], &frames[0], &error)); /* nothing changes */
    assert_true(image_copy(&frames[2], &frames[0], &error));
    image_set_pixel(&frames[2], 49, 39, 0xFFFFFF);
    size_t size = gif_bytes(first, sizeof first, frames, 3);
    assert_int_equal(gif_bytes(second, sizeof second, frames, 3), size);
    assert_memory_equal(first, second, size);
    assert_memory_equal(first, "GIF89a", 6);
    size_t alone = gif_bytes(second, sizeof second, frames, 1);
    assert_true(size < alone + 200); /* the other two hold one pixel each */
    frames[1].width--;
    assert_false(image_write_gif(stdout, frames, 2, 5, &error));
    assert_false(image_write_gif(stdout, frames, 0, 5, &error));
    for (int i = 0; i < 3; i++) {
        image_free(&frames[i]);
    }
}

static void a_sheet_has_each_frame_in_its_place(void **state)
{
    struct image frames[5];
    struct image sheet;
    struct image_error error = { "" };
    (void)state;
    for (uint32_t i = 0; i < 5; i++) {
        make(&frames[i], 10, 6, i, 0xFFFFFF);
    }
    assert_true(image_sheet(&sheet, frames, 5, 3, &error));
    assert_int_equal(sheet.width, 3 * 14 + 4);
    assert_int_equal(sheet.height, 2 * 10 + 4);
    for (uint32_t i = 0; i < 5; i++) {
        for (uint32_t y = 0; y < 6; y++) {
            for (uint32_t x = 0; x < 10; x++) {
                assert_int_equal(image_pixel(&sheet, 4 + i % 3 * 14 + x, 4 + i / 3 * 10 + y),
                                 image_pixel(&frames[i], x, y));
            }
        }
    }
    image_free(&sheet);
    assert_true(image_sheet(&sheet, frames, 5, 0, &error)); /* three columns by itself */
    assert_int_equal(sheet.width, 3 * 14 + 4);
    image_free(&sheet);
    assert_false(image_sheet(&sheet, frames, 0, 0, &error));
    for (uint32_t i = 0; i < 5; i++) {
        image_free(&frames[i]);
    }
}

static void a_wide_sheet_is_reduced_by_means(void **state)
{
    struct image frames[4];
    struct image sheet;
    struct image_error error = { "" };
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        make(&frames[i], 1000, 3, i, 0);
        image_set_pixel(&frames[i], 0, 0, 0x102030);
        image_set_pixel(&frames[i], 1, 1, 0x306090);
    }
    assert_true(image_sheet(&sheet, frames, 4, 4, &error));
    assert_int_equal(sheet.width, 4 * 504 + 4);
    assert_int_equal(sheet.height, 2 + 8);
    assert_int_equal(image_pixel(&sheet, 4, 4), 0x102030);
    image_free(&sheet);
    for (uint32_t i = 0; i < 4; i++) {
        image_free(&frames[i]);
    }
}

static void differences_are_counted_and_shown(void **state)
{
    struct image a;
    struct image b;
    struct image picture;
    struct image_error error = { "" };
    (void)state;
    make(&a, 12, 9, 1, 0xFFFFFF);
    assert_true(image_copy(&b, &a, &error));
    assert_int_equal(image_count_differences(&a, &b), 0);
    image_set_pixel(&b, 0, 0, image_pixel(&a, 0, 0) ^ 1);
    image_set_pixel(&b, 11, 8, image_pixel(&a, 11, 8) ^ 0x800000);
    assert_int_equal(image_count_differences(&a, &b), 2);
    assert_true(image_difference(&picture, &a, &b, &error));
    for (uint32_t y = 0; y < 9; y++) {
        for (uint32_t x = 0; x < 12; x++) {
            bool differs = (x == 0 && y == 0) || (x == 11 && y == 8);
            assert_int_equal(image_pixel(&picture, x, y) == 0xFF0000, differs);
        }
    }
    image_free(&picture);
    image_free(&b);
    make(&b, 5, 20, 1, 0xFFFFFF);
    assert_int_equal(image_count_differences(&a, &b), 12 * 20);
    assert_true(image_difference(&picture, &a, &b, &error));
    assert_int_equal(picture.width, 12);
    assert_int_equal(picture.height, 20);
    assert_int_equal(image_pixel(&picture, 11, 19), 0xFF0000);
    image_free(&picture);
    image_free(&a);
    image_free(&b);
}

static void names_choose_the_format(void **state)
{
    struct image_error error = { "" };
    (void)state;
    assert_string_equal(image_format_of("a.b/c.ppm", &error)->name, "PPM");
    assert_null(image_format_of("a.ppm/c", &error));
    assert_null(image_format_of("c.jpg", &error));
    assert_null(image_format_of("ppm", &error));
    if (image_has_gif()) {
        assert_string_equal(image_format_of("out-%04d.png", &error)->name, "PNG");
    }
}

/* ---- owsim's file names ---- */

static void a_pattern_numbers_the_frames(void **state)
{
    static const struct {
        const char *pattern;
        uint32_t frame;
        const char *name;
    } cases[] = {
        { "out-%04d.ppm", 7, "out-0007.ppm" },
        { "out-%04d.ppm", 12345, "out-12345.ppm" },
        { "%d", 0, "0" },
        { "a%db", 42, "a42b" },
        { "%%%03d%%.ppm", 5, "%005%.ppm" },
        { "plain.ppm", 9, "plain.ppm" },
        { "%09d", 1, "000000001" },
        { "%%d.ppm", 3, "%d.ppm" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pattern pattern;
        struct image_error error = { "" };
        char name[64];
        assert_true(pattern_read(&pattern, cases[i].pattern, &error));
        assert_true(pattern_name(&pattern, cases[i].frame, name, sizeof name));
        assert_string_equal(name, cases[i].name);
        assert_false(pattern_name(&pattern, cases[i].frame, name, strlen(cases[i].name)));
    }
}

static void a_pattern_that_is_no_number_is_refused(void **state)
{
    static const char *const cases[] = { "%s",    "%n",   "%",     "a%",   "%x.ppm", "%5d",
                                         "%-4d",  "%00d", "%010d", "%0d",  "%ld",    "%d%d",
                                         "%d-%s", "%0",   "%04",   "%1$d", "% d",    "%+d" };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pattern pattern;
        struct image_error error = { "" };
        if (pattern_read(&pattern, cases[i], &error)) {
            fail_msg("'%s' is taken", cases[i]);
        }
    }
    char *longest = malloc(PATTERN_BYTES + 1);
    struct pattern pattern;
    struct image_error error = { "" };
    memset(longest, 'a', PATTERN_BYTES);
    longest[PATTERN_BYTES] = '\0';
    assert_false(pattern_read(&pattern, longest, &error));
    longest[PATTERN_BYTES - 1] = '\0';
    assert_true(pattern_read(&pattern, longest, &error));
    free(longest);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_come_back_as_they_were_written),
        cmocka_unit_test(broken_files_are_refused),
        cmocka_unit_test(a_ppm_may_have_comments),
        cmocka_unit_test(few_colours_are_kept_exactly),
        cmocka_unit_test(many_colours_become_at_most_255_near_ones),
        cmocka_unit_test(a_gif_shows_its_frames),
        cmocka_unit_test(a_gif_is_the_same_each_time),
        cmocka_unit_test(a_sheet_has_each_frame_in_its_place),
        cmocka_unit_test(a_wide_sheet_is_reduced_by_means),
        cmocka_unit_test(differences_are_counted_and_shown),
        cmocka_unit_test(names_choose_the_format),
        cmocka_unit_test(a_pattern_numbers_the_frames),
        cmocka_unit_test(a_pattern_that_is_no_number_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
