#include "tools/commands/index_output.h"

#include <algorithm>

#include "tools/failure.h"
#include "tools/library.h"
#include "tools/output_file.h"
#include "tools/signals.h"

namespace geodesic::tools {

namespace {

geoidx_save_options options_of(const FileForm& form) {
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = static_cast<uint32_t>(std::ranges::find(CODEC_NAMES, form.codec) - CODEC_NAMES.begin());
    if (form.no_positions) options.flags |= GEOIDX_SAVE_NO_POSITIONS;
    if (form.no_mesh) options.flags |= GEOIDX_SAVE_NO_MESH;
    return options;
}

}

void add_form_options(CLI::App& command, FileForm& form) {
    form.codec = CODEC_NAMES.front();
    command
        .add_option("--codec", form.codec,
                    "the form of the file: packed is small; lossless has a PNG of floats a table, as in the "
                    "paper; mapped is large, and open at once")
        ->check(CLI::IsMember(CODEC_NAMES))
        ->capture_default_str();
    command.add_flag("--no-positions", form.no_positions,
                     "leave the vertices' positions out of the file, which then opens with --mesh only");
}

void require_mesh_or_no_positions(const FileForm& form, bool keeps_mesh) {
    if (form.no_positions && keeps_mesh && !form.no_mesh)
        throw CLI::ValidationError(
            "a file without positions opens with --mesh only, so that it is of no use to keep "
            "the mesh in it: leave out --no-positions or the mesh");
}

void require_index_output(const std::string& output, const std::string& input) {
    require_writable(output, {&input, 1});
    require_no_terminal(output);
    // The library replaces what is at the path, which must not happen to a device.
    if (is_device_or_pipe(output)) throw Failure(output + ": is not a regular file; - is standard output");
}

void save_index(const geoidx& index, const FileForm& form, const std::string& path) {
    const geoidx_save_options options = options_of(form);
    if (path == STANDARD_OUTPUT) return write_file(path, saved_bytes(index, options, path));
    const SignalsHeldBack until_renamed;
    require_ok(geoidx_save(&index, behind_links(path).c_str(), &options), path);
}

geoidx_info info_of_saved(const geoidx& index, const FileForm& form, const std::string& path) {
    const geoidx_save_options options = options_of(form);
    geoidx_info info = info_of(index, path);
    if (info.engine == GEOIDX_ENGINE_OVERLAY) info.codec = options.codec;
    info.file_flags = options.flags & GEOIDX_SAVE_NO_POSITIONS;
    if (form.no_mesh) info.has_mesh = 0;
    return info;
}

void require_json_apart(bool json, const std::string& output) {
    if (json && output == STANDARD_OUTPUT)
        throw CLI::ValidationError("standard output is for one of -o and --json, not for both");
}

}
