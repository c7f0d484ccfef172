/* SPDX-License-Identifier: 0BSD */
/*
 * The validator: no truncation, no flipped bit and no wrong byte gets past it;
 * what a liar with the right checksum writes is refused, or is harmless to walk
 * and draw. Run it under the sanitizers too: all memory is of exact size.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ow_blob.h"
#include "ow_tree.h"
#include "tests/property/blob_builder.h"
#include "tests/property/blob_exercise.h"

#define HEAD(name) ((uint32_t)offsetof(struct ow_disk_header, name))

static const uint32_t flag_sets[] = { 0, OW_TREE_IDS, OW_TREE_INDEX32 | OW_TREE_IDS,
                                      OW_TREE_NORMALS | OW_TREE_CLOSED };
enum { FLAG_SETS = sizeof flag_sets / sizeof *flag_sets };

/* A copy whose block is as large as size says, so that reading on is seen. */
static uint8_t *copy_of(const uint8_t *bytes, uint32_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    return copy;
}

static enum ow_status open_bytes(const uint8_t *bytes, uint32_t size)
{
    struct ow_tree tree;
    return ow_tree_open(&tree, bytes, size);
}

static uint32_t get32(const uint8_t *bytes, uint32_t at)
{
    return bytes[at] | (uint32_t)bytes[at + 1] << 8 | (uint32_t)bytes[at + 2] << 16 |
           (uint32_t)bytes[at + 3] << 24;
}

static void set32(uint8_t *bytes, uint32_t at, uint32_t value)
{
    for (uint32_t i = 0; i < 4; i++) {
        bytes[at + i] = (uint8_t)(value >> 8 * i);
    }
}

/* ---- what must open ------------------------------------------------------------------------- */
static void samples_open(void **state)
{
    (void)state;
    for (uint32_t f = 0; f < FLAG_SETS; f++) {
        uint32_t size;
        uint8_t *blob = builder_sample(flag_sets[f], &size);
        assert_int_equal(blob_exercise(blob, size), OW_OK);
        struct ow_tree tree;
        assert_int_equal(ow_tree_open(&tree, blob, size), OW_OK);
        assert_int_equal(tree.face_count, 9);
        assert_int_equal(tree.polygon_count, 5);
        assert_int_equal(tree.switch_count, 2);
        assert_int_equal(tree.node_count, 3);
        assert_int_equal(tree.depth, 2);
        assert_int_equal(tree.max_corners, 5);
        assert_int_equal(tree.vertex_count, 18);
        assert_int_equal(tree.box_min[0], -900);
        assert_int_equal(tree.box_max[1], 950);
        assert_int_equal(tree.flags, flag_sets[f] | OW_TREE_TWO_SIDED);
        free(blob);
    }
}

static void more_bytes_than_the_blob_do_no_harm(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(0, &size);
    blob = realloc(blob, size + 7);
    assert_non_null(blob);
    memset(blob + size, 0xA5, 7);
    assert_int_equal(open_bytes(blob, size + 7), OW_OK);
    free(blob);
}

static void a_tree_without_faces_opens(void **state)
{
    (void)state;
    struct builder *b = builder_new(0);
    uint32_t size, root = builder_sequence(b);
    uint8_t *blob = builder_finish(b, root, &size);
    assert_int_equal(blob_exercise(blob, size), OW_OK);
    free(blob);
    free(b);
}

/* A chain of switches as deep as the builder can: the stack is one entry a level. */
static void deep_trees_walk(void **state)
{
    (void)state;
    struct builder *b = builder_new(OW_TREE_SWITCH_ONLY);
    (void)builder_colour(b, 0x808080);
    uint32_t root = 0, last = 0;
    for (int i = 0; i < 1000; i++) {
        int z = -1000 + 2 * i;
        const int v[3][3] = { { -100, -100, z }, { 100, -100, z }, { 0, 100, z } };
        uint32_t polygon = builder_triangle(b, v, 0, 0);
        uint32_t node = builder_switch(b, (const int64_t[4]){ 0, 0, 1, -z });
        builder_add(b, node, OW_ITEM_FACE, polygon);
        if (i > 0) {
            builder_child(b, last, (uint32_t)i % 2, OW_ITEM_NODE, node);
        } else {
            root = node;
        }
        last = node;
    }
    uint32_t size;
    uint8_t *blob = builder_finish(b, root, &size);
    assert_int_equal(blob_exercise(blob, size), OW_OK);
    free(blob);
    free(b);
}

