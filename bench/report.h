#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "bench/table.h"

namespace geodesic::bench {

// What every subcommand takes.
struct ReportArguments {
    std::string json; // file; empty: none
};
void add_report_options(CLI::App& command, ReportArguments& arguments);

// The output of one subcommand: what was asked on which machine, then tables. Printed as it grows; the JSON
// file is whole after each table, so that an interrupted run keeps what it measured.
class Report {
public:
    Report(std::string command, Row parameters, const ReportArguments& arguments);

    void add(Table table); // nothing where it has no rows
    void note(const std::string& line);

private:
    void write_json() const;

    std::string command_;
    Row machine_;
    Row parameters_;
    std::string json_path_;
    std::vector<Table> tables_;
    std::vector<std::string> notes_;
};

// Throws tools::Failure("path: why").
void write_text_file(const std::string& path, const std::string& text);

// A line on stderr about what is being done now.
void progress(const std::string& line);

}
