/* Cascade as a C library: a script becomes a running pattern inside your own program.
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
 * C99. Link with -lcascade, or load libcascade.so.0 with dlopen(). No function throws, prints or
 * ends the program. Each returns a status: CASCADE_OK, which is 0, or why it has done nothing.
 * cascade_last_error() then gives message, hint and place to the thread that called it.
 *
 * Handles may be used from any thread: calls with the same pattern take turns, but for
 * cascade_cancel(). A handle that is null, freed or made up is answered by CASCADE_BAD_HANDLE.
 * Handles are not addresses: none is ever used twice.
 *
 * Strings that functions give are UTF-8 as far as the script is. They stay valid until the same
 * thread next calls a function of this header. Strings that are passed in are copied; none may be
 * null unless that is said.
 *
 * Structures begin with their size, which the caller sets to sizeof: a later library fills no more
 * than that. */
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

/* The version of this interface: it grows with additions, and nothing else changes. */
#define CASCADE_C_VERSION 1

typedef int32_t cascade_status;
enum {
    CASCADE_OK = 0,
    CASCADE_BAD_HANDLE = 1,   /* Null, freed, or never made. */
    CASCADE_BAD_ARGUMENT = 2, /* A null pointer, no size, an index out of range. */
    CASCADE_BAD_SCRIPT = 3,   /* The script is wrong: see cascade_message_at(). */
    CASCADE_REFUSED = 4,      /* A wrong expression or change; the pattern is as it was. */
    CASCADE_FAILED = 5,       /* The run failed, such as by infinite values, or cannot begin. */
    CASCADE_OUTDATED = 6,     /* The pattern has moved on, or is freed, since a view of it. */
    CASCADE_CANCELLED = 7,    /* By a callback or cascade_cancel(). The next step goes on. */
    CASCADE_NO_MEMORY = 8
};

typedef struct cascade_pattern cascade_pattern;
typedef struct cascade_view cascade_view;

/* Of the library in use: CASCADE_C_VERSION or later; Cascade's own, such as "0.1.0". */
CASCADE_C_API int32_t cascade_c_version(void);
CASCADE_C_API const char* cascade_version(void);

/* Errors of the calling thread's last call that failed. */
typedef struct cascade_error {
    size_t size; /* sizeof(cascade_error) */
    cascade_status status;
    int32_t line, column; /* From 1; 0 where the error has no place. */
    const char* file;     /* The script's name, or the option or expression, such as "<--set>". */
    const char* message;
    const char* hint; /* What to write instead; may be empty. */
} cascade_error;
CASCADE_C_API cascade_status cascade_last_error(cascade_error* error);
/* The same as text, with the line it is about, as the command line draws it. */
CASCADE_C_API const char* cascade_last_message(void);

/* How a pattern is computed. Zeros and null pointers stand for what is usual. */
typedef struct cascade_options {
    size_t size;             /* sizeof(cascade_options) */
    int32_t interpret;       /* Not 0: do not compile the equations; results are the same. */
    int32_t threads;         /* 0 for all that the machine has. */
    const char* name;        /* The script's name in messages; "<script>". */
    const char* folder;      /* Paths in the script are relative to it; ".". */
    size_t set_count;        /* Values of parameters and settings, as --set takes them: */
    const char* const* sets; /* "ka=1/80", "spots.ka=1/80". */
    int32_t has_seed;        /* Not 0: random numbers have this seed, not the script's: */
    uint32_t seed;
} cascade_options;

/* Makes a pattern of a script. `options` may be null. Where the script is wrong or its run cannot
 * begin, *pattern is a handle, too, which gives the messages and must be freed. It is null after
 * wrong arguments, and where memory is short. */
CASCADE_C_API cascade_status cascade_create(const char* script, const cascade_options* options,
                                            cascade_pattern** pattern);
/* Opens a file: a script, a picture that carries one, a session, or the folder of a saved run. */
CASCADE_C_API cascade_status cascade_open(const char* path, const cascade_options* options,
                                          cascade_pattern** pattern);
/* Plays the text of cascade_session(), or the bytes of a picture, to its end. Neither `sets` nor
 * the seed of options are used. */
CASCADE_C_API cascade_status cascade_play(const void* session, size_t bytes,
                                          const cascade_options* options,
                                          cascade_pattern** pattern);
CASCADE_C_API cascade_status cascade_free(cascade_pattern* pattern);

/* Errors and warnings of the script, in order of their places. */
typedef struct cascade_message {
    size_t size; /* sizeof(cascade_message) */
    int32_t is_error;
    int32_t line, column; /* From 1. */
    const char* file;
    const char* text;
    const char* hint; /* May be empty. */
} cascade_message;
CASCADE_C_API cascade_status cascade_message_count(cascade_pattern* pattern, size_t* count);
CASCADE_C_API cascade_status cascade_message_at(cascade_pattern* pattern, size_t index,
                                                cascade_message* message);
/* All of them as text, as the command line draws them. */
CASCADE_C_API cascade_status cascade_messages(cascade_pattern* pattern, const char** text);

