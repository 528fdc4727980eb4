/* The state of an instance, to return to it or to go on from it in another instance. */
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "instance.h"
#include "water.h"

/* A state is one block of bytes, which is also its serialised form: this head, the values of the variables, the nodes
   that the element was built with, the text of the parameter `settings` with its zero, and the element. The folder of
   the parameter `record` is of the instance, not of the state. */
struct head {
    char magic[8];
    uint64_t size; /* of the whole block [bytes] */
    char token[64];
    uint32_t version, mode;
    double start_time, time, stop_time;
    uint64_t stop_time_defined, nodes, numbers, settings, element; /* the last two in bytes */
    uint64_t saved; /* number of the state that the element saved with it, or 0 */
};

static const char MAGIC[8] = "sd-state";

/* Of states saved by elements in this process. A run with records returns only to the state that its element saved
   last: its files return with it. */
static atomic_uint_least64_t saved_states;

/* Parts of a block; NULL where the block holds none. */
struct parts {
    struct head head;
    const unsigned char *numbers, *built, *settings, *element;
};

static uint64_t size_of_block(const struct head *head)
{
    return sizeof *head + 8 * head->numbers + 48 * head->nodes + head->settings + head->element;
}

/* The parts of a block of this unit; false and a message for any other. */
static bool divide(const struct instance *instance, const unsigned char *block, size_t size, struct parts *parts)
{
    const struct layout *layout = &instance->layout;
    bool ours = block != NULL && size >= sizeof parts->head;
    if (ours) {
        struct head *head = &parts->head;
        memcpy(head, block, sizeof *head);
        parts->numbers = block + sizeof *head;
        parts->built = parts->numbers + 8 * layout->total;
        parts->settings = parts->built + 48 * layout->nodes;
        parts->element = parts->settings + head->settings;
        ours = memcmp(head->magic, MAGIC, sizeof MAGIC) == 0 && head->version == splashdown_abi_version()
               && strncmp(head->token, instance->token, sizeof head->token) == 0 && head->size == size
               && head->nodes == layout->nodes && head->numbers == layout->total && head->mode <= TERMINATED
               && head->settings > 0 && head->settings <= size && head->element <= size && size_of_block(head) == size
               && parts->settings[head->settings - 1] == '\0';
    }
    if (!ours) {
        log_message(instance, fmi3Error, "%zu bytes are not a state of this unit in this version", size);
    }
    return ours;
}

fmi3Status fmi3GetFMUState(fmi3Instance given, fmi3FMUState *FMUState)
{
    struct instance *instance = given;
    if (instance == NULL || FMUState == NULL) {
        return fmi3Error;
    }
    size_t element = 0;
    if (instance->element != NULL) {
        const fmi3Status status =
            checked(instance, "fmi3GetFMUState", splashdown_state_size(instance->element, &element));
        if (status != fmi3OK) {
            return status;
        }
    }
    if (instance->element != NULL && *instance->texts[TEXT_RECORD] != '\0') {
        const fmi3Status status = checked(instance, "fmi3GetFMUState", splashdown_save(instance->element));
        if (status != fmi3OK) {
            return status;
        }
        instance->saved = atomic_fetch_add(&saved_states, 1) + 1;
    }
    const struct layout *layout = &instance->layout;
    struct head head = {.version = splashdown_abi_version(),
                        .mode = instance->mode,
                        .start_time = instance->start_time,
                        .time = instance->time,
                        .stop_time = instance->stop_time,
                        .stop_time_defined = instance->stop_time_defined,
                        .nodes = layout->nodes,
                        .numbers = layout->total,
                        .settings = strlen(instance->texts[TEXT_SETTINGS]) + 1,
                        .element = element,
                        .saved = instance->saved};
    head.size = size_of_block(&head);
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    strncpy(head.token, instance->token, sizeof head.token - 1);
    unsigned char *block = malloc(head.size), *at = block;
    if (block == NULL) {
        log_message(instance, fmi3Error, "fmi3GetFMUState: no memory for %llu bytes", (unsigned long long)head.size);
        return fmi3Error;
    }
    memcpy(at, &head, sizeof head);
    at += sizeof head;
    memcpy(at, instance->numbers, 8 * layout->total);
    at += 8 * layout->total;
    memcpy(at, instance->built, 48 * layout->nodes);
    at += 48 * layout->nodes;
    memcpy(at, instance->texts[TEXT_SETTINGS], head.settings);
    at += head.settings;
    if (element > 0) {
        const fmi3Status status =
            checked(instance, "fmi3GetFMUState", splashdown_state_write(instance->element, at, element));
        if (status != fmi3OK) {
            free(block);
            return status;
        }
    }
    free(*FMUState);
    *FMUState = block;
    return fmi3OK;
}

