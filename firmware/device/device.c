/* SPDX-License-Identifier: 0BSD */
/* The device's loop. */
#include "device.h"

#include "message.h"
#include "text.h"

enum {
    RETRY_US = 1000000,   /* after a panel failed */
    WAKE_US = 500000,     /* the longest sleep: the watchdog wants to be fed */
    PIECES_A_STEP = 4096, /* of the stream, before anything else gets its turn */
    COMMAND_INFO = '?',
    COMMAND_STOP = 's',
    COMMAND_NEXT = 'n',
    COMMAND_GO = 'g',
    COMMAND_BUILT_IN = 'b'
};

static void print(const struct ow_device *device, enum ow_log_level level, const char *text)
{
    (void)ow_board_log(device->config.board, level, text);
}

/* ---- time, which can be stopped ---- */

static uint64_t board_now(const struct ow_device *device)
{
    const struct ow_clock *clock = device->config.viewer.clock;
    uint64_t now_us = 0;
    (void)clock->ops->now(clock->device, &now_us);
    return now_us;
}

static int now(void *context, uint64_t *time_us)
{
    const struct ow_device *device = context;
    *time_us = device->time_stopped ? device->stopped_us : board_now(device) - device->behind_us;
    return OW_OK;
}

/* Not longer than the watchdog allows: the caller asks again. */
static int wait_on_board(const struct ow_device *device, uint64_t until_us)
{
    const struct ow_wait *wait = device->config.viewer.wait;
    uint64_t latest_us = board_now(device) + WAKE_US;
    return wait->ops->wait(wait->device, until_us < latest_us ? until_us : latest_us);
}

static int wait_until(void *context, uint64_t until_us)
{
    struct ow_device *device = context;
    if (!device->time_stopped) {
        bool never = until_us == OW_TIME_NEVER;
        return wait_on_board(device, never ? until_us : until_us + device->behind_us);
    }
    if (device->moments > 0 && until_us != OW_TIME_NEVER) {
        device->moments--;
        device->stopped_us = until_us;
        return 0;
    }
    return wait_on_board(device, OW_TIME_NEVER);
}

static int sleep_until(void *context, uint64_t until_us)
{
    return wait_until(context, until_us);
}

/* Events carry the board's time; the viewer is to compare them with its own. */
static int next_event(void *context, struct ow_input_event *event)
{
    const struct ow_device *device = context;
    const struct ow_input *input = device->config.viewer.input;
    int status = input->ops->next(input->device, event);
    if (status == OW_OK) {
        event->time_us =
            device->time_stopped ? device->stopped_us : event->time_us - device->behind_us;
    }
    return status;
}

static const struct ow_input_ops input_ops = { .next = next_event };
static const struct ow_clock_ops clock_ops = { .now = now, .sleep = sleep_until };
static const struct ow_wait_ops wait_ops = { .wait = wait_until };

static void stop_time(struct ow_device *device)
{
    if (!device->time_stopped) {
        (void)now(device, &device->stopped_us);
        device->time_stopped = true;
        device->moments = 0;
    }
}

static void let_time_go(struct ow_device *device)
{
    if (device->time_stopped) {
        device->time_stopped = false;
        device->behind_us = board_now(device) - device->stopped_us;
    }
}

/* ---- messages ---- */

static void say(struct ow_device *device, const char *what, int status)
{
    struct text text = { 0 };
    text_add(&text, what);
    text_add(&text, ":\n");
    text_add(&text, ow_status_text(status));
    int shown = message_show(device->config.viewer.panel, text.bytes, device->config.memory,
                             device->config.memory_bytes);
    text = (struct text){ 0 };
    text_add(&text, what);
    text_add(&text, ": ");
    text_add(&text, ow_status_text(status));
    print(device, OW_LOG_ERROR, text.bytes);
    if (shown < 0 && shown != status) {
        text = (struct text){ 0 };
        text_add(&text, "panel: ");
        text_add(&text, ow_status_text(shown));
        print(device, OW_LOG_ERROR, text.bytes);
    }
    device->state = OW_DEVICE_SAYS;
    device->status = status;
}

static void print_shown(const struct ow_device *device, const char *what)
{
    const struct ow_viewer *viewer = &device->viewer;
    struct text text = { 0 };
    text_add(&text, what);
    text_pair(&text, "frame", (int32_t)viewer->frames);
    text_pair(&text, "view", (int32_t)viewer->number);
    text_pair(&text, "turn", (int32_t)viewer->turn);
    text_pair(&text, "tilt", viewer->tilt);
    text_pair(&text, "polygons", (int32_t)viewer->stats.polygons_painted);
    print(device, OW_LOG_INFO, text.bytes);
}

/* What the viewer would take for the tree of the moment, and what there is. */
static void print_memory(const struct ow_device *device)
{
    struct text text = { 0 };
    text_add(&text, "memory");
    text_pair(&text, "viewer", (int32_t)ow_viewer_bytes_needed(&device->viewer.config));
    text_pair(&text, "of", (int32_t)device->config.memory_bytes);
    text_pair(&text, "arena", (int32_t)device->config.arena_bytes);
    if (device->config.stack_used != NULL) {
        text_pair(&text, "stack", (int32_t)device->config.stack_used());
        text_pair(&text, "of", (int32_t)device->config.stack_bytes);
    }
    print(device, OW_LOG_INFO, text.bytes);
}

