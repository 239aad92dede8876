#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/field_output.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::tools {

namespace {

struct MsadArguments {
    std::string index;
    std::vector<std::string> sources;
    std::string mesh;
    FieldOutput output;
};

std::vector<float> distances_from(const geoidx& index, const std::string& path,
                                  const std::vector<uint32_t>& sources) {
    std::vector<float> distances(info_of(index, path).vertex_count);
    require_ok(geoidx_msad(&index, sources.data(), static_cast<uint32_t>(sources.size()), distances.data(),
                           static_cast<uint32_t>(distances.size())),
               path);
    return distances;
}

void msad(const MsadArguments& arguments) {
    const std::vector<uint32_t> sources = vertex_ids(arguments.sources);
    const std::vector<std::string> inputs{arguments.index, arguments.mesh};
    const bool has_mesh = !arguments.mesh.empty();
    require_writable(arguments.output, has_mesh, inputs);
    TriangleMesh mesh;
    if (has_mesh) mesh = read_mesh(arguments.mesh);
    const Index index = open_index(arguments.index, has_mesh ? &mesh : nullptr);
    const std::vector<float> distances = distances_from(*index, arguments.index, sources);
    write_field(arguments.output, distances, has_mesh ? &mesh : nullptr, sources,
                JsonObject().text("index", arguments.index));
}

}

void add_msad(CLI::App& app) {
    auto arguments = std::make_shared<MsadArguments>();
    CLI::App* command = app.add_subcommand("msad", "write every vertex's distance to the nearest source");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_option("S", arguments->sources, "source vertex ids")->required();
    CLI::Option* png = add_field_options(*command, arguments->output);
    CLI::Option* mesh =
        command->add_option("--mesh", arguments->mesh,
                            "the index's mesh, which a picture, a .ply and a file without positions need");
    png->needs(mesh);
    command->callback([arguments] { msad(*arguments); });
}

}
