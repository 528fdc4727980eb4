/* A wedge that falls into water: this program has the mass and the time loop, splashdown has the water.
 *
 *     bindings/c/install /usr/local
 *     gcc -std=c11 bindings/c/example/drop.c $(pkg-config --cflags --libs splashdown) -o drop && ./drop
 *
 * Prints time [s], height [m], velocity [m/s] and force [N/m] of each step. At step 40 it tries a step with a wrong velocity
 * and takes it back: the later steps are the same as without.
 */
#include <splashdown.h>
#include <stdio.h>
#include <stdlib.h>

static void must(splashdown_status status)
{
    if (status != SPLASHDOWN_OK) {
        char message[1000];
        splashdown_message(message, sizeof message);
        fprintf(stderr, "error %d: %s\n", (int)status, message);
        exit(1);
    }
}

int main(void)
{
    const char *settings[] = {"resolution.spacing=0.01", "time.end=0.02"};
    const double mass = 100.0, dt = 1e-4; /* kg/m, s */

    splashdown_scene *scene;
    must(splashdown_open("wedge", settings, 2, SPLASHDOWN_BODY, &scene));

    splashdown_scene_sizes sizes;
    must(splashdown_sizes(scene, &sizes));
    fprintf(stderr, "%zu nodes, %zu particles of water, %llu bytes, step %.1e s\n", sizes.nodes, sizes.fluid_particles,
            (unsigned long long)sizes.bytes, sizes.fluid_dt);

    double at[2], v[2], angle, spin, force[3] = {0.0, 0.0, 0.0};
    must(splashdown_scene_nodes(scene, at, v, &angle, &spin, 1));
    splashdown_element *element;
    must(splashdown_build(scene, at, v, &angle, &spin, 1, &element));

    for (int step = 0; step < 100; ++step) {
        if (step == 40) {
            double wrong[2] = {0.0, 0.0}, unused[3];
            must(splashdown_save(element));
            must(splashdown_contribute(element, dt, at, wrong, &angle, &spin, 1, unused, NULL));
            must(splashdown_restore(element));
        }
        double old = v[1], a = force[1] / mass - 9.81;
        v[1] += dt * a;
        at[1] += dt * (0.5 * (old + v[1]));
        must(splashdown_contribute(element, dt, at, v, &angle, &spin, 1, force, NULL));
        double time;
        must(splashdown_time(element, &time));
        printf("%.16e %.16e %.16e %.16e\n", time, at[1], v[1], force[1]);
    }
    must(splashdown_finish(element));
    return 0;
}
