/* Reading and writing of variables. */
#include <stdlib.h>
#include <string.h>

#include "instance.h"

/* A call that reads or writes variables, one after the other. */
struct access {
    struct instance *instance;
    const char *call;
    enum type type;
    bool writes;
    const fmi3ValueReference *references;
    size_t references_left, values_left;
    fmi3Status status;
    /* the variable in hand */
    size_t first, size; /* its values among those of the call */
    double *numbers;
    char **text;
};

/* fmi3OK, or a message, for the variable with an index of the layout. */
static fmi3Status check(const struct access *a, fmi3ValueReference reference)
{
    static const char *const TYPE[] = {"Float64", "UInt32", "Boolean", "String"};
    const struct instance *instance = a->instance;
    const size_t index = (size_t)reference - 1;
    if (reference == 0 || index >= instance->layout.count) {
        log_message(instance, fmi3Error, "%s: no variable has the value reference %u", a->call, (unsigned)reference);
        return fmi3Error;
    }
    const struct variable *variable = &instance->layout.variables[index];
    if (variable->type != a->type) {
        log_message(instance, fmi3Error, "%s: the variable %s has the type %s", a->call, variable->name,
                    TYPE[variable->type]);
        return fmi3Error;
    }
    if (a->values_left < size_of(&instance->layout, index)) {
        log_message(instance, fmi3Error, "%s: %zu values for the variable %s, expected %zu", a->call, a->values_left,
                    variable->name, size_of(&instance->layout, index));
        return fmi3Error;
    }
    if (a->writes && variable->causality == OUTPUT) {
        log_message(instance, fmi3Error, "%s: the variable %s is an output", a->call, variable->name);
        return fmi3Error;
    }
    const unsigned before = in(INSTANTIATED) | in(INITIALIZATION);
    return a->writes ? expect_mode(instance, a->call, variable->causality == INPUT ? before | in(STEP) : before)
                     : fmi3OK;
}

/* Takes the next variable in hand; false at the end, or with a status other than fmi3OK. */
static bool next(struct access *a)
{
    if (a->status != fmi3OK) {
        return false;
    }
    if (a->references_left == 0) {
        if (a->values_left > 0) {
            log_message(a->instance, fmi3Error, "%s: %zu values too many", a->call, a->values_left);
            a->status = fmi3Error;
        }
        return false;
    }
    const fmi3ValueReference reference = *a->references++;
    a->references_left--;
    a->first += a->size;
    const struct layout *layout = &a->instance->layout;
    if (reference == 0 && a->type == FLOAT64 && !a->writes && a->values_left > 0) {
        a->numbers = &a->instance->time;
        a->size = 1;
    } else if ((a->status = check(a, reference)) == fmi3OK) {
        const size_t index = (size_t)reference - 1;
        a->numbers = a->instance->numbers + layout->offset[index];
        a->text = &a->instance->texts[layout->variables[index].role == RECORD ? TEXT_RECORD : TEXT_SETTINGS];
        a->size = size_of(layout, index);
    } else {
        return false;
    }
    a->values_left -= a->size;
    return true;
}

/* A call with its arguments, all of which are checked before the first is read or written. */
static struct access begin(fmi3Instance given, const char *call, enum type type, bool writes,
                           const fmi3ValueReference *references, size_t nReferences, const void *values, size_t nValues)
{
    struct access a = {given, call, type, writes, references, nReferences, nValues, fmi3OK, 0, 0, NULL, NULL};
    if (given == NULL) {
        a.status = fmi3Error;
    } else if ((references == NULL && nReferences > 0) || (values == NULL && nValues > 0)) {
        log_message(given, fmi3Error, "%s: an array is NULL", call);
        a.status = fmi3Error;
    }
    struct access trial = a;
    while (next(&trial)) {
    }
    a.status = trial.status;
    return a;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3GetFloat64", FLOAT64, false, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        memcpy(values + a.first, a.numbers, a.size * sizeof *values);
    }
    return a.status;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3SetFloat64", FLOAT64, true, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        memcpy(a.numbers, values + a.first, a.size * sizeof *values);
    }
    return a.status;
}

fmi3Status fmi3GetUInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         fmi3UInt32 values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3GetUInt32", UINT32, false, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        values[a.first] = (fmi3UInt32)*a.numbers;
    }
    return a.status;
}

fmi3Status fmi3GetBoolean(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Boolean values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3GetBoolean", BOOLEAN, false, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        values[a.first] = *a.numbers != 0.0;
    }
    return a.status;
}

fmi3Status fmi3SetBoolean(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Boolean values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3SetBoolean", BOOLEAN, true, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        *a.numbers = values[a.first] ? 1.0 : 0.0;
    }
    return a.status;
}

fmi3Status fmi3GetString(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         fmi3String values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3GetString", STRING, false, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        values[a.first] = *a.text;
    }
    return a.status;
}

fmi3Status fmi3SetString(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                         const fmi3String values[], size_t nValues)
{
    struct access a =
        begin(instance, "fmi3SetString", STRING, true, valueReferences, nValueReferences, values, nValues);
    while (next(&a)) {
        char *text = copy_of(values[a.first]);
        if (text == NULL) {
            log_message(instance, fmi3Error, "fmi3SetString: a text is NULL, or there is no memory for it");
            return fmi3Error;
        }
        free(*a.text);
        *a.text = text;
    }
    return a.status;
}
