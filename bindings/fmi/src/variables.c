/* The tables of the variables. Inputs hold at the end of the step that follows, outputs are of the step done; loads are
   per metre of span. */
#include <stdint.h>
#include <string.h>

#include "variables.h"

static const struct variable BODY[] = {
    {"x", POSITION, FLOAT64, INPUT, 0, "m", "Reference point of the body at the end of the step, to the right"},
    {"y", POSITION, FLOAT64, INPUT, 0, "m", "Reference point of the body at the end of the step, upward"},
    {"vx", VELOCITY, FLOAT64, INPUT, 0, "m/s", "Velocity of the reference point at the end of the step, to the right"},
    {"vy", VELOCITY, FLOAT64, INPUT, 0, "m/s", "Velocity of the reference point at the end of the step, upward"},
    {"angle", ROTATION, FLOAT64, INPUT, 0, "rad", "Angle at the end of the step, counter-clockwise"},
    {"spin", SPIN, FLOAT64, INPUT, 0, "rad/s", "Angular velocity at the end of the step"},
    {"fx", FORCE, FLOAT64, OUTPUT, 0, "N/m", "Force of the water to the right, mean over the step"},
    {"fy", FORCE, FLOAT64, OUTPUT, 0, "N/m", "Force of the water upward, mean over the step"},
    {"moment", MOMENT, FLOAT64, OUTPUT, 0, "N", "Moment about the reference point, mean over the step"},
    {"fx_now", FORCE_NOW, FLOAT64, OUTPUT, 0, "N/m", "Force of the water to the right, at the end of the step"},
    {"fy_now", FORCE_NOW, FLOAT64, OUTPUT, 0, "N/m", "Force of the water upward, at the end of the step"},
    {"moment_now", MOMENT_NOW, FLOAT64, OUTPUT, 0, "N", "Moment about the reference point, at the end of the step"},
};

static const struct variable NODES[] = {
    {"position", POSITION, FLOAT64, INPUT, 2, "m", "Nodes at the end of the step: x to the right, y upward"},
    {"velocity", VELOCITY, FLOAT64, INPUT, 2, "m/s", "Velocities of the nodes at the end of the step"},
    {"force", FORCE, FLOAT64, OUTPUT, 2, "N/m", "Forces of the water on the nodes, mean over the step"},
    {"force_now", FORCE_NOW, FLOAT64, OUTPUT, 2, "N/m", "Forces of the water on the nodes, at the end of the step"},
};

static const struct variable TURNING[] = {
    {"rotation", ROTATION, FLOAT64, INPUT, 1, "rad", "Rotations of the nodes since t = 0, at the end of the step"},
    {"spin", SPIN, FLOAT64, INPUT, 1, "rad/s", "Angular velocities of the nodes at the end of the step"},
    {"moment", MOMENT, FLOAT64, OUTPUT, 1, "N", "Moments on the nodes, mean over the step"},
    {"moment_now", MOMENT_NOW, FLOAT64, OUTPUT, 1, "N", "Moments on the nodes, at the end of the step"},
};

static const struct variable COMMON[] = {
    {"fluid_steps", FLUID_STEPS, UINT32, OUTPUT, 0, NULL, "Steps of the water within the step"},
    {"fluid_dt", FLUID_DT, FLOAT64, OUTPUT, 0, "s", "Longest step that the water can take next"},
    {"work", WORK, FLOAT64, OUTPUT, 0, "J/m", "Work of the water on the body within the step"},
    {"penetration", PENETRATION, FLOAT64, OUTPUT, 0, "m", "Largest depth of a particle behind a surface"},
    {"spacing", SPACING, FLOAT64, PARAMETER, 0, "m", "Spacing of the particles; 0: that of the scene"},
    {"inputs_at_start", INPUTS_AT_START, BOOLEAN, PARAMETER, 0, NULL,
     "Inputs hold at the start of the step: the body moves on with its velocity"},
    {"settings", SETTINGS, STRING, PARAMETER, 0, NULL, "More keys of the scene, key=value, divided by semicolons"},
    {"record", RECORD, STRING, PARAMETER, 0, NULL, "New folder for log, series, summary and report; empty: none"},
};

static void append(struct layout *layout, const struct variable *rows, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        layout->variables[layout->count] = rows[k];
        layout->offset[layout->count] = layout->total;
        layout->total += size_of(layout, layout->count);
        layout->count++;
    }
}

struct layout lay_out(int interface, size_t nodes)
{
    struct layout layout = {.nodes = nodes};
    if (interface == SPLASHDOWN_BODY) {
        append(&layout, BODY, sizeof BODY / sizeof *BODY);
    } else {
        append(&layout, NODES, sizeof NODES / sizeof *NODES);
    }
    if (interface == SPLASHDOWN_TURNING_NODES) {
        append(&layout, TURNING, sizeof TURNING / sizeof *TURNING);
    }
    append(&layout, COMMON, sizeof COMMON / sizeof *COMMON);
    return layout;
}

size_t size_of(const struct layout *layout, size_t index)
{
    const int columns = layout->variables[index].columns;
    return columns == 0 ? 1 : (size_t)columns * layout->nodes;
}

size_t place_of(const struct layout *layout, enum role role)
{
    for (size_t k = 0; k < layout->count; k++) {
        if (layout->variables[k].role == role) {
            return layout->offset[k];
        }
    }
    return SIZE_MAX;
}

int interface_of(const char *name)
{
    static const struct {
        const char *name;
        int interface;
    } KNOWN[] = {{"body", SPLASHDOWN_BODY}, {"nodes", SPLASHDOWN_NODES}, {"turning_nodes", SPLASHDOWN_TURNING_NODES}};
    for (size_t k = 0; k < sizeof KNOWN / sizeof *KNOWN; k++) {
        if (strcmp(name, KNOWN[k].name) == 0) {
            return KNOWN[k].interface;
        }
    }
    return -1;
}
