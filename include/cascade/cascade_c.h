/* Cascade as a C library: runs a script as a pattern inside your own program.
 *
 *     cascade_pattern* spots;
 *     cascade_view* view;
 *     const void* b;
 *     if (cascade_create("stage one: turing_spots { ka: 1/80 }", NULL, &spots) != CASCADE_OK) {
 *         fputs(cascade_last_message(), stderr);
 *         return 2;
 *     }
 *     cascade_run(spots, NULL, NULL);
 *     cascade_view_open(spots, "b", &view, NULL);
 *     cascade_view_data(view, &b);
 *
 * The header is C99. Link with -lcascade, or load libcascade.so.0 with dlopen(). No function
 * throws, prints or ends the program. Each returns a status: CASCADE_OK, which is 0, or the reason
 * why the function has done nothing. If the thread that got an error calls cascade_last_error(), it
 * receives the message, hint and position of the error.
 *
 * Any thread may use a handle. A call waits until all other calls with the same pattern have
 * returned. Only cascade_cancel() does not wait. If a handle is null, was freed or was never made,
 * functions return CASCADE_BAD_HANDLE. Handles are not addresses, and no handle is ever reused.
 *
 * Strings that functions return are UTF-8 if the script is. They stay valid until the same thread
 * calls a function of this header again. Strings that are passed to functions are copied. They must
 * not be null unless a comment permits it.
 *
 * Structures begin with the member `size`, which the caller must set to the sizeof of the
 * structure. A later version of the library writes no more than this number of bytes. */
#ifndef CASCADE_CASCADE_C_H
#define CASCADE_CASCADE_C_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CASCADE_C_API __attribute__((visibility("default")))
#else
#define CASCADE_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. It increases when functions or members are added. Existing
 * functions and members are never changed or removed. */
#define CASCADE_C_VERSION 2

typedef int32_t cascade_status;
enum {
    CASCADE_OK = 0,
    CASCADE_BAD_HANDLE = 1,   /* The handle is null, was freed or was never made. */
    CASCADE_BAD_ARGUMENT = 2, /* A null pointer, no size, or an index out of range. */
    CASCADE_BAD_SCRIPT = 3,   /* The script has errors. See cascade_message_at(). */
    CASCADE_REFUSED = 4,      /* An expression or change is invalid. Nothing changed. */
    CASCADE_FAILED = 5,       /* Values are infinite or NaN, or the run cannot begin. */
    CASCADE_OUTDATED = 6,     /* The pattern was changed or freed while a view was open. */
    CASCADE_CANCELLED = 7,    /* Ended by a callback or cascade_cancel(). Call again to continue. */
    CASCADE_NO_MEMORY = 8
};

typedef struct cascade_pattern cascade_pattern;
typedef struct cascade_view cascade_view;

/* The first function returns the version of this interface in the loaded library, which is
 * CASCADE_C_VERSION or later. The second returns the version of Cascade, such as "0.1.0". */
CASCADE_C_API int32_t cascade_c_version(void);
CASCADE_C_API const char* cascade_version(void);

/* The error of the last call in this thread that failed. */
typedef struct cascade_error {
    size_t size; /* sizeof(cascade_error) */
    cascade_status status;
    int32_t line, column; /* Counted from 1. 0 if the error has no position. */
    const char* file;     /* The name of the script, option or expression, such as "<--set>". */
    const char* message;
    const char* hint; /* A suggestion. May be empty. */
} cascade_error;
CASCADE_C_API cascade_status cascade_last_error(cascade_error* error);
/* The last error as text, with the line of the script, as the command line prints it. */
CASCADE_C_API const char* cascade_last_message(void);

