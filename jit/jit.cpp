// The backend: compiles kernels, stores them, and returns stored ones.
#include "jit/jit.h"

#include "core/check.h"
#include "ir/kernel_calls.h"
#include "jit/code_cache.h"
#include "jit/field_pairs.h"
#include "jit/generator.h"
#include "jit/kernel_key.h"
#include "jit/processor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <unordered_map>

namespace cascade {
namespace {

template <typename Number>
class NativeKernel final : public Kernel {
public:
    NativeKernel(const CellKernel& kernel, Stencil stencil,
                 std::unique_ptr<LoadedFunction> function)
        : stencil_(stencil),
          fields_(kernel.field_names.size()),
          masks_(kernel.mask_names.size()),
          uniforms_(kernel.uniform_names.size()),
          results_(kernel.results.size()),
          pairs_(field_pairs(kernel).size()),
          function_(std::move(function)) {
        for (const Instruction& instruction : kernel.code) {
            const Op op = instruction.op;
            reads_links_ |= stencil.links && (is_link_sum(op) || is_link_reduction(op));
            reads_weights_ |= stencil.links && is_link_sum(op);
            has_gradients_ |= op >= Op::gradient_x && op <= Op::gradient_z;
        }
    }

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const override {
        CHECK(arguments.fields.size() >= fields_ && arguments.masks.size() >= masks_ &&
                  arguments.uniforms.size() >= uniforms_ && arguments.results.size() >= results_,
              "a kernel is given all its planes and numbers");
        const RowRange rows = cells.rows;
        CHECK(rows.empty() || (rows.begin >= 0 && rows.end <= arguments.layout.row_count()),
              "rows to compute are rows of the plane");
        const PlaneLayout& layout = arguments.layout;
        const ColumnRange columns = cells.columns.within(layout.width);
        if (columns.count() <= 0) return;
        CHECK(stencil_.z == (layout.depth > 1), "a kernel runs on grids of its stencil");
        if (stencil_.z) return run_slices(arguments, rows, columns);
        if (stencil_.links) return run_linked(arguments, rows, columns);
        const HaloColumns copied = columns_to_fill(arguments, columns);
        function_->template as<GridFunction<Number>>()(
            arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
            arguments.results.data(), columns.begin, columns.end, layout.stride, rows.begin,
            rows.end, arguments.is_near, copied.left, copied.right);
    }

    bool fills_columns() const override { return kernels_fill_columns(stencil_); }

private:
    /// Calls the kernel's function once for each slice that contains some of the rows.
    void run_slices(const KernelArgumentsOf<Number>& arguments, RowRange rows,
                    ColumnRange columns) const {
        const PlaneLayout& layout = arguments.layout;
        for_each_slice(layout, rows, [&](RowRange part, std::int64_t slice) {
            function_->template as<VolumeFunction<Number>>()(
                arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
                arguments.results.data(), columns.begin, columns.end, layout.stride, part.begin,
                part.end, arguments.is_near, layout.slice_rows(), slice);
        });
    }

