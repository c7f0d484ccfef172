/* SPDX-License-Identifier: 0BSD */
/*
 * Instances. An object's point v stands at R v + t in the tree's lattice. Seen
 * from the object the camera's axes are turned by R's inverse and the eye is
 * moved by t first; so a vertex is projected as ever, with a view of its own.
 */
#include "ow_instance.h"

#include "ow_light.h"

enum { ONE_Q8 = 256 };

/* What an eye is after turning: sqrt(3) < 7/4 as far as it could be before. */
#define TURNED_EYE_MAX (7LL * (OW_EYE_MAX + ONE_Q8 * (OW_LATTICE_MAX + 1LL)) / 4)
_Static_assert(TURNED_EYE_MAX < INT32_MAX, "a turned eye fits 32 bits");
_Static_assert(14LL * (OW_EYE_MAX / 4) + 2LL * ONE_Q8 * (OW_LATTICE_MAX + 1) < INT32_MAX,
               "a turned place of a light, and the way there from a vertex, fit 32 bits");
_Static_assert(3LL * 127 * ((TURNED_EYE_MAX >> 8) + OW_LATTICE_MAX + 1) < INT32_MAX,
               "the walk's test of facing fits 32 bits from a turned eye");

struct ow_instance ow_read_instance(const struct ow_tree *tree, uint32_t number)
{
    uint32_t at = tree->instances_at + number * OW_INSTANCE_BYTES;
    const ow_byte *bytes = tree->bytes + at;
    bool last = number + 1 == tree->instance_count;
    struct ow_instance instance = {
        .node_at = tree->nodes_at + 4 * ow_read_u32(bytes, 0),
        .first_vertex = ow_read_u32(bytes, 4),
        .end_vertex = last ? tree->vertex_count : ow_read_u32(bytes, OW_INSTANCE_BYTES + 4),
        .zero = ow_read_u32(bytes, 8),
        .radius = ow_read_u16(bytes, 30),
    };
    for (uint32_t i = 0; i < 3; i++) {
        instance.region_min[i] = ow_read_i16(bytes, 12 + 2 * i);
        instance.region_max[i] = ow_read_i16(bytes, 18 + 2 * i);
        instance.centre[i] = ow_read_i16(bytes, 24 + 2 * i);
    }
    return instance;
}

/* v turned back: R's transpose, rounded to the nearest. */
static void turn_back(int32_t turned[3], const struct ow_pose *pose, const int64_t v[3])
{
    for (int i = 0; i < 3; i++) {
        int64_t sum = 1 << 29;
        for (int k = 0; k < 3; k++) {
            sum += pose->rotation[k][i] * v[k];
        }
        turned[i] = (int32_t)(sum >> 30);
    }
}

/* No row is longer than a unit vector, as good as: nothing gets larger. */
static bool is_rotation(const struct ow_pose *pose)
{
    for (int i = 0; i < 3; i++) {
        uint64_t squares = 0;
        for (int k = 0; k < 3; k++) {
            int64_t r = pose->rotation[i][k];
            if (r > 1 << 30 || r < -(1 << 30)) {
                return false;
            }
            squares += (uint64_t)(r * r);
        }
        if (squares >> 40 > (1u << 20) + 4 || squares >> 40 < (1u << 20) - 4) {
            return false;
        }
    }
    return true;
}

enum place { IN_REGION, IN_CUBE, NOWHERE };

/* Where the pose puts the object's sphere. In the cube, no number gets too large. */
static enum place place_of(const struct ow_instance *instance, const struct ow_pose *pose)
{
    enum place place = IN_REGION;
    if (!is_rotation(pose)) {
        return NOWHERE;
    }
    const int64_t radius = (int64_t)instance->radius * ONE_Q8;
    const int64_t cube = OW_LATTICE_MAX * ONE_Q8;
    for (int i = 0; i < 3; i++) {
        int64_t sum = 0;
        for (int k = 0; k < 3; k++) {
            sum += (int64_t)pose->rotation[i][k] * instance->centre[k];
        }
        int64_t centre = (sum >> 22) + pose->place[i];
        if (centre - radius < -cube || centre + radius > cube) {
            return NOWHERE;
        }
        if (centre - radius < (int64_t)instance->region_min[i] * ONE_Q8 ||
            centre + radius > (int64_t)instance->region_max[i] * ONE_Q8) {
            place = IN_CUBE;
        }
    }
    return place;
}

/* The view as seen from the object. */
static void turn_view(struct ow_view *view, const struct ow_view *from, const struct ow_pose *pose)
{
    *view = *from;
    const ow_q30 *axes[3] = { from->right, from->up, from->forward };
    ow_q30 *turned[3] = { view->right, view->up, view->forward };
    int64_t eye[3];
    for (int a = 0; a < 3; a++) {
        int64_t axis[3];
        int64_t sum = 0; /* how far t lies along the axis, 38 fraction bits */
        for (int i = 0; i < 3; i++) {
            axis[i] = axes[a][i];
            sum += axis[i] * pose->place[i];
        }
        turn_back(turned[a], pose, axis);
        view->offset[a] = from->offset[a] + (sum >> 8);
        eye[a] = (int64_t)from->eye[a] - pose->place[a];
    }
    turn_back(view->eye, pose, eye);
    if (from->cuts) {
        const int64_t cut[3] = { from->cut_axis[0], from->cut_axis[1], from->cut_axis[2] };
        turn_back(view->cut_axis, pose, cut);
    }
}

