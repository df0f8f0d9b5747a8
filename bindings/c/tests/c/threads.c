/* Models in threads: many at once, each in its own; one that threads use in turns; one that goes
 * from the thread that made it to another that frees it.
 */
#define _POSIX_C_SOURCE 200809L
#include "expect.h"
#include <pthread.h>

#define THREADS 8
#define MODELS 20
#define TURNS 2000

/* Counts the enables of a period in 1000 ticks, with models that are made, saved and freed. */
static void *own_models(void *argument)
{
    uint64_t period = *(const int *)argument, enable;
    int round, tick;

    for (round = 0; round < MODELS; round++) {
        mrtl_model model = created("enable_counter", "width=8");
        int32_t output = found(model, "enable");
        mrtl_snapshot state;
        int enables = 0;

        EXPECT(mrtl_set(model, found(model, "period"), period), MRTL_OK);
        state = mrtl_save(model);
        EXPECT(mrtl_step(model, 3), MRTL_OK);
        EXPECT(mrtl_restore(model, state), MRTL_OK);
        for (tick = 0; tick < 1000; tick++) {
            EXPECT(mrtl_get(model, output, &enable), MRTL_OK);
            enables += (int)enable;
            EXPECT(mrtl_step(model, 1), MRTL_OK);
        }
        EXPECT(enables, 1000 / (int)period);
        EXPECT(mrtl_free_snapshot(state), MRTL_OK);
        EXPECT(mrtl_free(model), MRTL_OK);
        EXPECT(mrtl_step(model, 1), MRTL_WRONG_HANDLE);
    }
    return NULL;
}

struct shared {
    mrtl_model model;
    pthread_mutex_t lock;
};

/* Steps a model that other threads step too, under a lock. */
static void *in_turns(void *argument)
{
    struct shared *shared = argument;
    int turn;

    for (turn = 0; turn < TURNS; turn++) {
        pthread_mutex_lock(&shared->lock);
        EXPECT(mrtl_step(shared->model, 1), MRTL_OK);
        pthread_mutex_unlock(&shared->lock);
    }
    return NULL;
}

static void *last_use(void *argument)
{
    mrtl_model model = *(const mrtl_model *)argument;

    EXPECT(mrtl_step(model, 5), MRTL_OK);
    EXPECT(tick_of(model), THREADS * TURNS + 5);
    EXPECT(bits_of(model, "count"), (THREADS * TURNS + 5) % 100);
    EXPECT(mrtl_free(model), MRTL_OK);
    return NULL;
}

int main(void)
{
    struct shared shared = {0, PTHREAD_MUTEX_INITIALIZER};
    pthread_t threads[THREADS];
    int periods[THREADS], thread;

    for (thread = 0; thread < THREADS; thread++) {
        periods[thread] = thread + 3;
        EXPECT(pthread_create(&threads[thread], NULL, own_models, &periods[thread]), 0);
    }
    for (thread = 0; thread < THREADS; thread++)
        EXPECT(pthread_join(threads[thread], NULL), 0);

    shared.model = created("enable_counter", "width=8");
    EXPECT(mrtl_set(shared.model, found(shared.model, "period"), 100), MRTL_OK);
    for (thread = 0; thread < THREADS; thread++)
        EXPECT(pthread_create(&threads[thread], NULL, in_turns, &shared), 0);
    for (thread = 0; thread < THREADS; thread++)
        EXPECT(pthread_join(threads[thread], NULL), 0);
    EXPECT(pthread_create(&threads[0], NULL, last_use, &shared.model), 0);
    EXPECT(pthread_join(threads[0], NULL), 0);
    EXPECT(mrtl_tick(shared.model, NULL), MRTL_WRONG_HANDLE);

    printf("PASS\n");
    return 0;
}
