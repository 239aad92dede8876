#include <cstdio>
#include <new>

#include "bench/commands.h"

namespace geodesic::bench {

namespace {

enum ExitStatus { SUCCESS = 0, FAILURE = 1, WRONG_USAGE = 2 };

int fail(const char* why, ExitStatus status) {
    std::fflush(stdout);
    std::fprintf(stderr, "geoidx_bench: %s\n", why);
    return status;
}

void add_commands(CLI::App& app) {
    app.name("geoidx_bench");
    app.require_subcommand(1);
    add_paper(app);
    add_queries(app);
    add_metric(app);
    add_error(app);
    add_several(app);
    add_farthest(app);
    add_nearest(app);
    add_matrix(app);
    add_tails(app);
    add_stated(app);
    add_open(app);
    add_pairs(app);
    add_paths(app);
    add_surface(app);
    add_weighted(app);
    add_files(app);
}

int run(CLI::App& app, int argc, char** argv) {
    try {
        add_commands(app);
        app.parse(argc, argv);
        return SUCCESS;
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const CLI::ParseError& error) {
        return fail(error.what(), WRONG_USAGE);
    } catch (const std::bad_alloc&) {
        return fail("out of memory", FAILURE);
    } catch (const std::exception& error) {
        return fail(error.what(), FAILURE);
    }
}

}

}

int main(int argc, char** argv) {
    CLI::App app("Measures geoidx: time, error, size.");
    return geodesic::bench::run(app, argc, argv);
}
