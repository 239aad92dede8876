#include <memory>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/index_output.h"
#include "tools/commands/index_rows.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

struct ConvertArguments {
    std::string input, output, mesh;
    FileForm form;
    bool json = false;
};

void print_json(const geoidx_info& info, const ConvertArguments& arguments) {
    JsonObject object;
    object.text("index", arguments.input).text("output", arguments.output);
    add_rows(rows_of_index(info, arguments.output, true), object);
    object.print();
}

void convert(const ConvertArguments& arguments) {
    require_json_apart(arguments.json, arguments.output);
    require_index_output(arguments.output, arguments.input);
    const Index index = open_index_with(arguments.mesh, arguments.input);
    require_mesh_or_no_positions(arguments.form, info_of(*index, arguments.input).has_mesh != 0);
    save_index(*index, arguments.form, arguments.output);
    if (arguments.json) print_json(info_of_saved(*index, arguments.form, arguments.output), arguments);
}

}

void add_convert(CLI::App& app) {
    auto arguments = std::make_shared<ConvertArguments>();
    CLI::App* command = app.add_subcommand("convert", "write an index in another form");
    command->add_option("FILE", arguments->input, "index file")->required();
    command->add_option("-o,--output", arguments->output, "index file to write; - is stdout")->required();
    add_form_options(*command, arguments->form);
    command->add_flag("--no-mesh", arguments->form.no_mesh, "leave out the mesh that the index keeps");
    add_mesh_option(*command, arguments->mesh);
    command->add_flag("--json", arguments->json, "print a JSON object: what info prints of the new file");
    command->callback([arguments] { convert(*arguments); });
}

}
