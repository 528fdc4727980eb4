/* The reference host: a landing-dynamics program with water under it. It is scenarios/examples/reference_host.rs
 * in C. Both print the same bits: their sums and products have the same order.
 *
 *     bindings/c/install /usr/local
 *     gcc -std=c11 -ffp-contract=off bindings/c/example/reference_host.c $(pkg-config --cflags --libs splashdown) -lm \
 *         -o reference_host && ./reference_host scenarios/examples/reference_section.toml
 *
 * A fuselage section comes down at 3 m/s: a frame, a cabin on an oleo, and a flexible belly of nine nodes. The host integrates
 * them by velocity Verlet. It predicts each step with the water's last force; where the force came out too different it rejects
 * the step and repeats it with the better force.
 *
 * Per metre of span, SI units. Each line: time, height of frame and cabin, deflection and velocity of the keel, force of the
 * water, force of the oleo. At the end: steps, rejected steps.
 */
#include <math.h>
#include <splashdown.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Nodes of the belly, of the whole section with its deck; unknowns of the host; steps. */
enum { BELLY = 9, NODES = 11, UNKNOWNS = 2 + BELLY, STEPS = 400 };

static const double H = 0.1;                        /* distance of the belly's nodes along x, m */
static const double STIFFNESS = 6.0e3, NODE = 4.0;  /* bending stiffness, N m, and mass of a node, kg/m, of the belly */
static const double FRAME = 250.0, CABIN = 500.0;   /* masses, kg/m */
static const double SPRING = 5.0e5, DAMPER = 4.0e4; /* of the oleo, N/m2, N s2/m3 */
static const double GRAVITY = 9.81;                 /* m/s2 */
static const double DT = 5.0e-5, TOLERANCE = 0.002; /* s; change of velocity from which a step is rejected, m/s */

/* Heights of frame and cabin, deflections of the belly against the frame, m; and their velocities, m/s. */
typedef struct {
    double x[UNKNOWNS], v[UNKNOWNS];
} state;

static void must(splashdown_status status)
{
    if (status != SPLASHDOWN_OK) {
        char message[1000];
        splashdown_message(message, sizeof message);
        fprintf(stderr, "error %d: %s\n", (int)status, message);
        exit(1);
    }
}

static double oleo(const state *s)
{
    double closing = s->x[0] - s->x[1], speed = s->v[0] - s->v[1];
    return SPRING * closing + DAMPER * speed * fabs(speed);
}

/* Accelerations, m/s2, under the water's forces on the belly, N/m. */
static void accelerations(const state *s, const double water[BELLY], double a[UNKNOWNS])
{
    const double *w = s->x + 2;
    double moment[BELLY] = {0.0}, force[BELLY];
    for (int i = 1; i < BELLY - 1; ++i)
        moment[i] = STIFFNESS * (w[i - 1] - 2.0 * w[i] + w[i + 1]) / (H * H);
    for (int i = 0; i < BELLY; ++i) {
        double left = i > 0 ? moment[i - 1] : 0.0, right = i < BELLY - 1 ? moment[i + 1] : 0.0;
        force[i] = water[i] - (left - 2.0 * moment[i] + right) / H;
    }
    double strut = oleo(s);
    a[0] = (force[0] + force[BELLY - 1] - strut) / FRAME - GRAVITY;
    a[1] = strut / CABIN - GRAVITY;
    a[2] = a[1 + BELLY] = 0.0;
    for (int i = 1; i < BELLY - 1; ++i)
        a[2 + i] = force[i] / NODE - GRAVITY - a[0];
}

/* The state after a step under forces of the water that are predicted. */
static state verlet(const state *s, const double water[BELLY])
{
    double before[UNKNOWNS], after[UNKNOWNS];
    state end = *s;
    accelerations(s, water, before);
    for (int k = 0; k < UNKNOWNS; ++k)
        end.x[k] = s->x[k] + DT * s->v[k] + 0.5 * DT * DT * before[k];
    accelerations(&end, water, after);
    for (int k = 0; k < UNKNOWNS; ++k)
        end.v[k] = s->v[k] + 0.5 * DT * (before[k] + after[k]);
    return end;
}

int main(int count, char **words)
{
    const char *path = count > 1 ? words[1] : "scenarios/examples/reference_section.toml";
    splashdown_scene *scene;
    splashdown_element *water;
    double start[2 * NODES], at[2 * NODES], v[2 * NODES], forces[3 * NODES], predicted[BELLY] = {0.0};
    must(splashdown_open(path, NULL, 0, SPLASHDOWN_NODES, &scene));
    must(splashdown_scene_nodes(scene, start, v, NULL, NULL, NODES));
    must(splashdown_build(scene, start, v, NULL, NULL, NODES, &water));

    state now = {{0.0}, {v[1], v[1]}};
    int rejected = 0;
    memcpy(at, start, sizeof at);
    for (int step = 1; step <= STEPS; ++step) {
        must(splashdown_save(water));
        state end;
        double found[BELLY], with[UNKNOWNS], without[UNKNOWNS];
        for (bool redone = false;; redone = true, ++rejected) {
            end = verlet(&now, predicted);
            for (int k = 0; k < NODES; ++k) {
                double w = k < BELLY ? end.x[2 + k] : 0.0, rate = k < BELLY ? end.v[2 + k] : 0.0;
                at[2 * k + 1] = start[2 * k + 1] + end.x[0] + w;
                v[2 * k + 1] = end.v[0] + rate;
            }
            must(splashdown_contribute(water, DT, at, v, NULL, NULL, NODES, forces, NULL));
            double change = 0.0;
            for (int i = 0; i < BELLY; ++i) {
                found[i] = forces[3 * i + 1];
                change = fmax(change, DT * fabs(found[i] - predicted[i]) / NODE);
            }
            if (redone || change <= TOLERANCE)
                break;
            must(splashdown_restore(water));
            memcpy(predicted, found, sizeof predicted);
        }
        /* the nodes stay where they were predicted; their velocities take the impulse of the water */
        accelerations(&end, found, with);
        accelerations(&end, predicted, without);
        for (int k = 0; k < UNKNOWNS; ++k)
            end.v[k] += DT * (with[k] - without[k]);
        now = end;
        memcpy(predicted, found, sizeof predicted);
        if (step % 20 == 0) {
            double total = 0.0, time;
            for (int k = 0; k < NODES; ++k)
                total += forces[3 * k + 1];
            must(splashdown_time(water, &time));
            printf("%.16e %.16e %.16e %.16e %.16e %.16e %.16e\n", time, now.x[0], now.x[1], now.x[6], now.v[6], total,
                   oleo(&now));
        }
    }
    printf("%d steps, %d rejected\n", STEPS, rejected);
    must(splashdown_finish(water));
    return 0;
}
