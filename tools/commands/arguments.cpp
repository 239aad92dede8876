#include "tools/commands/arguments.h"

#include <charconv>

#include "tools/library.h"

namespace geodesic::tools {

namespace {

uint32_t vertex_id(const std::string& word) {
    uint32_t id = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, id);
    if (error == std::errc::result_out_of_range)
        throw CLI::ValidationError("vertex id '" + word + "' is not below 2^32");
    if (error != std::errc{} || stop != end) throw CLI::ValidationError("'" + word + "' is not a vertex id");
    return id;
}

}

std::vector<uint32_t> vertex_ids(std::span<const std::string> words) {
    std::vector<uint32_t> ids;
    for (const std::string& word : words) ids.push_back(vertex_id(word));
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
