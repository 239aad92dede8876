#pragma once

#include <cstdio>
#include <string>

namespace geodesic {

// A number for messages, short however large or small it is. Nine digits of a whole one at most: bindings
// whose ids have a sign take ten for an id.
inline std::string number_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

}
