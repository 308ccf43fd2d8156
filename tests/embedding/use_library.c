/* Uses every function of cascade_c.h from C99, in a library that dlopen() has loaded:
 * use_library LIBRARY FOLDER. Run by tests/c_library_test.sh. */
#include <cascade/cascade_c.h>

#include <dlfcn.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *library;

/* Every function of the header, loaded by its name. */
#define EACH(X)                                                                       \
    X(c_version) X(version) X(last_error) X(last_message) X(create) X(open) X(play)   \
    X(free) X(message_count) X(message_at) X(messages) X(get_state) X(stage_name)     \
    X(species_count) X(species_name) X(parameter_count) X(parameter_at) X(step)       \
    X(run) X(cancel) X(set) X(set_number) X(set_script) X(paint) X(begin_next_stage)  \
    X(undo) X(redo) X(view_open) X(view_data) X(view_close) X(values) X(feature)      \
    X(remarks) X(analyze) X(picture) X(write_picture) X(session) X(save) X(set_values) \
    X(write) X(film) X(page) X(get_model)
#define DECLARE(name) __typeof__(cascade_##name) *name;
static struct {
    EACH(DECLARE)
} c;

static void *find(const char *name) {
    void *const found = dlsym(library, name);
    if (!found) fprintf(stderr, "%s is not exported\n", name), exit(1);
    return found;
}

