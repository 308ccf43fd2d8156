// The module that uses HDF5 (picture/hdf5.h).
//
// Files have the format that the library writes by default. After a flush such a file can be opened
// at once, even if its writer was killed. A file in one of the newer formats would first need
// h5clear.
#include "core/version.h"
#include "picture/hdf5.h"
#include "picture/hdf5_driver.h"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <limits>
#include <new>
#include <set>
#include <stdexcept>
#include <utility>

namespace cascade {

namespace {

/// The innermost error of the library's last call.
std::string hdf5_reason() {
    std::string text = "unknown error of HDF5";
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_UPWARD,
        [](unsigned n, const H5E_error2_t* error, void* into) -> herr_t {
            if (n == 0 && error->desc) *static_cast<std::string*>(into) = error->desc;
            return 0;
        },
        &text);
    return text;
}

/// Throws if a call of the library has failed.
template <typename Number>
Number good(Number result) {
    if (result < 0) throw std::runtime_error(hdf5_reason());
    return result;
}

/// An identifier of the library, which the destructor closes.
class Handle {
public:
    using Close = herr_t (*)(hid_t);
    Handle() = default;
    Handle(hid_t id, Close close) : id_(good(id)), close_(close) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ >= 0) close_(id_);
    }
    operator hid_t() const { return id_; }

private:
    hid_t id_ = -1;
    Close close_ = nullptr;
};

Handle space_of(const std::vector<hsize_t>& sizes) {
    return {H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), H5Sclose};
}

/// The type of UTF-8 texts of any length.
Handle text_type() {
    Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    good(H5Tset_size(type, H5T_VARIABLE));
    good(H5Tset_cset(type, H5T_CSET_UTF8));
    return type;
}

/// Properties of new datasets, without the time of their creation, so that the same run writes the
/// same bytes.
Handle dataset_properties() {
    Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    good(H5Pset_obj_track_times(creation, false));
    return creation;
}

void write_attribute(hid_t object, const std::string& name, hid_t type, const void* value,
                     std::size_t count = 1) {
    const Handle space = count == 1 ? Handle(H5Screate(H5S_SCALAR), H5Sclose) : space_of({count});
    const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose);
    good(H5Awrite(attribute, type, value));
}

void write_text(hid_t object, const std::string& name, const std::string& text) {
    const char* const bytes = text.c_str();
    write_attribute(object, name, text_type(), &bytes);
}

void write_attributes(hid_t object, const Hdf5Attributes& attributes) {
    for (const auto& [name, value] : attributes) {
        if (const auto* number = std::get_if<double>(&value)) {
            write_attribute(object, name, H5T_NATIVE_DOUBLE, number);
        } else if (const auto* whole = std::get_if<std::int64_t>(&value)) {
            write_attribute(object, name, H5T_NATIVE_INT64, whole);
        } else if (const auto* numbers = std::get_if<std::vector<std::int32_t>>(&value)) {
            write_attribute(object, name, H5T_NATIVE_INT32, numbers->data(), numbers->size());
        } else {
            write_text(object, name, std::get<std::string>(value));
        }
    }
}

/// The type of a record in files.
Handle type_of_record(const Hdf5Value& largest) {
    const auto copy = [](hid_t type) { return Handle(H5Tcopy(type), H5Tclose); };
    if (std::holds_alternative<double>(largest)) return copy(H5T_IEEE_F64LE);
    if (std::holds_alternative<std::int64_t>(largest)) return copy(H5T_STD_I64LE);
    if (std::holds_alternative<std::int32_t>(largest)) return copy(H5T_STD_I32LE);
    Handle type = copy(H5T_C_S1);
    good(H5Tset_size(type, std::max<std::size_t>(1, std::get<std::string>(largest).size())));
    good(H5Tset_strpad(type, H5T_STR_NULLPAD));
    good(H5Tset_cset(type, H5T_CSET_UTF8));
    return type;
}

/// The number of rows in a chunk of about a mebibyte, the size of the library's cache.
std::vector<hsize_t> chunk_of(std::vector<hsize_t> sizes, std::size_t bytes) {
    constexpr std::size_t most = std::size_t{1} << 20;
    std::size_t whole = bytes;
    for (auto size = sizes.rbegin(); size != sizes.rend(); ++size) {
        *size = std::clamp<hsize_t>(most / whole, 1, *size);
        whole *= *size;
    }
    return sizes;
}

/// Calls a function that throws the library's errors.
template <typename Act>
Result<void> attempt_hdf5(const Act& act) {
    try {
        act();
        return {};
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        return failure(error.what());
    }
}

