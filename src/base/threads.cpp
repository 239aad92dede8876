#include "src/base/threads.h"

#include <algorithm>
#include <string>
#include <thread>

#include "format/error.h"

namespace geodesic {

uint32_t thread_count(uint32_t asked_for) {
    constexpr uint32_t MOST = 1024;
    if (asked_for > MOST)
        refuse_argument("threads is " + std::to_string(asked_for) + ", more than " + std::to_string(MOST));
    return asked_for ? asked_for : std::clamp(std::thread::hardware_concurrency(), 1u, MOST);
}

}
