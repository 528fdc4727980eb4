/* Life of an instance: from its instantiation to its end. */
#include "instance.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "water.h"

void log_message(const struct instance *instance, fmi3Status status, const char *format, ...)
{
    static const char *const CATEGORY[] = {
        [fmi3Warning] = "logStatusWarning",
        [fmi3Discard] = "logStatusDiscard",
        [fmi3Error] = "logStatusError",
        [fmi3Fatal] = "logStatusFatal",
    };
    if (instance->logger == NULL) {
        return;
    }
    char text[4352];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    instance->logger(instance->environment, status, CATEGORY[status], text);
}

fmi3Status expect_mode(const struct instance *instance, const char *call, unsigned allowed)
{
    static const char *const NAME[] = {"Instantiated", "Initialization Mode", "Step Mode", "Terminated"};
    if (instance == NULL) {
        return fmi3Error;
    }
    if ((in(instance->mode) & allowed) == 0) {
        log_message(instance, fmi3Error, "%s is not allowed in the state %s", call, NAME[instance->mode]);
        return fmi3Error;
    }
    return fmi3OK;
}

char *copy_of(const char *text)
{
    const size_t size = text == NULL ? 0 : strlen(text) + 1;
    char *copy = size == 0 ? NULL : malloc(size);
    return copy == NULL ? NULL : memcpy(copy, text, size);
}

bool make_room(struct instance *instance, size_t nodes)
{
    instance->layout = lay_out(instance->interface, nodes);
    instance->numbers = calloc(instance->layout.total, sizeof *instance->numbers);
    instance->first = calloc(6 * nodes, sizeof *instance->first);
    instance->built = calloc(6 * nodes, sizeof *instance->built);
    instance->moved = calloc(6 * nodes, sizeof *instance->moved);
    instance->forces = calloc(3 * nodes, sizeof *instance->forces);
    return instance->numbers != NULL && instance->first != NULL && instance->built != NULL && instance->moved != NULL
           && instance->forces != NULL;
}