/* Options for running a pattern. Zeros and null pointers select the defaults. */
typedef struct cascade_options {
    size_t size;             /* sizeof(cascade_options) */
    int32_t interpret;       /* Not 0: equations are interpreted; same results. */
    int32_t threads;         /* 0: as many as the machine has. */
    const char* name;        /* The script's name in messages. Default "<script>". */
    const char* folder;      /* Where relative paths in the script start. Default ".". */
    size_t set_count;        /* Values of parameters and settings, like --set: */
    const char* const* sets; /* "ka=1/80", "spots.ka=1/80". */
    int32_t has_seed;        /* Not 0: `seed` replaces the script's seed. */
    uint32_t seed;
} cascade_options;

/* Makes a pattern from a script. `options` may be null. If the script has errors or its run
 * cannot begin, *pattern is still a valid handle. Use it to read the messages, and free it. After
 * an invalid argument, or if memory is exhausted, *pattern is null. */
CASCADE_C_API cascade_status cascade_create(const char* script, const cascade_options* options,
                                            cascade_pattern** pattern);
/* Opens a script, a picture that contains one, a session, or the folder of a saved run. */
CASCADE_C_API cascade_status cascade_open(const char* path, const cascade_options* options,
                                          cascade_pattern** pattern);
/* Repeats a session to its end. `session` is the text of cascade_session() or the bytes of a
 * picture. The sets and the seed of `options` are ignored. */
CASCADE_C_API cascade_status cascade_play(const void* session, size_t bytes,
                                          const cascade_options* options,
                                          cascade_pattern** pattern);
CASCADE_C_API cascade_status cascade_free(cascade_pattern* pattern);

/* Errors and warnings of the script, in the order of their positions in it. */
typedef struct cascade_message {
    size_t size; /* sizeof(cascade_message) */
    int32_t is_error;
    int32_t line, column; /* Counted from 1. */
    const char* file;
    const char* text;
    const char* hint; /* May be empty. */
} cascade_message;
CASCADE_C_API cascade_status cascade_message_count(cascade_pattern* pattern, size_t* count);
CASCADE_C_API cascade_status cascade_message_at(cascade_pattern* pattern, size_t index,
                                                cascade_message* message);
/* All errors and warnings as text, as the command line prints them. */
CASCADE_C_API cascade_status cascade_messages(cascade_pattern* pattern, const char** text);

/* The progress of a pattern. */
typedef struct cascade_state {
    size_t size;                  /* sizeof(cascade_state) */
    int64_t width, height, depth; /* In cells. The cells of a model are one row. */
    int32_t stage, stage_count;   /* The stage that takes steps now, counted from 0. */
    int64_t steps;                /* Complete steps of the present stage. */
    int32_t is_finished;          /* Not 0: every stage has taken all its steps. */
    uint64_t moment;              /* Changes with every step and every change. */
} cascade_state;
CASCADE_C_API cascade_status cascade_get_state(cascade_pattern* pattern, cascade_state* state);
CASCADE_C_API cascade_status cascade_stage_name(cascade_pattern* pattern, int32_t stage,
                                                const char** name);
CASCADE_C_API cascade_status cascade_species_count(cascade_pattern* pattern, int32_t stage,
                                                   size_t* count);
CASCADE_C_API cascade_status cascade_species_name(cascade_pattern* pattern, int32_t stage,
                                                  size_t index, const char** name);

/* The parameters of all stages, in the order of the script. */
typedef struct cascade_parameter {
    size_t size; /* sizeof(cascade_parameter) */
    const char* stage;
    const char* name;
    const char* doc;        /* The comment that describes it. May be empty. */
    int32_t is_uniform;     /* Not 0: the same value in all cells. */
    double value;           /* NaN if not uniform, or before its stage begins. */
    int32_t has_range;      /* Whether the script says `in low .. high step s`. */
    double low, high, step; /* 0 without a range. `step` is also 0 if not given. */
} cascade_parameter;
CASCADE_C_API cascade_status cascade_parameter_count(cascade_pattern* pattern, size_t* count);
CASCADE_C_API cascade_status cascade_parameter_at(cascade_pattern* pattern, size_t index,
                                                  cascade_parameter* parameter);

