/* SPDX-License-Identifier: 0BSD */
/*
 * A picture of a tree. The format's order makes it short: nodes lie level by
 * level, so a node's child nodes have successive numbers.
 */
#include "plot.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>

#include "blob_node.h"
#include "tools/common/xalloc.h"

enum { COLUMN = 30, ROW = 46, MARGIN = 30, TOP = 56, RADIUS = 10 };

struct knot {
    bool is_switch;
    bool open;            /* its children are drawn */
    uint32_t depth;       /* the root's is 0 */
    uint32_t faces;       /* in a sequence, or in a switch's plane */
    uint32_t dots;        /* children of a switch that are one face */
    uint32_t first;       /* child node */
    uint32_t count;       /* child nodes */
    uint32_t nodes_below; /* itself included */
    uint32_t faces_below;
    uint32_t levels; /* of the subtree */
    double x;
};

struct plot {
    const struct ow_tree *tree;
    struct knot *knots;
    double columns; /* used so far */
    uint32_t deepest;
    uint32_t opened;
};

/* ---- reading ---- */

static void meet_item(struct knot *knot, uint32_t item, bool child, uint32_t *met)
{
    if (item == OW_ITEM_NONE) {
        return;
    }
    if (blob_item_tag(item) == OW_ITEM_NODE) {
        (*met)++;
        knot->count++;
    } else if (child) {
        knot->dots++;
    } else {
        knot->faces++;
    }
}

static void read_knots(struct plot *p)
{
    const uint8_t *bytes = p->tree->bytes;
    uint32_t at = p->tree->nodes_at;
    uint32_t met = 1;
    for (uint32_t i = 0; i < p->tree->node_count; i++) {
        struct knot *knot = &p->knots[i];
        struct blob_node node = blob_node_at(p->tree, at);
        knot->first = met;
        knot->is_switch = node.is_switch;
        for (uint32_t k = 0; node.is_switch && k < 2; k++) {
            meet_item(knot, ow_read_u32(bytes, node.children_at + 4 * k), true, &met);
        }
        for (uint32_t k = 0; k < node.count; k++) {
            meet_item(knot, ow_read_u32(bytes, node.items_at + 4 * k), false, &met);
        }
        at = node.end_at;
        for (uint32_t k = 0; k < knot->count; k++) {
            p->knots[knot->first + k].depth = knot->depth + 1;
        }
    }
    for (uint32_t i = p->tree->node_count; i > 0; i--) {
        struct knot *knot = &p->knots[i - 1];
        knot->nodes_below = 1;
        knot->faces_below = knot->faces + knot->dots;
        for (uint32_t k = 0; k < knot->count; k++) {
            const struct knot *child = &p->knots[knot->first + k];
            knot->nodes_below += child->nodes_below;
            knot->faces_below += child->faces_below;
            knot->levels = child->levels > knot->levels ? child->levels : knot->levels;
        }
        knot->levels++;
    }
}

/* ---- choosing ---- */

/* Opens the largest subtrees whose children fit, until the picture is full. */
static void open_largest(struct plot *p)
{
    uint32_t *shown = xalloc(PLOT_MOST_NODES, sizeof *shown);
    uint32_t count = 1;
    shown[0] = 0;
    for (;;) {
        uint32_t best = UINT32_MAX;
        for (uint32_t i = 0; i < count; i++) {
            const struct knot *knot = &p->knots[shown[i]];
            if (!knot->open && count + knot->count <= PLOT_MOST_NODES &&
                (best == UINT32_MAX || knot->nodes_below > p->knots[best].nodes_below)) {
                best = shown[i];
            }
        }
        if (best == UINT32_MAX) {
            break;
        }
        struct knot *knot = &p->knots[best];
        knot->open = true;
        p->opened++;
        p->deepest = knot->depth > p->deepest ? knot->depth : p->deepest;
        for (uint32_t k = 0; k < knot->count; k++) {
            shown[count++] = knot->first + k;
        }
    }
    free(shown);
}

/* ---- placing: at most PLOT_MOST_NODES are open, so recursion is bounded ---- */

static void place(struct plot *p, uint32_t number)
{
    struct knot *knot = &p->knots[number];
    p->deepest = knot->depth > p->deepest ? knot->depth : p->deepest;
    if (!knot->open || knot->count == 0) {
        knot->x = p->columns;
        p->columns += 1;
        return;
    }
    for (uint32_t k = 0; k < knot->count; k++) {
        place(p, knot->first + k);
    }
    knot->x = (p->knots[knot->first].x + p->knots[knot->first + knot->count - 1].x) / 2;
}

/* ---- drawing ---- */

static double x_of(const struct knot *knot)
{
    return MARGIN + COLUMN * (knot->x + 0.5);
}

static double y_of(const struct knot *knot)
{
    return TOP + ROW * (knot->depth + 0.5);
}