/* The shader as seen from the object: normals and places are the object's. */
static void turn_shader(struct ow_shader *shader, const struct ow_shader *from,
                        const struct ow_view *view, const struct ow_pose *pose)
{
    *shader = *from;
    shader->view = view;
    for (uint32_t k = 0; k < from->directional; k++) {
        const struct ow_ready_light *given = &from->lights[k];
        struct ow_ready_light *light = &shader->lights[k];
        int32_t towards[3];
        int32_t halfway[3];
        turn_back(towards, pose,
                  (const int64_t[3]){ given->towards_q14[0], given->towards_q14[1],
                                      given->towards_q14[2] });
        turn_back(halfway, pose,
                  (const int64_t[3]){ given->halfway_q14[0], given->halfway_q14[1],
                                      given->halfway_q14[2] });
        for (int i = 0; i < 3; i++) {
            light->halfway_q14[i] = (int16_t)halfway[i];
        }
        ow_light_set_direction(light, towards);
    }
    for (uint32_t k = from->directional; k < from->directional + (uint32_t)from->points; k++) {
        int64_t way[3];
        for (int i = 0; i < 3; i++) {
            way[i] = (int64_t)from->lights[k].light_q16[i] - pose->place[i];
        }
        turn_back(shader->lights[k].light_q16, pose, way);
    }
    int32_t cap[3];
    turn_back(cap, pose,
              (const int64_t[3]){ from->cap_normal[0], from->cap_normal[1], from->cap_normal[2] });
    for (int i = 0; i < 3; i++) {
        shader->cap_normal[i] = (int8_t)cap[i];
    }
}

/* From now on all is done in the space of this view: frame, walk, skipping. */
static void see_by(struct ow_frame *frame, const struct ow_view *view)
{
    frame->view = view;
    frame->frustum.view = view;
    ow_walk_see_by(&frame->walk, view);
}

static void leave(void *context)
{
    struct ow_frame *frame = context;
    struct ow_instance_state *state = frame->workspace->instances;
    if (frame->instance != 0) {
        frame->instance = 0;
        frame->shader = state->tree_shader;
        see_by(frame, state->tree_view);
    }
}

/* Into the space of an instance. False if it is not to be drawn. */
static bool go_to(struct ow_frame *frame, uint32_t number)
{
    struct ow_instance_state *state = frame->workspace->instances;
    const struct ow_pose *pose = &frame->look->poses[number];
    struct ow_instance instance = ow_read_instance(frame->tree, number);
    if (frame->instance == number + 1) {
        return true;
    }
    leave(frame);
    if (place_of(&instance, pose) == NOWHERE) {
        return false;
    }
    frame->instance = number + 1;
    turn_view(&state->view, state->tree_view, pose);
    turn_shader(&state->shader, &state->tree_shader, &state->view, pose);
    frame->shader = state->shader;
    see_by(frame, &state->view);
    return true;
}

static bool enter(void *context, uint32_t number, uint32_t *node_at)
{
    struct ow_frame *frame = context;
    *node_at = ow_read_instance(frame->tree, number).node_at;
    return go_to(frame, number);
}

/* A face on its own, in the space that its vertices are in. */
static void go_to_face(struct ow_frame *frame)
{
    uint32_t vertex = ow_corner(frame->tree, frame->face.at, 0);
    uint32_t number = frame->tree->instance_count;
    while (number > 0 && vertex < ow_read_instance(frame->tree, number - 1).first_vertex) {
        number--;
    }
    if (number == 0) {
        leave(frame);
    } else {
        (void)go_to(frame, number - 1);
    }
}

/* All poses are judged; where each vertex has its place in the cache, it is put there. */
static void begin(struct ow_frame *frame)
{
    struct ow_instance_state *state = frame->workspace->instances;
    const struct ow_tree *tree = frame->tree;
    bool all = frame->workspace->cache_mask == OW_CACHE_ALL;
    state->tree_view = frame->view;
    state->tree_shader = frame->shader;
    for (uint32_t k = 0; k < tree->instance_count; k++) {
        struct ow_instance instance = ow_read_instance(tree, k);
        frame->instances_outside += place_of(&instance, &frame->look->poses[k]) != IN_REGION;
        if (all && go_to(frame, k)) {
            frame->clips |= ow_project_vertices(tree, frame->view, instance.first_vertex,
                                                instance.end_vertex, frame->workspace->points);
        }
    }
    leave(frame);
}

const struct ow_instancing ow_instancing = {
    .state_bytes = sizeof(struct ow_instance_state),
    .begin = begin,
    .enter = enter,
    .leave = leave,
    .go_to_face = go_to_face,
};
