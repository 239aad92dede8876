#include "tools/commands/arguments.h"

#include <charconv>

#include "tools/failure.h"
#include "tools/library.h"
#include "tools/mesh_io/text_scanner.h"

namespace geodesic::tools {

namespace {

// Of standard input, which is data: what is wrong in it is a failure, not wrong usage.
uint32_t vertex_id_of_line(std::string_view word, const TextScanner& lines) {
    try {
        return vertex_id(word);
    } catch (const CLI::ValidationError& error) {
        throw Failure("standard input: line " + std::to_string(lines.line_number()) + ": " + error.what());
    }
}

}

uint32_t vertex_id(std::string_view word) {
    uint32_t id = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, id);
    if (error == std::errc::result_out_of_range)
        throw CLI::ValidationError("vertex id " + quoted(word) + " is not below 2^32");
    if (error != std::errc{} || stop != end) throw CLI::ValidationError(quoted(word) + " is not a vertex id");
    return id;
}

std::vector<uint32_t> vertex_ids(std::span<const std::string> words) {
    std::vector<uint32_t> ids;
    for (const std::string& word : words) ids.push_back(vertex_id(word));
    return ids;
}

std::vector<uint32_t> vertex_pairs_of_text(std::string_view text) {
    std::vector<uint32_t> ids;
    TextScanner lines(text);
    std::string_view line;
    while (lines.next_filled_line(line)) {
        const std::string_view source = take_word(line);
        const std::string_view target = take_word(line);
        if (target.empty() || !take_word(line).empty())
            throw Failure("standard input: line " + std::to_string(lines.line_number()) +
                          ": a pair is two vertex ids");
        ids.push_back(vertex_id_of_line(source, lines));
        ids.push_back(vertex_id_of_line(target, lines));
    }
    return ids;
}

CLI::Validator whole_number() {
    const auto check = [](const std::string& word) -> std::string {
        uint64_t value = 0;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error == std::errc::result_out_of_range) return "'" + word + "' is too large";
        if (error != std::errc{} || stop != word.data() + word.size())
            return "'" + word + "' is not a whole number";
        return {};
    };
    return CLI::Validator(check, "");
}

CLI::Option* add_mesh_option(CLI::App& command, std::string& mesh) {
    return command.add_option("--mesh", mesh, "the index's mesh, which a file without positions needs");
}

void add_metric_options(CLI::App& command, MetricArguments& arguments) {
    command.add_option("--metric", arguments.metric, "what a distance is: exact or edges")
        ->check(CLI::IsMember({"exact", "edges"}))
        ->capture_default_str();
    command
        .add_option("--weld-tolerance", arguments.weld_tolerance,
                    "vertices at most this far apart are one; 0: equal positions only")
        ->capture_default_str();
    command.add_flag("--refuse-edges-of-many", arguments.refuse_edges_of_many,
                     "fail where an edge has more than two triangles");
}

void apply(const MetricArguments& arguments, geoidx_build_options& options) {
    options.metric = metric_of_name(arguments.metric);
    options.weld_tolerance = arguments.weld_tolerance;
    options.refuse_edges_of_many = arguments.refuse_edges_of_many ? 1 : 0;
}

}
