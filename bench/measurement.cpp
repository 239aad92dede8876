#include "bench/measurement.h"

#include <algorithm>
#include <memory>

namespace geodesic::bench {

namespace {

constexpr size_t PREPARED_TARGETS = 50; // of each prepared source

// One thread's questions about one index; the answers of msad() live in `field`.
class Questions {
public:
    Questions(const geoidx& index, const Model& model)
        : name_(model.path), field_(model.mesh.vertex_count()), query_(tools::make_query(index, name_)) {}

    float sssd(uint32_t source, uint32_t target) {
        float distance = 0;
        tools::require_ok(geoidx_query_sssd(query_.get(), source, target, &distance), name_);
        return distance;
    }

    void prepare(uint32_t source) { tools::require_ok(geoidx_query_prepare(query_.get(), source), name_); }

    float prepared(uint32_t target) {
        float distance = 0;
        tools::require_ok(geoidx_query_prepared(query_.get(), &target, 1, &distance), name_);
        return distance;
    }

    void batch(std::span<const uint32_t> sources) {
        fields_.resize(sources.size() * field_.size());
        tools::require_ok(geoidx_query_ssad_batch(query_.get(), sources.data(),
                                                  static_cast<uint32_t>(sources.size()), fields_.data(),
                                                  fields_.size()),
                          name_);
    }

    void set_threads(uint32_t count) {
        tools::require_ok(geoidx_query_set_threads(query_.get(), count), name_);
    }

    const std::vector<float>& msad(uint32_t source) {
        tools::require_ok(
            geoidx_query_msad(query_.get(), &source, 1, field_.data(), static_cast<uint32_t>(field_.size())),
            name_);
        return field_;
    }

private:
    const std::string& name_;
    std::vector<float> field_, fields_;
    tools::Query query_;
};

void add_pairs_of_field(size_t field, Questions& questions, const std::vector<float>& msad,
                        const Workload& workload, IndexErrors& errors) {
    for (size_t i = field; i < workload.pairs.size(); i += workload.error_sources.size()) {
        const Pair& pair = workload.pairs[i];
        const double sssd = double{questions.sssd(pair.source, pair.target)};
        errors.sssd.add(sssd, pair.exact);
        errors.difference.add(sssd, double{msad[pair.target]}, pair.exact);
    }
}

}

geoidx_build_options options_for(uint32_t threads, const std::vector<uint32_t>& patches) {
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.threads = threads;
    options.level_count = static_cast<uint32_t>(patches.size());
    std::copy(patches.begin(), patches.end(), options.patches);
    return options;
}

BuiltIndex build_index(const Model& model, const geoidx_build_options& options) {
    const geoidx_mesh view = tools::view_of(model.mesh);
    geoidx* index = nullptr;
    geoidx_status status = GEOIDX_OK;
    const Duration time =
        time_of([&] { status = geoidx_build(&view, &options, &index); }, CpuTime::of_process);
    tools::require_ok(status, model.path);
    return {tools::Index(index), time};
}

uint64_t file_size(const geoidx& index, const std::string& name) {
    uint64_t bytes = 0;
    tools::require_ok(geoidx_save_memory(&index, nullptr, nullptr, 0, &bytes), name);
    return bytes;
}

QueryTimes time_queries(const geoidx& index, const Model& model, const Workload& workload) {
    Questions questions(index, model);
    const std::span sources(workload.timed_sources), targets(workload.timed_targets);
    std::vector<Duration> sssd, prepared, msad, threads, batch;
    questions.msad(sources.front()); // brings the tables into memory
    for (const uint32_t source : sources) msad.push_back(time_of([&] { questions.msad(source); }));
    questions.set_threads(MSAD_THREADS);
    for (const uint32_t source : sources) threads.push_back(time_of([&] { questions.msad(source); }));
    for (size_t i = 0; i < sources.size(); ++i)
        sssd.push_back(time_of([&] { questions.sssd(sources[i], targets[i]); }));
    for (size_t i = 0; i < sources.size(); ++i) {
        if (i % PREPARED_TARGETS == 0) questions.prepare(sources[i]);
        prepared.push_back(time_of([&] { questions.prepared(targets[i]); }));
    }
    questions.batch(sources.first(BATCH));
    for (size_t i = 0; i + BATCH <= sources.size(); i += BATCH)
        batch.push_back(time_of([&] { questions.batch(sources.subspan(i, BATCH)); }));
    return {median(sssd), median(prepared), median(msad), median(threads), median(batch)};
}

IndexErrors measure_errors(const geoidx& index, const Model& model, const Workload& workload) {
    Questions questions(index, model);
    IndexErrors errors;
    for (size_t i = 0; i < workload.error_sources.size(); ++i) {
        const std::vector<double>& exact = workload.exact_fields[i];
        const std::vector<float>& answers = questions.msad(workload.error_sources[i]);
        for (size_t v = 0; v < exact.size(); ++v) errors.msad.add(double{answers[v]}, exact[v]);
        add_pairs_of_field(i, questions, answers, workload, errors);
    }
    return errors;
}

Measurement measure(const BuiltIndex& built, const Model& model, const Workload& workload) {
    const geoidx& index = *built.index;
    return {tools::info_of(index, model.path), file_size(index, model.path), built.time,
            time_queries(index, model, workload), measure_errors(index, model, workload)};
}

}
