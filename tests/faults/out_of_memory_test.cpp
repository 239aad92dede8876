// Every allocation that can fail fails in turn, those of zstd, libpng and the C++ library too: the answer is
// the right one or GEOIDX_ERROR_OUT_OF_MEMORY, and what was tried can be tried again. What takes long skips
// some of the later ones, by strides that are primes, so that they meet each kind; with GEOIDX_EVERY_FAULT in
// the environment no allocation is skipped, which takes about half an hour.

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/faults/faults.h"
#include "tests/query/planted_pairs.h"
#include "tests/support/temporary_directory.h"

using namespace geodesic::test;

namespace {

constexpr Source SOURCES[] = {Source::caller, Source::process};
constexpr uint32_t ENGINES[] = {GEOIDX_ENGINE_GRAPH, GEOIDX_ENGINE_OVERLAY};

// Of the allocations of a query, each of which is followed by every question.
constexpr uint64_t ASKING_STRIDE = 17;

constexpr uint32_t THREADS[] = {1, 4};

// Two parts that borders divide, one that none does, and vertices that no triangle uses.
TestMesh several_parts() {
    TestMesh mesh = hills(7, 6);
    mesh.add_vertex(50, 0, 0);
    append(mesh, hills(6, 6), 20);
    append(mesh, one_triangle(), 100);
    return mesh;
}

geoidx_build_options options_of(uint32_t engine, uint32_t threads = 1) {
    auto options = build_options(GEOIDX_METRIC_EXACT, 3);
    options.engine = engine;
    options.threads = threads;
    std::fill_n(options.patches, 3, 2u);
    return options;
}

// For a mesh of one part and one of several, by both engines.
void for_each_kind(const std::function<void(const TestMesh&, uint32_t engine)>& test) {
    for (const TestMesh& mesh : {hills(9, 8), several_parts()})
        for (uint32_t engine : ENGINES) {
            CAPTURE(mesh.vertex_count());
            CAPTURE(engine);
            test(mesh, engine);
        }
}

void for_each_file(const std::function<void(const Bytes& file)>& test) {
    for_each_kind([&](const TestMesh& mesh, uint32_t engine) {
        const Bytes file = save(build(mesh, options_of(engine)).get());
        if (engine == GEOIDX_ENGINE_GRAPH) return test(file);
        const auto numbers = numbers_of_ids(file, mesh.vertex_count());
        const Bytes steep = steep_section(planted_edges(mesh, 7), numbers);
        test(save(open(with_section(file, geodesic::TAG_STEEP_EDGES, steep)).get()));
    });
}

geoidx_open_options opening_with(const geoidx_allocator& allocator) {
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.allocator = allocator;
    return options;
}

IndexHandle open_with(const Bytes& file, const geoidx_allocator& allocator) {
    const auto options = opening_with(allocator);
    geoidx* index = nullptr;
    require_success(geoidx_open_memory(file.data(), file.size(), &options, &index));
    return IndexHandle(index);
}

Bytes content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> content{std::istreambuf_iterator<char>(file), {}};
    Bytes bytes(content.size());
    std::memcpy(bytes.data(), content.data(), content.size());
    return bytes;
}

void write(const std::filesystem::path& path, const Bytes& content) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(content.data()), static_cast<std::streamsize>(content.size()));
}

// ---- Questions

// Ids all over the mesh, the unused vertex and every part among them.
std::vector<uint32_t> some_vertices(uint32_t vertex_count, uint32_t count) {
    std::vector<uint32_t> vertices;
    for (uint32_t i = 0; i < count; ++i) vertices.push_back(i * (vertex_count - 1) / (count - 1));
    return vertices;
}

struct Asked {
    const geoidx* index;
    geoidx_query* query;
    uint32_t vertex_count;
    std::vector<uint32_t> few, many; // vertices
    std::vector<uint32_t> pairs;
    std::vector<float> answer; // with room for the largest
    std::vector<uint32_t> ids; // that an answer names, one for each vertex