    void run_linked(const KernelArgumentsOf<Number>& arguments, RowRange rows,
                    ColumnRange columns) const {
        const PlaneLayout& layout = arguments.layout;
        const LinkTable<Number>& links = arguments.links;
        CHECK(columns.begin % LinkTable<Number>::slice_cells == 0,
              "linked cells are computed in whole slices");
        CHECK(!reads_links_ || links.starts, "a kernel that reduces links is given them");
        CHECK(!reads_weights_ || links.weights, "and weights, where it asks for them");
        CHECK(!has_gradients_ || links.gradients[2], "and gradients, where it asks for them");
        const auto run = [&](RowRange part, Number* pairs, RowRange copied) {
            function_->template as<LinkedFunction<Number>>()(
                arguments.fields.data(), arguments.masks.data(), arguments.uniforms.data(),
                arguments.results.data(), columns.begin, columns.end, layout.stride, part.begin,
                part.end, links.starts, links.bases, links.offsets, links.weights,
                links.gradients[0], links.gradients[1], links.gradients[2], links.filled, pairs,
                copied.begin * layout.stride, copied.end * layout.stride);
        };
        if (pairs_ == 0) return run(rows, nullptr, {0, 0});
        // The number of cells per part. The copied pairs of fields for that many cells, and for the
        // cells around them, fit into a second-level cache.
        constexpr std::int64_t cells_of_part = 16384;
        const std::int64_t height = std::max(cells_of_part / layout.width, links.reach);
        static thread_local AlignedArray<Number> pairs;
        for (RowRange part{rows.begin, 0}; part.begin < rows.end; part.begin = part.end) {
            part.end = std::min(part.begin + height, rows.end);
            const RowRange copied =
                part.end - part.begin == 1
                    ? rows_around(links, layout, part.begin, columns)
                    : RowRange{std::max<std::int64_t>(0, part.begin - links.reach),
                               std::min(part.end + links.reach, layout.height)};
            const std::size_t numbers = 2 * pairs_ *
                                        static_cast<std::size_t>(copied.end - copied.begin) *
                                        static_cast<std::size_t>(layout.stride);
            if (pairs.bytes() < numbers * sizeof(Number)) pairs = AlignedArray<Number>(numbers);
            run(part, pairs.data(), copied);
        }
    }

    /// All rows to which the links of a row's cells lead, including the row itself.
    static RowRange rows_around(const LinkTable<Number>& links, const PlaneLayout& layout,
                                std::int64_t row, ColumnRange columns) {
        constexpr std::int64_t lanes = LinkTable<Number>::slice_cells;
        const std::int64_t slices = (layout.width + lanes - 1) / lanes;
        const std::int64_t first = row * slices + columns.begin / lanes;
        const std::int64_t last = row * slices + (columns.end - 1) / lanes;
        std::int64_t least = layout.row_start(row), most = least;
        for (std::int64_t link = lanes * links.starts[first]; link < lanes * links.starts[last + 1];
             ++link) {
            least = std::min(least, links.target(link));
            most = std::max(most, links.target(link));
        }
        return {least / layout.stride, most / layout.stride + 1};
    }

    Stencil stencil_;
    std::size_t fields_, masks_, uniforms_, results_, pairs_;
    bool reads_links_ = false, reads_weights_ = false, has_gradients_ = false;
    std::unique_ptr<LoadedFunction> function_;
};

/// A kernel that was compiled or is being compiled.
using Compiling = std::shared_future<Result<KernelPointer>>;

/// The largest number of stored kernels. If more are stored, all are dropped, so that a long
/// session does not fill the memory. Kernels that are in use are not destroyed.
constexpr std::size_t most_known = 1024;

class JitBackend final : public Backend {
public:
    explicit JitBackend(const JitOptions& options)
        : lanes_(options.lanes > 0 ? options.lanes : host_lanes()),
          optimise_(options.optimise),
          environment_(environment_key(options.optimise)),
          cache_(environment_.empty() ? std::filesystem::path() : options.cache) {}

    std::string_view name() const override { return "jit"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        const KernelShape shape = shape_of(kernel, stencil);
        const std::string key = kernel_key(kernel, shape);
        std::promise<Result<KernelPointer>> promise;
        if (const auto known = find_or_announce(key, promise)) return known->get();
        Result<KernelPointer> made = failure("not compiled");
        try {
            made = make(kernel, shape, key);
        } catch (...) {  // Memory ran out. Waiting threads get the exception, too.
            forget(key);
            promise.set_exception(std::current_exception());
            throw;
        }
        if (!made) forget(key);
        promise.set_value(made);
        return made;
    }

    KernelPointer find(const CellKernel& kernel, Stencil stencil) override {
        const KernelShape shape = shape_of(kernel, stencil);
        const std::string key = kernel_key(kernel, shape);
        if (const auto known = find_known(key)) return known->value_or(nullptr);
        auto function = load_kept(environment_ + key);
        if (!function) return nullptr;
        std::promise<Result<KernelPointer>> promise;
        promise.set_value(as_kernel(kernel, shape, std::move(function)));
        const Compiling made = promise.get_future().share();
        const std::lock_guard lock(mutex_);
        make_room();
        known_.insert_or_assign(key, made);
        return *made.get();
    }

