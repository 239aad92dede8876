// Opens files whose content was changed and whose checksums are right, and queries those that open. The first
// byte chooses: the rest as a file by itself, or changes to a small index of either engine, with positions or
// without, or with the mesh, six bytes each: section, position, value.
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "format/container.h"
#include "src/file/sections.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/copied_matrices.h"

using namespace geodesic;

namespace {

using Bytes = std::vector<std::byte>;

// Four by three cells, bent.
struct SmallMesh {
    std::vector<float> positions;
    std::vector<uint32_t> triangles;

    SmallMesh();
    geoidx_mesh view() const {
        geoidx_mesh mesh;
        geoidx_mesh_init(&mesh);
        mesh.positions = positions.data();
        mesh.vertex_count = positions.size() / 3;
        mesh.triangles = triangles.data();
        mesh.triangle_count = triangles.size() / 3;
        return mesh;
    }
};

SmallMesh::SmallMesh() {
    for (uint32_t y = 0; y < 4; ++y)
        for (uint32_t x = 0; x < 5; ++x) {
            const auto at = static_cast<float>(x), bend = static_cast<float>(x * x + y * y);
            positions.insert(positions.end(), {at, static_cast<float>(y), 0.05f * bend});
            if (x == 4 || y == 3) continue;
            const uint32_t v = x + 5 * y;
            triangles.insert(triangles.end(), {v, v + 1, v + 6, v, v + 6, v + 5});
        }
}

const SmallMesh& small_mesh() {
    static const SmallMesh mesh;
    return mesh;
}

Bytes small_index(uint32_t engine, uint32_t flags, uint32_t store_mesh = 0) {
    const geoidx_mesh mesh = small_mesh().view();
    geoidx_build_options options;
    geoidx_build_options_init(&options);
    options.engine = engine;
    options.level_count = 2;
    options.patches[0] = options.patches[1] = 2;
    options.threads = 1;
    options.store_mesh = store_mesh;
    geoidx* index = nullptr;
    fuzz::require(geoidx_build(&mesh, &options, &index) == GEOIDX_OK, "the small index is built");
    geoidx_save_options how;
    geoidx_save_options_init(&how);
    how.flags = flags;
    uint64_t size = 0;
    geoidx_save_memory(index, &how, nullptr, 0, &size);
    Bytes file(size);
    fuzz::require(geoidx_save_memory(index, &how, file.data(), size, &size) == GEOIDX_OK, "it is saved");
    geoidx_close(index);
    return file;
}

bool is_bytes(const format::Section& section) { return section.codec != format::Codec::Png; }

// Sections of bytes are changed; those of matrices stay.
Bytes changed(const Bytes& file, fuzz::Input input) {
    const auto container = format::Container::parse(file, INDEX_TAGS);
    const auto sections = container.sections();
    std::map<uint32_t, Bytes> raw;
    for (const format::Section& section : sections)
        if (is_bytes(section)) raw[section.tag] = container.read_bytes(section.tag, UINT64_MAX);
    while (!input.empty()) {
        const format::Section& section = sections[input.byte() % sections.size()];
        const uint32_t position = input.byte(), value = input.word();
        if (!is_bytes(section)) continue;
        Bytes& bytes = raw[section.tag];
        if (value == 0xD00D) bytes.resize(position); // shorter or longer
        for (size_t i = 0; i < 4 && position + i < bytes.size(); ++i)
            bytes[position + i] = static_cast<std::byte>(value >> 8 * i);
    }
    format::ContainerWriter writer(container.mesh_fingerprint());
    for (const format::Section& section : sections) {
        if (is_bytes(section))
            writer.add_bytes(section.tag, raw[section.tag]);
        else
            test::copy_images(container, file, section, writer);
    }
    return writer.finish();
}

// No answer is asked to be right: the content may say anything. None may be read from elsewhere.
void query(const geoidx& index) {
    geoidx_info info{};
    info.struct_size = sizeof info;
    fuzz::require(geoidx_get_info(&index, &info) == GEOIDX_OK, "info is given");
    const auto count = static_cast<uint32_t>(info.vertex_count);
    if (count > 1000) return;
    std::vector<float> distances(count);
    for (uint32_t source = 0; source < count; source += 3) {
        fuzz::require(geoidx_msad(&index, &source, 1, distances.data(), count) == GEOIDX_OK, "MSAD");
        fuzz::require(distances[source] == 0, "MSAD is 0 at its source");
        for (uint32_t target = 0; target < count; ++target) {
            float there = 0, back = 0;
            fuzz::require(geoidx_sssd(&index, source, target, &there) == GEOIDX_OK, "SSSD");
            fuzz::require(geoidx_sssd(&index, target, source, &back) == GEOIDX_OK, "SSSD back");
            fuzz::require(std::memcmp(&there, &back, sizeof there) == 0, "SSSD is symmetric");
        }
    }
}

// What geoidx_verify told first.
struct FirstIssue {
    size_t file_size;
    geoidx_status status = GEOIDX_OK;

