// Values of patterns and the geometry of models as NumPy arrays, and arrays as values.
#include "python/pattern.h"

#include <pybind11/stl.h>

#include <cstring>
#include <utility>
#include <vector>

namespace cascade {
namespace {

py::tuple shape_of(std::int64_t depth, std::int64_t height, std::int64_t width) {
    if (depth > 1) return py::make_tuple(depth, height, width);
    if (height > 1) return py::make_tuple(height, width);
    return py::make_tuple(width);
}

/// An array that owns the numbers of a vector, in rows of `columns`.
template <typename Number>
py::array array_of(std::vector<Number> numbers, py::ssize_t columns) {
    auto* const kept = new std::vector<Number>(std::move(numbers));
    const py::capsule base(kept,
                           [](void* vector) { delete static_cast<std::vector<Number>*>(vector); });
    const auto rows = static_cast<py::ssize_t>(kept->size()) / columns;
    std::vector<py::ssize_t> sides{rows};
    if (columns > 1) sides.push_back(columns);
    return py::array_t<Number>(sides, kept->data(), base);
}

[[noreturn]] void refuse(const std::string& message, const std::string& hint) {
    throw Fault{{true, "", 0, 0, message, hint}, message + " (" + hint + ")"};
}

}  // namespace

py::array values(PythonPattern& of, const std::string& expression, bool copy) {
    PatternView view = of.running().view(expression);
    if (view.data == nullptr) of.fail();
    const bool is_single = view.number == PatternView::Number::binary32;
    const py::dtype type = is_single ? py::dtype::of<float>() : py::dtype::of<double>();
    std::vector<py::ssize_t> sides, strides;
    const auto add = [&](std::int64_t cells, std::int64_t bytes) {
        sides.push_back(cells);
        strides.push_back(bytes);
    };
    if (view.depth > 1) add(view.depth, view.slice_bytes);
    if (view.height > 1) add(view.height, view.row_bytes);
    add(view.width, type.itemsize());
    // The array is a copy, because no owner is passed.
    if (copy) return py::array(type, sides, strides, view.data);
    auto* const owner = new std::shared_ptr<const void>(std::move(view.owner));
    const py::capsule base(owner, [](void* kept) {
        delete static_cast<std::shared_ptr<const void>*>(kept);
    });
    py::array array(type, sides, strides, view.data, base);
    array.attr("flags").attr("writeable") = false;
    return array;
}

void set_values(PythonPattern& of, const std::string& item, const py::array& numbers) {
    Pattern& pattern = of.running();
    if (std::strchr("fiub", numbers.dtype().kind()) == nullptr) {
        refuse("'" + item + "' cannot take an array of " + std::string(py::str(numbers.dtype())),
               "arrays have real numbers, such as float32 and float64");
    }
    // If there is no such item, Pattern::set_values() below fails with a message.
    const PatternView view = pattern.view(item);
    const py::tuple its_shape = shape_of(view.depth, view.height, view.width);
    const py::object given_shape = numbers.attr("shape");
    if (view.data != nullptr && !given_shape.equal(its_shape)) {
        refuse("an array of shape " + std::string(py::str(given_shape)) + " does not fit '" + item +
                   "', which has shape " + std::string(py::str(py::object(its_shape))),
               "the first index is the row, as in pictures: (height, width)");
    }
    using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
    const Doubles doubles(numbers);
    of.check(pattern.set_values(item, {doubles.data(), doubles.data() + doubles.size()}));
}

py::tuple shape(PythonPattern& of) {
    const Pattern& pattern = of.own();
    return shape_of(pattern.depth(), pattern.height(), pattern.width());
}

py::dict model(PythonPattern& of) {
    PatternModel model = of.during([](Pattern& pattern) { return pattern.model(); });
    of.check(!model.points.empty());
    py::dict arrays;
    arrays["points"] = array_of(std::move(model.points), 3);
    arrays["areas"] = array_of(std::move(model.areas), 1);
    arrays["links"] = array_of(std::move(model.links), 2);
    arrays["weights"] = array_of(std::move(model.weights), 1);
    arrays["vertices"] = array_of(std::move(model.vertices), 3);
    arrays["triangles"] = array_of(std::move(model.triangles), 3);
    return arrays;
}

}  // namespace cascade