static void print_info(const struct ow_device *device)
{
    const struct ow_tree *tree = &device->tree;
    struct text text = { 0 };
    if (device->state == OW_DEVICE_SHOWS) {
        print_shown(device, "shows");
    }
    text_add(&text, "tree");
    text_pair(&text, "bytes", (int32_t)tree->blob_bytes);
    text_pair(&text, "polygons", (int32_t)tree->polygon_count);
    text_pair(&text, "vertices", (int32_t)tree->vertex_count);
    print(device, OW_LOG_INFO, text.bytes);
    print_memory(device);
}

/* ---- trees ---- */

static void show_tree(struct ow_device *device, const char *what, const void *bytes, uint32_t size)
{
    struct ow_viewer_config config = device->config.viewer;
    if (device->config.place != NULL) {
        bytes = device->config.place(bytes, size);
    }
    int status = bytes == NULL ? OW_MEMORY : (int)ow_tree_open(&device->tree, bytes, size);
    if (status < 0) {
        say(device, what, status);
        return;
    }
    config.tree = &device->tree;
    config.clock = &device->clock;
    config.wait = &device->wait;
    config.input = config.input != NULL ? &device->input : NULL;
    status = ow_viewer_start(&device->viewer, &config, device->config.memory,
                             device->config.memory_bytes);
    if (status < 0) {
        say(device, what, status);
        print_memory(device);
        return;
    }
    device->state = OW_DEVICE_SHOWS;
    device->status = OW_OK;
    print_info(device);
}

static void show_built_in(struct ow_device *device)
{
    show_tree(device, "built-in tree", device->config.tree, device->config.tree_bytes);
}

void ow_device_start(struct ow_device *device, const struct ow_device_config *config)
{
    *device = (struct ow_device){
        .config = *config,
        .receiver = { .arena = config->arena, .capacity = config->arena_bytes },
    };
    device->clock = (struct ow_clock){ &clock_ops, device };
    device->wait = (struct ow_wait){ &wait_ops, device };
    device->input = (struct ow_input){ &input_ops, device };
    show_built_in(device);
}

/* ---- the stream ---- */

static void obey(struct ow_device *device, char command)
{
    switch (command) {
    case COMMAND_INFO:
        print_info(device);
        break;
    case COMMAND_STOP:
        stop_time(device);
        break;
    case COMMAND_NEXT:
        device->moments++;
        break;
    case COMMAND_GO:
        let_time_go(device);
        break;
    case COMMAND_BUILT_IN:
        show_built_in(device);
        break;
    default: /* noise on the line */
        break;
    }
}

static void end_receiving(struct ow_device *device)
{
    const char *what = "received tree";
    if (device->receiver.refused != OW_OK) {
        say(device, what, device->receiver.refused);
    } else {
        show_tree(device, what, device->receiver.arena, device->receiver.needed);
    }
}

/* The tree in the arena is about to be written over: nothing may draw it any more. */
static void begin_receiving(struct ow_device *device)
{
    device->state = OW_DEVICE_RECEIVES;
    (void)message_show(device->config.viewer.panel, "receiving a tree", device->config.memory,
                       device->config.memory_bytes);
}

static void take_bytes(struct ow_device *device)
{
    struct receiver *receiver = &device->receiver;
    for (uint32_t i = 0; i < PIECES_A_STEP && device->config.stream != NULL; i++) {
        char command;
        switch (receiver_take(receiver, device->config.stream, board_now(device), &command)) {
        case RECEIVER_NOTHING:
            return;
        case RECEIVER_BUSY:
            if (device->state != OW_DEVICE_RECEIVES && receiver->got >= 4) {
                begin_receiving(device);
            }
            break;
        case RECEIVER_COMMAND:
            obey(device, command);
            break;
        case RECEIVER_TREE:
            end_receiving(device);
            break;
        case RECEIVER_GONE:
            device->config.stream = NULL;
            break;
        }
    }
}

/* ---- the loop ---- */

/* Devices that fail may come back; what the tree or the configuration is to blame for may not. */
static bool may_come_back(int status)
{
    return status == OW_GONE || status == OW_BUS || status == OW_TIMEOUT || status == OW_BUSY ||
           status == OW_AGAIN;
}

static void draw(struct ow_device *device)
{
    if (device->failed && board_now(device) < device->again_us) {
        (void)wait_on_board(device, device->again_us);
        return;
    }
    int status = ow_viewer_step(&device->viewer);
    if (status >= 0) {
        if (status > 0 && device->time_stopped) {
            print_shown(device, "stopped:");
        }
        device->failed = false;
        return;
    }
    if (!may_come_back(status)) {
        say(device, "drawing", status);
        return;
    }
    if (!device->failed) {
        struct text text = { 0 };
        text_add(&text, "panel: ");
        text_add(&text, ow_status_text(status));
        text_add(&text, "; trying again every second");
        print(device, OW_LOG_ERROR, text.bytes);
    }
    device->failed = true;
    device->again_us = board_now(device) + RETRY_US;
}

void ow_device_step(struct ow_device *device)
{
    if (device->config.watchdog_us > 0) {
        (void)ow_board_watchdog(device->config.board, device->config.watchdog_us);
    }
    take_bytes(device);
    switch (device->state) {
    case OW_DEVICE_SHOWS:
        draw(device);
        break;
    case OW_DEVICE_RECEIVES: /* the next piece, or the end of patience */
        (void)wait_on_board(device, board_now(device) + WAKE_US);
        break;
    case OW_DEVICE_SAYS:
        (void)wait_on_board(device, OW_TIME_NEVER);
        break;
    }
}
