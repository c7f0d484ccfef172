/* SPDX-License-Identifier: 0BSD */
/*
 * The feudal priority logic, fed with relations: the 12 polygons of [CW96], whose
 * tables 1 to 5 and whose text say which bunches and switches come out, and small
 * cases for what the example does not have: coplanar polygons, separating planes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "tools/owc/feudal.h"
#include "tools/owc/feudal_tree.h"

enum { MOST = 20 };

#define F SPLIT_FRONT
#define B SPLIT_BACK
#define C SPLIT_ACROSS

/* Relations as a table: side[q][p] is where polygon p lies, seen from the plane q. */
struct table {
    uint8_t side[MOST][MOST];
    uint32_t plane[MOST];
    bool reversed[MOST];
    uint32_t split[3]; /* what may be cut, by which plane ... */
    uint32_t parts[2]; /* ... and into what */
    uint32_t splits;
    bool asked[MOST][MOST]; /* side(p, q) was asked for */
    uint32_t asked_count;
};

static uint32_t plane_of(void *context, uint32_t polygon)
{
    return ((struct table *)context)->plane[polygon];
}

static bool is_reversed(void *context, uint32_t polygon)
{
    return ((struct table *)context)->reversed[polygon];
}

static enum split_side side_of(void *context, uint32_t polygon, uint32_t plane)
{
    struct table *table = context;
    assert_true(polygon < MOST && plane < MOST);
    table->asked[plane][polygon] = true;
    table->asked_count++;
    return (enum split_side)table->side[plane][polygon];
}

static void split(void *context, uint32_t polygon, uint32_t plane, uint32_t parts[2])
{
    struct table *table = context;
    assert_int_equal(polygon, table->split[0]);
    assert_int_equal(plane, table->split[1]);
    memcpy(parts, table->parts, sizeof table->parts);
    table->splits++;
}

static struct feudal_source source_of(struct table *table)
{
    return (struct feudal_source){ table, plane_of, is_reversed, side_of, split };
}

/* A row: numbers in front, behind and across, each list ended by 0. */
static void set_row(struct table *table, uint32_t row, const uint32_t *front, const uint32_t *back,
                    const uint32_t *across)
{
    for (; *front != 0; front++) {
        table->side[row][*front] = F;
    }
    for (; *back != 0; back++) {
        table->side[row][*back] = B;
    }
    for (; *across != 0; across++) {
        table->side[row][*across] = C;
    }
}

#define LIST(...) ((const uint32_t[]){ __VA_ARGS__ })

/*
 * The paper's object. Rows 1 to 4 are its table 1, rows 6, 7, 11 and 12 its tables
 * 2 and 5. Rows 5, 8, 9 and 10 are not printed; the text says that these polygons
 * have absolute front priority. What tables 2 and 5 leave out stands as across: it
 * concerns polygons that are gone when it matters. 13 and 14 are the parts of 4.
 */
static void set_paper(struct table *t)
{
    memset(t, 0, sizeof *t);
    memset(t->side, C, sizeof t->side);
    for (uint32_t i = 1; i <= 14; i++) {
        t->plane[i] = i <= 12 ? i : 4;
    }
    for (uint32_t i = 1; i <= 12; i++) {
        if (i == 1 || i == 2 || i == 5 || i == 8 || i == 9 || i == 10) {
            memset(t->side[i], B, sizeof t->side[i]);
        }
    }
    set_row(t, 3, LIST(5, 6, 7, 12, 14, 0), LIST(1, 2, 10, 11, 13, 0), LIST(4, 8, 9, 0));
    set_row(t, 4, LIST(1, 11, 0), LIST(5, 6, 7, 8, 9, 12, 0), LIST(2, 3, 10, 0));
    set_row(t, 6, LIST(11, 0), LIST(7, 12, 14, 0), LIST(3, 4, 0));
    set_row(t, 7, LIST(3, 6, 11, 12, 0), LIST(9, 0), LIST(4, 5, 10, 14, 0));
    set_row(t, 11, LIST(4, 5, 6, 7, 9, 12, 13, 0), LIST(0), LIST(3, 10, 0));
    set_row(t, 12, LIST(3, 7, 11, 0), LIST(6, 0), LIST(4, 14, 0));
    t->split[0] = 4;
    t->split[1] = 3;
    t->parts[0] = 14;
    t->parts[1] = 13;
}

/* A tree as text: levels [back|front], then the switch with what lies in its plane. */
static void write_bunch(char *text, const struct feudal *f, const struct feudal_bunch *bunch)
{
    bool used[MOST] = { false };
    for (uint32_t i = 0; i < bunch->count; i++) {
        used[f->polygons[bunch->first + i]] = true;
    }
    const char *gap = "";
    for (uint32_t i = 0; i < MOST; i++) {
        if (used[i]) {
            sprintf(text + strlen(text), "%s%u", gap, i);
            gap = ",";
        }
    }
}

