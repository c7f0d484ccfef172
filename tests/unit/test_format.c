/* SPDX-License-Identifier: 0BSD */
/*
 * docs/FORMAT.md against ow_blob.h: every field's offset, name and type, the
 * flags, the tags, and the worked example, which must open and be what the page
 * says. Run from the repository's root.
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

static const char page_path[] = "docs/FORMAT.md";

struct field {
    const char *name;
    size_t offset;
    const char *type;
    size_t size;
};

#define FIELD(name, type)                                   \
    {                                                       \
#name, offsetof(struct ow_disk_header, name), type, \
            sizeof(((struct ow_disk_header *)0)->name)      \
    }

static const struct field fields[] = {
    FIELD(magic, "u32"),          FIELD(version, "u16"),      FIELD(header_bytes, "u16"),
    FIELD(blob_bytes, "u32"),     FIELD(crc32, "u32"),        FIELD(flags, "u32"),
    FIELD(polygon_count, "u32"),  FIELD(face_count, "u32"),   FIELD(vertex_count, "u32"),
    FIELD(node_count, "u32"),     FIELD(switch_count, "u32"), FIELD(depth, "u32"),
    FIELD(max_corners, "u32"),    FIELD(colour_count, "u32"), FIELD(instance_count, "u32"),
    FIELD(nodes_at, "u32"),       FIELD(polygons_at, "u32"),  FIELD(vertices_at, "u32"),
    FIELD(normals_at, "u32"),     FIELD(colours_at, "u32"),   FIELD(instances_at, "u32"),
    FIELD(box_min, "i16[3]"),     FIELD(box_max, "i16[3]"),   FIELD(tolerance_q8, "u32"),
    FIELD(origin_bits, "u64[3]"), FIELD(step_bits, "u64"),
};
enum { FIELDS = sizeof fields / sizeof *fields };

struct constant {
    uint32_t value;
    const char *name;
};

static const struct constant flags[] = {
    { OW_TREE_TWO_SIDED, "two-sided" },
    { OW_TREE_SWITCH_ONLY, "switch-only" },
    { OW_TREE_CLOSED, "closed" },
    { OW_TREE_INDEX32, "index32" },
    { OW_TREE_IDS, "ids" },
    { OW_TREE_NORMALS, "normals" },
};
static const struct constant tags[] = {
    { OW_ITEM_FACE, "face" },
    { OW_ITEM_REVERSE, "reverse" },
    { OW_ITEM_NODE, "node" },
    { OW_ITEM_INSTANCE, "instance" },
};

/* ---- the page's tables ---------------------------------------------------------------------- */
/* The first three cells of a table row. */
struct row {
    char cell[3][64];
};

static bool read_row(const char *line, struct row *row)
{
    memset(row, 0, sizeof *row);
    const char *at = line;
    for (int i = 0; i < 3; i++) {
        if (*at != '|') {
            return false;
        }
        at += strspn(at, "| ");
        size_t length = strcspn(at, "|\n");
        const char *next = at + length;
        while (length > 0 && at[length - 1] == ' ') {
            length--;
        }
        if (*next != '|') {
            return false;
        }
        length = length < sizeof row->cell[i] ? length : sizeof row->cell[i] - 1;
        memcpy(row->cell[i], at, length);
        at = next;
    }
    return true;
}

/* Reads the table whose head's first two cells are these; its rows, at most room. */
static uint32_t read_table(const char *first, const char *second, struct row *rows, uint32_t room)
{
    FILE *page = fopen(page_path, "r");
    assert_non_null(page);
    char line[1024];
    bool inside = false;
    uint32_t count = 0;
    while (fgets(line, sizeof line, page)) {
        struct row row;
        if (!read_row(line, &row)) {
            if (inside) {
                break;
            }
        } else if (inside && row.cell[0][0] != '-') {
            assert_true(count < room);
            rows[count++] = row;
        } else if (strcmp(row.cell[0], first) == 0 && strcmp(row.cell[1], second) == 0) {
            inside = true;
        }
    }
    fclose(page);
    return count;
}

