/* splashdown: water under the body of a host program. Written by cbindgen from bindings/c/src: do not edit.
 *
 * A host program has its own time loop and moves the body; splashdown moves the water and returns the forces.
 * Four phases, in this order:
 *
 *     splashdown_open        specify: a scene, built in or of a file, with settings
 *     splashdown_sizes       size: nodes, particles, bytes, step; nothing that grows with the water is allocated yet
 *     splashdown_build       build: the water at the start; the scene becomes an element
 *     splashdown_contribute  contribute: one step of the host; the forces on its nodes
 *
 * Units are SI, angles are in radians, loads are per metre of span. Positive angles and moments are counter-clockwise.
 *
 * Arrays: positions and velocities are x, y of the first node, then x, y of the second, and so on; forces are
 * F_x, F_y, M of each node. Every array is the caller's, with its length given. A length that does not fit gives
 * SPLASHDOWN_LENGTH. A call that fails writes to no array and to no structure.
 *
 * Errors: every call that can fail gives a status, 0 for success. splashdown_message gives the text of the last error of the
 * calling thread. An internal error gives SPLASHDOWN_PANIC, and later calls with that handle give SPLASHDOWN_AFTER_PANIC
 * until it is freed: no panic leaves the library. splashdown_build refuses water that does not fit in memory
 * (SPLASHDOWN_INPUT); memory that the system refuses later ends the process.
 *
 * Floating-point traps: only those for invalid operations and overflow may be on during calls. A trap for division by zero
 * or for inexact results ends the process.
 *
 * Handles: a handle is a number in the form of a pointer: it is never read through. A handle that was freed or
 * consumed gives SPLASHDOWN_NO_HANDLE. The caller frees what it opened; nothing else is allocated for the caller.
 *
 * Threads: every function may be called from any thread at any time. Calls with two handles are independent of each
 * other: each gives the same bits as alone. While a call with a handle runs, every other call with that handle gives
 * SPLASHDOWN_BUSY and does nothing. All elements share one pool of threads (splashdown_set_threads); the bits do
 * not depend on its size.
 *
 * Processes: a child after fork has the handles but not the threads. It must not use them: a call would wait for ever.
 */


#ifndef SPLASHDOWN_H
#define SPLASHDOWN_H

#include <stddef.h>
#include <stdint.h>

/**
 * Version of this interface. It grows when a program compiled against an earlier header would no longer work.
 */
#define SPLASHDOWN_ABI_VERSION 1

/**
 * How a call ended. The numbers never change; a later version may add some.
 */
typedef enum splashdown_status {
    /**
     * Done.
     */
    SPLASHDOWN_OK = 0,
    /**
     * A pointer is NULL, or not aligned for what it points to.
     */
    SPLASHDOWN_NULL = 1,
    /**
     * A length is not the expected one, or a buffer is too short.
     */
    SPLASHDOWN_LENGTH = 2,
    /**
     * A text is not UTF-8.
     */
    SPLASHDOWN_NOT_UTF8 = 3,
    /**
     * The scene, a setting or a value is wrong; nothing has changed.
     */
    SPLASHDOWN_INPUT = 4,
    /**
     * The water broke down within the step: restore a saved state, or free the element.
     */
    SPLASHDOWN_STEP = 5,
    /**
     * The step before failed, and no saved state was restored since.
     */
    SPLASHDOWN_FAILED = 6,
    /**
     * Nothing was saved.
     */
    SPLASHDOWN_NOTHING_SAVED = 7,
    /**
     * The bytes are not a state of this element, which has failed.
     */
    SPLASHDOWN_STATE = 8,
    /**
     * A file or a folder cannot be read or written.
     */
    SPLASHDOWN_FILE = 9,
    /**
     * Another call with this handle is running; this one did nothing.
     */
    SPLASHDOWN_BUSY = 10,
    /**
     * No such handle: it was freed or consumed, or is not one of this library.
     */
    SPLASHDOWN_NO_HANDLE = 11,
    /**
     * An internal error in this call. Please report it with the message.
     */
    SPLASHDOWN_PANIC = 12,
    /**
     * An internal error in an earlier call with this handle, which can only be freed.
     */
    SPLASHDOWN_AFTER_PANIC = 13,
    /**
     * The pool of threads is already in use, or cannot be made.
     */
    SPLASHDOWN_THREADS = 14,
} splashdown_status;

