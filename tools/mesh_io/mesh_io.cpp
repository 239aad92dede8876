#include "tools/mesh_io/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <new>

#include "tools/read_file.h"

namespace geodesic::tools {

namespace {

MeshFormat format_by_contents(std::string_view bytes) {
    const std::string_view first_line = bytes.substr(0, std::min(bytes.find_first_of("\r\n"), size_t{80}));
    if (first_line == "ply") return MeshFormat::ply;
    if (first_line.starts_with("solid")) return MeshFormat::stl;
    if (first_line.substr(0, 8).find("OFF") != std::string_view::npos) return MeshFormat::off;
    return MeshFormat::unknown;
}

TriangleMesh parse(MeshFormat format, std::string_view bytes) {
    switch (format) {
    case MeshFormat::obj:
        return read_obj(bytes);
    case MeshFormat::ply:
        return read_ply(bytes);
    case MeshFormat::off:
        return read_off(bytes);
    case MeshFormat::stl:
        return read_stl(bytes);
    case MeshFormat::unknown:
        break;
    }
    throw MeshFileError("not a known kind of mesh file (.obj, .ply, .off, .stl)");
}

}

std::string lower_case_extension(std::string_view path) {
    const size_t dot = path.find_last_of("./\\");
    if (dot == std::string_view::npos || path[dot] != '.') return {};
    std::string extension(path.substr(dot + 1));
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

MeshFormat mesh_format(std::string_view path, std::string_view bytes) {
    const std::string extension = lower_case_extension(path);
    if (extension == "obj") return MeshFormat::obj;
    if (extension == "ply") return MeshFormat::ply;
    if (extension == "off") return MeshFormat::off;
    if (extension == "stl") return MeshFormat::stl;
    return format_by_contents(bytes);
}

TriangleMesh read_mesh(const std::string& path) {
    try {
        const std::string bytes = read_file(path);
        TriangleMesh mesh = parse(mesh_format(path, bytes), bytes);
        if (mesh.positions.empty()) throw MeshFileError("the mesh has no vertices");
        if (mesh.triangles.empty()) throw MeshFileError("the mesh has no triangles");
        return mesh;
    } catch (const std::bad_alloc&) {
        throw MeshFileError(path + ": out of memory");
    } catch (const std::runtime_error& error) {
        throw MeshFileError(path + ": " + error.what());
    }
}

}
