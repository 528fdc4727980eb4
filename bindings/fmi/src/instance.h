/* An instance of the co-simulation unit: one body of the host, with its water. */
#ifndef SPLASHDOWN_FMI_INSTANCE_H
#define SPLASHDOWN_FMI_INSTANCE_H

#include <stddef.h>
#include <stdio.h>

#include "fmi3Functions.h"
#include "splashdown.h"
#include "variables.h"

/* What may be called: FMI 3.0, section 4.2.1. */
enum mode { INSTANTIATED, INITIALIZATION, STEP, TERMINATED };

struct instance {
    char *name;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback logger;

    char *token;
    char *scene_file; /* resources/scene.toml */
    char **settings;  /* key=value, of resources/unit.txt */
    size_t setting_count;
    int interface; /* one of splashdown_interface */

    enum mode mode;
    struct layout layout;
    double *numbers; /* values of all variables but texts, in the order of the layout */
    char *texts[TEXT_COUNT];
    double *first;  /* nodes of the scene at t = 0: positions, velocities, rotations, spins: 6 per node */
    double *built;  /* nodes that the element was built with, likewise */
    double *forces; /* 3 per node */
    double *moved;  /* nodes at the end of the step, 6 per node */

    splashdown_scene *scene; /* sized; taken by the element */
    splashdown_element *element;
    double start_time, time; /* of the importer, at the start and now [s] */
    double water_start;      /* time of the water when it was built: 0 at contact [s] */
    uint64_t saved;          /* number of the state that the element saved last, or 0 */
    bool failed;    /* the step before, and no state was set since */
    bool stop_time_defined;
    double stop_time;
};

/* A warning or an error for the importer, with the format of printf. */
void log_message(const struct instance *instance, fmi3Status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* fmi3OK, or a message that names the call and the status of its error. */
fmi3Status expect_mode(const struct instance *instance, const char *call, unsigned allowed);

/* Bit of a mode, for `expect_mode`. */
static inline unsigned in(enum mode mode) { return 1u << mode; }

/* Places of the variables and room for their values; false without memory. */
bool make_room(struct instance *instance, size_t nodes);

/* A copy on the heap; NULL for NULL or without memory. */
char *copy_of(const char *text);

#endif
