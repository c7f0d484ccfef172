/* SPDX-License-Identifier: 0BSD */
/*
 * The viewer: input -> view -> draw -> present, one round a call. It knows the
 * core and the HAL's interfaces, uses no heap, and draws only when something
 * changed. Freestanding: the same source runs on a chip and in the simulator.
 */
#ifndef OW_VIEWER_H
#define OW_VIEWER_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/clock.h"
#include "hal/input.h"
#include "hal/panel.h"
#include "hal/wait.h"
#include "hal/workers.h"
#include "ow_draw.h"

/* What a control does. */
enum ow_action {
    OW_ACTION_TURN, /* the eye goes round the model; amount: share of a turn, 2^32 a full one */
    OW_ACTION_TILT, /* the eye rises; amount likewise, stops a degree before the pole */
    OW_ACTION_ZOOM, /* amount: levels, each brings the eye nearer by 17/16 */
    OW_ACTION_HOME  /* back to the start, and turning by itself again */
};

/*
 * A press acts once, and again every repeat_us while it is held; a turn acts
 * as often as it has steps; an axis sets what it controls to its share of the
 * amount. HOME acts on a press.
 */
struct ow_binding {
    uint16_t control; /* enum ow_control, or the board's own number */
    uint8_t action;   /* enum ow_action */
    int32_t amount;
};

enum { OW_BINDINGS_MAX = 32 }; /* one bit each in a word that says which are held */

/* Left, right: 10 degrees; up, down: 5; in, out: a level; knobs and axes likewise; select: home. */
extern const struct ow_binding ow_default_bindings[];
extern const uint32_t ow_default_binding_count;

/* What comes after the last view. */
enum ow_viewer_end {
    OW_VIEWER_STOP,   /* the viewer has finished */
    OW_VIEWER_REPEAT, /* the first view again */
    OW_VIEWER_HOLD    /* it stays, until no input can come any more */
};

/* Where time is measured by those who want it: a bench, a cycle counter. */
enum ow_probe { OW_PROBE_DRAW_BEGIN, OW_PROBE_DRAW_END };

struct ow_viewer_config {
    const struct ow_tree *tree;
    struct ow_look look;
    struct ow_camera camera; /* the lens: projection, fov or height, near */

    /* Views: a list, if view is given, or one turn of the standard orbit in equal steps. */
    uint32_t views; /* how many, at least 1 */
    bool cuts;      /* ow_view_cut with these */
    int32_t cut_normal[3];
    ow_q8 cut_distance;
    uint64_t interval_us; /* between two views' starts; 0: as fast as it goes */
    enum ow_viewer_end end;
    ow_turn elevation; /* orbit: of the eye above the horizon */
    /* Fills eye, at and up of view 0 .. views-1, may change the lens; OW_OK or a status. */
    int (*view)(void *context, uint32_t number, struct ow_camera *camera);
    void *view_context;

    /* Input moves the eye on the orbit; a list takes none. */
    const struct ow_binding *bindings; /* NULL: ow_default_bindings */
    uint32_t binding_count;            /* at most OW_BINDINGS_MAX */
    uint32_t repeat_us;                /* of a button that is held; 0: it does not repeat */

    const struct ow_parts *parts; /* as in struct ow_workspace_config */

    /* Memory against speed. */
    uint16_t band_lines;      /* drawn at a time, rounded up to the panel's alignment; 0: all */
    uint8_t bands;            /* 1, or 2: draw one while the panel takes the other; 0 means 1 */
    uint32_t cached_vertices; /* as in struct ow_workspace_config */
    uint32_t listed_faces;    /* likewise; 0 unless the order is OW_SCAN_LINE */
    bool find_changes;        /* a bit a pixel: lending panels are told what changed */

