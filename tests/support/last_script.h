// Names the script with which a test crashed, when the test itself cannot give a message.
#pragma once

#include <csignal>
#include <initializer_list>
#include <string>
#include <unistd.h>

namespace cascade::test {

/// While this object exists, a crash prints the last script that was set.
class LastScript {
public:
    LastScript() {
        for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) {
            std::signal(signal, print);
        }
    }
    ~LastScript() {
        for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL}) {
            std::signal(signal, SIG_DFL);
        }
    }
    LastScript(const LastScript&) = delete;
    LastScript& operator=(const LastScript&) = delete;

    void tell(const std::string& script) { text() = script; }

private:
    static std::string& text() {
        static std::string script;
        return script;
    }
    static void print(int signal) {
        const std::string& script = text();
        (void)!::write(STDERR_FILENO, "\nthis script crashes:\n", 22);
        (void)!::write(STDERR_FILENO, script.data(), script.size());
        (void)!::write(STDERR_FILENO, "\n", 1);
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
};

}  // namespace cascade::test