static void the_header_is_as_the_page_says(void **state)
{
    (void)state;
    struct row rows[64];
    assert_int_equal(read_table("offset", "name", rows, 64), FIELDS);
    size_t end = 0;
    for (uint32_t i = 0; i < FIELDS; i++) {
        assert_int_equal(strtoul(rows[i].cell[0], NULL, 10), fields[i].offset);
        assert_string_equal(rows[i].cell[1], fields[i].name);
        assert_string_equal(rows[i].cell[2], fields[i].type);
        /* The type is as wide as the field, and the fields leave no gap. */
        size_t width = (size_t)strtoul(fields[i].type + 1, NULL, 10) / 8;
        assert_int_equal(width * (strchr(fields[i].type, '[') ? 3 : 1), fields[i].size);
        assert_int_equal(fields[i].offset, end);
        end += fields[i].size;
    }
    assert_int_equal(end, sizeof(struct ow_disk_header));
}

static void check_constants(const char *head, const struct constant *constants, uint32_t count)
{
    struct row rows[16];
    assert_int_equal(read_table(head, "name", rows, 16), count);
    for (uint32_t i = 0; i < count; i++) {
        assert_int_equal(strtoul(rows[i].cell[0], NULL, 0), constants[i].value);
        assert_string_equal(rows[i].cell[1], constants[i].name);
    }
}

static void flags_and_tags_are_as_the_page_says(void **state)
{
    (void)state;
    check_constants("flag", flags, sizeof flags / sizeof *flags);
    check_constants("tag", tags, sizeof tags / sizeof *tags);
    uint32_t all = 0;
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++) {
        all |= flags[i].value;
    }
    assert_int_equal(all, OW_TREE_FLAGS_KNOWN);
}

/* ---- the page's example --------------------------------------------------------------------- */
/* Lines of four hexadecimal digits and bytes; the addresses must follow one another. */
static uint32_t read_example(uint8_t *bytes, uint32_t room)
{
    FILE *page = fopen(page_path, "r");
    assert_non_null(page);
    char line[1024];
    uint32_t count = 0;
    while (fgets(line, sizeof line, page)) {
        char *end;
        unsigned long address = strtoul(line, &end, 16);
        if (end != line + 4 || end[0] != ' ' || end[1] != ' ') {
            continue;
        }
        assert_int_equal(address, count);
        for (char *at = end;; at = end) {
            unsigned long value = strtoul(at, &end, 16);
            if (end == at) {
                break;
            }
            assert_true(count < room && value < 256);
            bytes[count++] = (uint8_t)value;
        }
    }
    fclose(page);
    return count;
}

static void the_example_is_a_tree(void **state)
{
    (void)state;
    uint8_t bytes[4096];
    uint32_t size = read_example(bytes, sizeof bytes);
    assert_true(size > sizeof(struct ow_disk_header));
    assert_int_equal(blob_exercise(bytes, size), OW_OK);
    struct ow_tree tree;
    assert_int_equal(ow_tree_open(&tree, bytes, size), OW_OK);
    assert_int_equal(tree.blob_bytes, size);
    assert_int_equal(tree.polygon_count, 1);
    assert_int_equal(tree.face_count, 1);
    assert_int_equal(tree.vertex_count, 3);
}

/* What the page says in words, built by hand, gives the page's bytes. */
static void the_example_can_be_rebuilt(void **state)
{
    (void)state;
    uint8_t bytes[4096];
    uint32_t size = read_example(bytes, sizeof bytes), built_size;
    struct builder *b = builder_new(OW_TREE_SWITCH_ONLY);
    uint32_t colour = builder_colour(b, 0xC08040);
    const int corners[3][3] = { { -32767, -32767, 0 }, { 32767, -32767, 0 }, { 0, 32767, 0 } };
    uint32_t polygon = builder_triangle(b, corners, colour, 1);
    uint32_t root = builder_sequence(b);
    builder_add(b, root, OW_ITEM_FACE, polygon);
    b->step = 2.0 / 65534;
    uint8_t *built = builder_finish(b, root, &built_size);
    assert_int_equal(size, built_size);
    assert_memory_equal(bytes, built, size);
    free(built);
    free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_header_is_as_the_page_says),
        cmocka_unit_test(flags_and_tags_are_as_the_page_says),
        cmocka_unit_test(the_example_is_a_tree),
        cmocka_unit_test(the_example_can_be_rebuilt),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
