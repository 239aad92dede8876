// What an index says of itself.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "format/container.h"
#include "geoidx.h"
#include "src/capi/handles.h"
#include "src/capi/status.h"

using namespace geodesic;

namespace {

// Tables in which all distances are 0 have no steps.
void fill_steps(const OverlayIndex& index, geoidx_info& info) {
    for (uint32_t p = 0; p < index.numbering.patch_count(); ++p) {
        const double step = std::ldexp(double{index.quantum[p]}, index.shift[p]);
        if (step == 0) continue;
        info.largest_step = std::max(info.largest_step, step);
        info.smallest_step = info.smallest_step == 0 ? step : std::min(info.smallest_step, step);
    }
}

void fill_info(const Index& index, geoidx_info& info) {
    const Description& about = index.description;
    const Numbering& numbering = index.numbering();
    info.metric = about.metric;
    info.metric_flags = about.metric_flags;
    info.metric_fingerprint = about.metric_fingerprint;
    info.vertex_count = about.id_count;
    info.triangle_count = about.triangle_count;
    info.welded_vertex_count = index.vertices_with_id;
    info.mesh_fingerprint = about.mesh_fingerprint;
    info.engine = about.engine;
    info.table_entries = table_entries(index);
    info.border_vertex_count = numbering.border_vertex_count();
    info.bounding_box_diagonal = about.bounding_box_diagonal;
    info.delta = about.delta;
    info.seed = about.seed;
    info.format_major = format::FORMAT_MAJOR;
    info.format_minor = about.format_minor;
    info.level_count = numbering.level_count();
    for (uint32_t l = 1; l <= numbering.level_count(); ++l)
        info.patch_count[l - 1] = numbering.level_begin[l + 1] - numbering.level_begin[l];
    info.error_sources = about.error.sources;
    info.error_mean = about.error.mean;
    info.error_signed_mean = about.error.signed_mean;
    info.error_p99 = about.error.p99;
    info.error_p999 = about.error.p999;
    info.error_max = about.error.max;
    info.error_mean_at_vertices = about.error.mean_at_vertices;
    info.codec = about.codec;
    info.file_flags = about.file_flags;
    info.has_mesh = index.keeps_mesh() ? 1 : 0;
    info.added_vertex_count = numbering.vertex_count() - index.vertices_with_id;
    const auto& [near_by, middle, far_off] = about.error.by_distance;
    info.error_near_mean = near_by.mean;
    info.error_near_max = near_by.max;
    info.error_middle_mean = middle.mean;
    info.error_middle_max = middle.max;
    info.error_far_mean = far_off.mean;
    info.error_far_max = far_off.max;
    info.error_several_mean = about.error.several.mean;
    info.error_several_max = about.error.several.max;
    if (const auto* overlay = std::get_if<OverlayIndex>(&index.engine)) fill_steps(*overlay, info);
}

}

geoidx_status geoidx_get_info(const geoidx* index, geoidx_info* info) {
    return guarded([&] {
        require(index, "index is NULL");
        require(info, "info is NULL");
        require(info->struct_size >= sizeof(uint32_t), "struct_size is not set");
        geoidx_info whole_info{};
        fill_info(index->index, whole_info);
        whole_info.struct_size = std::min<uint32_t>(info->struct_size, sizeof whole_info);
        std::memcpy(info, &whole_info, whole_info.struct_size);
    });
}
