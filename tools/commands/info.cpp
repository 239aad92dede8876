#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/commands/index_rows.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

struct InfoArguments {
    std::string index;
    bool json = false;
};

void print_text(const std::vector<IndexRow>& rows) {
    for (const IndexRow& row : rows) std::printf("%-28s %s\n", row.label, row.value.c_str());
}

void print_json(const std::vector<IndexRow>& rows) {
    JsonObject object;
    add_rows(rows, object);
    object.print();
}

void info(const InfoArguments& arguments) {
    const Index index = open_index(arguments.index, nullptr);
    const std::vector<IndexRow> rows =
        rows_of_index(info_of(*index, arguments.index), arguments.index, arguments.json);
    arguments.json ? print_json(rows) : print_text(rows);
}

}

void add_info(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "show what an index is and how accurate");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { info(*arguments); });
}

}
