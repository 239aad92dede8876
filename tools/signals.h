#pragma once

#include <csignal>

namespace geodesic::tools {

// From then on Ctrl-C ends the program at once with exit status 130, and SIGTERM with 143, after one line on
// stderr. A shell's own jobs in the background, which start with Ctrl-C ignored, end likewise.
void exit_on_signals();

// While it lives, Ctrl-C, SIGTERM and SIGHUP wait, so that a file half written is not left behind.
class SignalsHeldBack {
public:
    SignalsHeldBack();
    ~SignalsHeldBack();
    SignalsHeldBack(const SignalsHeldBack&) = delete;
    SignalsHeldBack& operator=(const SignalsHeldBack&) = delete;

private:
    sigset_t old_mask_;
};

}