/* Whether the instance has an element that was built as that of the state. */
static bool same_element(const struct instance *instance, const struct parts *parts)
{
    const size_t spacing = place_of(&instance->layout, SPACING);
    return instance->element != NULL && memcmp(instance->built, parts->built, 48 * instance->layout.nodes) == 0
           && memcmp(instance->numbers + spacing, parts->numbers + 8 * spacing, 8) == 0
           && strcmp(instance->texts[TEXT_SETTINGS], (const char *)parts->settings) == 0;
}

fmi3Status fmi3SetFMUState(fmi3Instance given, fmi3FMUState FMUState)
{
    struct instance *instance = given;
    if (instance == NULL) {
        return fmi3Error;
    }
    struct parts parts;
    struct head head;
    if (FMUState != NULL) {
        memcpy(&head, FMUState, sizeof head);
    }
    if (!divide(instance, FMUState, FMUState == NULL ? 0 : head.size, &parts)) {
        return fmi3Error;
    }
    const bool kept = parts.head.element > 0 && same_element(instance, &parts);
    char *settings = copy_of((const char *)parts.settings);
    if (settings == NULL) {
        log_message(instance, fmi3Error, "fmi3SetFMUState: no memory");
        return fmi3Error;
    }
    free(instance->texts[TEXT_SETTINGS]);
    instance->texts[TEXT_SETTINGS] = settings;
    memcpy(instance->numbers, parts.numbers, 8 * instance->layout.total);
    instance->mode = parts.head.mode;
    instance->start_time = parts.head.start_time;
    instance->time = parts.head.time;
    instance->stop_time_defined = parts.head.stop_time_defined != 0;
    instance->stop_time = parts.head.stop_time;
    fmi3Status status = fmi3OK;
    if (!kept) {
        status = open_scene(instance);
        if (status == fmi3OK && parts.head.element > 0) {
            memcpy(instance->built, parts.built, 48 * instance->layout.nodes);
            status = build_element(instance, instance->built);
            memcpy(instance->numbers, parts.numbers, 8 * instance->layout.total);
        }
    }
    if (kept && parts.head.saved > 0 && parts.head.saved == instance->saved) {
        status = checked(instance, "fmi3SetFMUState", splashdown_restore(instance->element));
    } else if (status == fmi3OK && parts.head.element > 0) {
        status = checked(instance, "fmi3SetFMUState",
                         splashdown_state_read(instance->element, parts.element, parts.head.element));
    }
    instance->failed = status != fmi3OK;
    return status;
}

fmi3Status fmi3FreeFMUState(fmi3Instance given, fmi3FMUState *FMUState)
{
    if (given == NULL || FMUState == NULL) {
        return fmi3Error;
    }
    free(*FMUState);
    *FMUState = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance given, fmi3FMUState FMUState, size_t *size)
{
    struct instance *instance = given;
    if (instance == NULL || FMUState == NULL || size == NULL) {
        return fmi3Error;
    }
    struct head head;
    memcpy(&head, FMUState, sizeof head);
    *size = head.size;
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance given, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    struct instance *instance = given;
    size_t needed;
    if (fmi3SerializedFMUStateSize(given, FMUState, &needed) != fmi3OK || serializedState == NULL) {
        return fmi3Error;
    }
    if (size < needed) {
        log_message(instance, fmi3Error, "fmi3SerializeFMUState: %zu bytes, expected %zu", size, needed);
        return fmi3Error;
    }
    memcpy(serializedState, FMUState, needed);
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance given, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState)
{
    struct instance *instance = given;
    struct parts parts;
    if (instance == NULL || FMUState == NULL || !divide(instance, serializedState, size, &parts)) {
        return fmi3Error;
    }
    void *block = malloc(size);
    if (block == NULL) {
        log_message(instance, fmi3Error, "fmi3DeserializeFMUState: no memory for %zu bytes", size);
        return fmi3Error;
    }
    parts.head.saved = 0;
    memcpy(block, serializedState, size);
    free(*FMUState);
    *FMUState = memcpy(block, &parts.head, sizeof parts.head);
    return fmi3OK;
}
