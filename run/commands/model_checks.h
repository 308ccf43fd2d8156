// Options of model files that do not fit what is written.
#pragma once

#include "run/commands/run.h"
#include "run/script/option_statements.h"
#include "run/script/script.h"

#include <string>

namespace cascade {

/// Reports options that are incompatible with the domain or with each other.
class OptionRefuser {
public:
    explicit OptionRefuser(Script& script) : script_(script) {}

    void refuse_if(bool is_wrong, const std::string& option, std::string message,
                   std::string hint) {
        if (is_wrong) refuse(option, option, std::move(message), std::move(hint));
    }
    void refuse(const std::string& option, const std::string& value, std::string message,
                std::string hint) {
        script_.diagnostics.error(option_span(script_.sources, option, value), std::move(message),
                                  std::move(hint));
    }

private:
    Script& script_;
};

/// On a model: options without a file that they apply to.
void check_model_files(OptionRefuser& options, const RunRequest& request);

/// On a model with fields: what needs heights, if the run has none.
void check_heights(OptionRefuser& options, const RunRequest& request, bool has_heights);

/// Of cells that crawl, which become copies of shapes.
void check_levels_of_cells(OptionRefuser& options, const RunRequest& request);

/// Of the body of a volume, which has a surface and no cells on it.
void check_of_body(OptionRefuser& options, const RunRequest& request);

/// Of cells that crawl in a plane or in space.
void check_without_surface(OptionRefuser& options, const RunRequest& request);

/// On grids. A plane has maps, too.
void check_without_model(OptionRefuser& options, const RunRequest& request, bool is_plane);

}  // namespace cascade
