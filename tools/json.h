#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace geodesic::tools {

// A JSON string with its quotes. Names of files may hold anything: what is no UTF-8 becomes U+FFFD.
std::string json_text(std::string_view text);

// With the digits that bring the same float or double back; null where it is infinite or not a number, which
// JSON does not know.
std::string json_number(float number);
std::string json_number(double number);

// An object with a member a line, in the order of the calls.
class JsonObject {
public:
    JsonObject& text(std::string_view key, std::string_view value) { return json(key, json_text(value)); }
    JsonObject& count(std::string_view key, uint64_t value) { return json(key, std::to_string(value)); }
    JsonObject& number(std::string_view key, double value) { return json(key, json_number(value)); }
    JsonObject& truth(std::string_view key, bool value) { return json(key, value ? "true" : "false"); }
    // `value` is JSON already.
    JsonObject& json(std::string_view key, std::string_view value);

    // Writes it to stdout.
    void print() const;

private:
    std::string members_;
};

}
