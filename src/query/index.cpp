#include "src/query/index.h"

#include <algorithm>
#include <utility>

#include "format/error.h"
#include "geoidx.h"
#include "src/base/array.h"
#include "src/file/code_tables.h"
#include "src/graph/prepare.h"
#include "src/index/section_tags.h"
#include "src/overlay/prepare/prepare.h"
#include "src/overlay/sssd/labels.h"
#include "src/overlay/sssd/pair_tables.h"

namespace geodesic {

namespace {

uint32_t count_vertices_with_id(const StoredIndex& stored) {
    std::vector<bool> has_id(stored.positions.size(), false);
    for (const uint32_t number : stored.number_of_id)
        if (number != NONE) has_id[number] = true;
    return static_cast<uint32_t>(std::ranges::count(has_id, true));
}

}

void prepare(const StoredIndex& stored, Index& index) {
    index.description = stored.description;
    index.number_of_id.assign(stored.number_of_id.begin(), stored.number_of_id.end());
    index.vertices_with_id = count_vertices_with_id(stored);
    if (stored.description.codec == GEOIDX_CODEC_MAPPED)
        index.mesh = stored.mesh;
    else
        keep_mesh(stored.mesh, index);
    if (stored.description.engine == GEOIDX_ENGINE_OVERLAY)
        prepare_overlay(stored, index.engine.emplace<OverlayIndex>(index.memory));
    else
        prepare_graph(stored, index.engine.emplace<GraphIndex>(index.memory));
}

void keep_mesh(const format::StoredBytes& mesh, Index& index) {
    index.mesh_bytes.assign(mesh.bytes.begin(), mesh.bytes.end());
    index.mesh = {mesh.codec, mesh.raw_size, index.mesh_bytes};
}

void prepare_pairs(const Index& index) {
    const auto* const overlay = std::get_if<OverlayIndex>(&index.engine);
    if (!overlay) return;
    require_pair_tables(*overlay);
    make_all_labels(*overlay);
}

void release_pairs(const Index& index) {
    if (const auto* const overlay = std::get_if<OverlayIndex>(&index.engine)) release_pair_tables(*overlay);
}

void leave_out_labels(Index& index) {
    if (auto* const overlay = std::get_if<OverlayIndex>(&index.engine)) overlay->pairs.has_labels = false;
}

StoredIndex restore(const Index& index) {
    StoredIndex stored;
    stored.description = index.description;
    stored.number_of_id.assign(index.number_of_id.begin(), index.number_of_id.end());
    stored.mesh = index.mesh;
    if (const auto* const overlay = std::get_if<OverlayIndex>(&index.engine))
        restore_overlay(*overlay, stored);
    else
        restore_graph(std::get<GraphIndex>(index.engine), stored);
    return stored;
}

void require_hops_follow(const Index& index) {
    StoredIndex stored = restore(index);
    if (const auto code = code_between_steps(stored))
        throw Error(GEOIDX_ERROR_CORRUPT, "section HOPS holds " + *code, TAG_HOP_CODES);
    const auto codes = std::exchange(stored.hop_codes, {});
    stored.description.codec = GEOIDX_CODEC_PACKED;
    Index again(global_heap());
    prepare(stored, again);
    if (!std::ranges::equal(std::get<OverlayIndex>(again.engine).hops.codes, codes))
        throw Error(GEOIDX_ERROR_CORRUPT, "section HOPS: tables of the same distances contradict each other",
                    TAG_HOP_CODES);
}

uint64_t table_entries(const Index& index) {
    const Numbering& numbering = index.numbering();
    if (const auto* const graph = std::get_if<GraphIndex>(&index.engine))
        return numbering.leaf_entries() + graph->border_tables.size();
    return numbering.overlay_engine_entries();
}

}