static void draw_line(FILE *out, double x1, double y1, double x2, double y2)
{
    fprintf(out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>\n", x1, y1, x2, y2);
}

static void draw_edges(FILE *out, const struct plot *p, uint32_t number)
{
    const struct knot *knot = &p->knots[number];
    for (uint32_t k = 0; knot->open && k < knot->count; k++) {
        const struct knot *child = &p->knots[knot->first + k];
        draw_line(out, x_of(knot), y_of(knot), x_of(child), y_of(child));
        draw_edges(out, p, knot->first + k);
    }
    for (uint32_t k = 0; knot->open && k < knot->dots; k++) {
        double x = x_of(knot) + (k == 0 ? -6 : 6);
        draw_line(out, x_of(knot), y_of(knot), x, y_of(knot) + 19);
    }
}

static void draw_text(FILE *out, double x, double y, uint32_t value)
{
    fprintf(out, "<text x=\"%.1f\" y=\"%.1f\">%" PRIu32 "</text>\n", x, y, value);
}

static void draw_closed(FILE *out, const struct knot *knot, double x, double y)
{
    fprintf(out,
            "<path class=\"more\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"><title>%" PRIu32
            " nodes in %" PRIu32 " levels, %" PRIu32 " faces</title></path>\n",
            x, y - RADIUS, x - 13, y + RADIUS, x + 13, y + RADIUS, knot->nodes_below, knot->levels,
            knot->faces_below);
    draw_text(out, x, y + 8, knot->nodes_below);
}

static void draw_knot(FILE *out, const struct knot *knot)
{
    double x = x_of(knot);
    double y = y_of(knot);
    if (!knot->open) {
        draw_closed(out, knot, x, y);
        return;
    }
    for (uint32_t k = 0; k < knot->dots; k++) {
        fprintf(out, "<circle class=\"face\" cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>\n",
                x + (k == 0 ? -6 : 6), y + 19);
    }
    if (knot->is_switch) {
        fprintf(out,
                "<circle class=\"switch\" cx=\"%.1f\" cy=\"%.1f\" r=\"%d\"><title>switch, %" PRIu32
                " faces in its plane</title></circle>\n",
                x, y, RADIUS, knot->faces);
    } else {
        fprintf(out,
                "<rect class=\"sequence\" x=\"%.1f\" y=\"%.1f\" width=\"26\" height=\"%d\">"
                "<title>sequence of %" PRIu32 " faces and %" PRIu32 " nodes</title></rect>\n",
                x - 13, y - 9, 18, knot->faces, knot->count);
    }
    draw_text(out, x, y + 3.5, knot->faces);
}

static void draw_all(FILE *out, const struct plot *p, uint32_t number)
{
    const struct knot *knot = &p->knots[number];
    draw_knot(out, knot);
    for (uint32_t k = 0; knot->open && k < knot->count; k++) {
        draw_all(out, p, knot->first + k);
    }
}

static const char style[] =
    "<style>line{stroke:#888}text{font:9px sans-serif;text-anchor:middle}"
    ".head{font:12px sans-serif;text-anchor:start}"
    ".switch{fill:#fff;stroke:#136}.sequence{fill:#fd8;stroke:#850}.face{fill:#136}"
    ".more{fill:#dde;stroke:#136}</style>\n";

static void draw_head(FILE *out, const struct plot *p)
{
    const struct ow_tree *tree = p->tree;
    double width = 2 * MARGIN + COLUMN * p->columns;
    width = width < 560 ? 560 : width;
    fprintf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\">\n",
            width, TOP + ROW * (p->deepest + 1.5));
    fputs(style, out);
    fputs("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", out);
    fprintf(out,
            "<text class=\"head\" x=\"%d\" y=\"20\">%" PRIu32 " switches (circles), %" PRIu32
            " sequences (boxes), %" PRIu32 " faces (the numbers), %" PRIu32 " levels</text>\n",
            MARGIN, tree->switch_count, tree->node_count - tree->switch_count, tree->face_count,
            tree->depth);
    if (p->opened < tree->node_count) {
        fprintf(out,
                "<text class=\"head\" x=\"%d\" y=\"38\">%" PRIu32
                " nodes are drawn; a triangle stands for as many as it says</text>\n",
                MARGIN, p->opened);
    }
}

void plot_tree(FILE *out, const struct ow_tree *tree)
{
    struct plot plot = { .tree = tree };
    plot.knots = xalloc_zero(tree->node_count, sizeof *plot.knots);
    read_knots(&plot);
    open_largest(&plot);
    place(&plot, 0);
    draw_head(out, &plot);
    draw_edges(out, &plot, 0);
    draw_all(out, &plot, 0);
    fputs("</svg>\n", out);
    free(plot.knots);
}
