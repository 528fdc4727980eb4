/* The variables of a unit: one table for the model description, for reading and for writing. */
#ifndef SPLASHDOWN_FMI_VARIABLES_H
#define SPLASHDOWN_FMI_VARIABLES_H

#include <stdbool.h>
#include <stddef.h>

#include "splashdown.h"

/* What a variable is to the water. */
enum role {
    POSITION,
    VELOCITY,
    ROTATION,
    SPIN, /* inputs */
    FORCE,
    MOMENT,
    FORCE_NOW,
    MOMENT_NOW, /* outputs */
    FLUID_STEPS,
    FLUID_DT,
    WORK,
    PENETRATION, /* outputs */
    SPACING,
    INPUTS_AT_START,
    SETTINGS,
    RECORD /* parameters */
};

enum type { FLOAT64, UINT32, BOOLEAN, STRING };
enum causality { INPUT, OUTPUT, PARAMETER };

/* Texts of an instance. */
enum { TEXT_SETTINGS, TEXT_RECORD, TEXT_COUNT };

struct variable {
    const char *name;
    enum role role;
    enum type type;
    enum causality causality;
    int columns; /* 0: one number; 1: [nodes]; 2: [nodes][2] */
    const char *unit, *description;
};

/* Most variables of an interface. */
enum { VARIABLES = 24 };

/* The table of an interface, with the place of each variable in the numbers of an instance. The value reference is the
   index plus one; 0 is the time. */
struct layout {
    struct variable variables[VARIABLES];
    size_t offset[VARIABLES];
    size_t count;
    size_t nodes;
    size_t total; /* numbers */
};

/* The layout of an interface. */
struct layout lay_out(int interface, size_t nodes);

/* The interface of a name, body, nodes or turning_nodes; -1 for any other. */
int interface_of(const char *name);

/* Numbers of a variable. */
size_t size_of(const struct layout *layout, size_t index);

/* Place of the first variable of a role in the numbers, or SIZE_MAX where the interface has none. */
size_t place_of(const struct layout *layout, enum role role);

#endif
