// Finds results of earlier sweeps by the keys of their runs.
#include "run/commands/sweep_folder.h"

#include "core/file.h"
#include "core/temporary_file.h"

#include <system_error>
#include <utility>

namespace cascade {
namespace {

/// Copies the result of a run from the folder of another sweep. Returns an empty optional if no
/// gathered folder contains the result.
Result<std::optional<SweepResult>> gather(const SweepRequest& request,
                                          const std::filesystem::path& to, const std::string& key) {
    for (const auto& folder : request.gathered) {
        auto result = read_result(folder / "runs", key);
        if (!result) continue;
        if (auto written = write_result(to, key, *result); !written) {
            return tl::unexpected(written.error());
        }
        return result;
    }
    return std::optional<SweepResult>();
}

}  // namespace

Result<void> prepare_folder(const std::filesystem::path& folder) {
    if (auto made = make_folder(folder / "runs"); !made) return made;
    for (const char* name : {"sheet.png", "features.csv", "runs/x.json"}) {
        if (auto good = check_writable(folder / name); !good) return good;
    }
    for (const auto& each : {folder, folder / "runs"}) remove_dead_temporaries(each);
    return {};
}

Result<std::optional<SweepResult>> earlier_result(const SweepRequest& request,
                                                  const std::filesystem::path& folder,
                                                  const PlannedRun& run) {
    if (request.force) return std::optional<SweepResult>();
    auto result = read_result(folder / "runs", run.key);
    if (!result) {
        auto gathered = gather(request, folder / "runs", run.key);
        if (!gathered || !*gathered) return gathered;
        result = *std::move(gathered);
    }
    const auto saved = folder / "fields" / folder_name(request.varied, run.values) / "run.json";
    std::error_code error;
    const bool has_fields = result->failed() || std::filesystem::exists(saved, error);
    if (request.fields && !has_fields) return std::optional<SweepResult>();
    return result;
}

}  // namespace cascade
