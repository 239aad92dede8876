#pragma once

#include <csignal>

namespace geodesic::tools {

// While it lives, Ctrl-C and SIGTERM are noted instead of ending the program; a second one ends it.
class InterruptWatch {
public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    static bool interrupted();

private:
    struct sigaction old_interrupt_ {};
    struct sigaction old_terminate_ {};
};

// While it lives, Ctrl-C and SIGTERM wait, so that a file half written is not left behind.
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
