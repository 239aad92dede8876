#include "tests/campaign/mesh_case.h"

#include <iomanip>
#include <istream>
#include <ostream>
#include <sstream>

#include "tests/campaign/mesh_checks.h"
#include "tests/campaign/random_mesh.h"

namespace geodesic::campaign {

MeshCase random_case(uint64_t seed) {
    Dice dice(seed);
    Dice of_mesh(dice.bits()), of_options(dice.bits());
    MeshCase result{random_mesh(of_mesh), {}};
    result.options = random_options(of_options, result.soup);
    return result;
}

std::optional<Failure> failure_of(const MeshCase& mesh_case, bool quiet) {
    return failure_of([&] { check_case(mesh_case.soup, mesh_case.options); }, quiet);
}

void write_case(std::ostream& out, const MeshCase& mesh_case, const std::string& failure) {
    std::istringstream lines("failed " + failure + '\n' + described(mesh_case.options));
    for (std::string line; std::getline(lines, line);) out << "# " << line << '\n';
    out << std::setprecision(17);
    for (const auto& p : mesh_case.soup.positions)
        out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& [a, b, c] : mesh_case.soup.triangles)
        out << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
}

MeshCase read_case(std::istream& in) {
    MeshCase result;
    std::string options;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "#") options += line.substr(1) + '\n';
        if (kind == "v") {
            Eigen::Vector3d p;
            words >> p.x() >> p.y() >> p.z();
            result.soup.positions.push_back(p);
        }
        if (kind == "f") {
            std::array<uint32_t, 3> triangle;
            for (uint32_t& id : triangle) {
                words >> id;
                --id;
            }
            result.soup.triangles.push_back(triangle);
        }
    }
    result.options = read_options(options);
    return result;
}

}
