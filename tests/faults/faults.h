#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <optional>

#include "tests/capi/calls.h"
#include "tests/capi/counting_allocator.h"
#include "tests/faults/failing_malloc.h"
#include "tests/support/sanitized.h"

namespace geodesic::test {

// Whose allocations fail.
enum class Source { caller, process };

// One try of something, in which one allocation fails, or all from that one on.
class Fault {
public:
    Fault(Source source, uint64_t failing_call, bool recovers)
        : source_(source), failing_call_(failing_call), recovers_(recovers),
          allocator_(UINT64_MAX, recovers) {}

    // For what is to be tried; the default one when it is the process's allocations that fail.
    geoidx_allocator allocator() { return source_ == Source::caller ? allocator_.get() : geoidx_allocator{}; }

    // Calls what is to be tried, and counts allocations during that call only. The result must be success or
    // a lack of memory, and success when nothing failed.
    geoidx_status disturb(const std::function<geoidx_status()>& call) {
        const geoidx_status status = source_ == Source::caller ? with_allocator(call) : with_malloc(call);
        INFO("detail: ", std::string(geoidx_last_error()));
        CHECK((status == GEOIDX_OK || (failures_ > 0 && status == GEOIDX_ERROR_OUT_OF_MEMORY)));
        return status;
    }

    uint64_t failures() const { return failures_; }
    bool everything_was_released() const { return allocator_.blocks() == 0 && allocator_.mistakes() == 0; }

private:
    geoidx_status with_allocator(const std::function<geoidx_status()>& call) {
        allocator_.fail_at(failing_call_);
        const geoidx_status status = call();
        allocator_.never_fail();
        failures_ = allocator_.failures();
        return status;
    }

    geoidx_status with_malloc(const std::function<geoidx_status()>& call) {
        const FailingMalloc failing(failing_call_, recovers_);
        const geoidx_status status = call();
        failures_ = failing.failures();
        return status;
    }

    Source source_;
    uint64_t failing_call_, failures_ = 0;
    bool recovers_;
    CountingAllocator allocator_;
};

// Tries something with one allocation failing after the other until none fails any more: the first ones, and
// then fewer and fewer, up to one of `stride`. Once more where allocations after the failing one succeed.
// Every one fails where GEOIDX_EVERY_FAULT is set in the environment. Returns how often one failed.
inline uint64_t try_with_faults(Source source, uint64_t stride, const std::function<void(Fault&)>& attempt) {
    constexpr uint64_t FIRST_ONES = SANITIZED ? 2 : 8; // of twice as many every second one, and so on
    if (std::getenv("GEOIDX_EVERY_FAULT")) stride = 1;
    uint64_t failed = 0;
    for (bool recovers : {false, true})
        for (uint64_t k = 0;; k += std::min(stride, 1 + k / FIRST_ONES)) {
            CAPTURE(k);
            CAPTURE(recovers);
            REQUIRE(k < 1000000);
            Fault fault(source, k, recovers);
            attempt(fault);
            CHECK(fault.everything_was_released());
            if (fault.failures() == 0) break;
            ++failed;
        }
    return failed;
}

}
