/* SPDX-License-Identifier: 0BSD */
/* From the first frames on, the loop asks for no memory and gives none back. */
#define _DEFAULT_SOURCE
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "boards/linux/run.h"
#include "tests/unit/child.h"
#include "tests/unit/sim_scene.h"

/* ---- counting ---- */

static volatile bool counting;
static volatile uint32_t heap_calls;
static volatile uint32_t heap_calls_ever;

static void note_call(void)
{
    heap_calls_ever++;
    if (counting) {
        heap_calls++;
    }
}

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif

#ifdef SANITIZED
int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void *, size_t),
                                              void (*on_free)(const volatile void *));

static void on_malloc(const volatile void *memory, size_t bytes)
{
    (void)memory;
    (void)bytes;
    note_call();
}

static void on_free(const volatile void *memory)
{
    (void)memory;
    note_call();
}

static void begin_counting(void)
{
    assert_true(__sanitizer_install_malloc_and_free_hooks(on_malloc, on_free) > 0);
}
#else
/* glibc's own, under the names that it has for this purpose. */
extern void *__libc_malloc(size_t bytes);
extern void *__libc_calloc(size_t count, size_t bytes);
extern void *__libc_realloc(void *memory, size_t bytes);
extern void __libc_free(void *memory);

void *malloc(size_t bytes)
{
    note_call();
    return __libc_malloc(bytes);
}

void *calloc(size_t count, size_t bytes)
{
    note_call();
    return __libc_calloc(count, bytes);
}

void *realloc(void *memory, size_t bytes)
{
    note_call();
    return __libc_realloc(memory, bytes);
}

void free(void *memory)
{
    note_call();
    __libc_free(memory);
}

static void begin_counting(void)
{
}
#endif

/* ---- a run on a file; its writes are the frames ---- */

enum { WARM = 20, COUNTED = 100 };

static char folder[CHILD_PATH];
static struct linux_system system_calls;
static uint32_t frames;
static bool provoke; /* one call in the middle, to see that the test can fail */

static ssize_t count_frame(int fd, const void *bytes, size_t count)
{
    frames++;
    counting = frames >= WARM && frames < WARM + COUNTED;
    if (provoke && frames == WARM + 1) {
        void *volatile memory = malloc(1); /* the compiler may not leave out both */
        free(memory);
    }
    if (frames == WARM + COUNTED) {
        kill(getpid(), SIGTERM);
    }
    return linux_system.write(fd, bytes, count);
}

static void run_for_a_while(const char *tree)
{
    static struct run run;
    char path[CHILD_PATH];
    folder_path(path, folder, "frame");
    struct oldwell_settings settings = {
        .tree = tree,
        .panel = PANEL_FILE,
        .device = path,
        .size = { 64, 48 },
        .format = &ow_format_rgb565,
        .look = { .order = OW_FRONT_TO_BACK, .shade = OW_SHADE_FLAT, .ambient_q8 = 256 },
        .fov = 45,
        .orbit = 64,
        .fps = 1000,
        .stats = false,
    };
    frames = 0;
    heap_calls = 0;
    system_calls = linux_system;
    system_calls.write = count_frame;
    assert_int_equal(run_main(&run, &settings, &system_calls), 0);
    assert_true(frames >= WARM + COUNTED);
    counting = false;
}

static void drawing_leaves_the_heap_alone(void **state)
{
    run_for_a_while(*state);
    assert_true(heap_calls_ever > 0); /* the start has some: they are seen */
    assert_int_equal(heap_calls, 0);
    provoke = true;
    run_for_a_while(*state);
    assert_true(heap_calls > 0);
}

static int make_tree(void **state)
{
    static char path[CHILD_PATH];
    uint32_t size;
    uint8_t *blob = scene_cube(&size);
    begin_counting();
    *state = path;
    folder_make(folder);
    folder_path(path, folder, "tree.owt");
    FILE *stream = fopen(path, "wb");
    size_t written = stream != NULL ? fwrite(blob, 1, size, stream) : 0;
    bool good = stream != NULL && fclose(stream) == 0 && written == size;
    free(blob);
    return good ? 0 : -1;
}

static int remove_tree(void **state)
{
    (void)state;
    folder_remove(folder);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(drawing_leaves_the_heap_alone, make_tree, remove_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
