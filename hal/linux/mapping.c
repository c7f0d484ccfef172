/* SPDX-License-Identifier: 0BSD */
/* A SIGBUS handler that puts zeros where a device's memory was. */
#define _GNU_SOURCE /* MAP_ANONYMOUS */
#include "hal/linux/mapping.h"

#include <errno.h>
#include <signal.h>
#include <stdint.h>
#include <sys/mman.h>

/* Read by the handler. An entry counts while bytes is not 0, which is written last. */
struct mapping {
    uint8_t *volatile memory;
    volatile size_t bytes;
    volatile sig_atomic_t lost;
};

static struct mapping mappings[LINUX_MAPPINGS];

static void on_bus_error(int number, siginfo_t *info, void *context)
{
    int saved = errno;
    uintptr_t at = (uintptr_t)info->si_addr;
    (void)context;
    for (size_t i = 0; i < LINUX_MAPPINGS; i++) {
        struct mapping *mapping = &mappings[i];
        uintptr_t start = (uintptr_t)mapping->memory;
        if (mapping->bytes == 0 || at < start || at - start >= mapping->bytes) {
            continue;
        }
        if (mmap(mapping->memory, mapping->bytes, PROT_READ | PROT_WRITE,
                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED) {
            mapping->lost = 1;
            errno = saved;
            return;
        }
    }
    signal(number, SIG_DFL); /* not ours: the same access ends the program now */
}

static void install(void)
{
    static bool installed;
    struct sigaction action = { .sa_sigaction = on_bus_error, .sa_flags = SA_SIGINFO };
    if (!installed) {
        sigemptyset(&action.sa_mask);
        installed = sigaction(SIGBUS, &action, NULL) == 0;
    }
}

static struct mapping *find(const void *memory)
{
    for (size_t i = 0; i < LINUX_MAPPINGS; i++) {
        if (mappings[i].bytes != 0 && mappings[i].memory == memory) {
            return &mappings[i];
        }
    }
    return NULL;
}

void *linux_map(const struct linux_system *system, size_t bytes, int fd, uint64_t offset)
{
    install();
    void *memory = system->mmap(bytes, fd, offset);
    if (memory == MAP_FAILED) {
        return NULL;
    }
    for (size_t i = 0; i < LINUX_MAPPINGS; i++) {
        if (mappings[i].bytes == 0) {
            mappings[i].memory = memory;
            mappings[i].lost = 0;
            mappings[i].bytes = bytes;
            return memory;
        }
    }
    (void)system->munmap(memory, bytes);
    errno = ENOMEM;
    return NULL;
}

bool linux_map_is_lost(const void *memory)
{
    const struct mapping *mapping = find(memory);
    return mapping != NULL && mapping->lost != 0;
}

void linux_unmap(const struct linux_system *system, void *memory, size_t bytes)
{
    struct mapping *mapping = find(memory);
    if (mapping != NULL) {
        mapping->bytes = 0;
    }
    (void)system->munmap(memory, bytes);
}
