#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>

#include <fcntl.h>
#include <unistd.h>

#include "geoidx.h"
#include "tools/commands/commands.h"
#include "tools/failure.h"
#include "tools/mesh_io/text_scanner.h"
#include "tools/signals.h"
#include "tools/spelling.h"

namespace geodesic::tools {

namespace {

enum ExitStatus { SUCCESS = 0, FAILURE = 1, WRONG_USAGE = 2 };

std::string version_text() {
    const uint32_t version = geoidx_version();
    return "geoidx " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

std::string chosen_command(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? "" : chosen.front()->get_name();
}

int report(const CLI::App& app, std::string message, ExitStatus status) {
    std::ranges::replace(message, '\n', ' '); // a file name may hold one
    const std::string command = chosen_command(app);
    const std::string prefix = command.empty() ? "" : command + ": ";
    std::fprintf(stderr, "geoidx: %s%s\n", prefix.c_str(), message.c_str());
    if (status == WRONG_USAGE)
        std::fprintf(stderr, "see 'geoidx %s--help'\n", command.empty() ? "" : (command + " ").c_str());
    return status;
}

// CLI11 itself says only that a subcommand is missing, or that an option before it is not expected.
std::string message_of(const CLI::App& app, const CLI::ParseError& error, const char* word) {
    const std::string command = chosen_command(app);
    if (word && *word == '-')
        return quoted(word) + " stands before the command; options come after it, as in 'geoidx " +
               (command.empty() ? "COMMAND" : command) + " ... " + word + "'";
    if (!command.empty() || !word) return error.what();
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
    const std::string meant = probable_word(word, names);
    const std::string unknown = "there is no command " + quoted(word);
    if (!meant.empty()) return unknown + "; did you mean '" + meant + "'?";
    return unknown + "; there are " + CLI::detail::join(names, ", ");
}

void add_commands(CLI::App& app) {
    app.name("geoidx");
    app.require_subcommand(1);
    app.footer("Exit status: 0 success, 1 failure, 2 wrong usage, 130 after Ctrl-C.");
    app.set_version_flag("--version", version_text());
    add_build(app);
    add_convert(app);
    add_info(app);
    add_verify(app);
    add_sssd(app);
    add_path(app);
    add_msad(app);
    add_exact(app);
    add_bench(app);
}

// A stream that is closed would lend its number to the next file that is opened, and what is printed would
// land there. What takes its place is opened the other way round, so that using it fails.
void keep_standard_streams_open() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (fcntl(stream, F_GETFD) < 0) [[maybe_unused]]
            const int same = open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

// A full disk shows only when the last of the output goes out.
void flush_output() {
    if (std::fflush(stdout) != 0 || std::ferror(stdout))
        throw Failure(std::string("standard output: ") + std::strerror(errno));
}

void parse(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        app.exit(help_or_version); // prints it
        std::cout.flush();
        if (!std::cout) throw Failure(std::string("standard output: ") + std::strerror(errno));
    }
}

int run(CLI::App& app, int argc, char** argv) {
    try {
        keep_standard_streams_open();
        exit_on_signals();
        add_commands(app);
        parse(app, argc, argv);
        flush_output();
        return SUCCESS;
    } catch (const CLI::ParseError& error) {
        return report(app, message_of(app, error, argc > 1 ? argv[1] : nullptr), WRONG_USAGE);
    } catch (const std::bad_alloc&) {
        return report(app, "out of memory", FAILURE);
    } catch (const std::exception& error) {
        return report(app, error.what(), FAILURE);
    }
}

}

}

int main(int argc, char** argv) {
    CLI::App app("Geodesic distances on triangle meshes, precomputed once, answered from one file.");
    return geodesic::tools::run(app, argc, argv);
}