    /* Devices. Panel and clock are mandatory, the others may be NULL. All outlive the viewer. */
    const struct ow_panel *panel;
    const struct ow_clock *clock;
    const struct ow_input *input;
    const struct ow_wait *wait;
    const struct ow_workers *workers; /* NULL: one; each needs a workspace */
    uint8_t quarter_turns; /* of the picture, clockwise, 0 .. 3: by the panel if it can */
    uint32_t timeout_us;   /* for pixels on their way to the panel; 0: a second */

    void (*probe)(void *context, enum ow_probe point); /* NULL: nobody measures */
    void *probe_context;
};

/* What each worker has of its own. Private. */
struct ow_viewer_worker {
    struct ow_workspace workspace;
    struct ow_stats stats;
    int status;
};

/* Fields down to `stats` are for reading, the rest is private. */
struct ow_viewer {
    bool finished;   /* no step will draw any more */
    uint32_t number; /* of the view drawn last or to be drawn next */
    uint32_t frames; /* shown since the start */
    enum ow_status
        drawn; /* of the last frame: OW_OK, OW_CAPACITY, OW_BUDGET (something was left out) or OW_REGION */
    struct ow_view view;   /* of the last frame, turned as the panel needs it */
    uint8_t turned;        /* quarter turns that the panel leaves to the projection */
    struct ow_stats stats; /* of the last frame */

    struct ow_look look; /* the configured one, its light turned with the picture */
    struct ow_viewer_config config;
    struct ow_panel_info panel;
    struct ow_viewer_worker *worker; /* workers of them, in the memory given */
    uint32_t workers;
    struct ow_changes changes;
    uint8_t *band[2];
    uint32_t band_stride; /* bytes */
    uint16_t band_lines;
    bool changed; /* the panel does not show the present view yet */
    bool manual;  /* input has moved the eye: no more turning by itself */
    bool input_gone;
    ow_turn turn; /* by input, on top of the view's own */
    int32_t tilt;
    int32_t zoom;
    uint64_t due_us; /* when the next view starts */
    uint32_t held;   /* a bit a binding */
    uint64_t repeat_us;
};

/*
 * Bytes that ow_viewer_start needs: workspace and bands. Asks the panel for
 * its size. 0: the configuration is out of range or the panel does not answer.
 */
uint32_t ow_viewer_bytes_needed(const struct ow_viewer_config *config);

/*
 * Checks the devices and gets ready for the first view. memory: aligned to 8
 * bytes, kept until the viewer is no longer used; *config is copied. Errors:
 * OW_ARGUMENT, OW_MEMORY, OW_UNSUPPORTED (a mandatory function is missing), or
 * what the panel reports.
 */
int ow_viewer_start(struct ow_viewer *viewer, const struct ow_viewer_config *config, void *memory,
                    uint32_t bytes);

/*
 * One round. Returns 1: a frame is on the panel; 0: nothing was to be drawn, it
 * slept until something may have changed; or a status: of the view
 * (OW_ARGUMENT), of drawing (OW_SIDES) or of a device. After a failure nothing
 * is in flight (but after OW_TIMEOUT), and the next round draws the frame anew.
 */
int ow_viewer_step(struct ow_viewer *viewer);

/* From the first view again. */
void ow_viewer_restart(struct ow_viewer *viewer);

/* Where the eye has got to: what a viewer that takes another's place goes on with. */
struct ow_viewer_place {
    uint32_t number; /* of the view */
    ow_turn turn;    /* by input, on top of it */
    int32_t tilt;
    int32_t zoom;
    bool manual; /* it does not turn by itself: input has moved the eye */
};

void ow_viewer_get_place(const struct ow_viewer *viewer, struct ow_viewer_place *place);

/* To be drawn next. A number of more views than there are begins with the first. */
void ow_viewer_set_place(struct ow_viewer *viewer, const struct ow_viewer_place *place);

/* The present view must be drawn again: the tree behind it was changed, the panel came back. */
void ow_viewer_refresh(struct ow_viewer *viewer);

#endif
