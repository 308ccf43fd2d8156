// The functions of include/cascade/cascade_c.h that read from a pattern: views, values, features
// and pictures.
#include "library/c_calls.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

using namespace cascade;

cascade_status cascade_view_open(cascade_pattern* pattern, const char* expression,
                                 cascade_view** view, cascade_shape* shape) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (view == nullptr) return bad_argument("the caller gave no memory for the view");
        *view = nullptr;
        if (expression == nullptr) return bad_argument("the expression is null");
        PatternView made = of.view(expression);
        if (made.data == nullptr) return refused(of);
        if (shape != nullptr) {
            const int32_t bits = made.number == PatternView::Number::binary32 ? 32 : 64;
            const auto given = give(shape, {0, bits, made.is_computed, made.width, made.height,
                                            made.depth, made.row_bytes, made.slice_bytes});
            if (given != CASCADE_OK) return given;
        }
        const auto own = patterns().find(pattern);
        *view = views().add(std::make_shared<OwnView>(OwnView{own, std::move(made)}));
        return CASCADE_OK;
    });
}
cascade_status cascade_view_data(cascade_view* view, const void** data) {
    return guarded([&]() -> cascade_status {
        const auto own = views().find(view);
        if (!own) return fail(CASCADE_BAD_HANDLE, "this is not a view, or it has been closed");
        if (data == nullptr) return bad_argument("the caller gave no memory for the address");
        *data = nullptr;
        const auto of = own->of.lock();
        if (!of) return fail(CASCADE_OUTDATED, "the pattern of this view has been freed");
        return in_turn(*of, [&](Pattern& pattern) -> cascade_status {
            if (pattern.moment() != own->view.moment) {
                return fail(CASCADE_OUTDATED, "the pattern has moved on since the view was opened",
                            "open another view");
            }
            *data = own->view.data;
            return CASCADE_OK;
        });
    });
}
cascade_status cascade_view_close(cascade_view* view) {
    return guarded([&]() -> cascade_status {
        return views().remove(view)
                   ? CASCADE_OK
                   : fail(CASCADE_BAD_HANDLE, "this is not a view, or it has been closed");
    });
}
cascade_status cascade_values(cascade_pattern* pattern, const char* expression, double* values,
                              size_t count) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (expression == nullptr || values == nullptr) return bad_argument("a pointer is null");
        const std::vector<double> numbers = of.numbers(expression);
        if (numbers.empty()) return refused(of);
        if (numbers.size() != count) {
            return bad_argument("there are " + std::to_string(numbers.size()) + " cells, not " +
                                std::to_string(count));
        }
        std::copy(numbers.begin(), numbers.end(), values);
        return CASCADE_OK;
    });
}

cascade_status cascade_feature(cascade_pattern* pattern, const char* expression, const char* name,
                               double* value) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (name == nullptr || value == nullptr) return bad_argument("a pointer is null");
        const auto features = of.features(text_or_empty(expression));
        if (features.empty()) return refused(of);
        for (const PatternFeature& feature : features) {
            if (feature.name != name) continue;
            *value = feature.value;
            return CASCADE_OK;
        }
        return bad_argument("there is no feature '" + std::string(name) + "'");
    });
}
cascade_status cascade_remarks(cascade_pattern* pattern, const char** text) {
    return with(pattern, [&](Pattern& of) {
        std::string lines;
        for (const std::string& remark : of.remarks()) lines += remark + "\n";
        return give_text(text, std::move(lines));
    });
}
cascade_status cascade_analyze(cascade_pattern* pattern, const char* stage, int32_t as_json,
                               const char** text) {
    return with_run(pattern, [&](Pattern& of) {
        std::string report = of.analysis(text_or_empty(stage), as_json != 0);
        return report.empty() ? refused(of) : give_text(text, std::move(report));
    });
}

cascade_status cascade_picture(cascade_pattern* pattern, const char* expression, const void** data,
                               size_t* bytes) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (data == nullptr || bytes == nullptr) return bad_argument("a pointer is null");
        std::string file = of.picture(text_or_empty(expression));
        if (file.empty()) return refused(of);
        return give_bytes(data, bytes, std::move(file));
    });
}
cascade_status cascade_write_picture(cascade_pattern* pattern, const char* expression,
                                     const char* path) {
    return change(pattern, {path},
                  [&](Pattern& of) { return of.write_picture(path, text_or_empty(expression)); });
}
cascade_status cascade_write(cascade_pattern* pattern, const char* path, const char* options) {
    return change(pattern, {path},
                  [&](Pattern& of) { return of.write(path, options_or_none(options)); });
}
cascade_status cascade_film(cascade_pattern* pattern, const char* path, int64_t every,
                            const char* options, cascade_callback callback, void* user) {
    return with_run(pattern, [&](Pattern& of) -> cascade_status {
        if (path == nullptr) return bad_argument("a pointer is null");
        bool is_cancelled = false;
        const ProgressWatcher watcher = [&, watch = watcher_of(callback, user)](const auto& now) {
            is_cancelled = is_cancelled || (watch && !watch(now));
            return !is_cancelled;
        };
        if (of.film(path, every, options_or_none(options), watcher)) return CASCADE_OK;
        return is_cancelled ? fail(of, CASCADE_CANCELLED) : refused(of);
    });
}
cascade_status cascade_page(cascade_pattern* pattern, const char** html) {
    return with_run(pattern, [&](Pattern& of) {
        std::string page = of.page();
        return page.empty() ? refused(of) : give_text(html, std::move(page));
    });
}
cascade_status cascade_get_model(cascade_pattern* pattern, cascade_model* model) {
    return with_run(pattern, [&](Pattern& of) {
        thread_local PatternModel given;
        given = of.model();
        if (given.points.empty()) return refused(of);
        return give(model, {0, given.areas.size(), given.weights.size(), given.vertices.size() / 3,
                            given.triangles.size() / 3, given.points.data(), given.areas.data(),
                            given.links.data(), given.weights.data(), given.vertices.data(),
                            given.triangles.data()});
    });
}
cascade_status cascade_session(cascade_pattern* pattern, const char** text) {
    return with_run(pattern, [&](Pattern& of) {
        std::string log = of.session();
        return log.empty() ? refused(of) : give_text(text, std::move(log));
    });
}
cascade_status cascade_save(cascade_pattern* pattern, const char* folder) {
    return change(pattern, {folder}, [&](Pattern& of) { return of.save(folder); });
}