/* Reads resources/unit.txt: the interface, the token, and a line for each setting. */
static bool read_unit(struct instance *instance, const char *resources)
{
    const size_t room = strlen(resources) + 32;
    char *path = malloc(room), line[4096];
    instance->scene_file = malloc(room);
    if (path == NULL || instance->scene_file == NULL) {
        free(path);
        return false;
    }
    const char *slash = *resources != '\0' && resources[strlen(resources) - 1] == '/' ? "" : "/";
    snprintf(instance->scene_file, room, "%s%sscene.toml", resources, slash);
    snprintf(path, room, "%s%sunit.txt", resources, slash);
    FILE *file = fopen(path, "r");
    bool read = file != NULL;
    while (read && fgets(line, sizeof line, file) != NULL) {
        line[strcspn(line, "\n")] = '\0';
        const char *value = strchr(line, ' ') == NULL ? "" : strchr(line, ' ') + 1;
        if (strncmp(line, "interface ", 10) == 0) {
            instance->interface = interface_of(value);
            read = instance->interface >= 0;
        } else if (strncmp(line, "token ", 6) == 0 && instance->token == NULL) {
            read = (instance->token = copy_of(value)) != NULL;
        } else if (strncmp(line, "set ", 4) == 0) {
            char **more = realloc(instance->settings, (instance->setting_count + 1) * sizeof *more);
            read = more != NULL;
            if (read) {
                instance->settings = more;
                read = (more[instance->setting_count++] = copy_of(value)) != NULL;
            }
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    if (!read || instance->token == NULL) {
        log_message(instance, fmi3Error, "%s cannot be read", path);
    }
    free(path);
    return read && instance->token != NULL;
}

/* Values at the start: nodes of the scene, zeros, no texts. */
static void set_start_values(struct instance *instance)
{
    memset(instance->numbers, 0, instance->layout.total * sizeof *instance->numbers);
    inputs_of_nodes(instance, instance->first);
    for (size_t k = 0; k < TEXT_COUNT; k++) {
        instance->texts[k][0] = '\0';
    }
    instance->mode = INSTANTIATED;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate)
{
    struct instance *instance = calloc(1, sizeof *instance);
    if (instance == NULL) {
        return NULL;
    }
    instance->environment = instanceEnvironment;
    instance->logger = logMessage;
    instance->name = copy_of(instanceName);
    bool made = instance->name != NULL && instantiationToken != NULL && resourcePath != NULL;
    for (size_t k = 0; k < TEXT_COUNT; k++) {
        made = (instance->texts[k] = copy_of("")) != NULL && made;
    }
    if (!made) {
        log_message(instance, fmi3Error,
                    "fmi3InstantiateCoSimulation needs a name, a token and the path of the resources");
    } else if (eventModeUsed || nRequiredIntermediateVariables > 0) {
        log_message(instance, fmi3Error, "the unit has no Event Mode and no intermediate updates");
    } else if (read_unit(instance, resourcePath)) {
        if (strcmp(instance->token, instantiationToken) != 0) {
            log_message(instance, fmi3Error, "the token is %s, expected %s", instantiationToken, instance->token);
        } else if (open_scene(instance) == fmi3OK) {
            set_start_values(instance);
            return instance;
        }
    }
    fmi3FreeInstance(instance);
    return NULL;
}

void fmi3FreeInstance(fmi3Instance given)
{
    struct instance *instance = given;
    if (instance == NULL) {
        return;
    }
    drop_water(instance);
    for (size_t k = 0; k < instance->setting_count; k++) {
        free(instance->settings[k]);
    }
    for (size_t k = 0; k < TEXT_COUNT; k++) {
        free(instance->texts[k]);
    }
    free(instance->settings);
    free(instance->numbers);
    free(instance->first);
    free(instance->built);
    free(instance->moved);
    free(instance->forces);
    free(instance->scene_file);
    free(instance->token);
    free(instance->name);
    free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance given, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    struct instance *instance = given;
    const fmi3Status status = expect_mode(instance, "fmi3EnterInitializationMode", in(INSTANTIATED));
    if (status != fmi3OK) {
        return status;
    }
    if (!isfinite(startTime) || (stopTimeDefined && !(stopTime > startTime))) {
        log_message(instance, fmi3Error, "start %g s and stop %g s: expected a finite start before the stop", startTime,
                    stopTime);
        return fmi3Error;
    }
    instance->start_time = instance->time = startTime;
    instance->stop_time_defined = stopTimeDefined;
    instance->stop_time = stopTime;
    instance->mode = INITIALIZATION;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance given)
{
    struct instance *instance = given;
    fmi3Status status = expect_mode(instance, "fmi3ExitInitializationMode", in(INITIALIZATION));
    if (status == fmi3OK) {
        status = begin_water(instance);
    }
    if (status == fmi3OK) {
        instance->mode = STEP;
    }
    return status;
}

fmi3Status fmi3Terminate(fmi3Instance given)
{
    struct instance *instance = given;
    fmi3Status status = expect_mode(instance, "fmi3Terminate", in(STEP));
    if (status == fmi3OK) {
        status = finish_element(instance);
        instance->mode = TERMINATED;
    }
    return status;
}

fmi3Status fmi3Reset(fmi3Instance given)
{
    struct instance *instance = given;
    if (instance == NULL) {
        return fmi3Error;
    }
    for (size_t k = 0; k < TEXT_COUNT; k++) {
        instance->texts[k][0] = '\0';
    }
    instance->numbers[place_of(&instance->layout, SPACING)] = 0.0;
    const fmi3Status status = open_scene(instance);
    set_start_values(instance);
    return status;
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    return instance == NULL ? fmi3Error : fmi3OK; /* warnings and errors are always logged, and there is nothing else */
}