    Asked(const geoidx* index, geoidx_query* query)
        : index(index), query(query), vertex_count(static_cast<uint32_t>(info_of(index).vertex_count)),
          few(some_vertices(vertex_count, 4)), many(some_vertices(vertex_count, 18)),
          answer(size_t{18} * vertex_count), ids(vertex_count) {
        for (uint32_t a : many)
            for (uint32_t b : few) pairs.insert(pairs.end(), {a, b});
        clear();
    }

    void clear() { std::fill(answer.begin(), answer.end(), -1.0f); }
};

struct Question {
    const char* name;
    bool uses_threads;
    geoidx_status (*ask)(Asked& asked);
};

uint32_t size_of(const std::vector<uint32_t>& vertices) { return static_cast<uint32_t>(vertices.size()); }

const Question QUESTIONS_TO_A_QUERY[] = {
    {"sssd", false,
     [](Asked& a) {
         for (size_t i = 0; i < a.pairs.size() / 2; ++i)
             if (const auto status =
                     geoidx_query_sssd(a.query, a.pairs[2 * i], a.pairs[2 * i + 1], &a.answer[i]))
                 return status;
         return geoidx_status{GEOIDX_OK};
     }},
    {"prepared", false,
     [](Asked& a) {
         if (const auto status = geoidx_query_prepare(a.query, a.few[1])) return status;
         return geoidx_query_prepared(a.query, a.many.data(), a.many.size(), a.answer.data());
     }},
    {"msad of one", true,
     [](Asked& a) {
         return geoidx_query_msad(a.query, a.few.data() + 1, 1, a.answer.data(), a.vertex_count);
     }},
    {"msad of several", true,
     [](Asked& a) {
         return geoidx_query_msad(a.query, a.many.data(), size_of(a.many), a.answer.data(), a.vertex_count);
     }},
    {"msad of two", true,
     [](Asked& a) { return geoidx_query_msad(a.query, a.few.data(), 2, a.answer.data(), a.vertex_count); }},
    {"msad within", true,
     [](Asked& a) {
         return geoidx_query_msad_within(a.query, a.few.data(), size_of(a.few), 3, a.answer.data(),
                                         a.vertex_count);
     }},
    {"farthest points", true,
     [](Asked& a) {
         uint32_t points[5], count;
         return geoidx_query_farthest_points(a.query, a.few.data(), size_of(a.few), 5, points,
                                             a.answer.data(), &count);
     }},
    {"nearest sources", true,
     [](Asked& a) {
         const auto status = geoidx_query_nearest_sources(a.query, a.many.data(), size_of(a.many),
                                                          a.ids.data(), a.answer.data(), a.vertex_count);
         if (status == GEOIDX_OK) std::ranges::copy(a.ids, a.answer.begin() + a.vertex_count);
         return status;
     }},
    {"within", false,
     [](Asked& a) {
         uint32_t count;
         return geoidx_query_within(a.query, a.few.data(), size_of(a.few), 3, a.ids.data(), a.answer.data(),
                                    a.vertex_count, &count);
     }},
    {"nearest targets", false,
     [](Asked& a) {
         uint32_t positions[3], count;
         return geoidx_query_nearest_targets(a.query, a.few[2], a.many.data(), size_of(a.many), positions,
                                             a.answer.data(), 3, &count);
     }},
    {"matrix", false,
     [](Asked& a) {
         return geoidx_query_matrix(a.query, a.many.data(), size_of(a.many), a.few.data(), size_of(a.few),
                                    a.answer.data(), a.many.size() * a.few.size());
     }},
    {"ssad batch", false,
     [](Asked& a) {
         return geoidx_query_ssad_batch(a.query, a.many.data(), size_of(a.many), a.answer.data(),
                                        uint64_t{size_of(a.many)} * a.vertex_count);
     }},
};