    static int32_t take(void* user, const geoidx_issue* issue) {
        auto& first = *static_cast<FirstIssue*>(user);
        if (first.status == GEOIDX_OK) first.status = issue->status;
        fuzz::require(issue->offset <= first.file_size, "an issue is inside the file");
        fuzz::require(issue->number != 0, "an issue has a number");
        fuzz::require(issue->number != GEOIDX_ISSUE_WHOLE_INDEX || issue->status == GEOIDX_ERROR_LIMIT,
                      "what contradicts the format is in a section");
        return 1;
    }
};

void open(const void* data, size_t size) {
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(data, size, nullptr, &index);
    fuzz::require((status == GEOIDX_OK) == (index != nullptr), "there is an index or an error");
    FirstIssue first{size};
    fuzz::require(geoidx_verify(data, size, FirstIssue::take, &first) == status,
                  "verify says what open says");
    fuzz::require(first.status == status, "verify returns what it tells first");
    if (index) query(*index);
    geoidx_close(index);
}

// Verify has no mesh, so that it finds less.
void open_without_positions(const void* data, size_t size) {
    const geoidx_mesh mesh = small_mesh().view();
    geoidx_open_options options;
    geoidx_open_options_init(&options);
    options.expected_mesh = &mesh;
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(data, size, &options, &index);
    fuzz::require((status == GEOIDX_OK) == (index != nullptr), "there is an index or an error");
    FirstIssue first{size};
    const geoidx_status verified = geoidx_verify(data, size, FirstIssue::take, &first);
    fuzz::require(first.status == verified, "verify returns what it tells first");
    fuzz::require(status != GEOIDX_OK || verified == GEOIDX_OK, "verify accepts what opens");
    if (index) query(*index);
    geoidx_close(index);
}

// Verify looks at the mesh, too. Where it finds nothing, there is a surface.
void open_with_mesh(const void* data, size_t size) {
    geoidx* index = nullptr;
    const geoidx_status status = geoidx_open_memory(data, size, nullptr, &index);
    FirstIssue first{size};
    const geoidx_status verified = geoidx_verify(data, size, FirstIssue::take, &first);
    fuzz::require(first.status == verified, "verify returns what it tells first");
    fuzz::require(status == GEOIDX_OK || verified == status, "verify refuses what does not open");
    if (!index) return;
    geoidx_info info{};
    info.struct_size = sizeof info;
    fuzz::require(geoidx_get_info(index, &info) == GEOIDX_OK, "info is given");
    geoidx_surface* surface = nullptr;
    const geoidx_status made = geoidx_surface_of_index(index, nullptr, &surface);
    fuzz::require((made == GEOIDX_OK) == (surface != nullptr), "there is a surface or an error");
    if (info.has_mesh) fuzz::require(made == verified, "a surface is made where verify finds nothing");
    geoidx_surface_close(surface);
    geoidx_close(index);
}

}

constexpr uint8_t WITHOUT_POSITIONS = 0x80, WITH_MESH = 0xC0; // choices from here on

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const Bytes originals[] = {small_index(GEOIDX_ENGINE_GRAPH, 0),
                                      small_index(GEOIDX_ENGINE_OVERLAY, 0)};
    static const Bytes without_positions[] = {small_index(GEOIDX_ENGINE_GRAPH, GEOIDX_SAVE_NO_POSITIONS),
                                              small_index(GEOIDX_ENGINE_OVERLAY, GEOIDX_SAVE_NO_POSITIONS)};
    static const Bytes with_mesh[] = {small_index(GEOIDX_ENGINE_GRAPH, 0, 1),
                                      small_index(GEOIDX_ENGINE_OVERLAY, 0, 1)};
    fuzz::Input input({data, size});
    const uint8_t choice = input.byte();
    if (choice % 3 == 2) {
        open(input.rest().data(), input.rest().size());
    } else if (choice >= WITH_MESH) {
        const Bytes file = changed(with_mesh[choice % 3], input);
        open_with_mesh(file.data(), file.size());
    } else if (choice >= WITHOUT_POSITIONS) {
        const Bytes file = changed(without_positions[choice % 3], input);
        open_without_positions(file.data(), file.size());
    } else {
        const Bytes file = changed(originals[choice % 3], input);
        open(file.data(), file.size());
    }
    return 0;
}
