/* The water under an instance: every call of the library is here and in `state.c`. */
#ifndef SPLASHDOWN_FMI_WATER_H
#define SPLASHDOWN_FMI_WATER_H

#include "instance.h"

/* The status of the importer for one of the library, after its message was logged. */
fmi3Status checked(const struct instance *instance, const char *call, splashdown_status status);

/* Opens the scene with the settings of the unit and of the parameters; its nodes become `first`. */
fmi3Status open_scene(struct instance *instance);

/* The water at t = 0 with the parameters and inputs of the instance, recording where asked. */
fmi3Status begin_water(struct instance *instance);

/* Builds the element at the nodes `start`, 6 per node; takes the scene. */
fmi3Status build_element(struct instance *instance, double *start);

/* The water goes with the nodes through a step [s]; outputs follow. */
fmi3Status step_element(struct instance *instance, double dt);

/* The forces of this instant as outputs. */
fmi3Status read_forces_now(struct instance *instance);

/* Ends the element: writes summary and report where recording was asked. */
fmi3Status finish_element(struct instance *instance);

/* Scene and element are given back. */
void drop_water(struct instance *instance);

/* The inputs as nodes, 6 per node: positions, velocities, rotations, spins. */
void nodes_of_inputs(const struct instance *instance, double *nodes);

/* And back. */
void inputs_of_nodes(struct instance *instance, const double *nodes);

#endif
