// Finds processes whose children have all ended, such as a launcher that waits for ever.
#include "app/process_tree.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace cascade {
namespace {

/// A process with one child. It lives until it is killed and never waits for the child.
class ParentProcess {
public:
    ParentProcess() {
        int ready[2];
        if (::pipe(ready) != 0) return;
        process_ = ::fork();
        if (process_ == 0) {
            const pid_t child = ::fork();
            if (child == 0) {
                for (;;) ::pause();
            }
            const bool told = ::write(ready[1], &child, sizeof child) == sizeof child;
            while (told) ::pause();
            ::_exit(1);
        }
        has_child_ = ::read(ready[0], &child_, sizeof child_) == sizeof child_;
        ::close(ready[0]);
        ::close(ready[1]);
    }
    ~ParentProcess() {
        ::kill(child_, SIGKILL);
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    ParentProcess(const ParentProcess&) = delete;
    ParentProcess& operator=(const ParentProcess&) = delete;

    pid_t process() const { return process_; }
    pid_t child() const { return child_; }
    bool has_child() const { return has_child_; }

private:
    pid_t process_ = -1, child_ = -1;
    bool has_child_ = false;
};

/// Whether only_ended_below() becomes true within ten seconds.
bool becomes_true(pid_t process) {
    for (int k = 0; k < 1000; ++k) {
        if (only_ended_below(process)) return true;
        ::usleep(10'000);
    }
    return false;
}

TEST(ProcessTree, TellsEndedChildrenFromOthers) {
    const ParentProcess parent;
    ASSERT_TRUE(parent.has_child());
    EXPECT_FALSE(only_ended_below(parent.process()));
    EXPECT_FALSE(only_ended_below(parent.child())) << "it has no children";
    ::kill(parent.child(), SIGKILL);
    EXPECT_TRUE(becomes_true(parent.process()));
}

TEST(ProcessTree, HasNothingBelowProcessesThatDoNotExist) { EXPECT_FALSE(only_ended_below(-1)); }

}  // namespace
}  // namespace cascade
