#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

// What an index file holds, by the words of format/SPEC.md, which this is written from, and not from src.
namespace geodesic::file_campaign {

constexpr uint32_t NOTHING = UINT32_MAX;
constexpr float NO_PATH = std::numeric_limits<float>::infinity();

struct Matrix {
    std::vector<float> values;
    uint32_t rows = 0, cols = 0;
};

struct FileContent {
    // A segment between two positions of a border of which none follows the other.
    struct Bridge {
        uint32_t slot, end; // counted over all borders, and in its own
        float length;
    };

    uint32_t engine = 0, metric = 0, metric_flags = 0;
    bool is_packed = false; // overlay engine only
    float bound_scale = 0;
    double delta = 0, diagonal = 1;

    std::vector<uint32_t> level_begin; // of the levels 0 .. L + 1
    std::vector<uint32_t> children;    // per inner patch
    std::vector<uint32_t> parent;      // per patch

    std::vector<uint32_t> number_of_id;
    float position_step = 1;
    std::array<double, 3> position_origin{};
    std::vector<std::array<int32_t, 3>> positions; // per vertex number
    // If positions are left out: the mesh that they come from, x, y, z of each id and three ids a triangle.
    bool has_positions = true;
    std::vector<double> mesh_positions;
    std::vector<uint32_t> triangles;

    std::vector<uint32_t> owned;                // per inner patch
    std::vector<uint32_t> internal;             // per leaf
    std::vector<std::vector<uint32_t>> borders; // per patch; the root has none

    std::vector<float> quantum;                     // per patch
    uint8_t shift = 0;                              // of all patches
    std::vector<std::vector<uint32_t>> next;        // per patch and position of its border: of segments
    std::vector<std::vector<float>> segment_length; // likewise
    std::vector<Bridge> bridges;

    std::vector<Matrix> border_tables, overlay_tables, border_internal_tables, internal_tables;

    bool is_canonical = true; // coded as the library itself codes it
    // Of each vertex number, a part of the mesh that no path leads out of; empty where entries say otherwise.
    std::vector<uint32_t> component;

    uint32_t level_count() const { return static_cast<uint32_t>(level_begin.size()) - 2; }
    uint32_t patch_count() const { return static_cast<uint32_t>(parent.size()); }
    uint32_t inner_count() const { return static_cast<uint32_t>(children.size()); }
    uint32_t vertex_count() const { return static_cast<uint32_t>(positions.size()); }
    uint32_t id_count() const { return static_cast<uint32_t>(number_of_id.size()); }
    bool is_overlay() const { return engine == 1; }
};

// The same seed gives the same content.
FileContent random_content(uint64_t seed);

struct WrittenFile {
    std::vector<std::byte> bytes;
    uint64_t raw_size = 0; // of all sections
};

// With right checksums.
WrittenFile write_content(const FileContent& content);

}
