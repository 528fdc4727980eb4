/* Every wrong use of the interface gives its status and a message, writes nothing, and ends no process.
 *
 *     misuse [FOLDER]      with a folder, a run is broken too, and runs are recorded there
 */
#include <math.h>
#include <splashdown.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SETTINGS = 4 };
static const char *settings[SETTINGS] = {"resolution.spacing=0.02", "tank.width=1.6", "tank.depth=0.6", "time.end=0.02"};
static int asked;
static double start_time; /* of the scene last built, s */

/* `call` must give `status`, and a message with `part` in it. */
static void gives(int line, splashdown_status found, splashdown_status expected, const char *part)
{
    char message[2000];
    splashdown_message(message, sizeof message);
    ++asked;
    if (found != expected || (expected != SPLASHDOWN_OK && strstr(message, part) == NULL)) {
        fprintf(stderr, "line %d: status %d, expected %d with `%s`; message: %s\n", line, (int)found, (int)expected, part,
                message);
        exit(1);
    }
}
#define GIVES(status, part, call) gives(__LINE__, (call), (status), (part))
#define OK(call) GIVES(SPLASHDOWN_OK, "", (call))
#define TRUE(condition) (++asked, (condition) ? (void)0 : (fprintf(stderr, "line %d: " #condition "\n", __LINE__), exit(1)))

static splashdown_scene *opened(int interface_kind)
{
    splashdown_scene *scene = NULL;
    OK(splashdown_open("wedge", settings, SETTINGS, interface_kind, &scene));
    return scene;
}

static splashdown_element *built(double at[2], double v[2])
{
    splashdown_scene *scene = opened(SPLASHDOWN_BODY);
    splashdown_element *element = NULL;
    double angle, spin;
    splashdown_scene_sizes sizes;
    OK(splashdown_sizes(scene, &sizes));
    TRUE(sizes.nodes == 1 && sizes.rotations == 1);
    start_time = sizes.start_time;
    OK(splashdown_scene_nodes(scene, at, v, &angle, &spin, 1));
    OK(splashdown_build(scene, at, v, &angle, &spin, 1, &element));
    return element;
}

static void messages(void)
{
    char buffer[64];
    splashdown_scene *scene = NULL;
    GIVES(SPLASHDOWN_INPUT, "no_such_scene", splashdown_open("no_such_scene", NULL, 0, SPLASHDOWN_BODY, &scene));
    size_t needed = splashdown_message(NULL, 0);
    TRUE(needed > 1 && splashdown_message(buffer, 0) == needed);
    memset(buffer, '#', sizeof buffer);
    TRUE(splashdown_message(buffer, 5) == needed && strlen(buffer) == 4 && buffer[5] == '#');
    TRUE(splashdown_abi_version() == SPLASHDOWN_ABI_VERSION && strlen(splashdown_version()) >= 5);
}