const Question QUESTIONS_TO_AN_INDEX[] = {
    {"sssd of an index", false,
     [](Asked& a) { return geoidx_sssd(a.index, a.few[0], a.few[1], &a.answer[0]); }},
    {"sssd batch", false,
     [](Asked& a) {
         return geoidx_sssd_batch(a.index, a.pairs.data(), a.pairs.size() / 2, a.answer.data());
     }},
    {"msad of an index", false,
     [](Asked& a) {
         return geoidx_msad(a.index, a.few.data(), size_of(a.few), a.answer.data(), a.vertex_count);
     }},
    {"matrix of an index", false,
     [](Asked& a) {
         return geoidx_matrix(a.index, a.many.data(), size_of(a.many), a.many.data(), size_of(a.many),
                              a.answer.data(), a.many.size() * a.many.size());
     }},
    {"ssad batch of an index", false,
     [](Asked& a) {
         return geoidx_ssad_batch(a.index, a.many.data(), size_of(a.many), a.answer.data(),
                                  uint64_t{size_of(a.many)} * a.vertex_count);
     }},
};

using Answers = std::vector<std::vector<float>>; // one a question

Answers answers_to(std::span<const Question> questions, Asked& asked) {
    Answers answers;
    for (const Question& question : questions) {
        CAPTURE(question.name);
        asked.clear();
        require_success(question.ask(asked));
        answers.push_back(asked.answer);
    }
    return answers;
}

// The question at hand fails or is answered rightly, and so are all questions of its kind after that.
void ask_with_fault(Fault& fault, Asked& asked, std::span<const Question> questions, size_t at_hand,
                    const Answers& right) {
    asked.clear();
    const geoidx_status status = fault.disturb([&] { return questions[at_hand].ask(asked); });
    if (status == GEOIDX_OK) CHECK(asked.answer == right[at_hand]);
    if (fault.failures() > 0) CHECK(answers_to(questions, asked) == right);
}

}

TEST_CASE("out of memory while opening") {
    for_each_file([](const Bytes& file) {
        for (Source source : SOURCES) {
            const uint64_t stride = source == Source::caller ? 1 : 3;
            const uint64_t failed = try_with_faults(source, stride, [&](Fault& fault) {
                const auto options = opening_with(fault.allocator());
                geoidx* index = nullptr;
                const geoidx_status status = fault.disturb(
                    [&] { return geoidx_open_memory(file.data(), file.size(), &options, &index); });
                CHECK((status == GEOIDX_OK) == (index != nullptr));
                if (index) CHECK(save(index) == file);
                geoidx_close(index);
            });
            CHECK(failed > 20);
        }
    });
}

TEST_CASE("out of memory while opening with the mesh, whose positions the file leaves out") {
    for_each_kind([](const TestMesh& mesh, uint32_t engine) {
        const auto built = build(mesh, options_of(engine));
        const Bytes whole = save(built.get());
        const Bytes file = save(built.get(), GEOIDX_CODEC_PACKED, GEOIDX_SAVE_NO_POSITIONS);
        const geoidx_mesh view = mesh.view();
        for (Source source : SOURCES) {
            const uint64_t stride = source == Source::caller ? 1 : 3;
            const uint64_t failed = try_with_faults(source, stride, [&](Fault& fault) {
                auto options = opening_with(fault.allocator());
                options.expected_mesh = &view;
                geoidx* index = nullptr;
                const geoidx_status status = fault.disturb(
                    [&] { return geoidx_open_memory(file.data(), file.size(), &options, &index); });
                CHECK((status == GEOIDX_OK) == (index != nullptr));
                if (index) CHECK(save(index) == whole);
                geoidx_close(index);
            });
            CHECK(failed > 20);
        }
    });
}