/**
 * What of the body the host moves. A function takes it as int32_t.
 */
typedef enum splashdown_interface {
    /**
     * One node at the reference point of a rigid body: x, y, angle; forces F_x, F_y, M about it.
     */
    SPLASHDOWN_BODY = 0,
    /**
     * The corners of the body's polygon, or the points of its polyline; straight between them.
     */
    SPLASHDOWN_NODES = 1,
    /**
     * The same with rotations: cubic between them, with moments.
     */
    SPLASHDOWN_TURNING_NODES = 2,
} splashdown_interface;

/**
 * Water under the body of a host.
 */
typedef struct splashdown_element splashdown_element;

/**
 * A scene that is specified and sized.
 */
typedef struct splashdown_scene splashdown_scene;

/**
 * Sizes of a scene, before anything that grows with the water is allocated.
 */
typedef struct splashdown_scene_sizes {
    /**
     * Nodes that the host moves.
     */
    size_t nodes;
    /**
     * 1 if nodes have rotations, 0 if rotations and spins are NULL in every call.
     */
    size_t rotations;
    /**
     * Particles of the water at the start.
     */
    size_t fluid_particles;
    /**
     * Particles of the walls.
     */
    size_t wall_particles;
    /**
     * Memory of the element [bytes].
     */
    uint64_t bytes;
    /**
     * Step of the water at the start [s].
     */
    double fluid_dt;
    /**
     * Warnings about the scene, to be read by splashdown_warning.
     */
    size_t warnings;
    /**
     * Time at the start [s]: below zero where a body starts above the water.
     */
    double start_time;
} splashdown_scene_sizes;

/**
 * What the water did in a step of the host.
 */
typedef struct splashdown_contribution {
    /**
     * Steps that the water took.
     */
    uint64_t fluid_steps;
    /**
     * Longest step that the water could take next [s].
     */
    double fluid_dt;
    /**
     * Longest next step of a host that moves with the force of the last step [s]: an estimate, infinite where it is unknown.
     */
    double host_dt;
    /**
     * Energy given to the nodes [J/m].
     */
    double work;
    /**
     * Impulse given to the nodes, all together [N s/m]: dt times the sum of the forces.
     */
    double impulse[2];
    /**
     * Particles of the water beyond a wall's surface at the end.
     */
    uint64_t penetrated;
    /**
     * How far the deepest of them is beyond it [m].
     */
    double depth;
} splashdown_contribution;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * The text of the last error of the calling thread, UTF-8, ended by a zero; empty if there was none.
 *
 * Returns the bytes that the whole text needs with its zero. A shorter buffer gets the beginning of the text, ended by a zero;
 * NULL or a length of 0 gets nothing. A call that succeeds leaves the text as it is.
 *
 * Memory: `buffer` is NULL or points to `length` writable bytes.
 */
size_t splashdown_message(char *buffer,
                          size_t length);

/**
 * Version of the interface in the library at run time; compare it with SPLASHDOWN_ABI_VERSION of the header.
 */
uint32_t splashdown_abi_version(void);

/**
 * Version of splashdown, such as "0.1.0". The text belongs to the library and stays.
 */
const char *splashdown_version(void);

/**
 * Threads of the pool that all elements share; 0 for one per core, as it is without this call.
 *
 * Call it once, before the first scene is opened. Results do not depend on the number.
 */
enum splashdown_status splashdown_set_threads(size_t count);

