#include <atomic>
#include <functional>
#include <memory>
#include <new>

#include "bench/commands.h"
#include "bench/report.h"
#include "bench/rows.h"
#include "bench/statistics.h"
#include "bench/timing.h"
#include "tools/library.h"
#include "tools/mesh_io/mesh_io.h"

namespace geodesic::bench {

namespace {

struct OpenArguments {
    std::vector<std::string> files;
    std::string mesh;
    uint32_t rounds = 9;
    ReportArguments report;
};

// Counts the bytes that an index and its queries hold.
class CountedMemory {
public:
    uint64_t bytes() const { return bytes_; }
    geoidx_allocator allocator() { return {allocate, release, this}; }

private:
    static void* allocate(void* user, uint64_t size, uint64_t alignment) {
        void* memory = ::operator new (size, std::align_val_t{alignment}, std::nothrow);
        if (memory) static_cast<CountedMemory*>(user)->bytes_ += size;
        return memory;
    }
    static void release(void* user, void* memory, uint64_t size, uint64_t alignment) {
        static_cast<CountedMemory*>(user)->bytes_ -= size;
        ::operator delete (memory, std::align_val_t{alignment});
    }

    std::atomic<uint64_t> bytes_ = 0; // an index is opened on several threads
};

// What one round of opening and first questions took: milliseconds from its beginning, and bytes.
struct Round {
    double opened_ms, field_ms, pair_ms;
    uint64_t opened_bytes, field_bytes, pair_bytes;
    uint64_t vertices;
};

// `mesh` may be null.
tools::Index open_in(CountedMemory& memory, const std::string& path, const geoidx_mesh* mesh,
                     uint32_t threads) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = mesh;
    options.allocator = memory.allocator();
    options.threads = threads;
    geoidx* index = nullptr;
    tools::require_ok(geoidx_open(path.c_str(), &options, &index), path);
    return tools::Index(index);
}

double milliseconds_of(const std::function<void()>& work) { return 1e3 * time_of(work).wall; }

Round open_once(const std::string& path, const geoidx_mesh* mesh, uint32_t threads) {
    CountedMemory memory;
    Round round{};
    tools::Index index;
    round.opened_ms = milliseconds_of([&] { index = open_in(memory, path, mesh, threads); });
    round.opened_bytes = memory.bytes();

    const geoidx_info info = tools::info_of(*index, path);
    round.vertices = info.welded_vertex_count;
    const auto count = static_cast<uint32_t>(info.vertex_count);
    const uint32_t source = count / 3;
    std::vector<float> field(count);
    round.field_ms = round.opened_ms + milliseconds_of([&] {
                         tools::require_ok(geoidx_msad(index.get(), &source, 1, field.data(), count), path);
                     });
    round.field_bytes = memory.bytes();
    float distance = 0;
    round.pair_ms = round.field_ms + milliseconds_of([&] {
                        tools::require_ok(geoidx_sssd(index.get(), source, count - 1, &distance), path);
                    });
    round.pair_bytes = memory.bytes();
    return round;
}

Row open_row(const std::string& path, const geoidx_mesh* mesh, uint32_t threads, uint32_t rounds) {
    std::vector<double> opened, field, pair;
    Round round{};
    for (uint32_t i = 0; i < rounds; ++i) {
        round = open_once(path, mesh, threads);
        opened.push_back(round.opened_ms);
        field.push_back(round.field_ms);
        pair.push_back(round.pair_ms);
    }
    const auto each = [&](uint64_t bytes) {
        return static_cast<double>(bytes) / static_cast<double>(round.vertices);
    };
    return {{"index", "index", path},
            {"vertices", "vertices", round.vertices},
            {"threads", "threads", uint64_t{threads}},
            {"open_ms", "open ms", median(opened)},
            {"first_field_ms", "to the first field", median(field)},
            {"first_pair_ms", "to the first pair", median(pair)},
            {"index_bytes_per_vertex", "bytes a vertex", each(round.opened_bytes)},
            {"field_bytes_per_vertex", "with a field", each(round.field_bytes)},
            {"pair_bytes_per_vertex", "with a pair", each(round.pair_bytes)}};
}

void open(const OpenArguments& arguments) {
    Report report("open", {{"rounds", "rounds", uint64_t{arguments.rounds}}}, arguments.report);
    Table table{"open", "Opening and memory", {}};
    tools::TriangleMesh mesh;
    if (!arguments.mesh.empty()) mesh = tools::read_mesh(arguments.mesh);
    const geoidx_mesh view = tools::view_of(mesh);
    const geoidx_mesh* expected = arguments.mesh.empty() ? nullptr : &view;
    for (const std::string& file : arguments.files)
        for (const uint32_t threads : {1u, 2u}) {
            progress(file);
            table.rows.push_back(open_row(file, expected, threads, arguments.rounds));
        }
    report.add(std::move(table));
    report.note(
        "Medians. The file is in the page cache but for the first round. The first pair comes after the "
        "field. Memory is that of the index and its scratch, in the caller's allocator.");
}

}

void add_open(CLI::App& app) {
    auto arguments = std::make_shared<OpenArguments>();
    CLI::App* command = app.add_subcommand("open", "times of opening, and memory, of index files");
    command->add_option("INDEX", arguments->files, "index files")->required();
    command->add_option("--mesh", arguments->mesh, "of all of these indices, for files without positions");
    command->add_option("--rounds", arguments->rounds, "of which the median counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    add_report_options(*command, arguments->report);
    command->callback([arguments] { open(*arguments); });
}

}
