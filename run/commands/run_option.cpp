// Each function looks for an option in the tables of options.
#include "run/commands/run_option.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

std::string flag_of(RunOption option) {
    std::string flag;
    switch (option) {
#define CASCADE_PICTURE_OPTION(type, member, initial, key, ...) \
    case RunOption::member:                                     \
        flag = "--" key;                                        \
        break;
#include "run/script/picture_options.def"
#define CASCADE_RUN_OPTION(id, member, name, ...) \
    case RunOption::id:                           \
        flag = name;                              \
        break;
#include "run/commands/run_options.def"
    }
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

bool is_given(const RunRequest& request, RunOption option) {
    const RunRequest usual;
    switch (option) {
#define CASCADE_PICTURE_OPTION(type, member, ...) \
    case RunOption::member:                       \
        return differ(request.picture.member, usual.picture.member);
#include "run/script/picture_options.def"
#define CASCADE_RUN_OPTION(id, member, ...) \
    case RunOption::id:                     \
        return differ(request.member, usual.member);
#include "run/commands/run_options.def"
    }
    CHECK(false, "every option is a row");
}

}  // namespace cascade