#define CHECK(condition)                                                              \
    do {                                                                              \
        if (condition) break;                                                         \
        fprintf(stderr, "%s:%d: %s is false\n", __FILE__, __LINE__, #condition);      \
        fprintf(stderr, "%s\n", c.last_message());                  \
        exit(1);                                                                      \
    } while (0)

static const char *const script =
    "domain { grid: 40, 24 }\n"
    "system s {\n"
    "  ## How fast it goes.\n"
    "  rate: 0.1 in 0 .. 1 step 0.05\n"
    "  place: x\n"
    "  u: 1 + 0.5 * sin(7 * x + 3 * y)\n"
    "  u' = rate * lap(u)\n"
    "}\n"
    "stage one: s { iterations: 30 }\n"
    "stage two: s { iterations: 20; u: u }\n";

static cascade_pattern *made(const char *text) {
    cascade_pattern *pattern = NULL;
    CHECK(c.create(text, NULL, &pattern) == CASCADE_OK);
    return pattern;
}

static cascade_error error_of(void) {
    cascade_error error = {0};
    error.size = sizeof error;
    CHECK(c.last_error(&error) == CASCADE_OK);
    return error;
}

static void tells_errors(void) {
    cascade_pattern *pattern = NULL;
    CHECK(c.create("stage one: turing_spots {\n  kaa: 1\n}\n", NULL, &pattern) == CASCADE_BAD_SCRIPT);
    CHECK(error_of().line == 2 && error_of().column == 3);
    CHECK(strstr(error_of().message, "kaa") && strstr(error_of().hint, "ka"));
    CHECK(strcmp(error_of().file, "<script>") == 0);
    CHECK(strstr(c.last_message(), "^~~"));
    size_t count = 0;
    CHECK(c.message_count(pattern, &count) == CASCADE_OK && count == 1);
    cascade_message message = {0};
    message.size = sizeof message;
    CHECK(c.message_at(pattern, 0, &message) == CASCADE_OK && message.is_error && message.line == 2);
    CHECK(c.message_at(pattern, 1, &message) == CASCADE_BAD_ARGUMENT);
    const char *text = NULL;
    CHECK(c.messages(pattern, &text) == CASCADE_OK && strstr(text, "kaa"));
    CHECK(c.step(pattern, 1, NULL) == CASCADE_BAD_SCRIPT && strstr(c.last_message(), "kaa"));
    CHECK(c.free(pattern) == CASCADE_OK);

    cascade_options options = {0};
    const char *sets[] = {"rate=0.2", "rote=0.2"};
    options.size = sizeof options;
    options.name = "mine";
    options.sets = sets;
    options.set_count = 2;
    CHECK(c.create(script, &options, &pattern) == CASCADE_BAD_SCRIPT);
    CHECK(strcmp(error_of().file, "<--set>") == 0 && strstr(error_of().message, "rote"));
    c.free(pattern);
    static double with_one[40 * 24], with_two[40 * 24];
    options.set_count = 1;
    options.has_seed = 1;
    for (options.seed = 1; options.seed <= 2; ++options.seed) {
        CHECK(c.create("domain { grid: 40, 24 }\nsystem s { rate: 0; u: random(0, 1); u' = rate }\n"
                       "stage one: s { iterations: 1 }", &options, &pattern) == CASCADE_OK);
        CHECK(c.values(pattern, "u", options.seed == 1 ? with_one : with_two, 40 * 24) == CASCADE_OK);
        c.free(pattern);
    }
    CHECK(memcmp(with_one, with_two, sizeof with_one) != 0);
    CHECK(c.open("does/not/exist", NULL, &pattern) == CASCADE_FAILED);
    CHECK(strstr(c.last_message(), "does/not/exist"));
    c.free(pattern);

    pattern = made(
        "system bomb { u: 1; u' = u * u * u }\nstage one: bomb { iterations: 1000 }\n");
    CHECK(c.run(pattern, NULL, NULL) == CASCADE_FAILED && strstr(c.last_message(), "not finite"));
    CHECK(c.step(pattern, 1, NULL) == CASCADE_FAILED);
    CHECK(c.set_number(pattern, "u", 1) == CASCADE_FAILED);
    c.free(pattern);
}

/* Null, freed and made-up handles, and null pointers. */
static void survives_misuse(void) {
    cascade_pattern *pattern = made(script);
    cascade_view *view = NULL;
    const void *data = NULL;
    const char *text = NULL;
    size_t count = 0;
    double value = 0;
    CHECK(c.view_open(pattern, "u", &view, NULL) == CASCADE_OK);
    CHECK(c.free(pattern) == CASCADE_OK);
    CHECK(c.view_data(view, &data) == CASCADE_OUTDATED && data == NULL);
    CHECK(c.view_close(view) == CASCADE_OK);
    CHECK(c.view_close(view) == CASCADE_BAD_HANDLE && c.view_data(view, &data) == CASCADE_BAD_HANDLE);
    int local = 0;
    cascade_pattern *const wrong[] = {NULL, pattern, (cascade_pattern *)&local};
    for (int k = 0; k < 3; ++k) {
        cascade_pattern *const p = wrong[k];
        CHECK(c.step(p, 1, NULL) == CASCADE_BAD_HANDLE && c.run(p, NULL, NULL) == CASCADE_BAD_HANDLE);
        CHECK(c.cancel(p) == CASCADE_BAD_HANDLE && c.free(p) == CASCADE_BAD_HANDLE);
        CHECK(c.set(p, "a", "1") == CASCADE_BAD_HANDLE && c.undo(p) == CASCADE_BAD_HANDLE);
        CHECK(c.redo(p) == CASCADE_BAD_HANDLE && c.set_number(p, "a", 1) == CASCADE_BAD_HANDLE);
        CHECK(c.set_script(p, script) == CASCADE_BAD_HANDLE);
        CHECK(c.paint(p, "u", "1") == CASCADE_BAD_HANDLE);
        CHECK(c.begin_next_stage(p) == CASCADE_BAD_HANDLE);
        CHECK(c.view_open(p, "u", &view, NULL) == CASCADE_BAD_HANDLE);
        CHECK(c.values(p, "u", &value, 1) == CASCADE_BAD_HANDLE);
        CHECK(c.feature(p, NULL, "mean", &value) == CASCADE_BAD_HANDLE);
        CHECK(c.messages(p, &text) == CASCADE_BAD_HANDLE && c.session(p, &text) == CASCADE_BAD_HANDLE);
        CHECK(c.remarks(p, &text) == CASCADE_BAD_HANDLE);
        CHECK(c.analyze(p, NULL, 0, &text) == CASCADE_BAD_HANDLE);
        CHECK(c.picture(p, NULL, &data, &count) == CASCADE_BAD_HANDLE);
        CHECK(c.write_picture(p, NULL, "x.png") == CASCADE_BAD_HANDLE);
        CHECK(c.save(p, "x") == CASCADE_BAD_HANDLE && c.stage_name(p, 0, &text) == CASCADE_BAD_HANDLE);
        CHECK(error_of().status == CASCADE_BAD_HANDLE);
    }
    pattern = made(script);
    CHECK(c.create(NULL, NULL, &pattern) == CASCADE_BAD_ARGUMENT && pattern == NULL);
    CHECK(c.create(script, NULL, NULL) == CASCADE_BAD_ARGUMENT);
    cascade_options options = {0};
    CHECK(c.create(script, &options, &pattern) == CASCADE_BAD_ARGUMENT);
    pattern = made(script);
    CHECK(c.get_state(pattern, NULL) == CASCADE_BAD_ARGUMENT);
    CHECK(c.set(pattern, NULL, "1") == CASCADE_BAD_ARGUMENT);
    CHECK(c.view_open(pattern, NULL, &view, NULL) == CASCADE_BAD_ARGUMENT);
    CHECK(c.step(pattern, -1, NULL) == CASCADE_BAD_ARGUMENT);
    CHECK(c.stage_name(pattern, 2, &text) == CASCADE_BAD_ARGUMENT);
    CHECK(c.feature(pattern, NULL, "beauty", &value) == CASCADE_BAD_ARGUMENT);
    CHECK(c.free(pattern) == CASCADE_OK);
}

/* A program that was compiled before members were added gives a smaller size. */
static void fills_what_the_caller_knows(void) {
    cascade_pattern *const pattern = made(script);
    struct {
        size_t size;
        int64_t width, beyond;
    } old = {offsetof(cascade_state, height), 0, 77};
    CHECK(c.get_state(pattern, (cascade_state *)(void *)&old) == CASCADE_OK);
    CHECK(old.width == 40 && old.beyond == 77);
    c.free(pattern);
}

static void tells_what_is_there(void) {
    cascade_pattern *const pattern = made(script);
    cascade_state state = {0};
    state.size = sizeof state;
    CHECK(c.get_state(pattern, &state) == CASCADE_OK);
    CHECK(state.width == 40 && state.height == 24 && state.depth == 1 && state.stage_count == 2);
    const char *name = NULL;
    size_t count = 0;
    CHECK(c.stage_name(pattern, 1, &name) == CASCADE_OK && strcmp(name, "two") == 0);
    CHECK(c.species_count(pattern, 0, &count) == CASCADE_OK && count == 1);
    CHECK(c.species_name(pattern, 0, 0, &name) == CASCADE_OK && strcmp(name, "u") == 0);
    CHECK(c.parameter_count(pattern, &count) == CASCADE_OK && count == 4);
    cascade_parameter rate = {0}, place = {0};
    rate.size = place.size = sizeof rate;
    CHECK(c.parameter_at(pattern, 1, &place) == CASCADE_OK && !place.is_uniform && !place.has_range);
    CHECK(isnan(place.value));
    CHECK(c.parameter_at(pattern, 0, &rate) == CASCADE_OK);
    CHECK(strcmp(rate.stage, "one") == 0 && strcmp(rate.name, "rate") == 0);
    CHECK(strcmp(rate.doc, "How fast it goes.") == 0 && rate.is_uniform && rate.has_range);
    CHECK(rate.low == 0 && rate.high == 1 && rate.step == 0.05 && (float)rate.value == 0.1F);
    const char *text = NULL;
    CHECK(c.analyze(pattern, NULL, 0, &text) == CASCADE_OK && strlen(text) > 0);
    CHECK(c.remarks(pattern, &text) == CASCADE_OK);
    double mean = 0;
    CHECK(c.feature(pattern, "u", "mean", &mean) == CASCADE_OK && fabs(mean - 1) < 0.1);
    CHECK(c.feature(pattern, "nobody", "mean", &mean) == CASCADE_REFUSED && error_of().line == 1);
    c.free(pattern);
}

static const float *cells(cascade_view *view) {
    const void *data = NULL;
    CHECK(c.view_data(view, &data) == CASCADE_OK);
    return data;
}

static void shows_values_without_a_copy(void) {
    cascade_pattern *const pattern = made(script);
    CHECK(c.step(pattern, 5, NULL) == CASCADE_OK);
    cascade_view *first = NULL, *second = NULL, *sum = NULL;
    cascade_shape shape = {0};
    shape.size = sizeof shape;
    CHECK(c.view_open(pattern, "u", &first, &shape) == CASCADE_OK);
    CHECK(c.view_open(pattern, "u", &second, NULL) == CASCADE_OK);
    CHECK(shape.bits == 32 && !shape.is_computed && shape.width == 40 && shape.height == 24);
    const float *const u = cells(first);
    CHECK(u == cells(second));
    CHECK(c.view_open(pattern, "u + place", &sum, &shape) == CASCADE_OK && shape.is_computed);
    double all[40 * 24];
    CHECK(c.values(pattern, "u", all, 40 * 24) == CASCADE_OK);
    CHECK(c.values(pattern, "u", all, 39) == CASCADE_BAD_ARGUMENT);
    cascade_shape of_u = {0};
    of_u.size = sizeof of_u;
    CHECK(c.view_close(second) == CASCADE_OK);
    CHECK(c.view_open(pattern, "u", &second, &of_u) == CASCADE_OK);
    for (int j = 0; j < 24; ++j) {
        const float *const row = (const float *)(const void *)((const char *)u + j * of_u.row_bytes);
        for (int i = 0; i < 40; ++i) CHECK((double)row[i] == all[j * 40 + i]);
    }
    /* The pattern moves on: the view says so, and its memory keeps what it held. */
    const void *data = NULL;
    CHECK(c.step(pattern, 1, NULL) == CASCADE_OK);
    CHECK(c.view_data(first, &data) == CASCADE_OUTDATED && data == NULL);
    CHECK(c.view_data(sum, &data) == CASCADE_OUTDATED);
    CHECK((double)u[3] == all[3]);
    CHECK(c.run(pattern, NULL, NULL) == CASCADE_OK);
    CHECK(c.set(pattern, "two.rate", "0.3") == CASCADE_OK);
    CHECK((double)u[39] == all[39]);
    CHECK(c.view_close(first) == CASCADE_OK && c.view_close(second) == CASCADE_OK);
    CHECK(c.view_close(sum) == CASCADE_OK);
    CHECK(c.view_open(pattern, "nobody", &first, NULL) == CASCADE_REFUSED && first == NULL);
    CHECK(strstr(error_of().message, "nobody") && error_of().column == 1);
    c.free(pattern);

    cascade_pattern *const fine = made(
        "domain { grid: 8, 8; precision: double }\n"
        "system s { u: 1/3; u' = lap(u) }\nstage one: s { iterations: 3 }\n");
    CHECK(c.view_open(fine, "u", &first, &shape) == CASCADE_OK && shape.bits == 64);
    CHECK(c.view_data(first, &data) == CASCADE_OK && *(const double *)data == 1.0 / 3);
    c.free(fine);
    c.view_close(first);
}

struct watch {
    cascade_pattern *pattern;
    int calls;
    int64_t last_step;
};
static int32_t stop_at_once(const cascade_progress *progress, void *user) {
    struct watch *const watch = user;
    ++watch->calls;
    watch->last_step = progress->step;
    CHECK(progress->size == sizeof *progress && strcmp(progress->stage, "one") == 0);
    CHECK(progress->stage_count == 2 && progress->steps == 30);
    CHECK(c.step(watch->pattern, 1, NULL) == CASCADE_BAD_ARGUMENT);
    return 0;
}

static void is_stopped_and_changed(const char *folder) {
    cascade_pattern *pattern = made(script), *again = NULL;
    struct watch watch = {pattern, 0, 0};
    CHECK(c.run(pattern, stop_at_once, &watch) == CASCADE_CANCELLED && watch.calls > 0);
    int64_t taken = 0;
    CHECK(c.step(pattern, 3, &taken) == CASCADE_OK && taken == 3);
    CHECK(c.set_number(pattern, "one.rate", 0.15) == CASCADE_OK);
    CHECK(c.set_number(pattern, "rate", NAN) == CASCADE_REFUSED);
    CHECK(c.set(pattern, "rat", "1") == CASCADE_REFUSED && strstr(error_of().message, "rat"));
    CHECK(c.paint(pattern, "u", "u + disc(0.3, 0.3, 0.2)") == CASCADE_OK);
    CHECK(c.undo(pattern) == CASCADE_OK && c.redo(pattern) == CASCADE_OK);
    CHECK(c.redo(pattern) == CASCADE_REFUSED);
    CHECK(c.begin_next_stage(pattern) == CASCADE_OK && c.step(pattern, 7, NULL) == CASCADE_OK);

    static double there[40 * 24], here[40 * 24];
    CHECK(c.values(pattern, "u", here, 40 * 24) == CASCADE_OK);
    const char *text = NULL;
    CHECK(c.session(pattern, &text) == CASCADE_OK);
    CHECK(c.play(text, strlen(text), NULL, &again) == CASCADE_OK);
    CHECK(c.values(again, "u", there, 40 * 24) == CASCADE_OK);
    CHECK(memcmp(here, there, sizeof here) == 0);
    c.free(again);

    char path[1024];
    const void *png = NULL;
    size_t bytes = 0;
    snprintf(path, sizeof path, "%s/c.png", folder);
    CHECK(c.picture(pattern, "u", &png, &bytes) == CASCADE_OK && memcmp(png, "\x89PNG", 4) == 0);
    CHECK(c.write_picture(pattern, NULL, path) == CASCADE_OK);
    CHECK(c.write_picture(pattern, NULL, "c.tiff") == CASCADE_REFUSED);
    CHECK(c.open(path, NULL, &again) == CASCADE_OK);
    CHECK(c.values(again, "u", there, 40 * 24) == CASCADE_OK);
    CHECK(memcmp(here, there, sizeof here) == 0);
    c.free(again);

    snprintf(path, sizeof path, "%s/saved", folder);
    CHECK(c.save(pattern, path) == CASCADE_OK);
    CHECK(c.open(path, NULL, &again) == CASCADE_OK);
    CHECK(c.run(pattern, NULL, NULL) == CASCADE_OK && c.run(again, NULL, NULL) == CASCADE_OK);
    CHECK(c.values(pattern, "u", here, 40 * 24) == CASCADE_OK);
    CHECK(c.values(again, "u", there, 40 * 24) == CASCADE_OK);
    CHECK(memcmp(here, there, sizeof here) == 0);
    c.free(again);
    CHECK(c.set_script(pattern, "nonsense") == CASCADE_REFUSED);
    CHECK(c.set_script(pattern, script) == CASCADE_OK);
    c.free(pattern);
}

static char *in(const char *folder, const char *name) {
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}
static int begins_with(const char *path, const char *bytes) {
    char read[16] = {0};
    FILE *const file = fopen(path, "rb");
    if (!file) return 0;
    const size_t count = fread(read, 1, sizeof read - 1, file);
    fclose(file);
    return count >= strlen(bytes) && memcmp(read, bytes, strlen(bytes)) == 0;
}
static int32_t cancel_at_once(const cascade_progress *progress, void *user) {
    (void)progress;
    ++*(int *)user;
    return 0;
}

static void takes_values_and_writes_files(const char *folder) {
    static double given[40 * 24], found[40 * 24];
    for (int k = 0; k < 40 * 24; ++k) given[k] = k;
    cascade_pattern *const pattern = made(script);
    CHECK(c.set_values(pattern, "u", given, 40 * 24) == CASCADE_OK);
    CHECK(c.values(pattern, "u", found, 40 * 24) == CASCADE_OK);
    CHECK(memcmp(given, found, sizeof given) == 0);
    CHECK(c.set_values(pattern, "u", given, 7) == CASCADE_REFUSED && strstr(error_of().message, "960"));
    CHECK(c.set_values(pattern, "rate", given, 40 * 24) == CASCADE_REFUSED);
    CHECK(c.set_values(pattern, "u", NULL, 40 * 24) == CASCADE_BAD_ARGUMENT);
    given[5] = NAN;
    CHECK(c.set_values(pattern, "u", given, 40 * 24) == CASCADE_REFUSED);

    CHECK(c.write(pattern, in(folder, "c.svg"), "{\"palette\": \"viridis\"}") == CASCADE_OK);
    CHECK(begins_with(in(folder, "c.svg"), "<svg"));
    CHECK(c.write(pattern, in(folder, "c.svg"), "{\"pallete\": 1}") == CASCADE_REFUSED);
    CHECK(strstr(error_of().message, "pallete") && strstr(error_of().hint, "palette"));
    CHECK(c.write(pattern, in(folder, "c.svg"), "nonsense") == CASCADE_REFUSED);
    CHECK(c.write(pattern, in(folder, "c.tiff"), NULL) == CASCADE_REFUSED);
    CHECK(c.write(pattern, NULL, NULL) == CASCADE_BAD_ARGUMENT);

    int calls = 0;
    cascade_pattern *const endless =
        made("system s { u: x; u' = 0.1 * lap(u) }\nstage one: s { iterations: 1000000000 }\n");
    CHECK(c.film(endless, in(folder, "never.gif"), 1000, NULL, cancel_at_once, &calls) == CASCADE_CANCELLED);
    CHECK(calls > 0 && !begins_with(in(folder, "never.gif"), "GIF"));
    c.free(endless);
    CHECK(c.film(pattern, in(folder, "c.gif"), 10, "{\"show\": \"u\"}", NULL, NULL) == CASCADE_OK);
    CHECK(begins_with(in(folder, "c.gif"), "GIF89a"));

    const char *html = NULL;
    const cascade_status status = c.page(pattern, &html);
    CHECK(status == CASCADE_OK ? strstr(html, "<html") != NULL : strstr(error_of().message, "engine.wasm") != NULL);
    cascade_model model = {0};
    model.size = sizeof model;
    CHECK(c.get_model(pattern, &model) == CASCADE_REFUSED && strstr(error_of().message, "grid"));
    c.free(pattern);

    cascade_pattern *const ball =
        made("domain { surface: sphere; cells: 200 }\nstage one: turing_spots {}\n");
    CHECK(c.get_model(ball, &model) == CASCADE_OK && model.cell_count == 200);
    CHECK(model.link_count > 300 && model.triangle_count > 100 && model.vertex_count > 50);
    double area = 0;
    for (size_t k = 0; k < model.cell_count; ++k) area += model.areas[k];
    CHECK(fabs(area - 3.14159) < 0.1 && model.points[0] >= 0 && model.points[0] <= 1);
    for (size_t k = 0; k < model.link_count; ++k) {
        CHECK(model.links[2 * k] < model.links[2 * k + 1] && model.links[2 * k + 1] < 200);
        CHECK(model.weights[k] > 0);
    }
    for (size_t k = 0; k < 3 * model.triangle_count; ++k) CHECK(model.triangles[k] < model.vertex_count);
    c.free(ball);
}

static void *use(void *handle) {
    for (int k = 0; k < 200; ++k) {
        const char *name = NULL;
        double value = 0;
        CHECK(c.step(handle, 1, NULL) == CASCADE_OK);
        CHECK(c.feature(handle, NULL, "mean", &value) == CASCADE_OK && value > 0);
        CHECK(c.stage_name(handle, 0, &name) == CASCADE_OK && strcmp(name, "one") == 0);
        CHECK(c.set(handle, "nobody", "1") == CASCADE_REFUSED);
        CHECK(strstr(c.last_message(), "nobody"));
    }
    return NULL;
}
static void *stop(void *handle) {
    while (c.cancel(handle) == CASCADE_OK) {
    }
    return NULL;
}
static void takes_calls_of_several_threads(void) {
    cascade_pattern *const pattern = made(script);
    pthread_t threads[2];
    for (int k = 0; k < 2; ++k) CHECK(pthread_create(&threads[k], NULL, use, pattern) == 0);
    for (int k = 0; k < 2; ++k) pthread_join(threads[k], NULL);
    c.free(pattern);

    cascade_pattern *const endless =
        made("system s { u: x; u' = lap(u) }\nstage one: s { iterations: 1000000000 }\n");
    CHECK(pthread_create(&threads[0], NULL, stop, endless) == 0);
    CHECK(c.run(endless, NULL, NULL) == CASCADE_CANCELLED);
    c.free(endless);
    pthread_join(threads[0], NULL);
}

int main(int argc, char **argv) {
    if (argc != 3) return 2;
    library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
#define FIND(name) *(void **)&c.name = find("cascade_" #name);
    EACH(FIND)
    CHECK(c.c_version() == CASCADE_C_VERSION && strlen(c.version()) > 2);
    tells_errors();
    survives_misuse();
    fills_what_the_caller_knows();
    tells_what_is_there();
    shows_values_without_a_copy();
    is_stopped_and_changed(argv[2]);
    takes_values_and_writes_files(argv[2]);
    takes_calls_of_several_threads();
    puts("the library can be used from C");
    return 0;
}
