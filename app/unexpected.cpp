// Exceptions mean a lack of memory or a bug. All other errors are values.
#include "app/unexpected.h"

#include "app/exit_status.h"

#include <exception>
#include <new>
#include <string>

namespace cascade {

int tell_of_exception(const Console& console) {
    try {
        throw;
    } catch (const std::bad_alloc&) {
        console.fail({"there is not enough memory",
                      "use a smaller grid or fewer cells, or allow more with --limit-memory"});
        return exit_status::failed_run;
    } catch (const std::exception& error) {
        console.fail(
            {std::string("this is a fault of Cascade: ") + error.what(), "it is a bug in Cascade"});
        return exit_status::bug;
    }
}

}  // namespace cascade
