/* Two elements on two threads give the same bits as alone; of two threads with one element, one is refused; an element that one
 * thread frees is gone for the other.
 */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <sched.h>
#include <splashdown.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 30 };

struct fall {
    double sink; /* m/s */
    double forces[STEPS];
};

static void must(splashdown_status status)
{
    if (status != SPLASHDOWN_OK) {
        char message[1000];
        splashdown_message(message, sizeof message);
        fprintf(stderr, "error %d: %s\n", (int)status, message);
        exit(1);
    }
}

static splashdown_element *wedge(double at[2], double v[2])
{
    const char *settings[] = {"resolution.spacing=0.02", "time.end=0.02"};
    double angle, spin;
    splashdown_scene *scene;
    splashdown_element *element;
    must(splashdown_open("wedge", settings, 2, SPLASHDOWN_BODY, &scene));
    must(splashdown_scene_nodes(scene, at, v, &angle, &spin, 1));
    must(splashdown_build(scene, at, v, &angle, &spin, 1, &element));
    return element;
}

static void *falls(void *given)
{
    struct fall *fall = given;
    double at[2], v[2], angle = 0.0, spin = 0.0, force[3];
    splashdown_element *element = wedge(at, v);
    v[1] = -fall->sink;
    for (int step = 0; step < STEPS; ++step) {
        at[1] += 1e-4 * v[1];
        must(splashdown_contribute(element, 1e-4, at, v, &angle, &spin, 1, force, NULL));
        fall->forces[step] = force[1];
    }
    must(splashdown_free_element(element));
    return NULL;
}

struct shared {
    splashdown_element *element;
    double at[2], v[2];
    atomic_int done, refused;
};

static void *shares(void *given)
{
    struct shared *shared = given;
    const double angle = 0.0, spin = 0.0;
    double force[3];
    while (atomic_load(&shared->done) < 20 || atomic_load(&shared->refused) == 0) {
        splashdown_status status =
            splashdown_contribute(shared->element, 1e-4, shared->at, shared->v, &angle, &spin, 1, force, NULL);
        if (status == SPLASHDOWN_OK) {
            atomic_fetch_add(&shared->done, 1);
        } else if (status == SPLASHDOWN_BUSY) {
            atomic_fetch_add(&shared->refused, 1);
            sched_yield();
        } else {
            must(status);
        }
    }
    return NULL;
}

/* Frees the element as soon as no other call runs. */
static void *frees(void *given)
{
    struct shared *shared = given;
    while (splashdown_free_element(shared->element) == SPLASHDOWN_BUSY) {
        sched_yield();
    }
    return NULL;
}

/* Steps until the element is gone. */
static void *outlives(void *given)
{
    struct shared *shared = given;
    const double angle = 0.0, spin = 0.0;
    double force[3];
    splashdown_status status;
    do {
        status = splashdown_contribute(shared->element, 1e-4, shared->at, shared->v, &angle, &spin, 1, force, NULL);
    } while (status == SPLASHDOWN_OK || status == SPLASHDOWN_BUSY);
    if (status != SPLASHDOWN_NO_HANDLE) {
        must(status);
    }
    return NULL;
}

int main(void)
{
    struct fall alone[2] = {{.sink = 1.0}, {.sink = 1.5}}, together[2] = {{.sink = 1.0}, {.sink = 1.5}};
    pthread_t threads[2];
    must(splashdown_set_threads(2));
    if (splashdown_set_threads(2) != SPLASHDOWN_THREADS) {
        fprintf(stderr, "the pool of threads is made once\n");
        return 1;
    }
    for (int k = 0; k < 2; ++k) {
        falls(&alone[k]);
    }
    for (int k = 0; k < 2; ++k) {
        pthread_create(&threads[k], NULL, falls, &together[k]);
    }
    for (int k = 0; k < 2; ++k) {
        pthread_join(threads[k], NULL);
    }
    if (memcmp(alone, together, sizeof alone) != 0) {
        fprintf(stderr, "two elements on two threads: not the bits that each gives alone\n");
        return 1;
    }

    struct shared shared = {0};
    shared.element = wedge(shared.at, shared.v);
    double start, time;
    must(splashdown_time(shared.element, &start));
    shared.v[0] = shared.v[1] = 0.0;
    for (int k = 0; k < 2; ++k) {
        pthread_create(&threads[k], NULL, shares, &shared);
    }
    for (int k = 0; k < 2; ++k) {
        pthread_join(threads[k], NULL);
    }
    must(splashdown_time(shared.element, &time));
    pthread_create(&threads[0], NULL, outlives, &shared);
    pthread_create(&threads[1], NULL, frees, &shared);
    for (int k = 0; k < 2; ++k) {
        pthread_join(threads[k], NULL);
    }
    int steps = (int)((time - start) / 1e-4 + 0.5), done = atomic_load(&shared.done), refused = atomic_load(&shared.refused);
    if (steps != done) {
        fprintf(stderr, "one element on two threads: %d calls done, but %d steps\n", done, steps);
        return 1;
    }
    printf("threads: two elements give the same bits as alone; of one element %d calls done, %d refused as busy\n", done, refused);
    return 0;
}
