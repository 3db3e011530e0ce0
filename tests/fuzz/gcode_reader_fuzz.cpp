// libFuzzer: whatever the bytes, the reader answers with layers or with Error (unreadable).
//
//     cmake -B build-fuzz -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DRIBVAULT_BUILD_FUZZERS=ON -DRIBVAULT_BUILD_TESTS=OFF
//     cmake --build build-fuzz --target gcode_reader_fuzz
//     build-fuzz/bin/gcode_reader_fuzz -dict=tests/fuzz/gcode.dict NEW_INPUTS tests/corpus/gcode
//     tests/fuzz/gcode_inputs
#include <cstdlib>
#include <string_view>

#include "ribvault/error.hpp"
#include "ribvault/print/read_gcode.hpp"

namespace {

void require(bool holds) {
    if (!holds) std::abort();
}

/// What every reader of a GcodePrint relies on.
void check(const ribvault::GcodePrint& print) {
    require(!print.layers.empty());
    for (std::size_t k = 0; k < print.layers.size(); ++k) {
        const ribvault::GcodeLayer& layer = print.layers[k];
        require(!layer.tracks.empty() && layer.height > 0 && layer.layer < print.layer_count);
        require(k == 0 || print.layers[k - 1].z <= layer.z);
        require(layer.on_bed == (layer.below.empty() && layer.under_air.empty()));
        require((layer.air_layers > 0) == !layer.under_air.empty() && (layer.below.empty() || layer.under_air.empty()));
        for (const std::size_t j : layer.below) require(j < k && print.layers[j].z < layer.z);
        for (const std::size_t j : layer.under_air) require(j < k && print.layers[j].z < layer.z);
        for (const ribvault::GcodeTrack& t : layer.tracks)
            require(t.a < layer.points.size() && t.b < layer.points.size() && t.width > 0 &&
                    t.feature < print.features.size() && t.line > 0 && t.line <= print.lines);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    try {
        check(ribvault::read_gcode(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz"));
    } catch (const ribvault::Error& e) {
        require(e.kind() == ribvault::ErrorKind::unreadable);
    }
    return 0;
}