static void opening(void)
{
    splashdown_scene *scene = NULL;
    const char *unknown[] = {"resolution.spacin=0.02"}, *empty[] = {NULL}, *latin[] = {"name=\xe9"};
    GIVES(SPLASHDOWN_NULL, "scene", splashdown_open(NULL, NULL, 0, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_NULL, "opened", splashdown_open("wedge", NULL, 0, SPLASHDOWN_BODY, NULL));
    GIVES(SPLASHDOWN_NULL, "settings", splashdown_open("wedge", NULL, 1, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_NULL, "settings", splashdown_open("wedge", NULL, (size_t)-1, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_NULL, "settings[0]", splashdown_open("wedge", empty, 1, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_NOT_UTF8, "settings[0]", splashdown_open("wedge", latin, 1, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_NOT_UTF8, "byte 2", splashdown_open("we\xff", NULL, 0, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_INPUT, "spacin", splashdown_open("wedge", unknown, 1, SPLASHDOWN_BODY, &scene));
    GIVES(SPLASHDOWN_INPUT, "SPLASHDOWN_NODES (1)", splashdown_open("wedge", settings, SETTINGS, 77, &scene));
    TRUE(scene == NULL);
}

static void scenes(void)
{
    splashdown_scene *scene = opened(SPLASHDOWN_NODES);
    splashdown_scene_sizes sizes;
    OK(splashdown_sizes(scene, &sizes));
    TRUE(sizes.rotations == 0 && sizes.nodes >= 3 && sizes.fluid_particles > 0 && sizes.bytes > 0 && sizes.fluid_dt > 0.0);
    GIVES(SPLASHDOWN_NULL, "sizes", splashdown_sizes(scene, NULL));
    GIVES(SPLASHDOWN_NULL, "scene", splashdown_sizes(NULL, &sizes));
    GIVES(SPLASHDOWN_INPUT, "index", splashdown_warning(scene, sizes.warnings, NULL, 0, NULL));

    size_t n = sizes.nodes;
    double *at = malloc(2 * n * sizeof *at), *v = malloc(2 * n * sizeof *v), one = 7.0;
    splashdown_element *element = NULL;
    GIVES(SPLASHDOWN_LENGTH, "nodes", splashdown_scene_nodes(scene, at, v, NULL, NULL, n - 1));
    GIVES(SPLASHDOWN_LENGTH, "rotations", splashdown_scene_nodes(scene, at, v, &one, NULL, n));
    TRUE(one == 7.0);
    OK(splashdown_scene_nodes(scene, at, v, NULL, NULL, n));
    GIVES(SPLASHDOWN_NULL, "positions", splashdown_build(scene, NULL, v, NULL, NULL, n, &element));
    GIVES(SPLASHDOWN_NULL, "velocities", splashdown_build(scene, at, NULL, NULL, NULL, n, &element));
    GIVES(SPLASHDOWN_NULL, "element", splashdown_build(scene, at, v, NULL, NULL, n, NULL));
    GIVES(SPLASHDOWN_LENGTH, "spins", splashdown_build(scene, at, v, NULL, at, n, &element));
    GIVES(SPLASHDOWN_LENGTH, "nodes", splashdown_build(scene, at, v, NULL, NULL, 0, &element));
    GIVES(SPLASHDOWN_LENGTH, "nodes", splashdown_build(scene, at, v, NULL, NULL, (size_t)-1, &element));
    double good = at[2];
    at[2] = NAN;
    GIVES(SPLASHDOWN_INPUT, "node", splashdown_build(scene, at, v, NULL, NULL, n, &element));
    TRUE(element == NULL);
    at[2] = good;
    OK(splashdown_build(scene, at, v, NULL, NULL, n, &element));
    OK(splashdown_free_element(element));
    GIVES(SPLASHDOWN_NO_HANDLE, "consumed", splashdown_sizes(scene, &sizes));
    GIVES(SPLASHDOWN_NO_HANDLE, "consumed", splashdown_free_scene(scene));
    OK(splashdown_free_scene(NULL));
    scene = opened(SPLASHDOWN_BODY);
    GIVES(SPLASHDOWN_NO_HANDLE, "element", splashdown_save((splashdown_element *)(void *)scene));
    OK(splashdown_free_scene(scene));
    OK(splashdown_free_scene(opened(SPLASHDOWN_TURNING_NODES)));
    free(at);
    free(v);
}

static void steps(void)
{
    double at[2], v[2], angle = 0.0, spin = 0.0, force[3] = {7.0, 7.0, 7.0}, time = 7.0;
    splashdown_element *element = built(at, v), *none = (splashdown_element *)(void *)&time;
    splashdown_contribution given;
    const double still[2] = {at[0], at[1]}, dt = 1e-4;

    GIVES(SPLASHDOWN_NOTHING_SAVED, "", splashdown_restore(element));
    GIVES(SPLASHDOWN_NULL, "element", splashdown_contribute(NULL, dt, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_NO_HANDLE, "element", splashdown_contribute(none, dt, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_NULL, "positions", splashdown_contribute(element, dt, NULL, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_NULL, "velocities", splashdown_contribute(element, dt, at, NULL, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_NULL, "rotations", splashdown_contribute(element, dt, at, v, NULL, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_NULL, "spins", splashdown_contribute(element, dt, at, v, &angle, NULL, 1, force, NULL));
    GIVES(SPLASHDOWN_NULL, "forces", splashdown_contribute(element, dt, at, v, &angle, &spin, 1, NULL, &given));
    GIVES(SPLASHDOWN_LENGTH, "given 2, expected 1", splashdown_contribute(element, dt, at, v, &angle, &spin, 2, force, NULL));
    GIVES(SPLASHDOWN_INPUT, "", splashdown_contribute(element, 0.0, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_INPUT, "", splashdown_contribute(element, NAN, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_INPUT, "", splashdown_contribute(element, -dt, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_INPUT, "", splashdown_contribute(element, INFINITY, at, v, &angle, &spin, 1, force, NULL));
    at[1] = NAN;
    GIVES(SPLASHDOWN_INPUT, "NaN", splashdown_contribute(element, dt, at, v, &angle, &spin, 1, force, NULL));
    at[1] = still[1] - 1000.0;
    GIVES(SPLASHDOWN_INPUT, "speed", splashdown_contribute(element, dt, at, v, &angle, &spin, 1, force, NULL));
    at[1] = still[1];
    spin = INFINITY;
    GIVES(SPLASHDOWN_INPUT, "", splashdown_contribute(element, dt, at, v, &angle, &spin, 1, force, NULL));
    spin = 0.0;
    TRUE(force[0] == 7.0 && force[1] == 7.0 && force[2] == 7.0);
    GIVES(SPLASHDOWN_NULL, "time", splashdown_time(element, NULL));
    OK(splashdown_time(element, &time));
    TRUE(time == start_time);
    at[1] += dt * v[1];
    OK(splashdown_contribute(element, dt, at, v, &angle, &spin, 1, force, &given));
    TRUE(given.fluid_steps >= 1 && fabs(given.impulse[1] - dt * force[1]) <= 1e-12 * fabs(given.impulse[1]));
    GIVES(SPLASHDOWN_LENGTH, "nodes", splashdown_forces_now(element, force, 2));
    GIVES(SPLASHDOWN_NULL, "forces", splashdown_forces_now(element, NULL, 1));
    GIVES(SPLASHDOWN_NULL, "dt", splashdown_fluid_dt(element, NULL));
    GIVES(SPLASHDOWN_LENGTH, "nodes", splashdown_nodes(element, at, v, NULL, NULL, 9));
    GIVES(SPLASHDOWN_NULL, "aligned", splashdown_forces_now(element, (double *)(void *)((char *)force + 1), 1));
    OK(splashdown_free_element(element));
    GIVES(SPLASHDOWN_NO_HANDLE, "freed", splashdown_time(element, &time));
    GIVES(SPLASHDOWN_NO_HANDLE, "freed", splashdown_free_element(element));
    GIVES(SPLASHDOWN_NO_HANDLE, "freed", splashdown_finish(element));
    OK(splashdown_free_element(NULL));
}

static void buffers(void)
{
    double at[2], v[2], few[4] = {7.0, 7.0, 7.0, 7.0};
    splashdown_element *element = built(at, v);
    size_t count = 0, size = 0;
    GIVES(SPLASHDOWN_NULL, "count", splashdown_particle_count(element, NULL));
    OK(splashdown_particle_count(element, &count));
    TRUE(count > 4);
    GIVES(SPLASHDOWN_LENGTH, "given 4", splashdown_particles(element, few, NULL, NULL, NULL, NULL, NULL, 4));
    TRUE(few[0] == 7.0);
    double *x = malloc(count * sizeof *x), *p = malloc(count * sizeof *p);
    OK(splashdown_particles(element, x, NULL, NULL, NULL, p, NULL, count));
    TRUE(isfinite(x[count - 1]) && isfinite(p[count - 1]));

    GIVES(SPLASHDOWN_NULL, "size", splashdown_state_size(element, NULL));
    OK(splashdown_state_size(element, &size));
    unsigned char *state = malloc(size);
    state[0] = 77;
    GIVES(SPLASHDOWN_LENGTH, "at least", splashdown_state_write(element, state, size - 1));
    GIVES(SPLASHDOWN_NULL, "buffer", splashdown_state_write(element, NULL, size));
    TRUE(state[0] == 77);
    OK(splashdown_state_write(element, state, size));
    OK(splashdown_state_read(element, state, size));
    GIVES(SPLASHDOWN_NULL, "buffer", splashdown_state_read(element, NULL, size));
    GIVES(SPLASHDOWN_STATE, "", splashdown_state_read(element, state, size / 2));
    /* the element has failed */
    double angle = 0.0, spin = 0.0, force[3];
    GIVES(SPLASHDOWN_FAILED, "", splashdown_contribute(element, 1e-4, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_FAILED, "failed", splashdown_save(element));
    GIVES(SPLASHDOWN_FAILED, "", splashdown_state_size(element, &size));
    OK(splashdown_state_read(element, state, size));
    at[1] += 1e-4 * v[1];
    OK(splashdown_contribute(element, 1e-4, at, v, &angle, &spin, 1, force, NULL));
    OK(splashdown_free_element(element));
    /* another element goes on from the state to the same bits */
    double start[2], again[3];
    element = built(start, v);
    OK(splashdown_state_read(element, state, size));
    OK(splashdown_contribute(element, 1e-4, at, v, &angle, &spin, 1, again, NULL));
    TRUE(memcmp(force, again, sizeof force) == 0);
    OK(splashdown_free_element(element));
    free(x);
    free(p);
    free(state);
}

/* A body that meets the floor of the tank breaks the run; a saved state makes it good again. */
static void broken(void)
{
    double at[2], v[2], angle = 0.0, spin = 0.0, force[3], good[2];
    splashdown_element *element = built(at, v);
    OK(splashdown_save(element));
    memcpy(good, at, sizeof good);
    v[1] = -25.0;
    splashdown_status status = SPLASHDOWN_OK;
    for (int step = 0; step < 400 && status == SPLASHDOWN_OK; ++step) {
        at[1] += 2e-4 * v[1];
        status = splashdown_contribute(element, 2e-4, at, v, &angle, &spin, 1, force, NULL);
    }
    GIVES(SPLASHDOWN_STEP, "in the step from t =", status);
    GIVES(SPLASHDOWN_FAILED, "", splashdown_contribute(element, 2e-4, at, v, &angle, &spin, 1, force, NULL));
    GIVES(SPLASHDOWN_FAILED, "save", splashdown_save(element));
    OK(splashdown_restore(element));
    v[1] = 0.0;
    OK(splashdown_contribute(element, 2e-4, good, v, &angle, &spin, 1, force, NULL));
    OK(splashdown_free_element(element));
}

static void records(const char *folder)
{
    double at[2], v[2], angle, spin, force[3];
    unsigned char state[8] = {0};
    splashdown_scene *scene = opened(SPLASHDOWN_BODY);
    splashdown_element *element = NULL;
    GIVES(SPLASHDOWN_NULL, "folder", splashdown_record(scene, NULL, 0));
    GIVES(SPLASHDOWN_NOT_UTF8, "folder", splashdown_record(scene, "\xe9", 0));
    OK(splashdown_record(scene, folder, 0));
    OK(splashdown_scene_nodes(scene, at, v, &angle, &spin, 1));
    OK(splashdown_build(scene, at, v, &angle, &spin, 1, &element));
    for (int step = 0; step < 5; ++step) {
        at[1] += 1e-4 * v[1];
        OK(splashdown_contribute(element, 1e-4, at, v, &angle, &spin, 1, force, NULL));
    }
    GIVES(SPLASHDOWN_INPUT, "records", splashdown_state_read(element, state, sizeof state));
    OK(splashdown_finish(element));
    GIVES(SPLASHDOWN_NO_HANDLE, "consumed", splashdown_finish(element));

    scene = opened(SPLASHDOWN_BODY);
    OK(splashdown_scene_nodes(scene, at, v, &angle, &spin, 1));
    OK(splashdown_record(scene, folder, 0));
    GIVES(SPLASHDOWN_INPUT, "", splashdown_build(scene, at, v, &angle, &spin, 1, &element)); /* it holds a run */
    OK(splashdown_record(scene, folder, 1));
    OK(splashdown_build(scene, at, v, &angle, &spin, 1, &element));
    OK(splashdown_finish(element));
    scene = opened(SPLASHDOWN_BODY);
    OK(splashdown_record(scene, "/dev/null/run", 0));
    GIVES(SPLASHDOWN_FILE, "/dev/null/run", splashdown_build(scene, at, v, &angle, &spin, 1, &element));
    OK(splashdown_free_scene(scene));
}

int main(int count, char **arguments)
{
    messages();
    opening();
    scenes();
    steps();
    buffers();
    if (count > 1) {
        broken();
        records(arguments[1]);
    }
    printf("misuse: %d answers as expected\n", asked);
    return 0;
}
