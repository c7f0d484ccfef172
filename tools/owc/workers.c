/* SPDX-License-Identifier: 0BSD */
/* Work shared among threads: each takes the next job until there is none. */
#include "workers.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

struct crew {
    void (*job)(void *context, uint32_t number, uint32_t thread);
    void *context;
    uint32_t count;
    atomic_uint next;
};

struct worker {
    struct crew *crew;
    pthread_t thread;
    uint32_t number;
};

static void *work(void *argument)
{
    const struct worker *worker = argument;
    struct crew *crew = worker->crew;
    for (;;) {
        uint32_t number = atomic_fetch_add(&crew->next, 1u);
        if (number >= crew->count) {
            return NULL;
        }
        crew->job(crew->context, number, worker->number);
    }
}

/* Where the system refuses a thread, the others do its work. */
void workers_run(uint32_t threads, uint32_t count,
                 void (*job)(void *context, uint32_t number, uint32_t thread), void *context)
{
    struct crew crew = { .job = job, .context = context, .count = count };
    struct worker workers[WORKERS_MOST];
    uint32_t most = threads < count ? threads : count;
    uint32_t started = 1;
    atomic_init(&crew.next, 0);
    while (started < most && started < WORKERS_MOST) {
        workers[started] = (struct worker){ .crew = &crew, .number = started };
        if (pthread_create(&workers[started].thread, NULL, work, &workers[started]) != 0) {
            break;
        }
        started++;
    }
    workers[0] = (struct worker){ .crew = &crew };
    work(&workers[0]);
    for (uint32_t i = 1; i < started; i++) {
        pthread_join(workers[i].thread, NULL);
    }
}

uint32_t workers_processors(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > WORKERS_MOST ? (uint32_t)WORKERS_MOST : (uint32_t)count;
}