/* A callback receives the progress about ten times a second, in the thread that takes the steps.
 * It returns 0 to cancel. With the pattern that takes the steps, it may call no function except
 * cascade_cancel(). The callback may be null. */
typedef struct cascade_progress {
    size_t size; /* Members beyond this size must not be read. */
    const char* stage;
    int32_t stage_number, stage_count; /* Counted from 1. */
    int64_t step, steps;
    double t, duration;      /* `duration` is 0 unless it ends the stage. */
    double steps_per_second; /* 0 while unknown. */
    double seconds_left;     /* Until the stage ends. Negative while unknown. */
} cascade_progress;
typedef int32_t (*cascade_callback)(const cascade_progress* progress, void* user);

/* Takes up to `count` steps, also across the ends of stages. `taken` receives the number of steps
 * taken. It may be null. */
CASCADE_C_API cascade_status cascade_step(cascade_pattern* pattern, int64_t count, int64_t* taken);
/* Takes all steps. */
CASCADE_C_API cascade_status cascade_run(cascade_pattern* pattern, cascade_callback callback,
                                         void* user);
/* Makes a cascade_step() or cascade_run() in another thread return after its present step. */
CASCADE_C_API cascade_status cascade_cancel(cascade_pattern* pattern);

/* Changes the pattern between two steps. cascade.h describes functions with the same names, which
 * do the same. A refused change has no effect. */
CASCADE_C_API cascade_status cascade_set(cascade_pattern* pattern, const char* name,
                                         const char* expression);
CASCADE_C_API cascade_status cascade_set_number(cascade_pattern* pattern, const char* name,
                                                double value);
CASCADE_C_API cascade_status cascade_set_script(cascade_pattern* pattern, const char* script);
CASCADE_C_API cascade_status cascade_paint(cascade_pattern* pattern, const char* item,
                                           const char* expression);
/* Sets a species or another item that cascade_paint() can change to a number for each cell, in the
 * order of cascade_values(). `count` must be the number of all cells. Since version 2. */
CASCADE_C_API cascade_status cascade_set_values(cascade_pattern* pattern, const char* item,
                                                const double* values, size_t count);
CASCADE_C_API cascade_status cascade_begin_next_stage(cascade_pattern* pattern);
CASCADE_C_API cascade_status cascade_undo(cascade_pattern* pattern);
CASCADE_C_API cascade_status cascade_redo(cascade_pattern* pattern);

/* A view contains the values of an expression in all cells. If the expression is a species or a
 * varying parameter on a grid without a mask, the view refers to the pattern's own memory.
 * Otherwise the values are computed when the view is opened, and `is_computed` is not 0. */
typedef struct cascade_shape {
    size_t size;  /* sizeof(cascade_shape) */
    int32_t bits; /* 32: float. 64: double, with `precision: double`. */
    int32_t is_computed;
    int64_t width, height, depth;
    int64_t row_bytes;   /* From one row to the next. Cells of a row are adjacent. */
    int64_t slice_bytes; /* From one slice to the next. */
} cascade_shape;
/* Opens a view of an expression. `shape` may be null. */
CASCADE_C_API cascade_status cascade_view_open(cascade_pattern* pattern, const char* expression,
                                               cascade_view** view, cascade_shape* shape);
/* Sets *data to the address of the first cell. If the pattern has changed since the view was
 * opened, returns CASCADE_OUTDATED. Until the view is closed, an address from an earlier call can
 * still be read, and contains the values of the moment when the view was opened. While a view is
 * open, the next step copies its plane once. To avoid this, close views before the step. */
CASCADE_C_API cascade_status cascade_view_data(cascade_view* view, const void** data);
CASCADE_C_API cascade_status cascade_view_close(cascade_view* view);

