#include "tools/signals.h"

#include <string_view>

#include <pthread.h>
#include <unistd.h>

namespace geodesic::tools {

namespace {

volatile std::sig_atomic_t stderr_is_terminal = 0;

// Only what is allowed inside of a signal handler; what cannot be written is not missed any more.
void say(std::string_view text) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
}

extern "C" void end_program(int signal) {
    if (stderr_is_terminal) say("\r\x1b[K"); // the progress bar, and the ^C behind it
    say(signal == SIGINT ? "geoidx: interrupted\n" : "geoidx: terminated\n");
    _exit(128 + signal);
}

}

void exit_on_signals() {
    stderr_is_terminal = isatty(STDERR_FILENO);
    struct sigaction action {};
    action.sa_handler = end_program;
    sigaddset(&action.sa_mask, SIGINT);
    sigaddset(&action.sa_mask, SIGTERM);
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

SignalsHeldBack::SignalsHeldBack() {
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGINT);
    sigaddset(&held, SIGTERM);
    sigaddset(&held, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &held, &old_mask_);
}

SignalsHeldBack::~SignalsHeldBack() { pthread_sigmask(SIG_SETMASK, &old_mask_, nullptr); }

}
