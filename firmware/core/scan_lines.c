/* SPDX-License-Identifier: 0BSD */
/*
 * Priority scan line [FKN80]: the walk numbers the faces; they are listed by
 * the first line they touch. Line by line the faces at hand are drawn, the one
 * with the highest number first, on a dynamic screen of one line. No frame
 * buffer is needed: a target may be a single line.
 */
#include "ow_draw.h"
#include "ow_frame.h"

#define NO_FACE 0xFFFFFFFFu

uint32_t ow_listed_faces_max(const struct ow_tree *tree)
{
    return tree->face_count;
}

/* Farthest first, so that pushing at the head of a line's list leaves the nearest in front. */
static void list_faces(struct ow_frame *frame)
{
    struct ow_workspace *workspace = frame->workspace;
    for (uint32_t i = 0; i < frame->view->height; i++) {
        workspace->line_heads[i] = NO_FACE;
    }
    while (ow_walk_next(&frame->walk, &frame->face)) {
        struct ow_box box;
        if (!ow_face_outline(frame, &box)) {
            continue;
        }
        if (frame->listed == workspace->listed_capacity) {
            frame->unlisted++;
            continue;
        }
        workspace->listed[frame->listed] = (struct ow_listed_face){
            .at = frame->face.at,
            .next = workspace->line_heads[box.line],
            .end_line = (uint16_t)box.end_line,
            .reverse = frame->face.reverse,
        };
        workspace->line_heads[box.line] = frame->listed++;
    }
}

static enum ow_status begin(struct ow_frame *frame)
{
    if (frame->workspace->listed_capacity == 0 ||
        frame->view->height > frame->workspace->listed_height) {
        return OW_ARGUMENT;
    }
    list_faces(frame);
    frame->at_hand = NO_FACE;
    return OW_OK;
}

/* Merges a line's new faces into those at hand; both are sorted, highest number first. */
static void take_new_faces(struct ow_frame *frame, uint32_t line)
{
    struct ow_listed_face *listed = frame->workspace->listed;
    uint32_t *link = &frame->at_hand;
    uint32_t fresh = frame->workspace->line_heads[line];
    while (fresh != NO_FACE) {
        while (*link != NO_FACE && *link > fresh) {
            link = &listed[*link].next;
        }
        uint32_t next_fresh = listed[fresh].next;
        listed[fresh].next = *link;
        *link = fresh;
        link = &listed[fresh].next;
        fresh = next_fresh;
    }
}

static void draw_at_hand(struct ow_frame *frame, uint32_t line)
{
    struct ow_listed_face *listed = frame->workspace->listed;
    uint32_t *link = &frame->at_hand;
    while (*link != NO_FACE && frame->surface.lines_open > 0) {
        struct ow_listed_face *entry = &listed[*link];
        if (entry->end_line <= line) {
            *link = entry->next;
            continue;
        }
        frame->face = (struct ow_face){ entry->at, entry->reverse };
        if (frame->walk.instances.enter != NULL) {
            frame->workspace->parts->instances->go_to_face(frame);
        }
        if (ow_draw_face(frame) && !entry->painted) {
            entry->painted = true;
            frame->painted++;
        }
        link = &entry->next;
    }
}

/* With more faces than the list holds, each line walks the tree: slow, and the right picture. */
static void draw_line(struct ow_frame *frame, const struct ow_target *target, uint32_t line)
{
    const struct ow_surface_kind *kind = &ow_surface_dynamic;
    frame->line = *target;
    frame->line.line_count = 1;
    frame->line.first_line = (uint16_t)line;
    frame->line.pixels = ow_line_pixels(target, line);
    ow_frame_aim(frame, kind, &frame->line);
    kind->begin(&frame->surface, frame->background);
    if (frame->unlisted > 0) {
        ow_frame_walk(frame);
    } else {
        draw_at_hand(frame, line);
    }
    kind->end(&frame->surface, frame->background);
}

static enum ow_status draw(struct ow_frame *frame, const struct ow_target *target)
{
    if (target->first_line < frame->lines_done) {
        return OW_ARGUMENT;
    }
    uint32_t end_line = (uint32_t)target->first_line + target->line_count;
    for (; frame->lines_done < end_line; frame->lines_done++) {
        take_new_faces(frame, frame->lines_done);
        if (frame->lines_done >= target->first_line) {
            draw_line(frame, target, frame->lines_done);
        }
    }
    return OW_OK;
}

const struct ow_line_order ow_line_order = { begin, draw };