/* Copies the values of an expression, row by row. `count` must be the number of all cells. */
CASCADE_C_API cascade_status cascade_values(cascade_pattern* pattern, const char* expression,
                                            double* values, size_t count);

/* Measures a feature of the picture, or of an expression if that is not null. `name` is
 * "wavelength", "spots", "holes", "area", "angle", "anisotropy", "mean", "deviation", "smallest" or
 * "largest". The value is NaN if the pattern does not have the feature. */
CASCADE_C_API cascade_status cascade_feature(cascade_pattern* pattern, const char* expression,
                                             const char* name, double* value);
/* The remarks of `cascade run` on the present state of the stages, one in each line. May be
 * empty. */
CASCADE_C_API cascade_status cascade_remarks(cascade_pattern* pattern, const char** text);
/* Predicts what will grow in a stage, in words or as JSON. `stage` is a name, or null for the
 * first stage. */
CASCADE_C_API cascade_status cascade_analyze(cascade_pattern* pattern, const char* stage,
                                             int32_t as_json, const char** text);

/* Draws the picture of the script, or an expression if that is not null, as a PNG file that
 * contains the session. The first function returns the file in memory, which stays valid as long as
 * a returned string does. The second one writes the file to a path that ends in .png. */
CASCADE_C_API cascade_status cascade_picture(cascade_pattern* pattern, const char* expression,
                                             const void** data, size_t* bytes);
CASCADE_C_API cascade_status cascade_write_picture(cascade_pattern* pattern, const char* expression,
                                                   const char* path);
/* Writes the present moment to a file in the format of its ending: a picture, a figure, a model,
 * crawling cells or a volume. `options` is null, or a JSON object with options of `cascade run`,
 * such as {"palette": "viridis", "bake": 2048}. Since version 2. */
CASCADE_C_API cascade_status cascade_write(cascade_pattern* pattern, const char* path,
                                           const char* options);
/* Takes all remaining steps, and writes a film of them with a frame after every `every` steps. If
 * `every` is 0, the smallest interval of the stages is used, where a stage without an interval
 * counts with a fiftieth of its steps. The callback may be null. Since version 2. */
CASCADE_C_API cascade_status cascade_film(cascade_pattern* pattern, const char* path, int64_t every,
                                          const char* options, cascade_callback callback,
                                          void* user);
/* The script as an HTML page that runs in browsers without the library, as `cascade export` writes
 * it. The page needs engine.wasm beside the library. Since version 2. */
CASCADE_C_API cascade_status cascade_page(cascade_pattern* pattern, const char** html);

/* The cells and triangles of a model. Positions are x, y and z of each point, 0 to 1 along the
 * longest side of the model's box. The arrays stay valid as long as a returned string does. */
typedef struct cascade_model {
    size_t size; /* sizeof(cascade_model) */
    size_t cell_count, link_count, vertex_count, triangle_count;
    const double* points;      /* 3 for each cell, in the order of cascade_values(). */
    const double* areas;       /* 1 for each cell. */
    const uint32_t* links;     /* 2 cells for each link, the lower one first. */
    const double* weights;     /* 1 for each link: the edge's length divided by the distance. */
    const double* vertices;    /* 3 for each vertex. */
    const uint32_t* triangles; /* 3 for each triangle, counterclockwise from outside. */
} cascade_model;
/* Refused if the pattern grows on a grid. Since version 2. */
CASCADE_C_API cascade_status cascade_get_model(cascade_pattern* pattern, cascade_model* model);

/* The log of all steps and changes, as text. Refused if no log can repeat the pattern, because it
 * began with saved values or because more than 256 MiB of values were set. */
CASCADE_C_API cascade_status cascade_session(cascade_pattern* pattern, const char** text);
/* Saves all values to a folder, for cascade_open() and `cascade run --resume`. */
CASCADE_C_API cascade_status cascade_save(cascade_pattern* pattern, const char* folder);

#ifdef __cplusplus
}
#endif

#endif