TEST_CASE("out of memory while a surface is made of the mesh that an index keeps") {
    const TestMesh mesh = hills(6, 6);
    for (const bool is_double : {false, true}) {
        const FloatMesh floats(mesh);
        const geoidx_mesh view = is_double ? mesh.view() : floats.view();
        auto options = options_of(GEOIDX_ENGINE_OVERLAY);
        options.store_mesh = 1;
        geoidx* built = nullptr;
        require_success(geoidx_build(&view, &options, &built));
        const IndexHandle index(built);
        const uint64_t failed = try_with_faults(Source::process, 1, [&](Fault& fault) {
            geoidx_surface* surface = nullptr;
            const geoidx_status status =
                fault.disturb([&] { return geoidx_surface_of_index(index.get(), nullptr, &surface); });
            CHECK((status == GEOIDX_OK) == (surface != nullptr));
            geoidx_surface_close(surface);
        });
        CHECK(failed > 20);
    }
}

TEST_CASE("out of memory while opening a file") {
    const TemporaryDirectory directory;
    const std::string path = (directory.path() / "index.gidx").string();
    const Bytes file = save(build(hills(6, 6), options_of(GEOIDX_ENGINE_OVERLAY)).get());
    write(path, file);
    try_with_faults(Source::process, 3, [&](Fault& fault) {
        geoidx* index = nullptr;
        const geoidx_status status =
            fault.disturb([&] { return geoidx_open(path.c_str(), nullptr, &index); });
        CHECK((status == GEOIDX_OK) == (index != nullptr));
        geoidx_close(index);
    });
}

TEST_CASE("out of memory while verifying") {
    for_each_file([](const Bytes& file) {
        const auto count = [](void* user, const geoidx_issue*) {
            ++*static_cast<uint32_t*>(user);
            return 1;
        };
        try_with_faults(Source::process, 5, [&](Fault& fault) {
            uint32_t issues = 0; // a lack of memory is none
            fault.disturb([&] { return geoidx_verify(file.data(), file.size(), count, &issues); });
            CHECK(issues == 0);
        });
    });
}

TEST_CASE("out of memory while saving to memory") {
    for_each_file([](const Bytes& file) {
        const IndexHandle index = open(file);
        const uint64_t failed = try_with_faults(Source::process, 5, [&](Fault& fault) {
            Bytes saved(file.size());
            uint64_t size = 0;
            const geoidx_status status = fault.disturb(
                [&] { return geoidx_save_memory(index.get(), nullptr, saved.data(), saved.size(), &size); });
            if (status == GEOIDX_OK) CHECK(saved == file);
        });
        CHECK(failed > 20);
    });
}

// Whatever fails, the old file or the new one is there, and no other.
TEST_CASE("out of memory while saving to a file, over a symbolic link too") {
    const TemporaryDirectory directory;
    const auto path = directory.path() / "index.gidx", link = directory.path() / "link.gidx";
    std::filesystem::create_symlink(path, link);
    const Bytes old(100, std::byte{7});
    const IndexHandle index = build(hills(6, 6), options_of(GEOIDX_ENGINE_OVERLAY));
    const Bytes file = save(index.get());
    for (const std::string& destination : {path.string(), link.string()})
        try_with_faults(Source::process, 7, [&](Fault& fault) {
            write(path, old);
            const geoidx_status status =
                fault.disturb([&] { return geoidx_save(index.get(), destination.c_str(), nullptr); });
            CHECK(content_of(path) == (status == GEOIDX_OK ? file : old));
            const std::filesystem::directory_iterator entries(directory.path());
            CHECK(std::distance(begin(entries), end(entries)) == 2);
        });
}

TEST_CASE("out of memory while creating a query") {
    for_each_file([](const Bytes& file) {
        for (Source source : SOURCES)
            try_with_faults(source, 1, [&](Fault& fault) {
                const IndexHandle index = open_with(file, fault.allocator());
                geoidx_query* query = nullptr;
                const geoidx_status status =
                    fault.disturb([&] { return geoidx_query_create(index.get(), &query); });
                CHECK((status == GEOIDX_OK) == (query != nullptr));
                geoidx_query_close(query);
            });
    });
}

