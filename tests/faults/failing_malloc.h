#pragma once

#include <cstdint>

namespace geodesic::test {

// Fails allocations of the whole process while it lives: malloc and its siblings, operator new, and beginning
// a thread, which takes a stack, on every thread and in every library. From the failing call on, counted from
// now, all fail, or only that one. There is one at a time.
class FailingMalloc {
public:
    FailingMalloc(uint64_t failing_call, bool recovers);
    ~FailingMalloc();
    FailingMalloc(const FailingMalloc&) = delete;
    FailingMalloc& operator=(const FailingMalloc&) = delete;

    // How many calls have failed so far.
    uint64_t failures() const;
};

}
