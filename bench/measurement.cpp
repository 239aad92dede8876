#include "bench/measurement.h"

#include <algorithm>
#include <memory>

namespace geodesic::bench {

namespace {

struct QueryCloser {
    void operator()(geoidx_query* query) const { geoidx_query_close(query); }
};
using Query = std::unique_ptr<geoidx_query, QueryCloser>;

// One thread's questions about one index; the answers of msad() live in `field`.
class Questions {
public:
    Questions(const geoidx& index, const Model& model)
        : name_(model.path), field_(model.mesh.vertex_count()) {
        geoidx_query* query = nullptr;
        tools::require_ok(geoidx_query_create(&index, &query), name_);
        query_.reset(query);
    }

    float sssd(const Pair& pair) {
        float distance = 0;
        tools::require_ok(geoidx_query_sssd(query_.get(), pair.source, pair.target, &distance), name_);
        return distance;
    }

    const std::vector<float>& msad(uint32_t source) {
        tools::require_ok(
            geoidx_query_msad(query_.get(), &source, 1, field_.data(), static_cast<uint32_t>(field_.size())),
            name_);
        return field_;
    }

private:
    const std::string& name_;
    std::vector<float> field_;
    Query query_;
};

void add_pairs_of_field(size_t field, Questions& questions, const std::vector<float>& msad,
                        const Workload& workload, IndexErrors& errors) {
    for (size_t i = field; i < workload.pairs.size(); i += workload.error_sources.size()) {
        const Pair& pair = workload.pairs[i];
        const double sssd = double{questions.sssd(pair)};
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
    tools::require_ok(geoidx_save_memory(&index, nullptr, 0, &bytes), name);
    return bytes;
}

QueryTimes time_queries(const geoidx& index, const Model& model, const Workload& workload) {
    Questions questions(index, model);
    std::vector<Duration> sssd, msad;
    questions.msad(workload.error_sources.front()); // brings the tables into memory
    for (const uint32_t source : workload.timed_sources)
        msad.push_back(time_of([&] { questions.msad(source); }));
    questions.sssd(workload.pairs.back());
    for (size_t i = 0; i < std::min<size_t>(TIMED_QUERIES, workload.pairs.size()); ++i)
        sssd.push_back(time_of([&] { questions.sssd(workload.pairs[i]); }));
    return {median(sssd), median(msad)};
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