class File final : public Hdf5File {
public:
    File(const std::filesystem::path& path, const Hdf5Layout& layout);

    Result<void> add(const std::vector<Hdf5Value>& values,
                     const std::vector<std::string>& fields) override;
    Result<void> describe(std::size_t stage, const std::map<std::string, double>& numbers) override;
    ~File() override;
    Result<void> close() override;

private:
    /// A dataset that becomes longer with each entry.
    struct Growing {
        Handle dataset;
        Handle type;
        std::vector<hsize_t> sizes;  ///< Of one entry.
    };

    void make_axes(const Hdf5Layout& layout);
    void write_column(const Hdf5Column& column, hid_t axis);
    void make_records(const Hdf5Layout& layout);
    Growing make_growing(const std::string& name, Handle type, std::vector<hsize_t> sizes,
                         const void* fill, hsize_t entries_in_chunk);
    void append(Growing& growing, const void* values);
    void append(Growing& record, const Hdf5Value& value);
    template <typename Act>
    Result<void> attempt(const Act& act) {
        auto done = attempt_hdf5(act);
        is_whole_ = is_whole_ && done;
        return done;
    }
    void flush() { good(flush_in_order(file_, written_)); }

    Handle file_;
    std::vector<Handle> axes_, groups_;
    std::vector<Growing> records_, fields_;
    hsize_t entries_ = 0;
    std::set<haddr_t> written_;
    bool is_whole_ = true;  ///< Whether all calls so far have succeeded.
};

File::File(const std::filesystem::path& path, const Hdf5Layout& layout) {
    const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    // Readers may open the file while it grows, and do not stop the run from writing.
    good(H5Pset_file_locking(access, false, true));
    good(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
    good(H5Pset_driver(access, good(hdf5_driver(path.c_str())), nullptr));
    file_ = Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
    write_attributes(file_, layout.about);
    for (const auto& [name, text] : layout.texts) {
        const Handle type = text_type();
        const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
        const Handle dataset(H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT,
                                        dataset_properties(), H5P_DEFAULT),
                             H5Dclose);
        const char* const bytes = text.c_str();
        good(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, &bytes));
    }
    make_records(layout);
    make_axes(layout);
    std::vector<hsize_t> sizes;
    for (const Hdf5Column& axis : layout.axes) sizes.push_back(axis.values.size());
    const bool is_single = layout.precision == Precision::single;
    const hid_t type = is_single ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const float short_nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& [name, attributes] : layout.fields) {
        Growing field = make_growing(name, Handle(H5Tcopy(type), H5Tclose), sizes,
                                     is_single ? static_cast<const void*>(&short_nan) : &nan, 1);
        for (std::size_t k = 0; k < axes_.size(); ++k) {
            good(H5DSattach_scale(field.dataset, axes_[k], static_cast<unsigned>(k) + 1));
        }
        write_attributes(field.dataset, attributes);
        fields_.push_back(std::move(field));
    }
    flush();
}

/// Makes the axis of the entries and the values along it.
void File::make_records(const Hdf5Layout& layout) {
    constexpr hsize_t in_chunk = 512;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Hdf5Record& record : layout.records) {
        const bool is_real = std::holds_alternative<double>(record.largest);
        Growing growing = make_growing(record.name, type_of_record(record.largest), {},
                                       is_real ? &nan : nullptr, in_chunk);
        if (records_.empty()) good(H5DSset_scale(growing.dataset, record.name.c_str()));
        write_attributes(growing.dataset, record.attributes);
        records_.push_back(std::move(growing));
    }
}

