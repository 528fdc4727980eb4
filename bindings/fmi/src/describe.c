/* Prints what the model description needs, as JSON: `describe TOKEN RESOURCES` for the resources of a unit. */
#include <stdio.h>
#include <stdlib.h>

#include "instance.h"

static void print_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                          fmi3String message)
{
    fprintf(stderr, "%s: %s\n", status == fmi3Warning ? "warning" : "error", message);
}

static void print_variable(const struct instance *instance, size_t index)
{
    static const char *const TYPE[] = {"Float64", "UInt32", "Boolean", "String"};
    static const char *const CAUSALITY[] = {"input", "output", "parameter"};
    const struct variable *variable = &instance->layout.variables[index];
    printf("%s{\"reference\": %zu, \"name\": \"%s\", \"type\": \"%s\", \"causality\": \"%s\", \"columns\": %d, ",
           index == 0 ? "" : ",\n  ", index + 1, variable->name, TYPE[variable->type], CAUSALITY[variable->causality],
           variable->columns);
    printf("\"unit\": \"%s\", \"description\": \"%s\", \"start\": [", variable->unit == NULL ? "" : variable->unit,
           variable->description);
    for (size_t k = 0; k < size_of(&instance->layout, index); k++) {
        printf("%s%.17g", k == 0 ? "" : ", ", instance->numbers[instance->layout.offset[index] + k]);
    }
    printf("]}");
}

int main(int count, char **arguments)
{
    if (count != 3) {
        fprintf(stderr, "usage: describe TOKEN RESOURCES\n");
        return 2;
    }
    struct instance *instance = fmi3InstantiateCoSimulation("describe", arguments[1], arguments[2], false, false, false,
                                                            false, NULL, 0, NULL, print_message, NULL);
    if (instance == NULL) {
        return 2;
    }
    printf("{\"version\": \"%s\", \"nodes\": %zu, \"variables\": [\n  ", splashdown_version(), instance->layout.nodes);
    for (size_t k = 0; k < instance->layout.count; k++) {
        print_variable(instance, k);
    }
    printf("\n]}\n");
    fmi3FreeInstance(instance);
    return 0;
}
