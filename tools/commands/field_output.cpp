#include "tools/commands/field_output.h"

#include <algorithm>
#include <cmath>

#include "tools/commands/field_format.h"
#include "tools/failure.h"
#include "tools/output_file.h"

namespace geodesic::tools {

namespace {

// What the name of the file says, or --format where it says nothing.
FieldFormat format_of(const FieldOutput& output) {
    const auto by_name = field_format_of_file(output.numbers);
    const auto wanted = field_format_of_name(output.format);
    if (by_name && wanted && *by_name != *wanted)
        throw CLI::ValidationError(output.numbers + ": its name says otherwise than --format " +
                                   output.format);
    if (by_name || wanted) return by_name ? *by_name : *wanted;
    if (output.numbers == STANDARD_OUTPUT) return FieldFormat::csv;
    throw CLI::ValidationError("--output: '" + output.numbers +
                               "' ends with none of .f32, .csv, .npy, .ply, and there is no --format");
}

void require_one_on_standard_output(const FieldOutput& output) {
    const int count =
        (output.numbers == STANDARD_OUTPUT) + (output.picture.file == STANDARD_OUTPUT) + output.json;
    if (count > 1)
        throw CLI::ValidationError("standard output is for one of -o, --png and --json, not for several");
}

void require_sound(const FieldOutput& output, bool has_mesh) {
    picture_options(output.picture);
    require_one_on_standard_output(output);
    if (output.numbers.empty() && output.picture.file.empty() && !output.json)
        throw CLI::ValidationError("one of -o, --png and --json is required");
    if (!output.numbers.empty() && format_of(output) == FieldFormat::ply && !has_mesh)
        throw CLI::ValidationError(output.numbers + ": a ply file holds the mesh, so it needs --mesh");
}

std::string name_or_null(const std::string& path) { return path.empty() ? "null" : json_text(path); }

// The members that say what the field is like.
void describe(std::span<const float> distances, JsonObject& object) {
    size_t reachable = 0;
    size_t farthest = 0;
    for (size_t v = 0; v < distances.size(); ++v) {
        if (!std::isfinite(distances[v])) continue;
        ++reachable;
        if (!std::isfinite(distances[farthest]) || distances[v] > distances[farthest]) farthest = v;
    }
    object.count("vertex_count", distances.size()).count("reachable_count", reachable);
    object.count("farthest_vertex", farthest).json("largest_distance", json_number(distances[farthest]));
}

template <class Values, class Printed>
std::string json_array(const Values& values, const Printed& printed) {
    std::string array;
    for (const auto& value : values) array.append(array.empty() ? "" : ", ").append(printed(value));
    return "[" + array + "]";
}

void print_object(const FieldOutput& output, std::span<const float> distances,
                  std::span<const uint32_t> sources, JsonObject& object) {
    object.json("sources", json_array(sources, [](uint32_t source) { return std::to_string(source); }));
    describe(distances, object);
    object.json("output", name_or_null(output.numbers)).json("picture", name_or_null(output.picture.file));
    if (output.numbers.empty() && output.picture.file.empty())
        object.json("distances", json_array(distances, [](float distance) { return json_number(distance); }));
    object.print();
}

}

CLI::Option* add_field_options(CLI::App& command, FieldOutput& output) {
    CLI::Option* numbers = command.add_option(
        "-o,--output", output.numbers, "file to write: .f32, .csv, .npy, or .ply with colours; - is stdout");
    command.add_option("--format", output.format, "of the output where its name does not say it; - is csv")
        ->needs(numbers)
        ->check(CLI::IsMember(FIELD_FORMAT_NAMES));
    CLI::Option* png = add_picture_options(command, output.picture);
    command.add_flag("--json", output.json,
                     "print a JSON object, which holds the distances if nothing else is to be written");
    return png;
}

void require_writable(const FieldOutput& output, bool has_mesh, std::span<const std::string> inputs) {
    require_sound(output, has_mesh);
    if (!output.numbers.empty()) {
        require_writable(output.numbers, inputs);
        if (format_of(output) != FieldFormat::csv) require_no_terminal(output.numbers);
    }
    if (output.picture.file.empty()) return;
    require_writable(output.picture.file, inputs);
    require_no_terminal(output.picture.file);
    if (is_same_path(output.picture.file, output.numbers))
        throw Failure(output.picture.file + ": is both -o and --png");
}

// Standard output comes last: it may be closed early, which ends the program.
void write_field(const FieldOutput& output, std::span<const float> distances, const TriangleMesh* mesh,
                 std::span<const uint32_t> sources, JsonObject object) {
    std::vector<std::pair<std::string, std::vector<unsigned char>>> files;
    if (!output.numbers.empty())
        files.emplace_back(output.numbers, encode_field(format_of(output), distances, mesh));
    if (mesh && !output.picture.file.empty())
        files.emplace_back(output.picture.file,
                           encode_picture(output.picture, render_field(*mesh, distances, sources,
                                                                       picture_options(output.picture))));
    std::stable_partition(files.begin(), files.end(),
                          [](const auto& file) { return file.first != STANDARD_OUTPUT; });
    for (const auto& [path, bytes] : files) write_file(path, bytes);
    if (output.json) print_object(output, distances, sources, object);
}

}