/// Writes the positions of the cells and the groups of stages.
void File::make_axes(const Hdf5Layout& layout) {
    Handle all;
    if (!layout.stages.empty()) {
        all = Handle(H5Gcreate2(file_, "stages", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    }
    for (const auto& [name, attributes] : layout.stages) {
        groups_.emplace_back(H5Gcreate2(all, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                             H5Gclose);
        write_attributes(groups_.back(), attributes);
    }
    for (const Hdf5Column& axis : layout.axes) write_column(axis, -1);
    for (const Hdf5Column& column : layout.coordinates) write_column(column, axes_.back());
}

/// Writes numbers along an axis. If `axis` is negative, the numbers themselves become an axis.
void File::write_column(const Hdf5Column& column, hid_t axis) {
    const Handle space = space_of({column.values.size()});
    Handle dataset(H5Dcreate2(file_, column.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT,
                              dataset_properties(), H5P_DEFAULT),
                   H5Dclose);
    good(H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()));
    write_text(dataset, "long_name", column.long_name);
    if (!column.unit.empty()) write_text(dataset, "units", column.unit);
    if (axis >= 0) {
        good(H5DSattach_scale(dataset, axis, 0));
        return;
    }
    good(H5DSset_scale(dataset, column.name.c_str()));
    axes_.push_back(std::move(dataset));
}

File::Growing File::make_growing(const std::string& name, Handle type, std::vector<hsize_t> sizes,
                                 const void* fill, hsize_t entries_in_chunk) {
    std::vector<hsize_t> chunk = chunk_of(sizes, H5Tget_size(type));
    chunk.insert(chunk.begin(), entries_in_chunk);
    std::vector<hsize_t> now = sizes;
    now.insert(now.begin(), 0);
    std::vector<hsize_t> most = sizes;
    most.insert(most.begin(), H5S_UNLIMITED);
    const Handle space(H5Screate_simple(static_cast<int>(now.size()), now.data(), most.data()),
                       H5Sclose);
    const Handle creation = dataset_properties();
    good(H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data()));
    if (fill) good(H5Pset_fill_value(creation, type, fill));
    // Without a cache, the library writes numbers, and gives them addresses, before the next flush.
    const Handle use(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
    good(H5Pset_chunk_cache(use, 0, 0, 1));
    Growing growing{{H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, creation, use),
                     H5Dclose},
                    std::move(type),
                    std::move(sizes)};
    if (!records_.empty()) good(H5DSattach_scale(growing.dataset, records_[0].dataset, 0));
    return growing;
}

/// Adds the values of an entry to a dataset. Without values it only becomes longer.
void File::append(Growing& growing, const void* values) {
    std::vector<hsize_t> all = growing.sizes;
    all.insert(all.begin(), entries_ + 1);
    good(H5Dset_extent(growing.dataset, all.data()));
    if (!values) return;
    std::vector<hsize_t> begin(all.size(), 0);
    begin[0] = entries_;
    all[0] = 1;
    const Handle there(H5Dget_space(growing.dataset), H5Sclose);
    good(H5Sselect_hyperslab(there, H5S_SELECT_SET, begin.data(), nullptr, all.data(), nullptr));
    good(H5Dwrite(growing.dataset, growing.type, space_of(all), there, H5P_DEFAULT, values));
}

void File::append(Growing& record, const Hdf5Value& value) {
    if (const auto* text = std::get_if<std::string>(&value)) {
        std::string bytes = *text;
        bytes.resize(H5Tget_size(record.type));
        return append(record, bytes.data());
    }
    std::visit([&](const auto& number) { append(record, static_cast<const void*>(&number)); },
               value);
}

Result<void> File::add(const std::vector<Hdf5Value>& values,
                       const std::vector<std::string>& fields) {
    return attempt([&] {
        for (std::size_t k = 0; k < fields_.size(); ++k) {
            append(fields_[k],
                   fields[k].empty() ? nullptr : static_cast<const void*>(fields[k].data()));
        }
        for (std::size_t k = 1; k < records_.size(); ++k) append(records_[k], values[k]);
        flush();
        // The axis is as long as there are complete entries.
        append(records_[0], values[0]);
        flush();
        ++entries_;
    });
}

Result<void> File::describe(std::size_t stage, const std::map<std::string, double>& numbers) {
    return attempt([&] {
        for (const auto& [name, number] : numbers) {
            write_attribute(groups_[stage], name, H5T_IEEE_F64LE, &number);
        }
        flush();
    });
}

Result<void> File::close() {
    return attempt([&] { flush(); });
}

/// Closes the file. Drops writes after a failure, because they would not be in order.
File::~File() {
    const DroppedWrites dropped(!is_whole_);
    fields_.clear();
    axes_.clear();
    groups_.clear();
    records_.clear();
    file_ = Handle();
}

Result<std::unique_ptr<Hdf5File>> open_hdf5(const std::filesystem::path& path,
                                            const Hdf5Layout& layout) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    std::unique_ptr<Hdf5File> file;
    const auto made = attempt_hdf5([&] { file = std::make_unique<File>(path, layout); });
    if (!made) return tl::unexpected(made.error());
    return file;
}

}  // namespace

}  // namespace cascade

extern "C" __attribute__((visibility("default"))) cascade::Hdf5Opener* cascade_hdf5_opener(
    std::string_view version) {
    return version == cascade::version() ? &cascade::open_hdf5 : nullptr;
}
