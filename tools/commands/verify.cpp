#include <cstdio>
#include <vector>

#include "tools/commands/commands.h"
#include "tools/failure.h"
#include "tools/json.h"
#include "tools/library.h"
#include "tools/read_file.h"

namespace geodesic::tools {

namespace {

struct VerifyArguments {
    std::string index;
    bool json = false;
};

struct Problem {
    uint32_t number;
    geoidx_status status;
    uint64_t byte;
    std::string message;
};

int32_t on_issue(void* user, const geoidx_issue* issue) {
    static_cast<std::vector<Problem>*>(user)->push_back(
        {issue->number, issue->status, issue->offset, issue->message});
    return 1;
}

void print_text(const std::string& path, const std::vector<Problem>& problems, bool ok) {
    for (const Problem& problem : problems)
        std::printf("issue %u, byte %llu: %s\n", problem.number,
                    static_cast<unsigned long long>(problem.byte), problem.message.c_str());
    if (ok) std::printf("%s: ok\n", path.c_str());
}

void print_json(const std::string& path, const std::vector<Problem>& problems, bool ok) {
    std::string list;
    for (const Problem& problem : problems)
        list += (list.empty() ? "" : ",") + ("\n    {\"number\": " + std::to_string(problem.number)) +
                ", \"byte\": " + std::to_string(problem.byte) +
                ", \"kind\": " + json_text(geoidx_status_string(problem.status)) +
                ", \"message\": " + json_text(problem.message) + "}";
    JsonObject().text("index", path).truth("ok", ok).json("problems", "[" + list + "]").print();
}

int32_t on_start_issue(void* user, const geoidx_issue* issue) {
    const bool tells_all = issue->number == GEOIDX_ISSUE_MAGIC || issue->number == GEOIDX_ISSUE_VERSION ||
                           issue->number == GEOIDX_ISSUE_FEATURE_FLAGS;
    if (tells_all) *static_cast<bool*>(user) = false;
    return 0;
}

// Whether more than the first bytes can matter: not those of a file that is no index, which may be endless.
bool may_be_index(const std::string& start) {
    bool may_be = true;
    geoidx_verify(start.data(), start.size(), on_start_issue, &may_be);
    return may_be;
}

std::string bytes_of(const std::string& path) {
    try {
        return read_file_if(path, may_be_index);
    } catch (const std::runtime_error& error) {
        throw Failure(path + ": " + error.what());
    }
}

// The problems go to stdout, where a list belongs; stderr gets its one line.
void verify(const VerifyArguments& arguments) {
    const std::string& path = arguments.index;
    const std::string bytes = bytes_of(path);
    std::vector<Problem> problems;
    const geoidx_status status = geoidx_verify(bytes.data(), bytes.size(), on_issue, &problems);
    const bool ok = status == GEOIDX_OK;
    arguments.json ? print_json(path, problems, ok) : print_text(path, problems, ok);
    if (!ok && problems.size() > 1)
        throw Failure(path + ": " + std::to_string(problems.size()) +
                      " problems, the first: " + problems.front().message);
    if (!ok && problems.size() == 1) throw Failure(path + ": " + problems.front().message);
    require_ok(status, path);
}

}

void add_verify(CLI::App& app) {
    auto arguments = std::make_shared<VerifyArguments>();
    CLI::App* command = app.add_subcommand("verify", "check every byte of an index");
    command->add_option("FILE", arguments->index, "index file")->required();
    command->add_flag("--json", arguments->json, "print a JSON object");
    command->callback([arguments] { verify(*arguments); });
}

}