TEST_CASE("out of memory while a query is asked") {
    for_each_file([](const Bytes& file) {
        const IndexHandle undisturbed = open(file);
        const QueryHandle its_query = query_of(undisturbed.get());
        Asked reference(undisturbed.get(), its_query.get());
        const Answers right = answers_to(QUESTIONS_TO_A_QUERY, reference);
        uint64_t failed = 0;
        for (const uint32_t threads : THREADS)
            for (size_t q = 0; q < std::size(QUESTIONS_TO_A_QUERY); ++q) {
                if (threads > 1 && !QUESTIONS_TO_A_QUERY[q].uses_threads) continue;
                CAPTURE(threads);
                CAPTURE(QUESTIONS_TO_A_QUERY[q].name);
                for (Source source : SOURCES)
                    failed += try_with_faults(source, ASKING_STRIDE, [&](Fault& fault) {
                        const IndexHandle index = open_with(file, fault.allocator());
                        const QueryHandle query = query_of(index.get());
                        require_success(geoidx_query_set_threads(query.get(), threads));
                        Asked asked(index.get(), query.get());
                        ask_with_fault(fault, asked, QUESTIONS_TO_A_QUERY, q, right);
                    });
            }
        CHECK(failed > 20);
    });
}

TEST_CASE("out of memory while an index is asked") {
    for_each_file([](const Bytes& file) {
        const IndexHandle undisturbed = open(file);
        Asked reference(undisturbed.get(), nullptr);
        const Answers right = answers_to(QUESTIONS_TO_AN_INDEX, reference);
        for (size_t q = 0; q < std::size(QUESTIONS_TO_AN_INDEX); ++q) {
            CAPTURE(QUESTIONS_TO_AN_INDEX[q].name);
            for (Source source : SOURCES) {
                const uint64_t stride = source == Source::process ? 2 : 1;
                const uint64_t failed = try_with_faults(source, stride, [&](Fault& fault) {
                    const IndexHandle index = open_with(file, fault.allocator());
                    Asked asked(index.get(), nullptr);
                    ask_with_fault(fault, asked, QUESTIONS_TO_AN_INDEX, q, right);
                });
                CHECK(failed > 10);
            }
        }
    });
}

TEST_CASE("out of memory while a query is given threads") {
    const Bytes file = save(build(hills(12, 11), options_of(GEOIDX_ENGINE_OVERLAY)).get());
    const IndexHandle undisturbed = open(file);
    const QueryHandle its_query = query_of(undisturbed.get());
    Asked reference(undisturbed.get(), its_query.get());
    const Answers right = answers_to(QUESTIONS_TO_A_QUERY, reference);
    for (uint32_t threads = 2; threads <= 4; ++threads)
        for (Source source : SOURCES) {
            const uint64_t failed = try_with_faults(source, 3, [&](Fault& fault) {
                const IndexHandle index = open_with(file, fault.allocator());
                const QueryHandle query = query_of(index.get());
                fault.disturb([&] { return geoidx_query_set_threads(query.get(), threads); });
                Asked asked(index.get(), query.get());
                CHECK(answers_to(QUESTIONS_TO_A_QUERY, asked) == right);
            });
            CHECK(failed > 10);
        }
}

// A failed preparation leaves no source prepared, not even the last one.
TEST_CASE("out of memory while a query is prepared anew") {
    const Bytes file = save(build(hills(12, 11), options_of(GEOIDX_ENGINE_OVERLAY)).get());
    uint64_t failed = 0;
    for (Source source : SOURCES)
        try_with_faults(source, 1, [&](Fault& fault) {
            const IndexHandle index = open_with(file, fault.allocator());
            const QueryHandle query = query_of(index.get());
            const geoidx_status status = fault.disturb([&] { return geoidx_query_prepare(query.get(), 5); });
            float distance = -1;
            const uint32_t target = 60;
            if (status != GEOIDX_OK) {
                ++failed;
                CHECK(geoidx_query_prepared(query.get(), &target, 1, &distance) ==
                      GEOIDX_ERROR_INVALID_ARGUMENT);
            }
            require_success(geoidx_query_prepare(query.get(), 5));
            require_success(geoidx_query_prepared(query.get(), &target, 1, &distance));
            CHECK(distance > 0);
        });
    CHECK(failed > 0);
}

