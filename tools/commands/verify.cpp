#include <cstdio>

#include "tools/commands/commands.h"
#include "tools/failure.h"
#include "tools/library.h"
#include "tools/read_file.h"

namespace geodesic::tools {

namespace {

struct Issues {
    size_t count = 0;
    std::string first;
};

int32_t on_issue(void* user, geoidx_status, uint64_t offset, const char* message) {
    Issues& issues = *static_cast<Issues*>(user);
    std::printf("byte %llu: %s\n", static_cast<unsigned long long>(offset), message);
    if (issues.count++ == 0) issues.first = message;
    return 1;
}

std::string bytes_of(const std::string& path) {
    try {
        return read_file(path);
    } catch (const std::runtime_error& error) {
        throw Failure(path + ": " + error.what());
    }
}

// The problems go to stdout, where a list belongs; stderr gets its one line.
void verify(const std::string& path) {
    const std::string bytes = bytes_of(path);
    Issues issues;
    const geoidx_status status = geoidx_verify(bytes.data(), bytes.size(), on_issue, &issues);
    if (status != GEOIDX_OK && issues.count > 1)
        throw Failure(path + ": " + std::to_string(issues.count) + " problems, the first: " + issues.first);
    if (status != GEOIDX_OK && issues.count == 1) throw Failure(path + ": " + issues.first);
    require_ok(status, path);
    std::printf("%s: ok\n", path.c_str());
}

}

void add_verify(CLI::App& app) {
    auto path = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("verify", "check every byte of an index");
    command->add_option("FILE", *path, "index file")->required();
    command->callback([path] { verify(*path); });
}

}
