#include "tools/commands/index_output.h"

#include <algorithm>

#include "tools/failure.h"
#include "tools/library.h"
#include "tools/output_file.h"
#include "tools/signals.h"

namespace geodesic::tools {

uint32_t codec_of_name(const std::string& name) {
    return static_cast<uint32_t>(std::ranges::find(CODEC_NAMES, name) - CODEC_NAMES.begin());
}

void add_codec_option(CLI::App& command, std::string& codec) {
    codec = CODEC_NAMES.front();
    command
        .add_option("--codec", codec,
                    "the form of the file: packed is small; lossless has a PNG of floats a table, as in the "
                    "paper; mapped is large, and open at once")
        ->check(CLI::IsMember(CODEC_NAMES))
        ->capture_default_str();
}

void require_index_output(const std::string& output, const std::string& input) {
    require_writable(output, {&input, 1});
    require_no_terminal(output);
    // The library replaces what is at the path, which must not happen to a device.
    if (is_device_or_pipe(output)) throw Failure(output + ": is not a regular file; - is standard output");
}

void save_index(const geoidx& index, uint32_t codec, const std::string& path) {
    if (path == STANDARD_OUTPUT) return write_file(path, saved_bytes(index, codec, path));
    geoidx_save_options options;
    geoidx_save_options_init(&options);
    options.codec = codec;
    const SignalsHeldBack until_renamed;
    require_ok(geoidx_save(&index, behind_links(path).c_str(), &options), path);
}

geoidx_info info_of_saved(const geoidx& index, uint32_t codec, const std::string& path) {
    geoidx_info info = info_of(index, path);
    if (info.engine == GEOIDX_ENGINE_OVERLAY) info.codec = codec;
    return info;
}

void require_json_apart(bool json, const std::string& output) {
    if (json && output == STANDARD_OUTPUT)
        throw CLI::ValidationError("standard output is for one of -o and --json, not for both");
}

}