    KernelCounts counts() const override { return {compiled_, found_}; }

    std::string code_identity() const override {
        return environment_.empty() ? "" : environment_ + std::to_string(lanes_) + "|";
    }

private:
    KernelShape shape_of(const CellKernel& kernel, Stencil stencil) const {
        KernelShape shape = shape_for(kernel, stencil, lanes_);
        shape.fills_columns = kernels_fill_columns(stencil);
        return shape;
    }

    /// The result of compiling a kernel, without waiting: nullopt if the kernel is unknown, and a
    /// null pointer if it is still being compiled.
    std::optional<Result<KernelPointer>> find_known(const std::string& key) {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(key);
        if (found == known_.end()) return std::nullopt;
        const bool is_made =
            found->second.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
        return is_made ? found->second.get() : Result<KernelPointer>(nullptr);
    }

    void make_room() {
        if (known_.size() >= most_known) known_.clear();
    }

    /// The kernel that another thread has compiled or is compiling. If there is none, other threads
    /// that request this kernel wait for `promise` from now on.
    std::optional<Compiling> find_or_announce(const std::string& key,
                                              std::promise<Result<KernelPointer>>& promise) {
        const std::lock_guard lock(mutex_);
        const auto found = known_.find(key);
        if (found != known_.end()) return found->second;
        make_room();
        known_.emplace(key, promise.get_future().share());
        return std::nullopt;
    }

    void forget(const std::string& key) {
        const std::lock_guard lock(mutex_);
        known_.erase(key);
    }

    Result<KernelPointer> make(const CellKernel& kernel, const KernelShape& shape,
                               const std::string& key) {
        auto function = load(kernel, shape, key);
        if (!function) return tl::unexpected(function.error());
        return as_kernel(kernel, shape, std::move(*function));
    }

    static KernelPointer as_kernel(const CellKernel& kernel, const KernelShape& shape,
                                   std::unique_ptr<LoadedFunction> function) {
        return with_number(kernel.precision, [&](auto zero) -> KernelPointer {
            return std::make_shared<NativeKernel<decltype(zero)>>(kernel, shape.stencil,
                                                                  std::move(function));
        });
    }

    /// Loads the code that an earlier process stored on disk. Null if no code is stored under this
    /// key.
    std::unique_ptr<LoadedFunction> load_kept(const std::string& file_key) {
        const auto image = cache_.find(file_key);
        if (!image) return nullptr;
        auto function = LoadedFunction::load(*image);
        if (!function) return nullptr;
        ++found_;
        return std::move(*function);
    }

    Result<std::unique_ptr<LoadedFunction>> load(const CellKernel& kernel, const KernelShape& shape,
                                                 const std::string& key) {
        const std::string file_key = environment_ + key;
        if (auto function = load_kept(file_key)) return function;
        const auto generator = code_generator();
        if (!generator) return tl::unexpected(generator.error());
        const auto image = (*generator)->compile(kernel, shape, optimise_);
        if (!image) return tl::unexpected(image.error());
        ++compiled_;
        cache_.keep(file_key, *image);
        return LoadedFunction::load(*image);
    }

    int lanes_;
    int optimise_;
    std::string environment_;
    CodeCache cache_;
    std::atomic<std::int64_t> compiled_{0}, found_{0};
    std::mutex mutex_;
    std::unordered_map<std::string, Compiling> known_;  ///< The kernels by their kernel_key().
};

}  // namespace

bool has_jit() { return true; }

Result<std::unique_ptr<Backend>> make_jit(const JitOptions& options) {
    if (auto good = check_options(options); !good) return tl::unexpected(good.error());
    return std::make_unique<JitBackend>(options);
}

}  // namespace cascade
