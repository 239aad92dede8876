// geoidx_stress_meshes FOLDER COUNT: writes COUNT meshes of each stress family into the folder, as OBJ files.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/support/stress_meshes.h"

using namespace geodesic::test;

namespace {

// Writes doubles so that reading them gives the same bits.
bool write_obj(const Soup& soup, const std::string& path) {
    std::FILE* const file = std::fopen(path.c_str(), "w");
    if (!file) return false;
    for (const auto& p : soup.positions) std::fprintf(file, "v %.17g %.17g %.17g\n", p.x(), p.y(), p.z());
    for (const auto& [a, b, c] : soup.triangles) std::fprintf(file, "f %u %u %u\n", a + 1, b + 1, c + 1);
    const bool is_written = std::ferror(file) == 0;
    return std::fclose(file) == 0 && is_written;
}

bool write_family(const StressFamily& family, const std::string& folder, int count) {
    std::string name = family.name;
    for (char& letter : name)
        if (letter == ' ') letter = '_';
    std::mt19937_64 random(77);
    for (int i = 1; i <= count; ++i)
        if (!write_obj(family.draw(random), folder + "/" + name + "_" + std::to_string(i) + ".obj"))
            return false;
    return true;
}

}

int main(int argument_count, char** arguments) {
    const int count = argument_count == 3 ? std::atoi(arguments[2]) : 0;
    if (count < 1) {
        std::fprintf(stderr, "usage: geoidx_stress_meshes FOLDER COUNT\n");
        return 2;
    }
    for (const auto families : {stress_families(), unorientable_families()})
        for (const StressFamily& family : families)
            if (!write_family(family, arguments[1], count)) {
                std::fprintf(stderr, "%s cannot be written to\n", arguments[1]);
                return 1;
            }
    return 0;
}
