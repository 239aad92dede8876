#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/picture_output.h"
#include "tools/failure.h"
#include "tools/json.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"
#include "tools/output_file.h"

namespace geodesic::tools {

namespace {

struct PathArguments {
    std::string index, mesh; // the latter is empty if it is the one that the index keeps
    std::vector<std::string> ids;
    std::string quality = "straight";
    std::string output;
    PictureOutput picture;
    std::optional<double> weld_tolerance;
    bool json = false;
};

// A path from one vertex to another: its length, and its points in order.
struct Way {
    double length = 0;
    std::vector<geoidx_path_point> points;
};

geoidx_surface_point point_at(const geoidx_surface& surface, uint32_t id, const std::string& path) {
    geoidx_surface_point point{};
    require_ok(geoidx_vertex_point(&surface, id, &point), path);
    return point;
}

Way way_between(const geoidx& index, const geoidx_surface& surface, const PathArguments& arguments,
                std::span<const uint32_t> ends) {
    const std::string& of = arguments.mesh.empty() ? arguments.index : arguments.mesh;
    const Query query = make_query(index, arguments.index);
    const geoidx_surface_point source = point_at(surface, ends[0], of),
                               target = point_at(surface, ends[1], of);
    const uint32_t quality = arguments.quality == "exact" ? GEOIDX_PATH_EXACT : GEOIDX_PATH_STRAIGHT;
    Way way;
    require_ok(geoidx_query_path(query.get(), &surface, &source, &target, quality, &way.length),
               arguments.index);
    uint64_t count = 0;
    require_ok(geoidx_query_path_points(query.get(), nullptr, 0, &count), arguments.index);
    way.points.resize(count);
    require_ok(geoidx_query_path_points(query.get(), way.points.data(), count, &count), arguments.index);
    return way;
}

template <class... Values>
std::string text_of(const char* format, Values... values) {
    std::array<char, 160> text;
    const int size = std::snprintf(text.data(), text.size(), format, values...);
    return {text.data(), static_cast<size_t>(size)};
}

// One line of the points, in the order of the path; indices of OBJ begin at 1.
std::string obj_of(const Way& way) {
    std::string text;
    for (const auto& [point, at] : way.points) text += text_of("v %.17g %.17g %.17g\n", at[0], at[1], at[2]);
    text += "l";
    for (size_t i = 1; i <= way.points.size(); ++i) text += " " + std::to_string(i);
    return text + "\n";
}

std::string ply_of(const Way& way) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(way.points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement edge " +
                       std::to_string(way.points.size() - 1) +
                       "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    for (const auto& [point, at] : way.points) text += text_of("%.17g %.17g %.17g\n", at[0], at[1], at[2]);
    for (size_t i = 1; i < way.points.size(); ++i)
        text += std::to_string(i - 1) + " " + std::to_string(i) + "\n";
    return text;
}

std::string csv_of(const Way& way) {
    std::string text = "triangle,weight0,weight1,weight2,x,y,z\n";
    for (const auto& [point, at] : way.points)
        text += std::to_string(point.triangle) +
                text_of(",%.17g,%.17g,%.17g", point.weights[0], point.weights[1], point.weights[2]) +
                text_of(",%.17g,%.17g,%.17g\n", at[0], at[1], at[2]);
    return text;
}

using Writer = std::string (*)(const Way&);

Writer writer_of(const std::string& output) {
    constexpr std::pair<const char*, Writer> WRITERS[] = {{"obj", obj_of}, {"ply", ply_of}, {"csv", csv_of}};
    const std::string extension = lower_case_extension(output);
    for (const auto& [name, writer] : WRITERS)
        if (extension == name) return writer;
    throw CLI::ValidationError("--output must end with .obj, .ply or .csv: " + output);
}

// The path on the mesh, which is coloured by the distances from the first vertex.
void write_picture(const PictureOutput& output, const geoidx& index, const TriangleMesh& mesh, const Way& way,
                   std::span<const uint32_t> ends) {
    std::vector<float> distances(mesh.vertex_count());
    require_ok(geoidx_msad(&index, ends.data(), 1, distances.data(), static_cast<uint32_t>(distances.size())),
               output.file);
    std::vector<WayPoint> points;
    for (const auto& [point, position] : way.points) {
        const uint32_t* const corners = mesh.triangles.data() + 3 * size_t{point.triangle};
        points.push_back(
            {{corners[0], corners[1], corners[2]}, {point.weights[0], point.weights[1], point.weights[2]}});
    }
    write_file(output.file,
               encode_picture(output, render_field(mesh, distances, ends, picture_options(output), points)));
}

void require_outputs(const PathArguments& arguments) {
    const std::array inputs{arguments.index, arguments.mesh};
    const std::string& picture = arguments.picture.file;
    picture_options(arguments.picture);
    if (picture == STANDARD_OUTPUT) throw CLI::ValidationError("--png: standard output is for the length");
    if (!arguments.output.empty()) require_writable(arguments.output, inputs);
    if (picture.empty()) return;
    if (arguments.mesh.empty()) throw CLI::ValidationError("--png needs MESH, also where the file keeps it");
    require_writable(picture, inputs);
    if (is_same_path(picture, arguments.output)) throw Failure(picture + ": is both -o and --png");
}

// Of three words before the options the first is the mesh.
void take_mesh(PathArguments& arguments) {
    if (arguments.ids.size() < 3) return;
    arguments.mesh = arguments.ids.front();
    arguments.ids.erase(arguments.ids.begin());
}

// The path is on the mesh of the command line or, without one, on that of the file.
void require_mesh(const geoidx& index, const PathArguments& arguments) {
    if (!arguments.mesh.empty()) return;
    if (arguments.weld_tolerance)
        throw CLI::ValidationError(
            "--weld-tolerance is of MESH; the mesh in the file is welded as the index is");
    if (!info_of(index, arguments.index).has_mesh)
        throw CLI::ValidationError(arguments.index +
                                   " keeps no mesh, so that MESH is needed: geoidx path FILE MESH A B");
}

void path(const PathArguments& arguments) {
    const std::vector<uint32_t> ids = vertex_ids(arguments.ids);
    const Writer writer = arguments.output.empty() ? nullptr : writer_of(arguments.output);
    require_outputs(arguments);
    std::optional<TriangleMesh> mesh;
    if (!arguments.mesh.empty()) mesh = read_mesh(arguments.mesh);
    const Index index = open_index(arguments.index, mesh ? &*mesh : nullptr, "geoidx path FILE MESH A B");
    require_mesh(*index, arguments);
    const Surface surface = mesh ? make_surface(*mesh, arguments.mesh, arguments.weld_tolerance.value_or(0))
                                 : surface_of(*index, arguments.index);
    const Way way = way_between(*index, *surface, arguments, ids);
    if (writer) {
        const std::string text = writer(way);
        write_file(arguments.output, {reinterpret_cast<const unsigned char*>(text.data()), text.size()});
    }
    if (!arguments.picture.file.empty()) write_picture(arguments.picture, *index, *mesh, way, ids);
    if (arguments.json) {
        JsonObject()
            .text("index", arguments.index)
            .count("source", ids[0])
            .count("target", ids[1])
            .number("length", way.length)
            .count("points", way.points.size())
            .print();
        return;
    }
    std::printf("%.9g\n", way.length);
    if (writer) return;
    for (const auto& [point, at] : way.points) std::printf("%.9g %.9g %.9g\n", at[0], at[1], at[2]);
}

}

void add_path(CLI::App& app) {
    auto arguments = std::make_shared<PathArguments>();
    CLI::App* command =
        app.add_subcommand("path", "print the path between two vertices: its length, then its points");
    command->add_option("FILE", arguments->index, "index file")->required();
    command
        ->add_option(
            "MESH A B", arguments->ids,
            "the mesh that the index was built from, unless the file keeps it (build --store-mesh), and "
            "two vertex ids")
        ->required()
        ->expected(2, 3);
    command
        ->add_option("--quality", arguments->quality,
                     "straight: locally shortest, from the index; exact: a shortest path")
        ->check(CLI::IsMember({"straight", "exact"}))
        ->capture_default_str();
    command->add_option("-o,--output", arguments->output,
                        "write the points to a file, .obj, .ply or .csv, and print the length only");
    add_picture_options(*command, arguments->picture)
        ->description("picture of the path to write, on the distances from A");
    command->add_option("--weld-tolerance", arguments->weld_tolerance,
                        "of MESH: that the index was built with");
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] {
        take_mesh(*arguments);
        path(*arguments);
    });
}

}
