/* The step of co-simulation. */
#include <math.h>

#include "instance.h"
#include "water.h"

/* Part of a step that the time of the importer may differ by from that of the water, from rounding [-]. */
static const double ROUNDING = 1e-3;

fmi3Status fmi3DoStep(fmi3Instance given, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    struct instance *instance = given;
    fmi3Status status = expect_mode(instance, "fmi3DoStep", in(STEP));
    if (status != fmi3OK) {
        return status;
    }
    if (eventHandlingNeeded == NULL || terminateSimulation == NULL || earlyReturn == NULL
        || lastSuccessfulTime == NULL) {
        log_message(instance, fmi3Error, "fmi3DoStep: a pointer for a result is NULL");
        return fmi3Error;
    }
    const double t = currentCommunicationPoint, dt = communicationStepSize;
    *eventHandlingNeeded = *terminateSimulation = *earlyReturn = fmi3False;
    *lastSuccessfulTime = instance->time;
    if (!(dt > 0.0) || !isfinite(dt)) {
        log_message(instance, fmi3Discard, "fmi3DoStep: a step of %g s, expected a number above 0", dt);
        return fmi3Discard;
    }
    if (instance->failed) {
        log_message(instance, fmi3Error, "fmi3DoStep: the step before failed; set a state from before it");
        return fmi3Error;
    }
    double water;
    status = checked(instance, "fmi3DoStep", splashdown_time(instance->element, &water));
    if (status != fmi3OK) {
        return status;
    }
    water += instance->start_time - instance->water_start;
    if (!(fabs(t - water) <= ROUNDING * dt)) {
        log_message(instance, fmi3Error, "fmi3DoStep: the communication point is %.17g s, the water is at %.17g s", t,
                    water);
        return fmi3Error;
    }
    if (instance->stop_time_defined && t + dt > instance->stop_time + ROUNDING * dt) {
        log_message(instance, fmi3Error, "fmi3DoStep: the step ends at %.17g s, after the stop time of %.17g s", t + dt,
                    instance->stop_time);
        return fmi3Error;
    }
    status = step_element(instance, dt);
    instance->failed = status > fmi3Discard;
    if (status == fmi3OK) {
        instance->time = *lastSuccessfulTime = t + dt;
    }
    return status;
}