static void write_node(char *text, const struct feudal *f, uint32_t number)
{
    if (number == FEUDAL_NONE) {
        strcat(text, "-");
        return;
    }
    const struct feudal_node *node = &f->nodes[number];
    for (uint32_t i = 0; i < node->level_count; i++) {
        const struct feudal_level *level = &f->levels[node->first_level + i];
        strcat(text, "[");
        write_bunch(text, f, &level->back);
        strcat(text, "|");
        write_bunch(text, f, &level->front);
        strcat(text, "]");
    }
    if (node->plane != FEUDAL_NONE) {
        sprintf(text + strlen(text), " %u<", node->polygon);
        write_bunch(text, f, &node->on);
        strcat(text, ">(");
        write_node(text, f, node->front);
        strcat(text, ")(");
        write_node(text, f, node->back);
        strcat(text, ")");
    }
}

static void make(struct feudal *f, struct table *t, const uint32_t *order, uint32_t count,
                 bool dynamic, char *text)
{
    struct feudal_source source = source_of(t);
    feudal_make(f, &source, order, count, dynamic, NULL);
    text[0] = '\0';
    write_node(text, f, 0);
}

/*
 * 1, 2, 5, 8, 9 and 10 are in front bunches; 3 becomes the switch and splits 4 into
 * 13 and 14; in front of it F1 holds 6 and 14 and B2 7 and 12; behind it B1 holds
 * 11 and 13.
 */
static void the_papers_example_static(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    char text[400];
    set_paper(&t);
    make(&f, &t, LIST(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12), 12, false, text);
    assert_string_equal(text, "[|1,2,5,8,9,10] 3<3>([|6,14][7,12|])([11,13|])");
    assert_int_equal(t.splits, 1);
    /* The whole table, and the rows of 6, 7 and 12 for the new part 14; 11 had 4 in front. */
    assert_int_equal(f.relations, 12 * 11 + 3);
    assert_int_equal(t.asked_count, 12 * 11 + 3);
    feudal_free(&f);
}

/* The random order that the paper uses. Each polygon taken is a level of its own. */
static void the_papers_example_dynamic(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    char text[400];
    set_paper(&t);
    make(&f, &t, LIST(2, 8, 7, 11, 1, 5, 6, 3, 10, 4, 12, 9), 12, true, text);
    assert_string_equal(text, "[|2][|8][|1][|5][|10][|9] 3<3>([|6,14][7,12|])([11,13|])");
    /* Rows of 11, 10, 9, 9, 9, 8, 7, 7, 7, 6, 6 and 6 relations, then the three of the split. */
    assert_int_equal(f.relations, 11 + 10 + 9 + 9 + 9 + 8 + 7 + 7 + 7 + 6 + 6 + 6 + 3);
    /* Table 5: 7 and 11 need no relation to 2 and 8, nor does 1. */
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t row = LIST(7, 11, 1)[i];
        assert_false(t.asked[row][2] || t.asked[row][8]);
        assert_true(t.asked[row][9]);
    }
    feudal_free(&f);
}

/* Coplanar polygons share a row; those of reverse normal go to the opposite bunch. */
static void coplanar_polygons(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    char text[400];
    memset(&t, 0, sizeof t);
    /* 1 and 3 look up from one plane, 2 down; 4, below, faces down. */
    for (uint32_t i = 1; i <= 4; i++) {
        t.plane[i] = i == 4 ? 4 : 1;
    }
    t.reversed[2] = true;
    t.side[1][4] = B;
    t.side[4][1] = t.side[4][2] = t.side[4][3] = B;
    make(&f, &t, LIST(1, 2, 3, 4), 4, false, text);
    assert_string_equal(text, "[2|1,3,4]");
    assert_int_equal(f.relations, 3 + 3);   /* two rows, not four */
    assert_int_equal(t.asked_count, 1 + 3); /* what lies in the plane itself is known */
    feudal_free(&f);
    /* The dynamic version takes the whole plane with its first polygon. */
    make(&f, &t, LIST(2, 4, 3, 1), 4, true, text);
    assert_string_equal(text, "[2|1,3][4|]");
    assert_int_equal(f.relations, 3);
    feudal_free(&f);
    /* Nothing but one plane: back priority is asked for first. */
    make(&f, &t, LIST(1, 2, 3), 3, false, text);
    assert_string_equal(text, "[1,3|2]");
    feudal_free(&f);
    make(&f, &t, LIST(2, 1, 3), 3, true, text);
    assert_string_equal(text, "[2|1,3]");
    feudal_free(&f);
}

