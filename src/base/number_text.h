#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace geodesic {

// A number for messages, short however large or small it is, and the same in every locale. It has at most
// nine digits: bindings of languages without unsigned numbers take a number of ten digits in a message for an
// id.
inline std::string number_text(double number) {
    if (std::isnan(number)) return "NaN";
    constexpr int DIGITS = 9;
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number, std::chars_format::general, DIGITS).ptr};
}

}
