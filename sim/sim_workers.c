/* SPDX-License-Identifier: 0BSD */
/* Workers on a host: each job has a number; a thread runs when the number has moved on. */
#include "sim/sim_workers.h"

#include <pthread.h>
#include <stdlib.h>

struct sim_worker {
    struct sim_workers *pool;
    pthread_t thread;
    uint32_t number;
};

struct sim_workers {
    pthread_mutex_t lock;
    pthread_cond_t begun; /* a new job, or the end */
    pthread_cond_t ended; /* the last thread is done with the job */
    void (*job)(void *context, uint32_t worker);
    void *context;
    uint64_t jobs;    /* begun so far */
    uint32_t at_work; /* threads that are not done with the last one */
    uint32_t count;
    bool stopping;
    struct sim_worker threads[];
};

static void *work(void *argument)
{
    struct sim_worker *self = argument;
    struct sim_workers *pool = self->pool;
    uint64_t done = 0;
    pthread_mutex_lock(&pool->lock);
    for (;;) {
        while (pool->jobs == done && !pool->stopping) {
            pthread_cond_wait(&pool->begun, &pool->lock);
        }
        if (pool->stopping) {
            break;
        }
        done = pool->jobs;
        pthread_mutex_unlock(&pool->lock);
        pool->job(pool->context, self->number);
        pthread_mutex_lock(&pool->lock);
        if (--pool->at_work == 0) {
            pthread_cond_signal(&pool->ended);
        }
    }
    pthread_mutex_unlock(&pool->lock);
    return NULL;
}

static int run(void *device, void (*job)(void *context, uint32_t worker), void *context)
{
    struct sim_workers *pool = device;
    pthread_mutex_lock(&pool->lock);
    pool->job = job;
    pool->context = context;
    pool->at_work = pool->count - 1;
    pool->jobs++;
    pthread_cond_broadcast(&pool->begun);
    pthread_mutex_unlock(&pool->lock);
    job(context, 0);
    pthread_mutex_lock(&pool->lock);
    while (pool->at_work > 0) {
        pthread_cond_wait(&pool->ended, &pool->lock);
    }
    pthread_mutex_unlock(&pool->lock);
    return OW_OK;
}

struct sim_workers *sim_workers_start(uint32_t count)
{
    struct sim_workers *pool = calloc(1, sizeof *pool + count * sizeof pool->threads[0]);
    if (pool == NULL) {
        return NULL;
    }
    pthread_mutex_init(&pool->lock, NULL);
    pthread_cond_init(&pool->begun, NULL);
    pthread_cond_init(&pool->ended, NULL);
    pool->count = 1;
    for (uint32_t i = 1; i < count; i++) {
        pool->threads[i] = (struct sim_worker){ .pool = pool, .number = i };
        if (pthread_create(&pool->threads[i].thread, NULL, work, &pool->threads[i]) != 0) {
            sim_workers_stop(pool);
            return NULL;
        }
        pool->count++;
    }
    return pool;
}

struct ow_workers sim_workers_seam(struct sim_workers *workers)
{
    static const struct ow_workers_ops ops = { .run = run };
    return (struct ow_workers){ &ops, workers, workers->count };
}

void sim_workers_stop(struct sim_workers *workers)
{
    if (workers == NULL) {
        return;
    }
    pthread_mutex_lock(&workers->lock);
    workers->stopping = true;
    pthread_cond_broadcast(&workers->begun);
    pthread_mutex_unlock(&workers->lock);
    for (uint32_t i = 1; i < workers->count; i++) {
        pthread_join(workers->threads[i].thread, NULL);
    }
    pthread_cond_destroy(&workers->ended);
    pthread_cond_destroy(&workers->begun);
    pthread_mutex_destroy(&workers->lock);
    free(workers);
}
