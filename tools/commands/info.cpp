#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "tools/commands/arguments.h"
#include "tools/commands/commands.h"
#include "tools/commands/index_rows.h"
#include "tools/library.h"

namespace geodesic::tools {

namespace {

struct InfoArguments {
    std::string index, mesh;
    bool json = false;
};

const char* coding_of(const geoidx_section& section) {
    constexpr std::array NAMES{"raw", "zstd", "png", "images"};
    return section.coding < NAMES.size() ? NAMES[section.coding] : "unknown";
}

// A file may have sections of later versions: bytes of their tags that are not printable are told as \xNN.
std::string tag_of(const geoidx_section& section) {
    std::string text;
    for (const char letter : std::string_view(section.tag))
        if (letter >= ' ' && letter <= '~') {
            text += letter;
        } else {
            char escaped[8];
            std::snprintf(escaped, sizeof escaped, "\\x%02X", static_cast<unsigned char>(letter));
            text += escaped;
        }
    return text;
}

void print_text(const std::vector<IndexRow>& rows, const std::vector<geoidx_section>& sections,
                const geoidx_info& info) {
    for (const IndexRow& row : rows) std::printf("%-28s %s\n", row.label, row.value.c_str());
    const auto vertices = static_cast<double>(info.welded_vertex_count);
    std::printf("\n%-8s %-8s %12s %12s %14s\n", "section", "coding", "bytes", "decoded", "bytes a vertex");
    for (const geoidx_section& section : sections)
        std::printf("%-8s %-8s %12llu %12llu %14.2f\n", tag_of(section).c_str(), coding_of(section),
                    static_cast<unsigned long long>(section.stored_size),
                    static_cast<unsigned long long>(section.raw_size),
                    vertices > 0 ? static_cast<double>(section.stored_size) / vertices : 0);
}

std::string json_of(const std::vector<geoidx_section>& sections) {
    std::string list;
    for (const geoidx_section& section : sections)
        list += std::string(list.empty() ? "" : ", ") + "{\"tag\": " + json_text(tag_of(section)) +
                ", \"coding\": " + json_text(coding_of(section)) +
                ", \"offset\": " + std::to_string(section.offset) +
                ", \"stored_size\": " + std::to_string(section.stored_size) +
                ", \"raw_size\": " + std::to_string(section.raw_size) + "}";
    return "[" + list + "]";
}

void print_json(const std::vector<IndexRow>& rows, const std::vector<geoidx_section>& sections) {
    JsonObject object;
    add_rows(rows, object);
    object.json("sections", json_of(sections));
    object.print();
}

void info(const InfoArguments& arguments) {
    const Index index = open_index_with(arguments.mesh, arguments.index);
    const geoidx_info about = info_of(*index, arguments.index);
    const std::vector<IndexRow> rows = rows_of_index(about, arguments.index, arguments.json);
    const std::vector<geoidx_section> sections = sections_of(*index, arguments.index);
    arguments.json ? print_json(rows, sections) : print_text(rows, sections, about);
}

}

void add_info(CLI::App& app) {
    auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "show what an index is and how accurate");
    command->add_option("FILE", arguments->index, "index file")->required();
    add_mesh_option(*command, arguments->mesh);
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { info(*arguments); });
}

}