/**
 * Open a scene: specify the water and the body.
 *
 * `scene` is the name of a built-in scene or the path of a TOML file; `settings` are `count` texts "key=value" as of
 * `splashdown run --set`, NULL for none. `interface_kind` is one of splashdown_interface. Every option of a scene file may be used. The
 * motion of the body in the scene only gives what is expected (speed of sound, fine zone): the host moves the body.
 *
 * Memory: `scene` and `settings[0..count]` are NULL or texts ended by a zero; `opened` is NULL or points to a handle.
 */
enum splashdown_status splashdown_open(const char *scene,
                                       const char *const *settings,
                                       size_t count,
                                       int32_t interface_kind,
                                       struct splashdown_scene **opened);

/**
 * Sizes of the scene: nodes, particles, bytes, step.
 *
 * Memory: `sizes` is NULL or points to a structure.
 */
enum splashdown_status splashdown_sizes(const struct splashdown_scene *scene,
                                        struct splashdown_scene_sizes *sizes);

/**
 * Warning `index` of the scene, UTF-8, ended by a zero.
 *
 * `needed`, unless NULL, gets the bytes that the text needs with its zero, also where `buffer` is NULL or too short and gets
 * nothing (SPLASHDOWN_LENGTH).
 *
 * Memory: `buffer` is NULL or points to `length` writable bytes; `needed` is NULL or points to a number.
 */
enum splashdown_status splashdown_warning(const struct splashdown_scene *scene,
                                          size_t index,
                                          char *buffer,
                                          size_t length,
                                          size_t *needed);

/**
 * The nodes at the start, with the motion that the scene gives them: `n` nodes into arrays of the caller.
 *
 * An array that is not wanted is NULL. Rotations [rad] and spins [rad/s] are NULL where nodes have none.
 *
 * Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values.
 */
enum splashdown_status splashdown_scene_nodes(const struct splashdown_scene *scene,
                                              double *positions,
                                              double *velocities,
                                              double *rotations,
                                              double *spins,
                                              size_t n);

/**
 * Record the run in `folder`: log.mcap, series.csv, summary.json and report.html as of `splashdown run`.
 *
 * `replace` is 1 to replace a run that is there, 0 to refuse the folder. What was recorded after
 * splashdown_save is discarded by splashdown_restore; the report is written by splashdown_finish.
 *
 * Memory: `folder` is NULL or a text ended by a zero.
 */
enum splashdown_status splashdown_record(struct splashdown_scene *scene, const char *folder, int32_t replace);

/**
 * Build the water at the start; the only phase that allocates what grows with the water.
 *
 * The nodes stand where splashdown_scene_nodes has them; their velocities are what they start with.
 *
 * On SPLASHDOWN_OK the scene is consumed: its handle is gone. After an error it is as before.
 *
 * Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values; `element` is NULL or points
 * to a handle.
 */
enum splashdown_status splashdown_build(struct splashdown_scene *scene,
                                        const double *positions,
                                        const double *velocities,
                                        const double *rotations,
                                        const double *spins,
                                        size_t n,
                                        struct splashdown_element **element);

/**
 * Free a scene that was not built. NULL is allowed.
 */
enum splashdown_status splashdown_free_scene(struct splashdown_scene *scene);

/**
 * Take the water through one step of the host of length `dt` [s], to where the nodes are at its end.
 *
 * `positions` [m] and `velocities` [m/s] have 2n values, `rotations` [rad] and `spins` [rad/s] have n values, or are NULL where
 * nodes have none. They belong together as those of a smooth motion do, x' = x + dt (v + v')/2. `forces` gets 3n values, F_x, F_y
 * [N/m] and M [N] of each node: their mean over the step, so that dt times them is the impulse. `contribution` is NULL if it is
 * not wanted.
 *
 * After SPLASHDOWN_STEP the element waits for splashdown_restore; after any other error nothing has changed. A record that cannot be
 * written ends there: the run goes on, and splashdown_finish gives SPLASHDOWN_FILE.
 *
 * Memory: Arrays are NULL or of the lengths above; `contribution` is NULL or points to a structure.
 */