TEST_CASE("out of memory while building") {
    for_each_kind([](const TestMesh& mesh, uint32_t engine) {
        const geoidx_mesh view = mesh.view();
        const Bytes file = save(build(mesh, options_of(engine)).get());
        for (const uint32_t threads : THREADS)
            for (Source source : SOURCES) {
                CAPTURE(threads);
                const uint64_t stride = source == Source::caller ? 13 : 2999;
                const uint64_t failed = try_with_faults(source, stride, [&](Fault& fault) {
                    auto options = options_of(engine, threads);
                    options.allocator = fault.allocator();
                    geoidx* index = nullptr;
                    const geoidx_status status =
                        fault.disturb([&] { return geoidx_build(&view, &options, &index); });
                    CHECK((status == GEOIDX_OK) == (index != nullptr));
                    if (index) CHECK(save(index) == file);
                    geoidx_close(index);
                });
                CHECK(failed > 5);
            }
    });
}

TEST_CASE("out of memory while building a small index") {
    const TestMesh mesh = hills(5, 5);
    const geoidx_mesh view = mesh.view();
    for (uint32_t engine : ENGINES) {
        auto options = options_of(engine, 2);
        options.level_count = 1;
        options.metric = GEOIDX_METRIC_EDGES;
        try_with_faults(Source::process, 47, [&](Fault& fault) {
            geoidx* index = nullptr;
            const geoidx_status status = fault.disturb([&] { return geoidx_build(&view, &options, &index); });
            CHECK((status == GEOIDX_OK) == (index != nullptr));
            geoidx_close(index);
        });
    }
}

TEST_CASE("out of memory while solving without an index") {
    const TestMesh mesh = several_parts();
    const geoidx_mesh view = mesh.view();
    const std::vector<uint32_t> sources = some_vertices(mesh.vertex_count(), 3);
    const auto options = build_options();
    const SolverHandle undisturbed = solver(mesh, options);
    const auto right = metric_distances(undisturbed.get(), sources, mesh.vertex_count());
    try_with_faults(Source::process, 1, [&](Fault& fault) {
        geoidx_solver* made = nullptr;
        const geoidx_status status =
            fault.disturb([&] { return geoidx_solver_create(&view, &options, &made); });
        CHECK((status == GEOIDX_OK) == (made != nullptr));
        geoidx_solver_close(made);
    });
    try_with_faults(Source::process, 1, [&](Fault& fault) {
        const SolverHandle own = solver(mesh, options);
        std::vector<double> distances(mesh.vertex_count());
        const geoidx_status status = fault.disturb([&] {
            return geoidx_solver_distances(own.get(), sources.data(), size_of(sources), nullptr,
                                           mesh.vertex_count(), distances.data());
        });
        if (status == GEOIDX_OK) CHECK(distances == right);
        CHECK(metric_distances(own.get(), sources, mesh.vertex_count()) == right);
    });
    // What a solve for a target has left, the next one does not take for its own.
    const uint32_t first = sources.front(), last = sources.back(), target = mesh.vertex_count() / 2;
    const auto distance_from = [&](geoidx_solver& from_solver, uint32_t source, double& distance) {
        return geoidx_solver_distances(&from_solver, &source, 1, &target, 1, &distance);
    };
    double from_first = 0, from_last = 0;
    require_success(distance_from(*undisturbed, first, from_first));
    require_success(distance_from(*undisturbed, last, from_last));
    try_with_faults(Source::process, 1, [&](Fault& fault) {
        const SolverHandle own = solver(mesh, options);
        double distance = 0;
        const geoidx_status status = fault.disturb([&] { return distance_from(*own, first, distance); });
        if (status == GEOIDX_OK) CHECK(distance == from_first);
        require_success(distance_from(*own, last, distance));
        CHECK(distance == from_last);
    });
}
