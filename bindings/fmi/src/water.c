/* The water under an instance. */
#include "water.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Where the inputs stand in nodes of 6 numbers each: [positions 2n][velocities 2n][rotations n][spins n]. */
static const struct part {
    enum role role;
    size_t first, columns;
} PARTS[] = {{POSITION, 0, 2}, {VELOCITY, 2, 2}, {ROTATION, 4, 1}, {SPIN, 5, 1}};

/* The message of the library's last error in this thread. */
static fmi3Status report_last_error(const struct instance *instance, fmi3Status status, const char *call)
{
    char text[4096] = "no message";
    splashdown_message(text, sizeof text);
    log_message(instance, status, "%s: %s", call, text);
    return status;
}

fmi3Status checked(const struct instance *instance, const char *call, splashdown_status status)
{
    if (status == SPLASHDOWN_OK) {
        return fmi3OK;
    }
    const bool panic = status == SPLASHDOWN_PANIC || status == SPLASHDOWN_AFTER_PANIC;
    return report_last_error(instance, panic ? fmi3Fatal : fmi3Error, call);
}

void nodes_of_inputs(const struct instance *instance, double *nodes)
{
    const size_t n = instance->layout.nodes;
    memset(nodes, 0, 6 * n * sizeof *nodes);
    for (const struct part *part = PARTS; part < PARTS + 4; part++) {
        const size_t place = place_of(&instance->layout, part->role);
        if (place != SIZE_MAX) {
            memcpy(nodes + part->first * n, instance->numbers + place, part->columns * n * sizeof *nodes);
        }
    }
}

void inputs_of_nodes(struct instance *instance, const double *nodes)
{
    const size_t n = instance->layout.nodes;
    for (const struct part *part = PARTS; part < PARTS + 4; part++) {
        const size_t place = place_of(&instance->layout, part->role);
        if (place != SIZE_MAX) {
            memcpy(instance->numbers + place, nodes + part->first * n, part->columns * n * sizeof *nodes);
        }
    }
}

/* Rotations and spins of nodes; NULL for an interface without. */
static double *rotations_of(const struct instance *instance, double *nodes)
{
    return instance->interface == SPLASHDOWN_NODES ? NULL : nodes + 4 * instance->layout.nodes;
}

static double *spins_of(const struct instance *instance, double *nodes)
{
    return instance->interface == SPLASHDOWN_NODES ? NULL : nodes + 5 * instance->layout.nodes;
}

/* A setting as the scene reads it: with a point, whatever the locale of the process has instead. */
static void write_setting(char *text, size_t length, const char *key, double value)
{
    snprintf(text, length, "%s=%.17g", key, value);
    char *at = strchr(text, '=') + 1;
    at += strspn(at, "+-0123456789");
    const size_t point = strcspn(at, "0123456789efina");
    if (point > 0) {
        *at = '.';
        memmove(at + 1, at + point, strlen(at + point) + 1);
    }
}

/* The settings of the unit, then the parameter `settings` (`text`, divided at its semicolons in place), then `spacing`;
   NULL without memory. */
static const char **all_settings(const struct instance *instance, char *text, const char *spacing, size_t *count)
{
    size_t most = instance->setting_count + 2;
    for (const char *at = text; (at = strchr(at, ';')) != NULL; at++) {
        most++;
    }
    const char **settings = calloc(most, sizeof *settings);
    if (settings == NULL) {
        return NULL;
    }
    *count = 0;
    for (size_t k = 0; k < instance->setting_count; k++) {
        settings[(*count)++] = instance->settings[k];
    }
    for (char *rest = text; rest != NULL;) {
        char *part = rest + strspn(rest, " ");
        rest = strchr(rest, ';');
        if (rest != NULL) {
            *rest++ = '\0';
        }
        if (*part != '\0') {
            settings[(*count)++] = part;
        }
    }
    if (*spacing != '\0') {
        settings[(*count)++] = spacing;
    }
    return settings;
}

/* The nodes of the scene at t = 0; the first time also the place of the variables. */
static fmi3Status take_nodes(struct instance *instance)
{
    splashdown_scene_sizes size;
    fmi3Status status = checked(instance, "the sizes of the scene", splashdown_sizes(instance->scene, &size));
    if (status != fmi3OK) {
        return status;
    }
    if (instance->numbers == NULL && !make_room(instance, size.nodes)) {
        log_message(instance, fmi3Error, "no memory for %zu nodes", size.nodes);
        return fmi3Error;
    }
    if (size.nodes != instance->layout.nodes) {
        log_message(instance, fmi3Error, "the parameter settings changes the number of nodes to %zu; the unit has %zu",
                    size.nodes, instance->layout.nodes);
        return fmi3Error;
    }
    const size_t n = size.nodes;
    double *nodes = instance->first;
    for (size_t k = 0; k < size.warnings; k++) {
        char text[4096];
        if (splashdown_warning(instance->scene, k, text, sizeof text, NULL) == SPLASHDOWN_OK) {
            log_message(instance, fmi3Warning, "%s", text);
        }
    }
    return checked(instance, "the nodes of the scene",
                   splashdown_scene_nodes(instance->scene, nodes, nodes + 2 * n, rotations_of(instance, nodes),
                                          spins_of(instance, nodes), n));
}