/* Where a pattern is. */
typedef struct cascade_state {
    size_t size;                  /* sizeof(cascade_state) */
    int64_t width, height, depth; /* Cells. Those of a model form one row. */
    int32_t stage, stage_count;   /* The stage that steps are taken in now, from 0. */
    int64_t steps;                /* Complete steps of that stage. */
    int32_t is_finished;          /* Every stage has taken all its steps. */
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
    const char* doc;        /* Its doc comment; may be empty. */
    int32_t is_uniform;     /* One number for all cells. */
    double value;           /* NaN if it varies, or if its stage has not begun. */
    int32_t has_range;      /* `in low .. high step s`: */
    double low, high, step; /* 0 without a range; step 0 if it has none. */
} cascade_parameter;
CASCADE_C_API cascade_status cascade_parameter_count(cascade_pattern* pattern, size_t* count);
CASCADE_C_API cascade_status cascade_parameter_at(cascade_pattern* pattern, size_t index,
                                                  cascade_parameter* parameter);

/* Steps. A callback gets the progress about ten times a second, in the thread that called, and
 * returns 0 to cancel. It may be null. It must not call functions with the same pattern, but for
 * cascade_cancel(). */
typedef struct cascade_progress {
    size_t size; /* As the library was built: read no member beyond it. */
    const char* stage;
    int32_t stage_number, stage_count; /* From 1. */
    int64_t step, steps;
    double t, duration;      /* If the stage ends at a time; otherwise duration is 0. */
    double steps_per_second; /* 0 while unknown. */
    double seconds_left;     /* Of this stage; negative while unknown. */
} cascade_progress;
typedef int32_t (*cascade_callback)(const cascade_progress* progress, void* user);

/* Takes up to `count` steps, from stage to stage. `taken` may be null. */
CASCADE_C_API cascade_status cascade_step(cascade_pattern* pattern, int64_t count, int64_t* taken);
/* Takes all steps. */
CASCADE_C_API cascade_status cascade_run(cascade_pattern* pattern, cascade_callback callback,
                                         void* user);
/* Makes a cascade_step() or cascade_run() of another thread return after its present step. */
CASCADE_C_API cascade_status cascade_cancel(cascade_pattern* pattern);

/* Changes between two steps; see the functions of the same names in cascade.h. A change that is
 * refused has no effect. */
CASCADE_C_API cascade_status cascade_set(cascade_pattern* pattern, const char* name,
                                         const char* expression);
CASCADE_C_API cascade_status cascade_set_number(cascade_pattern* pattern, const char* name,
                                                double value);
CASCADE_C_API cascade_status cascade_set_script(cascade_pattern* pattern, const char* script);
CASCADE_C_API cascade_status cascade_paint(cascade_pattern* pattern, const char* item,
                                           const char* expression);
CASCADE_C_API cascade_status cascade_begin_next_stage(cascade_pattern* pattern);
CASCADE_C_API cascade_status cascade_undo(cascade_pattern* pattern);
CASCADE_C_API cascade_status cascade_redo(cascade_pattern* pattern);

/* The numbers of an expression in all cells. A species or a varying parameter of a grid without a
 * mask is read where the pattern holds it; everything else is computed when the view is opened. */
typedef struct cascade_shape {
    size_t size;  /* sizeof(cascade_shape) */
    int32_t bits; /* 32, float, or with `precision: double` 64, double. */
    int32_t is_computed;
    int64_t width, height, depth;
    int64_t row_bytes;   /* From a row to the next. Cells of a row lie one after the other. */
    int64_t slice_bytes; /* From a slice to the next. */
} cascade_shape;
/* `shape` may be null. */
CASCADE_C_API cascade_status cascade_view_open(cascade_pattern* pattern, const char* expression,
                                               cascade_view** view, cascade_shape* shape);
/* The address of the first cell, or CASCADE_OUTDATED where its values are no longer the present
 * ones. An address that was given before stays readable, with the values of its moment, until the
 * view is closed. While a view is open, the next step copies its plane once: close it first if it
 * is not needed. */
CASCADE_C_API cascade_status cascade_view_data(cascade_view* view, const void** data);
CASCADE_C_API cascade_status cascade_view_close(cascade_view* view);

/* Copies the values of an expression, row by row, into `count` numbers, which must be those of all
 * cells. */
CASCADE_C_API cascade_status cascade_values(cascade_pattern* pattern, const char* expression,
                                            double* values, size_t count);

/* A measured feature of the picture, or of an expression if that is not null; NaN if the pattern
 * lacks it: "wavelength", "spots", "holes", "area", "angle", "anisotropy", "mean", "deviation",
 * "smallest", "largest". */
CASCADE_C_API cascade_status cascade_feature(cascade_pattern* pattern, const char* expression,
                                             const char* name, double* value);
/* Remarks of `cascade run` on the stages so far, each in a line of its own; empty if there are
 * none. */
CASCADE_C_API cascade_status cascade_remarks(cascade_pattern* pattern, const char** text);
/* What will grow in a stage, by its name, or in the first if that is null, as words or as JSON. */
CASCADE_C_API cascade_status cascade_analyze(cascade_pattern* pattern, const char* stage,
                                             int32_t as_json, const char** text);

/* The picture of the script, or of an expression if that is not null, as a PNG file that carries
 * the session; in memory, which stays valid as strings do, or in a file whose name ends in .png. */
CASCADE_C_API cascade_status cascade_picture(cascade_pattern* pattern, const char* expression,
                                             const void** data, size_t* bytes);
CASCADE_C_API cascade_status cascade_write_picture(cascade_pattern* pattern, const char* expression,
                                                   const char* path);
/* The log of all steps and changes. */
CASCADE_C_API cascade_status cascade_session(cascade_pattern* pattern, const char** text);
/* Saves all values in a folder, for cascade_open() and `cascade run --resume`. */
CASCADE_C_API cascade_status cascade_save(cascade_pattern* pattern, const char* folder);

#ifdef __cplusplus
}
#endif

#endif
