#pragma once

#include <cstdio>
#include <string>

namespace geodesic {

// A number for messages, short however large or small it is.
inline std::string number_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.12g", number);
    return text;
}

}