fmi3Status open_scene(struct instance *instance)
{
    drop_water(instance);
    char spacing[64] = "", *text = copy_of(instance->texts[TEXT_SETTINGS]);
    const double given = instance->numbers == NULL ? 0.0 : instance->numbers[place_of(&instance->layout, SPACING)];
    if (given != 0.0) {
        write_setting(spacing, sizeof spacing, "resolution.spacing", given);
    }
    size_t count;
    const char **settings = text == NULL ? NULL : all_settings(instance, text, spacing, &count);
    fmi3Status status = fmi3Error;
    if (settings == NULL) {
        log_message(instance, fmi3Error, "no memory for the settings of the scene");
    } else {
        status = checked(instance, "the scene",
                         splashdown_open(instance->scene_file, settings, count, instance->interface, &instance->scene));
    }
    free(settings);
    free(text);
    return status == fmi3OK ? take_nodes(instance) : status;
}

/* Loads of 3 numbers per node to the outputs of forces and moments. */
static void write_loads(struct instance *instance, enum role force, enum role moment)
{
    const size_t at = place_of(&instance->layout, force), about = place_of(&instance->layout, moment);
    for (size_t k = 0; k < instance->layout.nodes; k++) {
        memcpy(instance->numbers + at + 2 * k, instance->forces + 3 * k, 2 * sizeof *instance->forces);
        if (about != SIZE_MAX) {
            instance->numbers[about + k] = instance->forces[3 * k + 2];
        }
    }
}

static void write_number(struct instance *instance, enum role role, double value)
{
    instance->numbers[place_of(&instance->layout, role)] = value;
}

fmi3Status read_forces_now(struct instance *instance)
{
    const fmi3Status status =
        checked(instance, "the forces now",
                splashdown_forces_now(instance->element, instance->forces, instance->layout.nodes));
    if (status == fmi3OK) {
        write_loads(instance, FORCE_NOW, MOMENT_NOW);
    }
    return status;
}

fmi3Status build_element(struct instance *instance, double *start)
{
    const size_t n = instance->layout.nodes;
    const char *folder = instance->texts[TEXT_RECORD];
    fmi3Status status = fmi3OK;
    if (*folder != '\0') {
        status = checked(instance, "the parameter record", splashdown_record(instance->scene, folder, 0));
    }
    if (status == fmi3OK) {
        status = checked(instance, "building the water",
                         splashdown_build(instance->scene, start, start + 2 * n, rotations_of(instance, start),
                                          spins_of(instance, start), n, &instance->element));
    }
    splashdown_free_scene(instance->scene);
    instance->scene = NULL;
    if (status == fmi3OK) {
        memmove(instance->built, start, 6 * n * sizeof *start);
        status = checked(instance, "the time", splashdown_time(instance->element, &instance->water_start));
    }
    double dt;
    if (status == fmi3OK) {
        status = checked(instance, "the step of the water", splashdown_fluid_dt(instance->element, &dt));
    }
    if (status == fmi3OK) {
        write_number(instance, FLUID_DT, dt);
        status = read_forces_now(instance);
    }
    return status;
}

fmi3Status begin_water(struct instance *instance)
{
    const size_t count = 6 * instance->layout.nodes;
    const bool asked =
        *instance->texts[TEXT_SETTINGS] != '\0' || instance->numbers[place_of(&instance->layout, SPACING)] != 0.0;
    double *start = instance->moved, *before = instance->built;
    nodes_of_inputs(instance, start);
    if (asked || instance->scene == NULL) {
        memcpy(before, instance->first, count * sizeof *before);
        const fmi3Status status = open_scene(instance);
        if (status != fmi3OK) {
            return status;
        }
        for (size_t k = 0; k < count; k++) { /* inputs that were not set follow the scene */
            start[k] = start[k] == before[k] ? instance->first[k] : start[k];
        }
        inputs_of_nodes(instance, start);
    }
    return build_element(instance, start);
}

fmi3Status step_element(struct instance *instance, double dt)
{
    const size_t n = instance->layout.nodes;
    double *to = instance->moved;
    nodes_of_inputs(instance, to);
    if (instance->numbers[place_of(&instance->layout, INPUTS_AT_START)] != 0.0) {
        for (size_t k = 0; k < 2 * n; k++) {
            to[k] += dt * to[2 * n + k];
        }
        for (size_t k = 0; k < n; k++) {
            to[4 * n + k] += dt * to[5 * n + k];
        }
    }
    splashdown_contribution given;
    const splashdown_status done =
        splashdown_contribute(instance->element, dt, to, to + 2 * n, rotations_of(instance, to), spins_of(instance, to),
                              n, instance->forces, &given);
    if (done == SPLASHDOWN_INPUT) {
        return report_last_error(instance, fmi3Discard, "fmi3DoStep"); /* nothing has changed */
    }
    const fmi3Status status = checked(instance, "fmi3DoStep", done);
    if (status != fmi3OK) {
        return status;
    }
    write_loads(instance, FORCE, MOMENT);
    write_number(instance, FLUID_STEPS, (double)given.fluid_steps);
    write_number(instance, FLUID_DT, given.fluid_dt);
    write_number(instance, WORK, given.work);
    write_number(instance, PENETRATION, given.depth);
    return read_forces_now(instance);
}

fmi3Status finish_element(struct instance *instance)
{
    splashdown_element *element = instance->element;
    instance->element = NULL;
    return element == NULL ? fmi3OK : checked(instance, "fmi3Terminate", splashdown_finish(element));
}

void drop_water(struct instance *instance)
{
    splashdown_free_scene(instance->scene);
    splashdown_free_element(instance->element);
    instance->scene = NULL;
    instance->element = NULL;
    instance->saved = 0;
    instance->failed = false;
}