enum splashdown_status splashdown_contribute(struct splashdown_element *element,
                                             double dt,
                                             const double *positions,
                                             const double *velocities,
                                             const double *rotations,
                                             const double *spins,
                                             size_t n,
                                             double *forces,
                                             struct splashdown_contribution *contribution);

/**
 * Store the present state; it replaces the one stored before. A failed element has none: SPLASHDOWN_FAILED.
 */
enum splashdown_status splashdown_save(struct splashdown_element *element);

/**
 * Return to the state last saved, as often as needed. A step redone from there gives the same bits.
 */
enum splashdown_status splashdown_restore(struct splashdown_element *element);

/**
 * The nodes at the present time of the water: `n` nodes into arrays of the caller, as of splashdown_scene_nodes.
 *
 * Memory: `positions` and `velocities` are NULL or of 2n values, `rotations` and `spins` NULL or of n values.
 */
enum splashdown_status splashdown_nodes(const struct splashdown_element *element,
                                        double *positions,
                                        double *velocities,
                                        double *rotations,
                                        double *spins,
                                        size_t n);

/**
 * Forces of the water on the `n` nodes at this instant, F_x, F_y [N/m] and M [N] of each: 3n values.
 *
 * Memory: `forces` is NULL or of 3n values.
 */
enum splashdown_status splashdown_forces_now(const struct splashdown_element *element,
                                             double *forces,
                                             size_t n);

/**
 * Time of the water [s].
 *
 * Memory: `time` is NULL or points to a number.
 */
enum splashdown_status splashdown_time(const struct splashdown_element *element, double *time);

/**
 * Longest step that the water could take next [s].
 *
 * Memory: `dt` is NULL or points to a number.
 */
enum splashdown_status splashdown_fluid_dt(const struct splashdown_element *element, double *dt);

/**
 * End the run: write summary and report to the folder of splashdown_record. The element is consumed, also after an error.
 */
enum splashdown_status splashdown_finish(struct splashdown_element *element);

/**
 * Free an element without ending its run: what was recorded stays as it is. NULL is allowed.
 */
enum splashdown_status splashdown_free_element(struct splashdown_element *element);

/**
 * Number of the water's particles now.
 *
 * Memory: `count` is NULL or points to a number.
 */
enum splashdown_status splashdown_particle_count(const struct splashdown_element *element, size_t *count);

/**
 * The water's particles now, in the order of their identity, which is the same at every instant: positions x, y [m], velocities
 * u, v [m/s], pressures p [Pa], spacings [m].
 *
 * Each array has room for `length` values, at least splashdown_particle_count; one that is not wanted is NULL.
 *
 * Memory: Arrays are NULL or of `length` writable values.
 */
enum splashdown_status splashdown_particles(struct splashdown_element *element,
                                            double *x,
                                            double *y,
                                            double *u,
                                            double *v,
                                            double *p,
                                            double *spacing,
                                            size_t length);

/**
 * Bytes of the present state. They are kept until splashdown_state_write has written them, or the state has changed.
 *
 * Memory: `size` is NULL or points to a number.
 */
enum splashdown_status splashdown_state_size(struct splashdown_element *element,
                                             size_t *size);

/**
 * Write the present state into `buffer` of at least splashdown_state_size bytes.
 *
 * Memory: `buffer` is NULL or points to `length` writable bytes.
 */
enum splashdown_status splashdown_state_write(struct splashdown_element *element,
                                              uint8_t *buffer,
                                              size_t length);

/**
 * Take a state of an element that was built of the same scene, settings, interface and nodes; the next step gives the same bits.
 *
 * `length` is that of the state. A state saved before is gone. After SPLASHDOWN_STATE the element has failed. A
 * run that is recorded takes no state: SPLASHDOWN_INPUT.
 *
 * Memory: `buffer` is NULL or points to `length` readable bytes.
 */
enum splashdown_status splashdown_state_read(struct splashdown_element *element,
                                             const uint8_t *buffer,
                                             size_t length);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* SPLASHDOWN_H */
