// The outputs that show the geometry of every layer: the layers file and the run page.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/layer_spool.hpp"
#include "ribvault/report/run_report.hpp"

namespace ribvault {

/// Both begin with what is known last and go from the bed upwards, so the layers wait on disk.
class ShapeOutputs {
public:
    /// Throws Error (cannot_write) when a file cannot be made.
    void open(const std::optional<std::filesystem::path>& layers, const std::optional<std::filesystem::path>& page);
    /// The next layer from the top downwards, with its shapes_json and packed_shapes where there is a file for them.
    void add(const LayerReport& layer, const std::string& shapes, const std::string& packed);
    /// After the last layer; `report` is summed up. Throws Error (cannot_write).
    void write(const RunReport& report);
    /// Puts the files under their names.
    void commit();

private:
    struct Output {
        AtomicFile file;
        LayerSpool spool;
    };
    std::optional<Output> layers_, page_;
};

}  // namespace ribvault
