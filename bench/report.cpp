#include "bench/report.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "bench/machine.h"
#include "tools/failure.h"

namespace geodesic::bench {

namespace {

void print(const Row& row) {
    for (const Field& field : row)
        std::printf("%s: %s\n", field.heading.c_str(), to_text(field.value, field.digits).c_str());
}

}

void add_report_options(CLI::App& command, ReportArguments& arguments) {
    command.add_option("--json", arguments.json, "file to write the results to as JSON");
}

Report::Report(std::string command, Row parameters, const ReportArguments& arguments)
    : command_(std::move(command)), machine_(machine_description()), parameters_(std::move(parameters)),
      json_path_(arguments.json) {
    write_json();
    std::printf("# geoidx_bench %s\n\n", command_.c_str());
    print(machine_);
    print(parameters_);
    std::fflush(stdout);
}

void Report::add(Table table) {
    if (table.rows.empty()) return;
    std::printf("\n## %s\n\n%s", table.title.c_str(), to_text(table).c_str());
    std::fflush(stdout);
    tables_.push_back(std::move(table));
    write_json();
}

void Report::note(const std::string& line) {
    std::printf("\n%s\n", line.c_str());
    std::fflush(stdout);
    notes_.push_back(line);
    write_json();
}

void Report::write_json() const {
    if (json_path_.empty()) return;
    std::string text = "{\n  \"command\": " + json_string(command_) +
                       ",\n  \"machine\": " + to_json(machine_) +
                       ",\n  \"parameters\": " + to_json(parameters_) + ",\n  \"notes\": [";
    for (size_t i = 0; i < notes_.size(); ++i) text += (i ? ", " : "") + json_string(notes_[i]);
    text += ']';
    for (const Table& table : tables_) text += ",\n  " + json_string(table.key) + ": " + to_json(table, "  ");
    write_text_file(json_path_, text + "\n}\n");
}

void write_text_file(const std::string& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw tools::Failure(path + ": " + std::strerror(errno));
}

void progress(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

}