/* ---- what a wire or a worn flash does ------------------------------------------------------- */
static void every_truncation_is_refused(void **state)
{
    (void)state;
    for (uint32_t f = 0; f < FLAG_SETS; f++) {
        uint32_t size;
        uint8_t *blob = builder_sample(flag_sets[f], &size);
        for (uint32_t n = 0; n < size; n++) {
            uint8_t *cut = copy_of(blob, n);
            assert_int_equal(blob_exercise(cut, n), OW_TRUNCATED);
            free(cut);
        }
        free(blob);
    }
}

static void every_flipped_bit_is_refused(void **state)
{
    (void)state;
    for (uint32_t f = 0; f < FLAG_SETS; f++) {
        uint32_t size;
        uint8_t *blob = builder_sample(flag_sets[f], &size);
        for (uint32_t bit = 0; bit < 8 * size; bit++) {
            blob[bit / 8] ^= (uint8_t)(1u << bit % 8);
            assert_int_not_equal(blob_exercise(blob, size), OW_OK);
            blob[bit / 8] ^= (uint8_t)(1u << bit % 8);
        }
        assert_int_equal(open_bytes(blob, size), OW_OK);
        free(blob);
    }
}

static void every_wrong_byte_is_refused(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
    for (uint32_t at = 0; at < size; at++) {
        uint8_t right = blob[at];
        for (uint32_t value = 0; value < 256; value++) {
            blob[at] = (uint8_t)value;
            if (value != right) {
                assert_int_not_equal(open_bytes(blob, size), OW_OK);
            }
        }
        blob[at] = right;
    }
    free(blob);
}

/* ---- what a liar does ----------------------------------------------------------------------- */
/* Changes one 32-bit word of the sample, seals it, and expects this status. */
static void expect_word(uint32_t at, uint32_t value, enum ow_status expected)
{
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
    assert_int_not_equal(get32(blob, at), value);
    set32(blob, at, value);
    blob_seal(blob, size);
    enum ow_status status = blob_exercise(blob, size);
    if (status != expected) {
        print_error("word at %u set to %u: status %d, not %d\n", at, value, status, expected);
    }
    assert_int_equal(status, expected);
    free(blob);
}

static void statuses_say_what_is_wrong(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(0, &size);
    expect_word(HEAD(magic), OW_BLOB_MAGIC + 1, OW_MAGIC);
    expect_word(HEAD(version), 2 | 128u << 16, OW_VERSION);
    expect_word(HEAD(blob_bytes), 0x10000000, OW_TRUNCATED);
    blob[size - 1] ^= 1;
    assert_int_equal(open_bytes(blob, size), OW_CHECKSUM);
    free(blob);
}

static void wrong_counts_are_refused(void **state)
{
    (void)state;
    static const uint32_t fields[] = { HEAD(face_count),   HEAD(vertex_count), HEAD(node_count),
                                       HEAD(switch_count), HEAD(depth),        HEAD(max_corners),
                                       HEAD(colour_count) };
    static const uint32_t values[] = { 0, 1, 4, 6, 100, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF };
    for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
            uint32_t size;
            uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
            uint32_t old = get32(blob, fields[i]);
            free(blob);
            if (old != values[k]) {
                expect_word(fields[i], values[k], OW_CORRUPT);
            }
        }
    }
    expect_word(HEAD(instance_count), 1, OW_CORRUPT);
    expect_word(HEAD(flags), 0x80000000, OW_CORRUPT);
}