/* Five walls in a row, and two plates whose planes cut the walls that stand farther off. */
static void set_walls(struct table *t)
{
    memset(t, 0, sizeof *t);
    for (uint32_t i = 1; i <= 5; i++) {
        t->plane[i] = i;
        for (uint32_t k = 1; k <= 5; k++) {
            t->side[i][k] = k > i ? F : k < i ? B : SPLIT_ON;
        }
    }
    for (uint32_t k = 6; k <= 7; k++) { /* 6 stands between 1 and 2, 7 between 4 and 5 */
        t->plane[k] = k;
        memset(t->side[k] + 1, C, 7);
        t->side[1][k] = F;
        t->side[5][k] = B;
        t->side[2][k] = t->side[3][k] = t->side[4][k] = k == 6 ? B : F;
    }
    t->side[6][1] = t->side[6][2] = B;
    t->side[7][4] = t->side[7][5] = F;
}

static void separating_comes_before_splitting(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    char text[400];
    set_walls(&t);
    t.split[0] = MOST; /* nothing may be split before 3 has separated */
    make(&f, &t, LIST(7, 6, 5, 4, 3, 2, 1), 7, false, text);
    /* 1 and 5 first; of 2, 3 and 4, which all cut nothing, 3 has as many on both sides. */
    assert_string_equal(text, "[1|5] 3<3>([4,7|])([|2,6])");
    feudal_free(&f);
    /* The dynamic version takes the first plane that separates, not the best. */
    make(&f, &t, LIST(2, 1, 3, 4, 5, 6, 7), 7, true, text);
    assert_memory_equal(text, " 2<2>(", 6);
    feudal_free(&f);
}

/*
 * Nine walls in a row, 8 has nothing but 1 across its plane. Once 3 has parted 1 from
 * it, it separates what is left on its side.
 */
static void a_divided_table_is_counted_off(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    char text[400];
    memset(&t, 0, sizeof t);
    for (uint32_t i = 1; i <= 9; i++) {
        t.plane[i] = i;
        for (uint32_t k = 1; k <= 9; k++) {
            t.side[i][k] = k > i ? F : B;
        }
    }
    t.side[8][1] = C;
    make(&f, &t, LIST(8, 3, 4, 5, 6, 7, 9, 1, 2), 9, true, text);
    assert_string_equal(text, " 3<3>( 8<8>([9|])([4|][5|][6|][7|]))([1|][2|])");
    feudal_free(&f);
}

/* What the tree's parts look like as sequences and switches. */
static void write_items(char *text, const struct tree *tree, uint32_t first, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tree_item item = tree->items[first + i];
        static const char kinds[] = "+-#";
        sprintf(text + strlen(text), "%c%u ", kinds[tree_item_tag(item)], tree_item_value(item));
    }
}

static void bunches_become_sequences(void **state)
{
    (void)state;
    struct table t;
    struct feudal f;
    struct tree tree;
    char text[400];
    uint32_t rank[MOST];
    for (uint32_t i = 0; i < MOST; i++) {
        rank[i] = i;
    }
    rank[5] = 100; /* what is later in the file comes later in its bunch */
    set_paper(&t);
    make(&f, &t, LIST(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12), 12, false, text);
    feudal_to_tree(&tree, &f, rank, false);
    assert_int_equal(tree.root, tree_item_of(OW_ITEM_NODE, 0));
    text[0] = '\0';
    write_items(text, &tree, 0, tree.nodes[0].count);
    assert_string_equal(text, "#1 +1 +2 +8 +9 +10 +5 ");
    assert_int_equal(tree.nodes[1].plane, 3);
    const struct tree_node *front = &tree.nodes[tree_item_value(tree.nodes[1].front)];
    text[0] = '\0';
    write_items(text, &tree, (uint32_t)front->first, front->count);
    assert_string_equal(text, "+7 +12 +6 +14 ");
    tree_free(&tree);
    /* Two-sided: the reverses of the front bunches come with the back ones, and last. */
    feudal_to_tree(&tree, &f, rank, true);
    text[0] = '\0';
    write_items(text, &tree, 0, tree.nodes[0].count);
    assert_string_equal(text, "-1 -2 -8 -9 -10 -5 #1 +1 +2 +8 +9 +10 +5 ");
    front = &tree.nodes[tree_item_value(tree.nodes[1].front)];
    text[0] = '\0';
    write_items(text, &tree, (uint32_t)front->first, front->count);
    assert_string_equal(text, "-6 -14 +7 +12 -7 -12 +6 +14 ");
    text[0] = '\0';
    write_items(text, &tree, (uint32_t)tree.nodes[1].first, tree.nodes[1].count);
    assert_string_equal(text, "+3 -3 ");
    tree_free(&tree);
    feudal_free(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_papers_example_static),
        cmocka_unit_test(the_papers_example_dynamic),
        cmocka_unit_test(coplanar_polygons),
        cmocka_unit_test(separating_comes_before_splitting),
        cmocka_unit_test(a_divided_table_is_counted_off),
        cmocka_unit_test(bunches_become_sequences),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