static void wrong_sections_are_refused(void **state)
{
    (void)state;
    for (uint32_t at = HEAD(nodes_at); at <= HEAD(instances_at); at += 4) {
        uint32_t size;
        uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
        uint32_t old = get32(blob, at);
        free(blob);
        const uint32_t values[] = { 0,       4,          old - 4,    old + 4,    old + 1,
                                    old - 2, 0x7FFFFFFC, 0x80000000, 0xFFFFFFFC, size + 4 };
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
            expect_word(at, values[k], OW_CORRUPT);
        }
    }
}

/* The sample's root: word, front item, back item, plane, two coplanar faces. */
enum { ROOT = 128, ROOT_FRONT = 132, ROOT_BACK = 136, ROOT_PLANE = 140, ROOT_FACE = 156 };

static void wrong_children_are_refused(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
    uint32_t front = get32(blob, ROOT_FRONT), back = get32(blob, ROOT_BACK);
    free(blob);
    assert_int_equal(front & 3, OW_ITEM_NODE);
    expect_word(ROOT_FRONT, OW_ITEM_NODE, OW_CORRUPT); /* the root itself: a cycle */
    expect_word(ROOT_FRONT, back, OW_CORRUPT);         /* one child on both sides */
    expect_word(ROOT_BACK, front, OW_CORRUPT);         /* the same, the other way */
    expect_word(ROOT_BACK, OW_ITEM_NONE, OW_CORRUPT);  /* a node without a parent */
    expect_word(ROOT_FRONT, front + 4, OW_CORRUPT);    /* the middle of a node */
    expect_word(ROOT_FRONT, 0xFFFFFFFC | OW_ITEM_NODE, OW_CORRUPT);
    expect_word(ROOT_FRONT, OW_ITEM_INSTANCE, OW_CORRUPT); /* not in version 1 */
    expect_word(ROOT_FACE, front, OW_CORRUPT);             /* a node among coplanar faces */
    expect_word(ROOT_FACE, 0xFFFFFFFC | OW_ITEM_FACE, OW_CORRUPT);
    expect_word(ROOT_FACE, OW_ITEM_NONE, OW_CORRUPT);
    expect_word(ROOT, 2 | 2u << OW_NODE_COUNT_SHIFT, OW_CORRUPT); /* an unknown kind */
    expect_word(ROOT, OW_NODE_SWITCH | 8 | 2u << OW_NODE_COUNT_SHIFT, OW_CORRUPT);
    expect_word(ROOT, OW_NODE_SWITCH | 0xFFFFFFu << OW_NODE_COUNT_SHIFT, OW_CORRUPT);
    expect_word(ROOT, OW_NODE_SEQUENCE | 2u << OW_NODE_COUNT_SHIFT, OW_CORRUPT);
}

static void wrong_polygons_are_refused(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
    uint32_t at = get32(blob, HEAD(polygons_at)), first = get32(blob, at);
    free(blob);
    expect_word(at, (first & 0xFFFFFF00) | 2, OW_CORRUPT); /* two corners */
    expect_word(at, first & 0xFFFFFF00, OW_CORRUPT);       /* none */
    expect_word(at, first | 0xFF, OW_CORRUPT);             /* more than the section holds */
    expect_word(at + 4, 0x00010FFF, OW_CORRUPT);           /* a colour that is not there */
    expect_word(at + 4, 0x00018000, OW_CORRUPT);           /* an unknown flag */
    expect_word(at + 8, 0xFFFF0000, OW_CORRUPT);           /* a vertex that is not there */
}

static void backs_in_a_one_sided_tree_are_refused(void **state)
{
    (void)state;
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_IDS, &size);
    free(blob);
    expect_word(HEAD(flags), OW_TREE_IDS, OW_CORRUPT);
}

/* The high byte of a plane's third word, and the padding between sections. */
static void bytes_called_zero_are_checked(void **state)
{
    (void)state;
    expect_word(ROOT_PLANE + 8, 0x01000001, OW_CORRUPT);
    uint32_t size;
    uint8_t *blob = builder_sample(OW_TREE_NORMALS, &size); /* 54 bytes of normals, 2 of padding */
    uint32_t at = get32(blob, HEAD(colours_at)) - 1;
    assert_int_equal(blob[at], 0);
    blob[at] = 1;
    blob_seal(blob, size);
    assert_int_equal(blob_exercise(blob, size), OW_CORRUPT);
    free(blob);
}

/* ---- liars by the thousand ------------------------------------------------------------------ */
struct outcomes {
    uint32_t opened;
    uint32_t refused;
};

static void try_sealed(uint8_t *blob, uint32_t size, struct outcomes *outcomes)
{
    blob_seal(blob, size);
    enum ow_status status = blob_exercise(blob, size);
    assert_int_not_equal(status, OW_CHECKSUM);
    *(status == OW_OK ? &outcomes->opened : &outcomes->refused) += 1;
}

static void every_word_changed_is_refused_or_harmless(void **state)
{
    (void)state;
    struct outcomes outcomes = { 0, 0 };
    for (uint32_t f = 0; f < FLAG_SETS; f++) {
        uint32_t size;
        uint8_t *blob = builder_sample(flag_sets[f], &size);
        for (uint32_t at = 0; at + 4 <= size; at += 2) {
            uint32_t old = get32(blob, at);
            const uint32_t values[] = { 0,          1,          3,          0xFF,    0xFFFF,
                                        0x7FFF7FFF, 0x80008000, 0xFFFFFFFF, old + 1, old - 1,
                                        old + 4,    old - 4,    old << 1,   old ^ 2 };
            for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
                uint8_t *changed = copy_of(blob, size);
                set32(changed, at, values[k]);
                try_sealed(changed, size, &outcomes);
                free(changed);
            }
        }
        free(blob);
    }
    print_message("%u opened, %u refused\n", outcomes.opened, outcomes.refused);
    assert_true(outcomes.opened > 1000 && outcomes.refused > 1000);
}

static uint32_t random_below(uint64_t *random, uint32_t n)
{
    *random = *random * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*random >> 33) % n;
}

static void random_changes_are_refused_or_harmless(void **state)
{
    (void)state;
    struct outcomes outcomes = { 0, 0 };
    uint64_t random = 1;
    for (uint32_t i = 0; i < 6000; i++) {
        uint32_t size;
        uint8_t *blob = builder_sample(flag_sets[i % FLAG_SETS], &size);
        uint32_t from = i % 3 == 0 ? 0 : HEAD(origin_bits);
        for (uint32_t n = 1 + random_below(&random, 3); n > 0; n--) {
            uint32_t at = from + random_below(&random, size - from);
            blob[at] =
                (uint8_t)(random_below(&random, 2) ? random_below(&random, 256)
                                                   : blob[at] ^ 1u << random_below(&random, 8));
        }
        try_sealed(blob, size, &outcomes);
        free(blob);
    }
    print_message("%u opened, %u refused\n", outcomes.opened, outcomes.refused);
    assert_true(outcomes.opened > 500 && outcomes.refused > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_open),
        cmocka_unit_test(more_bytes_than_the_blob_do_no_harm),
        cmocka_unit_test(a_tree_without_faces_opens),
        cmocka_unit_test(deep_trees_walk),
        cmocka_unit_test(every_truncation_is_refused),
        cmocka_unit_test(every_flipped_bit_is_refused),
        cmocka_unit_test(every_wrong_byte_is_refused),
        cmocka_unit_test(statuses_say_what_is_wrong),
        cmocka_unit_test(wrong_counts_are_refused),
        cmocka_unit_test(wrong_sections_are_refused),
        cmocka_unit_test(wrong_children_are_refused),
        cmocka_unit_test(wrong_polygons_are_refused),
        cmocka_unit_test(bytes_called_zero_are_checked),
        cmocka_unit_test(backs_in_a_one_sided_tree_are_refused),
        cmocka_unit_test(every_word_changed_is_refused_or_harmless),
        cmocka_unit_test(random_changes_are_refused_or_harmless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
